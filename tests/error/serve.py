"""A scene that stays loaded in a peer which lives in Python: serve.py mitsuba_llvm|mitsuba_scalar|cycles SCENE SIZE FOLDER THREADS SAMPLER
Each line "SPP SEED OUT.npy" of the input is answered by the seconds of the rendering alone. The answer to the scene itself is "ready" and
the seconds in which numbers became what the peer reads, or "cannot WHY" where the peer has no such thing. With one line it is a whole
process, from start to picture."""
import os, sys, time
from dataclasses import replace
import numpy as np


def mitsuba_renderer(variant, scene, folder, threads, sampler):
    import mitsuba_side
    mi = mitsuba_side.start(variant)
    import drjit
    drjit.set_thread_count(threads)
    start = time.perf_counter()
    written = mitsuba_side.Writer(mi, scene, folder).scene_dict(sampler)
    translation = time.perf_counter() - start
    loaded = mi.load_dict(written)

    def render(spp, seed):
        start = time.perf_counter()
        picture = np.array(mi.render(loaded, spp=spp, seed=seed))
        return picture[..., :3], time.perf_counter() - start
    return render, translation


def cycles_renderer(scene, folder, threads):
    import bpy, cycles_side
    writer = cycles_side.Writer(scene, folder)
    bpy.context.scene.render.threads = threads

    def render(spp, seed):
        bpy.context.scene.cycles.samples = spp
        return writer.render(seed)
    return render, 0.0


def main():
    kind, name, size, folder, threads, sampler = sys.argv[1:7]
    answers = os.fdopen(os.dup(1), "w")  # renderers print, too
    os.dup2(2, 1)
    import error_scenes
    start = time.perf_counter()
    scene = replace(error_scenes.SCENES[name](), size=int(size))
    made = time.perf_counter() - start
    try:
        if kind == "cycles": render, translation = cycles_renderer(scene, folder, int(threads))
        else: render, translation = mitsuba_renderer({"mitsuba_llvm": "llvm_ad_rgb", "mitsuba_scalar": "scalar_rgb"}[kind], scene, folder, int(threads), sampler)
    except SystemExit as why:
        print("cannot", str(why).replace("error: ", ""), file=answers, flush=True)
        return
    print("ready", made + translation, file=answers, flush=True)
    for line in sys.stdin:
        spp, seed, out = line.split()
        picture, seconds = render(int(spp), int(seed))
        np.save(out, picture.astype(np.float32))
        print(seconds, file=answers, flush=True)


if __name__ == "__main__":
    main()
