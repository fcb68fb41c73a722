#!/usr/bin/env python3
"""Whether our pictures converge to those of Mitsuba 3 and of Cycles:
    truth.py RAYTRACER [SCENE...] [--mitsuba PYTHON] [--bpy PYTHON] [--folder build/truth] [--again] [--look]
Renders each scene of scenes.py by us and by its peer with 16 seeds or more, tests whether the means of blocks of
pixels and of whole pictures are the same (ztest.py), prints a line per scene, and writes them to tests/truth/truth.tsv.
Pictures of peers are kept in the folder and not rendered again unless --again is given; --look writes ours, theirs and the
t of blocks as PNG. --mitsuba: a python with mitsuba and numpy (pip install mitsuba; LLVM's shared library);
--bpy: one with bpy 4.5 (pip install bpy==4.5.15). Exit code 1 if a scene disagrees. It needs numpy itself; `make truth` runs it."""
import argparse, inspect, hashlib, os, subprocess, sys, time
sys.dont_write_bytecode = True
from dataclasses import replace
import numpy as np
import ours, scenes, ztest

HERE = os.path.dirname(os.path.abspath(__file__))
COLUMNS = ("scene", "peer", "seeds", "spp", "blocks", "block_noise_%", "ks_p", "ratio", "ratio_error", "channel_z",
           "verdict", "what", "note")


def peer_pictures(scene, folder, pythons, again):
    """From the last run where neither scene nor translator has changed."""
    side = os.path.join(HERE, scene.peer + "_side.py")
    with open(side, "rb") as file: code = file.read()
    key = hashlib.sha256(code + repr((scene.eye, scene.fov, scene.peer_spp, scene.seeds, scene.size)).encode() +
                         "\n".join(ours.text(replace(scene, spp=1))).encode()).hexdigest()[:12]
    out = os.path.join(folder, "%s-%s.npy" % (scene.peer, key))
    if again or not os.path.exists(out):
        log = os.path.join(folder, scene.peer + ".log")
        with open(log, "w") as file:
            code = subprocess.run([pythons[scene.peer], "-B", side, scene.name, out], stdout=file, stderr=file).returncode
        if code or not os.path.exists(out): raise SystemExit("error: %s failed; see %s" % (scene.peer, log))
    return np.load(out)


def put_row(name, row):
    """Replaces a row of the table, which keeps those of scenes that this run leaves out."""
    table, rows = os.path.join(HERE, "truth.tsv"), {}
    if os.path.exists(table):
        with open(table) as file: rows = {line.split("\t")[0]: line for line in list(file)[1:]}
    rows[name] = row + "\n"
    with open(table, "w") as file:
        file.write("\t".join(COLUMNS) + "\n")
        file.writelines(rows[n] for n in scenes.SCENES if n in rows)


def write_look(folder, scene, a, b, verdict):
    """ours | theirs | t of the blocks: red where ours is brighter, blue where it is darker."""
    a, b = a.mean(0), b.mean(0)
    top = max(np.percentile(b, 99), 1e-6)
    t = np.kron(np.clip(verdict.t / 6, -1, 1), np.ones((scene.block, scene.block)))
    marks = np.stack([np.maximum(t, 0), 0 * t, np.maximum(-t, 0)], -1)
    row = np.concatenate([np.clip(a / top, 0, 1) ** (1 / 2.2), np.clip(b / top, 0, 1) ** (1 / 2.2), marks], 1)
    with open(os.path.join(folder, "look.ppm"), "wb") as file:
        file.write(b"P6\n%d %d\n255\n" % (row.shape[1], row.shape[0]) + (row * 255 + 0.5).astype(np.uint8).tobytes())


def main():
    options = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    options.add_argument("raytracer")
    options.add_argument("scene", nargs="*")
    options.add_argument("--mitsuba", default=sys.executable)
    options.add_argument("--bpy", default=sys.executable)
    options.add_argument("--folder", default="build/truth")
    options.add_argument("--again", action="store_true")
    options.add_argument("--look", action="store_true")
    options.add_argument("--threads", type=int, default=2)
    args = options.parse_intermixed_args()
    failed = []
    for name in args.scene or scenes.SCENES:
        scene, folder, start = scenes.SCENES[name](), os.path.join(args.folder, name), time.time()
        a = ours.render(scene, folder, args.raytracer, args.threads)
        middle = time.time()
        b = peer_pictures(scene, folder, {"mitsuba": args.mitsuba, "cycles": args.bpy}, args.again)
        v = ztest.compare(a, b, scene.block, scene.hide)
        np.save(os.path.join(folder, "ours.npy"), a)
        if args.look: write_look(folder, scene, a, b, v)
        cells = (name, scene.peer, scene.seeds, "%d/%d" % (scene.spp, scene.peer_spp), v.blocks, "%.2f" % (100 * v.noise),
                 "%.3g" % v.ks, "%.5f" % v.ratio, "%.5f" % v.error, "%+.1f" % v.channel_z, v.why or "agrees", scene.what, scene.note)
        row = "\t".join(map(str, cells))
        print("%s  [worst block %d,%d t=%+.1f; %.0f s and %.0f s]" % ((row,) + v.worst + (middle - start, time.time() - middle)), flush=True)
        if not v.agrees: failed.append(name)
        put_row(name, row)
    print("%d of %d scenes agree" % (len(args.scene or scenes.SCENES) - len(failed), len(args.scene or scenes.SCENES)))
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
