#!/usr/bin/env python3
"""The rates of raytracer and Embree on the same rays, and how many times as fast raytracer is.

    python3 tests/bench/peers.py BENCH BUILD_FOLDER [--mesh FILE]... [--kernel NAME] [--threads N]
                                 [--rounds N] [--runs N] [--quality medium|high] [--cxx COMMAND]

Rounds alternate: raytracer, Embree, raytracer, ... so that both meet the same state of the machine.
Figures are medians over the rounds, Embree's those of its best mode for each set of rays. They are
appended to tests/bench/peers.tsv. Without --mesh: two meshes like scans, and behind them a line for
each mesh of meshes.py and each view with the ratios alone, of one round.
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


class Rates:
    """What both make of the same rays: for each of the sets, or "build", figures of every round."""

    def __init__(self, bench, peer, mesh, folder, view, rounds, arguments):
        rays = os.path.join(folder, "peers.rays")
        measured.output(bench, mesh, "--view", view, "--write-rays", rays)
        self.ours, self.theirs = collections.defaultdict(list), collections.defaultdict(list)
        hits = {}
        for _ in range(rounds):
            for who, found, command in (
                    ("raytracer", self.ours, (bench, mesh, "--view", view, "--no-picture", "--uv",
                                              "--kernel", arguments.kernel)),
                    ("Embree", self.theirs, (peer, rays, "--quality", arguments.quality))):
                text = measured.output(*command, "--threads", str(arguments.threads), "--runs", str(arguments.runs))
                hits[who] = measured.hits(text)
                for key, numbers in measured.figures(text).items():
                    found[key].append(numbers[0])
        self.peerName = text.split(",", 3)[2]  # behind BUILD and the mesh
        self.kernel = next(kind for kind, _ in self.ours if not kind.endswith("+uv"))
        os.remove(rays)
        for what, count in hits["raytracer"].items():
            if abs(count - hits["Embree"][what]) > 64 + count // 10000:
                sys.exit(f"{mesh}: {what} rays hit {count} times in raytracer, {hits['Embree'][what]} times in Embree")

    def of(self, what, suffix=""):
        """Ours, Embree's in its best mode, that mode, and how many times as fast ours are."""
        mine = next(v for (kind, w), v in self.ours.items() if w == what and kind.endswith("+uv") == bool(suffix))
        if what == "build":
            other = self.theirs["all", "build"]
            return mine, other, "-", [b / a for a, b in zip(mine, other)]
        mode, other = max(((kind, v) for (kind, w), v in self.theirs.items() if w == what),
                          key=lambda entry: measured.median(entry[1]))
        return mine, other, mode, [a / b for a, b in zip(mine, other)]


def compare(bench, peer, mesh, folder, arguments):
    rates = Rates(bench, peer, mesh, folder, "outside", arguments.rounds, arguments)

    def row(label, what, suffix):
        mine, other, mode, ratios = rates.of(what, suffix)
        return [label + suffix, f"{measured.median(mine):.2f}", f"{measured.median(other):.2f}", mode,
                *(f"{value:.2f}" for value in (measured.median(ratios), min(ratios), max(ratios)))]

    rows = [row(f"{s}, Mray/s", s, suffix) for s in measured.SETS for suffix in ("", " with u, v")
            if not suffix or s in ("primary", "bounce")]
    rows.append(row("build, ms", "build", ""))
    measured.printTable([f"{os.path.basename(mesh)}, {arguments.threads} thread{'s'[:arguments.threads > 1]}", rates.kernel,
                         "Embree", "its mode", "ratio", "least", "most"], rows)
    where = [measured.today(), measured.commit(), measured.cpuName(), measured.load(), arguments.threads,
             rates.kernel, os.path.basename(mesh), rates.peerName]
    measured.appendRows("peers.tsv", COLUMNS, [where + r for r in rows])


def survey(bench, peer, folder, arguments):
    arguments.runs = 3  # where rays take 2 ms in all, one run may be off by half
    rows = []
    for mesh in meshes.writeAll(folder, meshes.MESHES):
        for view in ("outside", "inside"):
            rates = Rates(bench, peer, mesh, folder, view, 1, arguments)
            name = f"{os.path.basename(mesh)}, {view}"
            found = {what: rates.of(what) for what in measured.SETS}
            rows.append([name] + [f"{ratios[0]:.2f}" for _, _, _, ratios in found.values()])
            where = [measured.today(), measured.commit(), measured.cpuName(), measured.load(), arguments.threads,
                     rates.kernel, name, rates.peerName]
            measured.appendRows("peers.tsv", COLUMNS, [
                where + [f"{what}, Mray/s", f"{mine[0]:.2f}", f"{other[0]:.2f}", mode] + [f"{ratios[0]:.2f}"] * 3
                for what, (mine, other, mode, ratios) in found.items()])
    print()
    measured.printTable(["times as fast as Embree's best mode", *measured.SETS], rows)


def main():
    parser = argparse.ArgumentParser(description="raytracer and Embree on the same rays.")
    parser.add_argument("bench")
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
    bench = os.path.abspath(arguments.bench)
    print(f"{measured.cpuName()}, load {measured.load()}, {arguments.rounds} rounds, commit {measured.commit()}")
    with tempfile.TemporaryDirectory() as folder:
        for mesh in [os.path.abspath(mesh) for mesh in arguments.mesh] or meshes.writeAll(folder, meshes.SCANS):
            compare(bench, peer, mesh, folder, arguments)
        if not arguments.mesh:
            survey(bench, peer, folder, arguments)


if __name__ == "__main__":
    main()
