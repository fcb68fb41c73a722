#!/usr/bin/env python3
"""Measures tree, rays and picture of some meshes, and appends a row each to tests/bench/results.tsv.

    python3 tests/bench/bench.py BENCH [--mesh FILE]... [--kernels NAMES] [--threads N] [--runs N]

Without --mesh: the two scans of meshes.py. Names of kernels with spaces between them.
"""
import argparse
import os
import tempfile

import measured
import meshes

COLUMNS = (["date", "commit", "cpu", "load", "threads", "kernel", "mesh"] +
           [f"{name}_mrays_s" for name in measured.SETS] + ["primary_uv_mrays_s", "bounce_uv_mrays_s"] +
           [f"{name}_{what}" for name in measured.SETS for what in ("nodes", "leaves")] +
           ["build_ms", "bytes_per_triangle"] +
           [f"picture_{step}_ms" for step in ("read", "build", "render", "write", "all")])


def rowOf(bench, mesh, kernel, arguments):
    text = measured.output(bench, mesh, "--kernel", kernel, "--uv", "--threads", str(arguments.threads),
                           "--runs", str(arguments.runs))
    found = measured.figures(text)
    name = next(kind for kind, what in found if what == "build")
    rays = [found[name, s] for s in measured.SETS]
    build, picture = found[name, "build"], found[name, "picture"]
    return ([measured.today(), measured.commit(), measured.cpuName(), measured.load(), arguments.threads, name,
             os.path.basename(mesh)] + [r[0] for r in rays] +
            [found[name + "+uv", s][0] for s in ("primary", "bounce")] +
            [cell for r in rays for cell in r[4:6]] + [build[0], build[3]] + picture)


def main():
    parser = argparse.ArgumentParser(description="Measures meshes and appends to tests/bench/results.tsv.")
    parser.add_argument("bench")
    parser.add_argument("--mesh", action="append", default=[])
    parser.add_argument("--kernels", default="auto")
    parser.add_argument("--threads", type=int, default=1)
    parser.add_argument("--runs", type=int, default=3)
    arguments = parser.parse_args()
    bench = os.path.abspath(arguments.bench)
    with tempfile.TemporaryDirectory() as folder:
        files = [os.path.abspath(mesh) for mesh in arguments.mesh] or meshes.writeAll(folder, meshes.SCANS)
        rows = [rowOf(bench, mesh, kernel, arguments) for mesh in files for kernel in arguments.kernels.split()]
    # The table lies down in the file and stands here: a line per figure.
    measured.printTable([f"{rows[0][1]}, {rows[0][2]}"] + [f"{row[6]} {row[5]}" for row in rows],
                        [[name] + [row[i] for row in rows] for i, name in enumerate(COLUMNS) if i > 6])
    measured.appendRows("results.tsv", COLUMNS, rows)
    print(f"{len(rows)} rows more in tests/bench/results.tsv")


if __name__ == "__main__":
    main()
