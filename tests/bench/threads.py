#!/usr/bin/env python3
"""Are N threads N times as fast as one? Whole processes (start, reading, building, rendering, writing), in
turns: one thread, N threads, and N processes of one thread at the same time: tests/bench/threads.tsv.

    python3 tests/bench/threads.py RAYTRACER [SCENE...] [--threads N] [--runs N]

N processes share nothing that the program could make better: how much longer they take than one is what
the machine's processors lose to each other (clock, caches, memory, neighbours). "faster" and "machine" are
medians of the turns' ratios, "best" is the shortest of one thread over the shortest of N. `taskset -c LIST`
before the command keeps all of them on some processors.
"""
import argparse
import os
import subprocess
import sys
import tempfile
import time

import measured
import meshes

SCENES = ["ball"] + [os.path.join(measured.TOP, "ASCII", name) for name in ("antialiasing.txt", "showcase.txt")]
COLUMNS = ["date", "commit", "cpu", "load", "scene", "threads", "one_ms", "n_ms", "apart_ms", "faster", "best", "machine",
           "of_machine"]


def milliseconds(commands):
    """Of commands that run at the same time, until the last one ends."""
    start = time.perf_counter()
    running = [subprocess.Popen(command, stderr=subprocess.PIPE, text=True) for command in commands]
    messages = [process.communicate()[1] for process in running]
    for process, message in zip(running, messages):
        if process.returncode != 0:
            sys.exit(message)
    return 1e3 * (time.perf_counter() - start)


def rowOf(raytracer, scene, folder, threads, runs):
    def command(number, some):
        return [raytracer, scene, os.path.join(folder, f"{number}.png"), "--threads", str(some), "--quiet"]
    ways = [[command(0, 1)], [command(0, threads)], [command(i, 1) for i in range(threads)]]
    turns = [[milliseconds(way) for way in ways] for _ in range(runs + 1)][1:]  # the first warms caches up
    one, many, apart = ([turn[i] for turn in turns] for i in range(3))
    faster = measured.median([a / b for a, b in zip(one, many)])
    machine = measured.median([threads * a / b for a, b in zip(one, apart)])
    return ([measured.today(), measured.commit(), measured.cpuName(), measured.load(), os.path.basename(scene), threads] +
            [f"{measured.median(ms):.1f}" for ms in (one, many, apart)] +
            [f"{ratio:.3f}" for ratio in (faster, min(one) / min(many), machine, faster / machine)])


def main():
    parser = argparse.ArgumentParser(description="Times of one thread, of N, and of N processes at once.")
    parser.add_argument("raytracer")
    parser.add_argument("scene", nargs="*", default=SCENES, help="a file or a name of meshes.py")
    parser.add_argument("--threads", type=int, default=2)
    parser.add_argument("--runs", type=int, default=9)
    arguments = parser.parse_args()
    rows = []
    with tempfile.TemporaryDirectory() as folder:
        for name in arguments.scene:
            scene = meshes.writeAll(folder, [name])[0] if name in meshes.MESHES else os.path.abspath(name)
            rows.append(rowOf(os.path.abspath(arguments.raytracer), scene, folder, arguments.threads, arguments.runs))
    measured.printTable(COLUMNS[4:], [row[4:] for row in rows])
    measured.appendRows("threads.tsv", COLUMNS, rows)


if __name__ == "__main__":
    main()
