#!/usr/bin/env python3
"""Run time against error, ours and Mitsuba's, Cycles' and POV-Ray's:
    bench_error.py RAYTRACER [SCENE...] [--mitsuba PYTHON] [--bpy PYTHON] [--povray FILE] [--size 128] [--seeds 16] [--only gate|look]
For each scene of error_scenes.py: whether the pictures are the same (Welch's t of blocks, ../truth/ztest.py), two references of other
samplers, errors of 1, 4, 16, ... samples in rounds that alternate between renderers, and seconds to equal error. Ours has its usual
sampler, Mitsuba multijitter, Cycles its usual one, POV-Ray n x n samples in each pixel, none adaptive. Rows go to error.tsv
and points.tsv, plots to plots/, all beside this file. Pictures of gates and references are kept in build/error. It needs numpy and, for
plots, matplotlib; `make bench-error` runs it. Exit code 1 if a test of the statistics fails."""
import argparse, os, sys, unittest
sys.dont_write_bytecode = True
HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, os.path.join(HERE, "..", "truth"))
from dataclasses import replace
import numpy as np
import curves, error_scenes, kept, measures, plots, renderers, tables, ztest

SCENES = error_scenes.SCENES
GATE_SPP = {"povray": 16}  # others have the scene's


def tests_pass():
    return unittest.TextTestRunner(verbosity=0).run(unittest.defaultTestLoader.loadTestsFromName("test_statistics")).wasSuccessful()


def gate(scene, folder, ours, peers, options):
    """What ztest says of each peer, by name."""
    said, pictures = {}, kept.pictures(ours, scene, folder, scene.spp, options.seeds)
    for r in peers:
        if r.why: continue
        theirs = kept.pictures(r, scene, folder, GATE_SPP.get(r.name, scene.peer_spp), options.seeds)
        v = ztest.compare(pictures, theirs, scene.block, scene.hide, r.step)
        said[r.name] = v.why or "agrees"
        print("%s\t%s\tgate\t%s\tratio %.5f +- %.5f, channel z %+.1f, p %.3g of %d blocks, %d still; worst block %d,%d t=%+.1f" % (
            scene.name, r.name, said[r.name], v.ratio, v.error, v.channel_z, v.ks, v.blocks, v.still, *v.worst), flush=True)
    return said


def look(scene, folder, ours, peers, options):
    """Writes ours and the peers' mean pictures of the gate beside each other, as shown, and below the t of blocks: red where ours is
    brighter, blue where it is darker."""
    from matplotlib import image
    first = kept.pictures(ours, scene, folder, scene.spp, options.seeds)
    rows = [[first.mean(0)], [np.zeros_like(first[0])]]
    for r in peers:
        if r.why: continue
        theirs = kept.pictures(r, scene, folder, GATE_SPP.get(r.name, scene.peer_spp), options.seeds)
        t = np.kron(np.clip(ztest.compare(first, theirs, scene.block, scene.hide).t / 6, -1, 1), np.ones((scene.block, scene.block)))
        rows[0].append(theirs.mean(0))
        rows[1].append(np.stack([np.maximum(t, 0), 0 * t, np.maximum(-t, 0)], -1))
    image.imsave(os.path.join(folder, "look.png"), np.concatenate([measures.display(np.concatenate(rows[0], 1)), np.concatenate(rows[1], 1)]))


def bench(scene, folder, ours, peers, gates, options):
    def renderer_of(flags): return renderers.Ours(options.raytracer, scene, folder, options.threads, flags)
    pairs = [kept.reference(scene, folder, renderer_of, sampler, options.reference_seconds) for sampler in ("random", "stratified")]
    able = [ours] + [r for r in peers if not r.why]
    for r in able:
        if r.name == "mitsuba_llvm": r.note_compiling()
    points, floors = curves.measure(able, [p for p, _ in pairs], options.seeds, options.limit)
    rows = list(tables.error_rows(scene, [ours] + peers, points, gates, error_scenes.levels(scene)))
    for row in rows: print("\t".join(map(str, row)), flush=True)
    tables.put_rows("error.tsv", tables.COLUMNS, scene.name, rows)
    tables.put_rows("points.tsv", tables.POINT_COLUMNS, scene.name, tables.point_rows(scene, points, floors))
    plots.plot(scene, points, error_scenes.levels(scene), floors["display"], os.path.join(HERE, "plots"))


def main():
    options = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    options.add_argument("raytracer")
    options.add_argument("scene", nargs="*", metavar="SCENE", help="of " + " ".join(SCENES))
    options.add_argument("--mitsuba", default=sys.executable)
    options.add_argument("--bpy", default=sys.executable)
    options.add_argument("--povray", default="povray")
    options.add_argument("--folder", default="build/error")
    options.add_argument("--size", type=int, default=128, help="pixels of a side, a multiple of 8")
    options.add_argument("--seeds", type=int, default=16)
    options.add_argument("--threads", type=int, default=2)
    options.add_argument("--limit", type=float, default=2.0, help="seconds of the longest rendering of a curve")
    options.add_argument("--reference-seconds", type=float, default=45, help="of each of both references")
    options.add_argument("--only", choices=("gate", "look"), help="no times: whether pictures agree, and with look also build/error/SCENE/look.png")
    options = options.parse_intermixed_args()
    if not tests_pass(): return 1
    for name in options.scene or SCENES:
        scene = replace(SCENES[name](), size=options.size)
        folder = os.path.abspath(os.path.join(options.folder, name))
        os.makedirs(folder, exist_ok=True)
        ours, peers = renderers.Ours(options.raytracer, scene, folder, options.threads), renderers.peers(options, scene, folder)
        gates = gate(scene, folder, ours, peers, options)
        if options.only == "look": look(scene, folder, ours, peers, options)
        if not options.only: bench(scene, folder, ours, peers, gates, options)
        for r in peers: r.close()
    return 0


if __name__ == "__main__":
    sys.exit(main())
