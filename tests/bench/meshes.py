#!/usr/bin/env python3
"""Writes the meshes of `make bench` and `make bench-peers` as OBJ.

    python3 tests/bench/meshes.py NAME FILE       one of MESHES, below
    python3 tests/bench/meshes.py --list
"""
import math
import os
import random
import sys

# A mesh is two lists: points (x, y, z), y upwards, and triangles of three numbers of points.


def joined(parts):
    """One mesh of many."""
    points, triangles = [], []
    for somePoints, someTriangles in parts:
        first = len(points)
        points += somePoints
        triangles += [(p + first, q + first, r + first) for p, q, r in someTriangles]
    return points, triangles


def globe(rows, columns, radius):
    """A ball; radius(a, b) by the angle from the pole and that around it."""
    points = []
    for i in range(rows + 1):
        for j in range(columns):
            a, b = math.pi * i / rows, 2 * math.pi * j / columns
            r = radius(a, b)
            points.append((r * math.sin(a) * math.cos(b), r * math.cos(a), r * math.sin(a) * math.sin(b)))
    triangles = []
    for i in range(rows):
        for j in range(columns):
            p, q = i * columns + j, i * columns + (j + 1) % columns
            triangles += [(p, q, p + columns), (q, q + columns, p + columns)]
    return points, triangles


def sheet(n, place):
    """n x n squares over [0, 1]^2; place(u, v) is a point."""
    points = [place(i / n, j / n) for j in range(n + 1) for i in range(n + 1)]
    triangles = []
    for j in range(n):
        for i in range(n):
            p = j * (n + 1) + i
            triangles += [(p, p + n + 1, p + 1), (p + 1, p + n + 1, p + n + 2)]
    return points, triangles


def box(lo, hi):
    points = [(x, y, z) for x in (lo[0], hi[0]) for y in (lo[1], hi[1]) for z in (lo[2], hi[2])]
    squares = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
    return points, [t for a, b, c, d in squares for t in ((a, b, c), (a, c, d))]


def ball():
    return globe(132, 263, lambda a, b: 1 + 0.05 * math.sin(9 * a) * math.cos(11 * b))


