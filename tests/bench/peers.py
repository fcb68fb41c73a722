#!/usr/bin/env python3
"""The rates of raytracer and Embree on the same rays, and how many times as fast raytracer is.

    python3 tests/bench/peers.py RAYTRACER BUILD_FOLDER [--mesh FILE]... [--kernel NAME] [--threads N]
                                 [--rounds N] [--runs N] [--quality medium|high] [--cxx COMMAND]

Rounds alternate: raytracer, Embree, raytracer, ... so that both meet the same state of the machine.
Figures are medians over the rounds, Embree's those of its best mode for each set of rays. They are
appended to tests/bench/peers.tsv.
"""
import argparse
import collections
import os
import subprocess
import sys
import tempfile

import measured
import meshes


COLUMNS = ["date", "commit", "cpu", "load", "threads", "kernel", "mesh", "peer", "what", "ours", "theirs", "mode", "ratio",
           "least", "most"]


def hasHeader(compiler, header):
    return subprocess.run([*compiler, "-fsyntax-only", "-include", header, "-x", "c++", os.devnull],
                          stderr=subprocess.DEVNULL, check=False).returncode == 0


def buildPeer(compiler, folder):
    version = next((v for v in (4, 3) if hasHeader(compiler, f"embree{v}/rtcore.h")), None)
    if version is None:
        sys.exit("bench-peers needs Embree: sudo apt-get install libembree-dev (Debian, Ubuntu)")
    os.makedirs(folder, exist_ok=True)
    program = os.path.join(folder, "peer_embree")
    source = os.path.join(measured.TOP, "tests", "bench", "peer_embree.cpp")
    # Not vectorised: g++ -O3 fills streams of rays in pieces that Embree's wide loads then wait for, and
    # its any-hit streams lose a tenth.
    subprocess.run([*compiler, "-O3", "-fno-tree-vectorize", "-march=native", "-std=c++20", source, "-o", program, f"-lembree{version}", "-pthread"],
                   check=True)
    return program


def compare(raytracer, peer, mesh, folder, arguments):
    name = os.path.splitext(os.path.basename(mesh))[0]
    rays = os.path.join(folder, name + ".rays")
    measured.output(raytracer, "bench", mesh, "--write-rays", rays)
    ours, theirs = collections.defaultdict(list), collections.defaultdict(list)
    hits = {}
    for _ in range(arguments.rounds):
        for who, found, command in (
                ("raytracer", ours, (raytracer, "bench", mesh, "--no-picture", "--uv", "--kernel", arguments.kernel)),
                ("Embree", theirs, (peer, rays, "--quality", arguments.quality))):
            text = measured.output(*command, "--threads", str(arguments.threads), "--runs", str(arguments.runs))
            hits[who] = measured.hits(text)
            for key, numbers in measured.figures(text).items():
                found[key].append(numbers[0])
    peerName = text.split(",", 3)[2]  # behind BUILD and the mesh
    os.remove(rays)
    for what, count in hits["raytracer"].items():
        if abs(count - hits["Embree"][what]) > 64 + count // 10000:
            sys.exit(f"{mesh}: {what} rays hit {count} times in raytracer, {hits['Embree'][what]} times in Embree")

    def row(label, what, suffix):
        mine = next(values for (kind, w), values in ours.items() if w == what and kind.endswith("+uv") == bool(suffix))
        if what == "build":
            mode, other = "", theirs["all", "build"]
            ratios = [b / a for a, b in zip(mine, other)]
        else:
            mode, other = max(((kind, values) for (kind, w), values in theirs.items() if w == what),
                              key=lambda entry: measured.median(entry[1]))
            ratios = [a / b for a, b in zip(mine, other)]
        return [label + suffix, f"{measured.median(mine):.2f}", f"{measured.median(other):.2f}", mode or "-",
                *(f"{value:.2f}" for value in (measured.median(ratios), min(ratios), max(ratios)))]

    rows = [row(f"{s}, Mray/s", s, suffix) for s in measured.SETS for suffix in ("", " with u, v")
            if not suffix or s in ("primary", "bounce")]
    rows.append(row("build, ms", "build", ""))
    kernel = next(kind for kind, _ in ours if not kind.endswith("+uv"))
    measured.printTable([f"{os.path.basename(mesh)}, {arguments.threads} thread{'s'[:arguments.threads > 1]}", kernel,
                         "Embree", "its mode", "ratio", "least", "most"], rows)
    where = [measured.today(), measured.commit(), measured.cpuName(), measured.load(), arguments.threads, kernel,
             os.path.basename(mesh), peerName]
    measured.appendRows("peers.tsv", COLUMNS, [where + r for r in rows])


def main():
    parser = argparse.ArgumentParser(description="raytracer and Embree on the same rays.")
    parser.add_argument("raytracer")
    parser.add_argument("folder")
    parser.add_argument("--mesh", action="append", default=[])
    parser.add_argument("--kernel", default="auto")
    parser.add_argument("--threads", type=int, default=1)
    parser.add_argument("--rounds", type=int, default=5)
    parser.add_argument("--runs", type=int, default=3)
    parser.add_argument("--quality", choices=["medium", "high"], default="medium")
    parser.add_argument("--cxx", default="g++")
    arguments = parser.parse_args()
    peer = buildPeer(arguments.cxx.split(), os.path.abspath(arguments.folder))
    raytracer = os.path.abspath(arguments.raytracer)
    print(f"{measured.cpuName()}, load {measured.load()}, {arguments.rounds} rounds, commit {measured.commit()}")
    with tempfile.TemporaryDirectory() as folder:
        files = [os.path.abspath(mesh) for mesh in arguments.mesh] or meshes.writeAll(folder)
        for mesh in files:
            compare(raytracer, peer, mesh, folder, arguments)


if __name__ == "__main__":
    main()
