#!/usr/bin/env python3
"""How time grows with triangles, pixels, lights and depth: tests/bench/growth.tsv, and growth.png when
matplotlib is there.

    python3 tests/bench/growth.py RAYTRACER [WHAT...] [--largest N] [--runs N] | --plot

WHAT is of: triangles pixels lights depth; all by default. --largest: of triangles, 10000000. A table
has the figures of one run of this script; --plot draws the table that there is.
"""
import argparse
import json
import os
import subprocess
import sys
import tempfile

import measured

COLUMNS = ["date", "commit", "cpu", "what", "n", "parse_s", "build_s", "render_s", "write_s", "rays", "ns_per_ray",
           "peak_mb"]
TABLE = os.path.join(measured.TOP, "tests", "bench", "growth.tsv")
PLOT = os.path.join(measured.TOP, "tests", "bench", "growth.png")
HEAD = """raytracer 1
settings {{
    resolution 512 512
    samples 1
    max_depth {depth}
}}
camera c {{
    look_at 0 -2 1.5  0 0 0  0 0 1
    lens 50
}}
"""


def waves(triangles, file):
    """The wavy square of waves.sh with one light."""
    with open(file, "w", encoding="ascii") as out:
        subprocess.run(["sh", "tests/bench/waves.sh", str(triangles)], cwd=measured.TOP, stdout=out, check=True)


def lamps(count, file):
    """The square of 20,000 triangles under many point lights, and a ball that hides some of each."""
    waves(20000, file)
    with open(file, "a", encoding="ascii") as out:
        out.write("sphere ball {\n    scale 0.3 0.3 0.3\n    translate 0 0 0.4\n}\n")
        for i in range(count - 1):
            out.write(f"light more{i} {{\n    translate {3 * (i % 8) / 8 - 1.5} {-4 + 3 * (i // 8) / 8} 5\n    color 9 9 9\n}}\n")


def mirrors(depth, file):
    """The inside of a room of mirrors: every ray goes on to the largest depth."""
    with open(file, "w", encoding="ascii") as out:
        out.write(HEAD.format(depth=depth))
        out.write("material mirror {\n    diffuse 0 0 0\n    mirror 0.99 0.99 0.99\n}\n"
                  "light l {\n    translate 0 0 2\n    color 9 9 9\n}\n"
                  "cube room {\n    scale 4 4 4\n    material mirror\n}\n"
                  "sphere ball {\n    scale 0.5 0.5 0.5\n    material mirror\n}\n")


# What grows: its steps, the scene for a step, and the options for it.
def subjects(largest):
    return {
        "triangles": ([n for n in (10 ** 3, 10 ** 4, 10 ** 5, 10 ** 6, 10 ** 7) if n <= largest], waves,
                      lambda n: ["--resolution", "512x512"]),
        "pixels": ([4 ** k for k in range(7, 13)], lambda n, file: waves(100000, file),
                   lambda n: ["--resolution", "{0}x{0}".format(round(n ** 0.5))]),
        "lights": ([2 ** k for k in range(7)], lamps, lambda n: ["--resolution", "512x512"]),
        "depth": ([2 ** k for k in range(6)], mirrors, lambda n: []),
    }


def measure(raytracer, scene, options, picture, runs):
    """The run of median render time, with the other times of their own medians."""
    found = [json.loads(measured.output(raytracer, scene, picture, "-q", "-t", "1", "--stats=json", "--spp", "1", *options))
             for _ in range(runs)]
    seconds = {key: measured.median([f["seconds"][key] for f in found]) for key in ("parse", "build", "render", "write")}
    return seconds, sum(found[0]["rays"].values()), found[0]["peak_bytes"]


