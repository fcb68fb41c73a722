#!/usr/bin/env python3
"""Is it worth building a better tree? Whole pictures with --tree fast, auto and best, in rounds that
alternate: tests/bench/trees.tsv.

    python3 tests/bench/trees.py RAYTRACER [MESH...] [--spp N]... [--runs N] [--resolution WxH]

MESH: names of meshes.py; without, those whose trees differ, and a scan.
"""
import argparse
import json
import os
import sys
import tempfile

import measured
import meshes

KINDS = ["fast", "auto", "best"]
SCENES = ["ball", "on-floor", "city", "hair", "boxes", "wires"]
COLUMNS = (["date", "commit", "cpu", "load", "mesh", "spp", "resolution"] + [f"{kind}_ms" for kind in KINDS] +
           [f"{kind}_build_ms" for kind in KINDS] + ["auto_to_better"])


def seconds(raytracer, scene, kind, options):
    picture = os.path.splitext(scene)[0] + ".ppm"
    found = json.loads(measured.output(raytracer, scene, picture, "-q", "-t", "1", "--stats=json", "--tree", kind,
                                       *options))["seconds"]
    return found["build"] + found["render"], found["build"]


def rowOf(raytracer, scene, name, spp, arguments):
    """Of building and rendering: the rest is the same for all."""
    options = ["--spp", str(spp), "--resolution", arguments.resolution]
    found = {kind: [] for kind in KINDS}
    for turn in range(arguments.runs):
        for kind in KINDS[turn % 3:] + KINDS[:turn % 3]:
            found[kind].append(seconds(raytracer, scene, kind, options))
    both = [1e3 * measured.median([s[0] for s in found[kind]]) for kind in KINDS]
    build = [1e3 * measured.median([s[1] for s in found[kind]]) for kind in KINDS]
    return ([measured.today(), measured.commit(), measured.cpuName(), measured.load(), name, spp, arguments.resolution] +
            [f"{ms:.1f}" for ms in both + build] + [f"{both[1] / min(both[0], both[2]):.3f}"])


def main():
    parser = argparse.ArgumentParser(description="Total times with fast, chosen and best trees.")
    parser.add_argument("raytracer")
    parser.add_argument("mesh", nargs="*")
    parser.add_argument("--spp", type=int, action="append", default=[])
    parser.add_argument("--runs", type=int, default=5)
    parser.add_argument("--resolution", default="320x240")
    arguments = parser.parse_args()
    rows = []
    with tempfile.TemporaryDirectory() as folder:
        for name in arguments.mesh or SCENES:
            scene = meshes.writeAll(folder, [name])[0]
            for spp in arguments.spp or [1, 16, 256]:
                rows.append(rowOf(os.path.abspath(arguments.raytracer), scene, name, spp, arguments))
                print(" ".join(str(cell) for cell in rows[-1][4:]), file=sys.stderr)
    sums = [sum(float(row[7 + i]) for row in rows) for i in range(3)]
    measured.printTable(COLUMNS[4:], [row[4:] for row in rows] +
                        [["all", "", ""] + [f"{s:.1f}" for s in sums] + ["", "", "", f"{sums[1] / min(sums[0], sums[2]):.3f}"]])
    measured.appendRows("trees.tsv", COLUMNS, rows)
    print(f"{len(rows)} rows more in tests/bench/trees.tsv")


if __name__ == "__main__":
    main()
