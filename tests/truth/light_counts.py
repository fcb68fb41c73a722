#!/usr/bin/env python3
"""One room lit by N glowing triangles of the same power in all: light_counts.py RAYTRACER [N...] [--threads T]
For each N a row of tests/truth/light_counts.tsv: processor seconds to prepare (reading, trees of triangles and of lights)
and then to render at 16 samples per pixel, the error of such a picture (RMSE over all seeds, relative to the mean), the
same for light that is found by hits alone, and whether the means of both agree: a white texture of the emission keeps
lamps from being sampled. z is that of the difference of whole pictures of 128 samples. Needs numpy."""
import argparse, os, resource, subprocess, sys
sys.dont_write_bytecode = True
import numpy as np
import ours
from mitsuba_side import write_ply
from scene import scattered, surface
from ztest import welch

SIZE, SPP, MORE, SEEDS = 48, 16, 128, 8  # pixels of a side, samples of timed pictures and of those whose means are compared
AREA, POWER = 0.25, 3.0  # of all triangles; radiance times area
EYE = (0, -3.4, 1)
HERE = os.path.dirname(os.path.abspath(__file__))
COLUMNS = ("lights", "prepare_cpu_s", "render_cpu_s", "rmse_16", "by_hits_rmse_16", "ratio", "ratio_error", "z", "agrees")
WALLS = (("floor", ""), ("ceiling", "translate 0 0 2"), ("back", "translate 0 1 1\n    rotate 90 1 0 0"),
         ("left", "translate -1 0 1\n    rotate 90 0 1 0"), ("right", "translate 1 0 1\n    rotate 90 0 1 0"))


def write_room(folder, count, by_hits):
    """The path of the scene. Its triangles have one total area, so that hits find them alike, and shine away from the camera,
    whose pixels would else have the noise of lamps that cross them."""
    mesh = scattered(count, 1.0, (-0.9, -0.9, 0.1), (0.9, 0.9, 1.9), 7)
    centres = np.repeat(mesh.points.reshape(-1, 3, 3).mean(1), 3, axis=0)
    mesh.points = centres + (mesh.points - centres) * np.sqrt(AREA / surface(mesh))
    a, b, c = (mesh.points[mesh.faces[:, i]] for i in range(3))
    faces_eye = np.einsum("ij,ij->i", np.cross(b - a, c - a), a - EYE) < 0
    mesh.faces[faces_eye] = mesh.faces[faces_eye][:, ::-1]
    write_ply(os.path.join(folder, "lamps%d.ply" % count), mesh)
    ours.write_pfm(os.path.join(folder, "white.pfm"), np.ones((1, 1, 3)))
    path = os.path.join(folder, "room%d%s.txt" % (count, "-hits" if by_hits else ""))
    with open(path, "w") as file:
        file.write("raytracer 1\nsettings {\n    resolution %d %d\n    integrator path\n    filter box 1\n    cutoff 0\n    max_depth 3\n}\n" % (SIZE, SIZE))
        file.write("camera eye {\n    look_at %s  0 0 1  0 0 1\n    fov 40\n    sensor 36 36\n}\nmaterial white {\n    diffuse 0.73 0.73 0.73\n}\n" % ours.numbers(EYE))
        if by_hits: file.write('texture one {\n    file "white.pfm"\n    space linear\n}\n')
        file.write("material glow {\n    diffuse 0 0 0\n    emission %s\n    emission_sides front\n%s}\n" % (
            ours.numbers([POWER / AREA] * 3), "    emission_texture one\n" if by_hits else ""))
        for name, place in WALLS: file.write("plane %s {\n    %s\n    material white\n}\n" % (name, place))
        file.write('mesh lamps {\n    file "lamps%d.ply"\n}\ninstance lamps {\n    mesh lamps\n    material glow\n}\n' % count)
    return path


def pictures(binary, path, seeds, *flags):
    """Pictures of these seeds, and the least processor seconds that one took."""
    out, pics, seconds = path[:-4] + ".pfm", [], []
    for seed in seeds:
        before = resource.getrusage(resource.RUSAGE_CHILDREN)
        subprocess.run([binary, path, out, "--quiet", "--seed", str(seed), *flags], check=True)
        after = resource.getrusage(resource.RUSAGE_CHILDREN)
        seconds.append(after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime)
        pics.append(ours.pfm(out))
    return np.array(pics), min(seconds)


def rmse(pics):
    """Of one picture against the true mean, relative to it: pictures of other seeds differ by their noise alone."""
    return float(np.sqrt(pics.var(0, ddof=1).mean()) / pics.mean())


def main():
    options = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    options.add_argument("raytracer")
    options.add_argument("counts", nargs="*", type=int, default=[10, 100, 10000, 1000000])
    options.add_argument("--threads", type=int, default=2)
    options.add_argument("--folder", default="build/truth/lights")
    args = options.parse_args()
    os.makedirs(args.folder, exist_ok=True)
    threads, seeds = ("--threads", str(args.threads)), range(1, SEEDS + 1)
    with open(os.path.join(HERE, "light_counts.tsv"), "w") as file:
        file.write("\t".join(COLUMNS) + "\n")
        for count in args.counts:
            paths = [write_room(args.folder, count, by_hits) for by_hits in (False, True)]
            prepared = pictures(args.raytracer, paths[0], (1, 2), "--spp", "1", "--crop", "0,0,1,1", *threads)[1]
            few, seconds = pictures(args.raytracer, paths[0], seeds, "--spp", str(SPP), *threads)
            many, hits = (pictures(args.raytracer, path, seeds, "--spp", str(MORE), *threads)[0] for path in paths)
            a, b = many.mean((1, 2, 3)), hits.mean((1, 2, 3))
            z, ratio = float(welch(a, b)[0]), a.mean() / b.mean()
            error = np.sqrt(a.var(ddof=1) / len(a) + b.var(ddof=1) / len(b)) / b.mean()
            row = "\t".join(["%d" % count, "%.3f" % prepared, "%.3f" % (seconds - prepared), "%.4f" % rmse(few),
                             "%.4f" % (rmse(hits) * (MORE / SPP) ** 0.5), "%.5f" % ratio, "%.5f" % error, "%+.1f" % z, "yes" if abs(z) < 3 else "no"])
            print(row, flush=True)
            file.write(row + "\n")
            file.flush()


if __name__ == "__main__":
    main()
