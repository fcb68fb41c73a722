#!/usr/bin/env python3
"""Writes the meshes of `make bench` as OBJ: python3 tests/bench/meshes.py ball|balls FILE

ball   69,432 triangles: a wavy ball, most of them smaller than a pixel of the bench's camera
balls  1,110,912 triangles: 16 of them, each turned another way, in 4 x 4 places
"""
import math
import os
import sys

ROWS, COLUMNS = 132, 263


def ballPoints():
    for i in range(ROWS + 1):
        for j in range(COLUMNS):
            a, b = math.pi * i / ROWS, 2 * math.pi * j / COLUMNS
            r = 1 + 0.05 * math.sin(9 * a) * math.cos(11 * b)
            yield r * math.sin(a) * math.cos(b), r * math.cos(a), r * math.sin(a) * math.sin(b)


def ballTriangles():
    for i in range(ROWS):
        for j in range(COLUMNS):
            p, q = i * COLUMNS + j, i * COLUMNS + (j + 1) % COLUMNS
            yield p, q, p + COLUMNS
            yield q, q + COLUMNS, p + COLUMNS


def write(file, copies):
    points, triangles = list(ballPoints()), list(ballTriangles())
    for k in range(copies * copies):
        a = math.radians(37 * k)
        x0, z0 = 2.4 * (k % copies), 2.4 * (k // copies)
        for x, y, z in points:
            file.write(f"v {math.cos(a) * x + math.sin(a) * z + x0:.9g} {y:.9g} "
                       f"{-math.sin(a) * x + math.cos(a) * z + z0:.9g}\n")
    for k in range(copies * copies):
        first = 1 + k * len(points)
        file.writelines(f"f {p + first} {q + first} {r + first}\n" for p, q, r in triangles)


COPIES = {"ball": 1, "balls": 4}


def writeAll(folder):
    """Writes every mesh of COPIES into the folder; returns the files."""
    files = [os.path.join(folder, name + ".obj") for name in COPIES]
    for file, copies in zip(files, COPIES.values()):
        with open(file, "w", encoding="ascii") as out:
            write(out, copies)
    return files


if __name__ == "__main__":
    if len(sys.argv) != 3 or sys.argv[1] not in COPIES:
        sys.exit(__doc__)
    with open(sys.argv[2], "w", encoding="ascii") as out:
        write(out, COPIES[sys.argv[1]])
