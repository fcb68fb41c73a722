#!/usr/bin/env python3
"""How honest --error is, and what it saves: goals.py RAYTRACER [SCENE...] [--seeds 4] [--folder build/error/goals]
For scenes of ASCII/ at a fifth of their size, three goals and some seeds: the true error of the picture as shown over the goal,
by two references of other seeds (measures.py); what part of blocks of 32 x 32 has an error of more than 1.1 of the reported one;
and the samples of a pixel against those that the same true error needs when all pixels have as many, read off a line through the
errors of powers of two, in logarithms. Rows go to goals.tsv beside this file, for scenes that are left out those of the last run.
`make bench-goals` runs it; it needs numpy. References are kept in the folder."""
import argparse, json, os, subprocess, sys
sys.dont_write_bytecode = True
HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, os.path.join(HERE, "..", "truth"))
import numpy as np
import measures, ours, tables

SCENES = "soft_shadows glossy dof motion_blur textures glass antialiasing transparent mirror world_environment".split()
GOALS = (0.02, 0.01, 0.005)
COLUMNS = ("scene", "goal", "seeds", "true/goal", "largest", "estimate/goal", "blocks_above_%", "least", "mean", "most", "even_samples",
           "of_even", "floor")
REFERENCE_SAMPLES, MOST_EVEN = 16384, 4096


class Pictures:
    def __init__(self, binary, scene, folder):
        self.binary, self.scene, self.folder = binary, os.path.join(HERE, "..", "..", "ASCII", scene + ".txt"), os.path.join(folder, scene)
        os.makedirs(self.folder, exist_ok=True)

    def render(self, *flags):
        """The picture, its statistics, and the path of its name without .pfm."""
        out = os.path.join(self.folder, "now")
        done = subprocess.run([self.binary, self.scene, out + ".pfm", "--scale", "20", "-q", "--stats=json", *flags], check=True,
                              capture_output=True, text=True)
        return ours.pfm(out + ".pfm"), json.loads(done.stdout), out

    def reference(self, number):
        path = os.path.join(self.folder, "reference%d.npy" % number)
        if not os.path.exists(path):
            picture, _, _ = self.render("--spp", str(REFERENCE_SAMPLES), "--seed", str(900 + number), "--texture-filter", "none")
            np.save(path, picture)
        return np.load(path)


def block_means(values, side=32):
    h, w = values.shape
    return np.array([values[y:y + side, x:x + side].mean() for y in range(0, h, side) for x in range(0, w, side)])


def rows(pictures, name, seeds):
    references = [pictures.reference(k) for k in (1, 2)]
    def squares(picture): return (measures.differences(picture, *references, "display") * measures.differences(picture, *references[::-1], "display")).mean(-1)
    floor = np.sqrt(max(measures.floor(*references, "display"), 0))
    even = []  # logarithms of error and samples
    for power in range(2, MOST_EVEN.bit_length()):
        mse = np.mean([squares(pictures.render("--spp", str(1 << power), "--seed", str(50 + s))[0]).mean() for s in range(2)])
        if mse <= floor ** 2: break
        even.append((np.log(mse) / 2, np.log(1 << power)))
    for goal in GOALS:
        true, estimate, samples, above = [], [], [], []
        for seed in range(seeds):
            picture, stats, out = pictures.render("--error", str(goal), "--seed", str(seed), "--aov", "error")
            wrong = squares(picture)
            true.append(np.sqrt(max(wrong.mean(), 0)))
            estimate.append(stats["error_estimate"])
            samples.append([stats["samples"][k] for k in ("min", "mean", "max")])
            reported = np.sqrt(block_means(ours.pfm(out + ".error.pfm")[..., 0] ** 2))
            above += list(np.sqrt(np.maximum(block_means(wrong), 0)) > 1.1 * reported + 2 * floor)
        least, mean, most = np.mean(samples, 0)
        errors, counts = zip(*even)
        x = np.log(np.mean(true))
        reaches = errors[-1] <= x <= errors[0]
        needed = float(np.exp(np.interp(-x, -np.array(errors), counts)))
        yield (name, goal, seeds, *("%.2f" % v for v in (np.mean(true) / goal, max(true) / goal, np.mean(estimate) / goal)),
               "%.1f" % (100 * np.mean(above)), "%d" % least, "%.1f" % mean, "%d" % most,
               "%.1f" % needed if reaches else (">%.0f" if x < errors[-1] else "<%.0f") % needed,
               "%.2f" % (mean / needed) if reaches else "-", "%.5f" % floor)


def main():
    options = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    options.add_argument("raytracer")
    options.add_argument("scene", nargs="*", metavar="SCENE")
    options.add_argument("--seeds", type=int, default=4)
    options.add_argument("--folder", default="build/error/goals")
    options = options.parse_args()
    for name in options.scene or SCENES:
        found = list(rows(Pictures(options.raytracer, name, options.folder), name, options.seeds))
        for row in found: print("\t".join(map(str, row)), flush=True)
        tables.put_rows("goals.tsv", COLUMNS, name, found)


if __name__ == "__main__":
    main()
