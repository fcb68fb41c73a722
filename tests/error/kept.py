"""Pictures that are kept in build/error and made again only where what they depend on has changed, or where too few are there."""
import hashlib, os
from dataclasses import replace
import numpy as np
import ours

HERE = os.path.dirname(os.path.abspath(__file__))
SIDES = {"mitsuba_llvm": "../truth/mitsuba_side.py", "mitsuba_scalar": "../truth/mitsuba_side.py", "cycles": "../truth/cycles_side.py", "povray": "povray_side.py"}


def key(scene, *more, side=None):
    """Of what a scene says and of the translator in `side`."""
    said = hashlib.sha256("\n".join(ours.text(replace(scene, spp=1))).encode())
    for picture in [*scene.pictures.values()] + ([scene.sky] if scene.sky is not None else []): said.update(np.ascontiguousarray(picture).tobytes())
    if side:
        with open(os.path.join(HERE, side), "rb") as file: said.update(file.read())
    said.update(repr(more).encode())
    return said.hexdigest()[:12]


def pictures(renderer, scene, folder, spp, seeds):
    """Of the seeds from 1 on: [seed, row, column, channel]."""
    path = os.path.join(folder, "gate-%s-%s.npy" % (renderer.name, key(scene, spp, seeds, side=SIDES.get(renderer.name))))
    if not os.path.exists(path):
        np.save(path, np.array([renderer.render(spp, seed)[0] for seed in range(1, seeds + 1)], np.float32))
    return np.load(path).astype(np.float64)


def reference(scene, folder, renderer_of, sampler, seconds, spp=1024):
    """The mean of pictures of `spp` samples by another sampler than that which is measured, as many as are made in so many seconds, and
    its samples per pixel. A run that is stopped goes on from what there is."""
    path = os.path.join(folder, "reference-%s-%s.npz" % (sampler, key(scene, spp)))
    total, count, spent = 0.0, 0, 0.0
    if os.path.exists(path):
        with np.load(path) as file: total, count, spent = file["total"], int(file["count"]), float(file["spent"])
    if spent < seconds:
        renderer = renderer_of(("--integrator", "path", "--sampler", sampler))
        while spent < seconds:
            picture, took = renderer.render(spp, (1000 if sampler == "random" else 500000) + count)
            total, count, spent = total + picture, count + 1, spent + took
            np.savez(path + ".part.npz", total=total, count=count, spent=spent)
            os.replace(path + ".part.npz", path)
    return total / count, count * spp