def measureAll(arguments):
    rows = []
    with tempfile.TemporaryDirectory() as folder:
        scene, picture = os.path.join(folder, "scene.txt"), os.path.join(folder, "picture.png")
        for what, (steps, write, options) in subjects(arguments.largest).items():
            if arguments.what and what not in arguments.what:
                continue
            for n in steps:
                write(n, scene)
                seconds, rays, peak = measure(arguments.raytracer, scene, options(n), picture, arguments.runs)
                rows.append([measured.today(), measured.commit(), measured.cpuName(), what, n,
                             *(f"{seconds[key]:.6f}" for key in ("parse", "build", "render", "write")), rays,
                             f"{1e9 * seconds['render'] / rays:.1f}", f"{peak / 1e6:.1f}"])
                print(" ".join(str(cell) for cell in rows[-1][3:]), file=sys.stderr)
    return rows


def tableRows():
    with open(TABLE, encoding="utf-8") as file:
        lines = [line.rstrip("\n").split("\t") for line in file]
    return lines[1:] if lines and lines[0] == COLUMNS else []


def plot(rows):
    try:
        import matplotlib
        matplotlib.use("Agg")
        from matplotlib import pyplot
    except ImportError:
        print("no plot: it needs matplotlib (pip install matplotlib); the table is in tests/bench/growth.tsv")
        return
    colors = {"parse": "#b5651d", "build": "#14706f", "render": "#1d2328", "write": "#9aa5ad"}
    labels = {"triangles": "triangles of one mesh", "pixels": "pixels", "lights": "point lights",
              "depth": "bounces between mirrors"}
    words = {"parse": "read", "build": "build", "render": "render", "write": "write"}
    pyplot.rcParams.update({"font.size": 8, "axes.spines.top": False, "axes.spines.right": False})
    figure, axes = pyplot.subplots(2, 2, figsize=(8, 5.2), sharey=True)
    for axis, what in zip(axes.flat, subjects(10 ** 9)):
        mine = [row for row in rows if row[3] == what]
        if not mine:
            continue
        n = [float(row[4]) for row in mine]
        for i, step in enumerate(colors):
            # Reading a scene of a few lines says nothing.
            if what == "triangles" or step == "render" or (what == "pixels" and step == "write"):
                axis.plot(n, [1e3 * float(row[5 + i]) for row in mine], color=colors[step], marker="o", markersize=3,
                          linewidth=1.4, label=words[step])
        last = 1e3 * float(mine[-1][7])
        axis.plot([n[0], n[-1]], [last * n[0] / n[-1], last], color="#c9d0d5", linestyle="--", linewidth=1, zorder=0,
                  label="in proportion")
        axis.set(xscale="log", yscale="log", xlabel=labels[what])
        axis.grid(True, which="major", color="#eef1f2", linewidth=0.6)
        axis.legend(frameon=False, loc="upper left", fontsize=7)
    for row in axes:
        row[0].set_ylabel("milliseconds, one thread")
    axes[0][0].set_ylim(0.1, 3e4)
    figure.tight_layout()
    figure.savefig(PLOT, dpi=110, metadata={"Software": None})
    print(f"tests/bench/growth.png: {os.path.getsize(PLOT) / 1000:.0f} kB")


def main():
    parser = argparse.ArgumentParser(description="Time against triangles, pixels, lights and depth.")
    parser.add_argument("raytracer", nargs="?")
    parser.add_argument("what", nargs="*")
    parser.add_argument("--largest", type=int, default=10 ** 7)
    parser.add_argument("--runs", type=int, default=3)
    parser.add_argument("--plot", action="store_true")
    arguments = parser.parse_args()
    if arguments.raytracer:
        arguments.raytracer = os.path.abspath(arguments.raytracer)
        fresh = measureAll(arguments)
        kept = [row for row in (tableRows() if os.path.exists(TABLE) else []) if row[3] not in {r[3] for r in fresh}]
        rows = kept + fresh
        order = list(subjects(10 ** 9))
        rows.sort(key=lambda row: (order.index(row[3]), float(row[4])))
        with open(TABLE, "w", encoding="utf-8") as file:
            file.writelines("\t".join(str(cell) for cell in row) + "\n" for row in [COLUMNS] + rows)
        measured.printTable(COLUMNS[3:], [row[3:] for row in fresh])
    elif not arguments.plot:
        sys.exit(__doc__)
    plot(tableRows())


if __name__ == "__main__":
    main()