def balls():
    points, triangles = ball()

    def turned(k):
        c, s = math.cos(math.radians(37 * k)), math.sin(math.radians(37 * k))
        x0, z0 = 2.4 * (k % 4), 2.4 * (k // 4)
        return [(c * x + s * z + x0, y, -s * x + c * z + z0) for x, y, z in points], triangles
    return joined(turned(k) for k in range(16))


def sphere():
    return globe(360, 700, lambda a, b: 1)


def onFloor():
    """Small on a large floor: one triangle is as large as a third of the picture, the others are
    smaller than a pixel."""
    points, triangles = ball()
    return joined([([(x, y + 1.05, z) for x, y, z in points], triangles),
                   sheet(1, lambda u, v: (30 * u - 15, 0, 30 * v - 15))])


def room():
    """Walls and furniture of boxes."""
    parts = [box((0, 0, 0), (8, 3, 6))]

    def table(x, z, long, wide, high):
        parts.append(box((x, high - 0.05, z), (x + long, high, z + wide)))
        for a in (0, long - 0.06):
            for b in (0, wide - 0.06):
                parts.append(box((x + a, 0, z + b), (x + a + 0.06, high - 0.05, z + b + 0.06)))
    table(3, 2, 2, 1, 0.75)
    for x, z in ((3.2, 1.4), (4.3, 1.4), (3.2, 3.2), (4.3, 3.2)):
        table(x, z, 0.45, 0.45, 0.45)
        parts.append(box((x, 0.45, z if z < 2 else z + 0.4), (x + 0.45, 0.95, (z if z < 2 else z + 0.4) + 0.05)))
    for shelf in range(6):
        parts.append(box((6, 0.4 * shelf, 5.6), (7.8, 0.4 * shelf + 0.04, 5.95)))
        for book in range(5):
            x = 6.1 + 0.3 * book + 0.03 * shelf
            parts.append(box((x, 0.4 * shelf + 0.04, 5.65), (x + 0.08, 0.4 * shelf + 0.3, 5.9)))
    return joined(parts)


def city():
    """Blocks on a plain."""
    draw = random.Random(5).random
    blocks = [box((1.5 * i, 0, 1.5 * j), (1.5 * i + 1, 0.3 + 4 * draw() ** 3, 1.5 * j + 1))
              for i in range(30) for j in range(30)]
    return joined(blocks + [sheet(1, lambda u, v: (48 * u - 1.6, 0, 48 * v - 1.6))])


def soup():
    """Triangles anywhere, that share nothing."""
    draw = random.Random(6).uniform
    points = []
    for _ in range(200000):
        middle = [draw(-1, 1) for _ in range(3)]
        points += [tuple(c + draw(-0.02, 0.02) for c in middle) for _ in range(3)]
    return points, [(i, i + 1, i + 2) for i in range(0, len(points), 3)]


def hair():
    """Curved strands on a ball, 200 times as long as wide: boxes of them are mostly air."""
    draw = random.Random(7).gauss
    parts = [globe(32, 64, lambda a, b: 1)]
    for _ in range(8000):
        x, y, z = (draw(0, 1) for _ in range(3))
        r = math.sqrt(x * x + y * y + z * z)
        x, y, z = x / r, y / r, z / r
        side = math.hypot(x, z) + 1e-9
        bend, points = draw(0, 0.4), []
        for k in range(7):
            out, fall = 1 + 0.12 * k, 0.02 * k * k
            for s in (-0.002, 0.002):
                turn = s * (1 - k / 8) - bend * 0.02 * k
                points.append((out * x - turn * z / side, out * y - fall, out * z + turn * x / side))
        parts.append((points, [t for k in range(0, 12, 2) for t in ((k, k + 1, k + 2), (k + 1, k + 3, k + 2))]))
    return joined(parts)


def boxes():
    """From 0.01 to 0.5 long on each side, in and through each other."""
    draw = random.Random(8)
    parts = []
    for _ in range(5000):
        middle = [draw.uniform(-1, 1) for _ in range(3)]
        size = [0.005 * 50 ** draw.random() for _ in range(3)]
        parts.append(box([c - s for c, s in zip(middle, size)], [c + s for c, s in zip(middle, size)]))
    return joined(parts)


def wires():
    """Straight strips in all directions, up to 1.5 long and 0.004 wide."""
    draw = random.Random(9)
    parts = []
    for _ in range(5000):
        x, y, z = (draw.gauss(0, 1) for _ in range(3))
        long = draw.uniform(0.2, 1.5) / math.sqrt(x * x + y * y + z * z)
        start = [draw.uniform(-1, 1) for _ in range(3)]
        end = [s + long * d for s, d in zip(start, (x, y, z))]
        side = math.hypot(x, y) / 0.004
        parts.append(([(p[0] - y * w / side, p[1] + x * w / side, p[2]) for p in (start, end) for w in (0, 1)],
                      [(0, 2, 3), (0, 3, 1)]))
    return joined(parts)


def terrain():
    def height(u, v):
        return sum(0.5 ** k * math.sin(2.1 ** k * (3 * u + k)) * math.cos(2.3 ** k * (2.5 * v - k)) for k in range(7))
    return sheet(300, lambda u, v: (10 * u, height(u, v), 10 * v))


def pair():
    return sheet(1, lambda u, v: (u, 0.3 * u * v, v))


def cube():
    return box((-1, -1, -1), (1, 1, 1))


SCANS = ("ball", "balls")
# Triangles, and what each is for.
MESHES = {
    "ball": ball,         # 69,432: a scan
    "balls": balls,       # 1,110,912: more than the caches hold
    "sphere": sphere,     # 504,000: no ray that starts outside meets it twice
    "on-floor": onFloor,  # 69,434: fine and coarse side by side
    "terrain": terrain,   # 180,000: rays that hardly meet anything twice, along the ground
    "soup": soup,         # 200,000: boxes that overlap everywhere
    "hair": hair,         # 100,096: boxes that are nearly empty
    "boxes": boxes,       # 60,000: large and small across each other
    "wires": wires,       # 10,000: no box is full, and all overlap
    "city": city,         # 10,802: large triangles, some of them hidden
    "room": room,         # 792: few and large, and every ray meets one
    "cube": cube,         # 12: no tree is worth while
    "pair": pair,         # 2: what a ray costs at least
}


def write(file, name):
    points, triangles = MESHES[name]()
    file.writelines(f"v {x:.9g} {y:.9g} {z:.9g}\n" for x, y, z in points)
    file.writelines(f"f {p + 1} {q + 1} {r + 1}\n" for p, q, r in triangles)


def writeAll(folder, names):
    """Writes these meshes into the folder; returns the files."""
    files = [os.path.join(folder, name + ".obj") for name in names]
    for file, name in zip(files, names):
        with open(file, "w", encoding="ascii") as out:
            write(out, name)
    return files


if __name__ == "__main__":
    if sys.argv[1:] == ["--list"]:
        print("\n".join(MESHES))
        sys.exit()
    if len(sys.argv) != 3 or sys.argv[1] not in MESHES:
        sys.exit(__doc__)
    with open(sys.argv[2], "w", encoding="ascii") as out:
        write(out, sys.argv[1])
