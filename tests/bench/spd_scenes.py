"""Scenes for tests/bench/povray.py, as lists of plain shapes: three of the Standard Procedural
Databases (Eric Haines 1987), a tree and a mountain in their manner, and a field of spheres. Made by
rule alone, so that every machine has the same ones; right-handed, z up."""
import math
from collections import namedtuple

Fill = namedtuple('Fill', 'color kd ks shine')  # kd * cos + ks * cosR^shine, mirror ks
Sphere = namedtuple('Sphere', 'fill centre radius')
Cone = namedtuple('Cone', 'fill base base_radius apex apex_radius')  # without caps
Polygon = namedtuple('Polygon', 'fill corners')  # counter-clockwise from outside, convex
Scene = namedtuple('Scene', 'eye at up angle background lights items')
SKY = (0.078, 0.361, 0.753)


def add(a, b): return tuple(x + y for x, y in zip(a, b))
def sub(a, b): return tuple(x - y for x, y in zip(a, b))
def mul(a, s): return tuple(x * s for x in a)
def dot(a, b): return sum(x * y for x, y in zip(a, b))
def cross(a, b): return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])
def unit(a): return mul(a, 1 / math.sqrt(dot(a, a)))


def turn(v, axis, angle):
    """Rodrigues' rotation."""
    axis, c, s = unit(axis), math.cos(angle), math.sin(angle)
    return add(add(mul(v, c), mul(cross(axis, v), s)), mul(axis, dot(axis, v) * (1 - c)))


def pcg(n):
    """32 bits for a number, as pcg_output_rxs_m_xs (O'Neill 2014)."""
    s = (n * 747796405 + 2891336453) & 0xffffffff
    w = (((s >> ((s >> 28) + 4)) ^ s) * 277803737) & 0xffffffff
    return (w >> 22) ^ w


def uniform(n): return pcg(n) * 2.0 ** -32


def tetra(size=6):
    """A Sierpinski pyramid: polygons only, one light, no mirrors."""
    blue, items = Fill((1, 0.2, 0.2), 1, 0, 1), []
    corners = [(1, 1, 1), (1, -1, -1), (-1, 1, -1), (-1, -1, 1)]

    def pyramid(centre, half, levels):
        if levels > 0:
            for c in corners: pyramid(add(centre, mul(c, half / 2)), half / 2, levels - 1)
            return
        for i, j, k in (0, 1, 2), (0, 2, 3), (0, 3, 1), (1, 3, 2):
            a, b, c = corners[i], corners[j], corners[k]
            if dot(cross(sub(b, a), sub(c, a)), a) < 0: b, c = c, b
            items.append(Polygon(blue, [add(centre, mul(p, half)) for p in (a, b, c)]))
    pyramid((0, 0, 0), 1, size - 1)
    return Scene((1.02285, -3.17715, -2.17451), (-0.004103, -0.004103, 0.216539), (-0.816497, -0.816497, 0.816497),
                 45, SKY, [(2, -18, -5)], items)


def balls(size=4):
    """The sphereflake: (9^(size+1) - 1) / 8 mirroring spheres over a square, three lights."""
    d, tilt = math.sqrt(0.5), math.asin(2 / math.sqrt(6))
    trio = [turn(v, (1, -1, 0), tilt) for v in ((d, d, 0), (d, 0, -d), (0, d, -d))]
    children = [turn(trio[i % 3], (0, 0, 1), i // 3 * math.tau / 3) for i in range(9)]
    shiny = Fill((1, 0.9, 0.7), 0.5, 0.5, 3.0827)
    items = [Polygon(Fill((1, 0.75, 0.33), 0.8, 0, 1), [(12, 12, -.5), (-12, 12, -.5), (-12, -12, -.5), (12, -12, -.5)])]

    def ball(centre, radius, way, levels):
        items.append(Sphere(shiny, centre, radius))
        if levels == 0: return
        axis = cross((0, 0, 1), way)
        for child in children:
            if dot(axis, axis) > 0: child = turn(child, axis, math.acos(max(-1, min(way[2], 1))))
            ball(add(centre, mul(child, radius * 4 / 3)), radius / 3, child, levels - 1)
    ball((0, 0, 0), 0.5, (0, 0, 1), size)
    return Scene((2.1, 1.3, 1.7), (0, 0, 0), (0, 0, 1), 45, SKY, [(4, 3, 2), (1, -4, 4), (-3, 1, 5)], items)


def rings(size=7):
    """A pyramid of knots of six rings: as many cylinders as spheres, all mirrors, three lights."""
    # A ring of five joints about the centre of its knot, as the cube's symmetries place it.
    knot = [((1, 0, 0), ((.930995, 0, 0), (.287693, .885424, 0), (-.753191, .547222, 0), (-.753191, -.547226, 0), (.287693, -.885426, 0))),
            ((0, 1, 0), ((.753191, .547224, 0), (0, .489454, .791951), (-.753191, -.244726, .489453), (-.465497, -.640706, -.489453), (.465497, -.151246, -.791951))),
            ((0, 0, 1), ((-.287693, .885424, 0), (-.465497, .151254, .791951), (0, -.791956, .489453), (.465497, -.640706, -.489453), (.287693, .395974, -.791951))),
            ((0, 1, 1), ((-.930995, 0, 0), (-.287693, -.395976, .791951), (.753191, -.244726, .489453), (.753191, .244724, -.489453), (-.287693, .395974, -.791951))),
            ((1, 0, 1), ((-.287693, -.885426, 0), (.287693, -.395976, .791951), (.465497, .640704, .489453), (0, .791954, -.489453), (-.465497, -.151246, -.791951))),
            ((1, 1, 0), ((.753191, -.547226, 0), (.465497, .151254, .791951), (-.465497, .640704, .489453), (-.753191, .244724, -.489453), (0, -.489456, -.791951)))]
    height, radius = math.sqrt(4 + 2 * math.sqrt(2)), 0.07412
    items = [Polygon(Fill((1, 1, 1), 1, 0, 1), [(8.83895, 20.905, 10.3389), (-10.8389, 20.905, 10.3389),
                                                (-10.8389, 20.905, -9.33895), (8.83895, 20.905, -9.33895)])]
    for layer in range(size):
        for z in range(layer + 1):
            for x in range(layer + 1):
                centre = (2 * x - layer, height * (layer + 1), 2 * z - layer)
                for color, joints in knot:
                    fill = Fill(color, 0.5, 0.2, 3.0827)
                    for i in range(5):
                        here = add(centre, joints[i])
                        items.append(Cone(fill, here, radius, add(centre, joints[i - 1]), radius))
                        items.append(Sphere(fill, here, radius))
    return Scene((-1, -2.61313, 0.5), (-1, -1.61313, 0.5), (0, 0, 1), 45, SKY,
                 [(3, -2.61313, 3), (-4, -2.61313, 1), (2, -2.61313, -4)], items)


def tree(size=11):
    """Branches of cones with a sphere at each fork, no mirrors, seven lights."""
    bark, items = Fill((0.55, 0.4, 0.2), 1, 0, 1), []
    items.append(Polygon(Fill((0.5, 0.45, 0.35), 1, 0, 1), [(60, 60, 0), (-60, 60, 0), (-60, -60, 0), (60, -60, 0)]))

    def branch(at, way, side, length, radius, levels):
        end = add(at, mul(way, length))
        items.append(Cone(bark, at, radius, end, radius * 0.7))
        items.append(Sphere(bark, end, radius * 0.7))
        if levels == 0: return
        across = cross(way, side)
        for angle, twist, scale in (0.42, 0.6, 0.82), (-0.52, 1.7, 0.76):
            new = turn(way, across, angle)
            branch(end, new, turn(turn(side, across, angle), new, twist), length * scale, radius * 0.7, levels - 1)
    branch((0, 0, 0), (0, 0, 1), (1, 0, 0), 1, 0.12, size)
    lights = [(20 * math.cos(k), 20 * math.sin(k), 12 + 2 * k) for k in range(7)]
    return Scene((4.5, 0.4, 2.2), (0, 0, 1.7), (0, 0, 1), 45, SKY, lights, items)


def mount(size=7):
    """A fractal mountain of 2 * 4^size triangles with four mirroring spheres, one light."""
    n = 2 ** size
    height = [[0.0] * (n + 1) for _ in range(n + 1)]

    def set_height(i, j, parents, step):
        height[i][j] = sum(height[a][b] for a, b in parents) / len(parents) + \
            (uniform(i * 4099 + j) - 0.5) * 0.55 * step / n
    step = n  # midpoints of squares, then of their sides
    while step > 1:
        half = step // 2
        for i in range(half, n, step):
            for j in range(half, n, step):
                set_height(i, j, [(i - half, j - half), (i - half, j + half), (i + half, j - half), (i + half, j + half)], step)
        for i in range(0, n + 1, half):
            for j in range((i // half + 1) % 2 * half, n + 1, step):
                near = [(i - half, j), (i + half, j), (i, j - half), (i, j + half)]
                set_height(i, j, [(a, b) for a, b in near if 0 <= a <= n and 0 <= b <= n], step)
        step = half

    def point(i, j): return (2 * i / n - 1, 2 * j / n - 1, height[i][j])
    rock, items = Fill((0.9, 0.75, 0.5), 1, 0, 1), []
    for i in range(n):
        for j in range(n):
            a, b, c, d = point(i, j), point(i + 1, j), point(i + 1, j + 1), point(i, j + 1)
            items += [Polygon(rock, [a, b, c]), Polygon(rock, [a, c, d])]
    mirror = Fill((1, 1, 1), 0.1, 0.8, 40)
    items += [Sphere(mirror, (x, y, 0.55), 0.25) for x in (-.45, .45) for y in (-.45, .45)]
    return Scene((-1.6, 1.6, 1.7), (0, 0, 0.1), (0, 0, 1), 45, SKY, [(-4, 2, 8)], items)


def field(size=4):
    """10^size spheres of many sizes on a square, all mirroring a fifth, one light."""
    count, items = 10 ** size, []
    shrink = math.sqrt(10000 / count)  # the same part of the ground is covered
    items.append(Polygon(Fill((0.6, 0.6, 0.6), 0.7, 0.2, 50), [(60, 90, 0), (-60, 90, 0), (-60, -30, 0), (60, -30, 0)]))
    for i in range(count):
        u = [uniform(8 * i + k) for k in range(6)]
        radius = (0.08 + 0.22 * u[0]) * shrink
        fill = Fill(tuple(0.2 + 0.8 * c for c in u[3:6]), 0.7, 0.2, 50)
        items.append(Sphere(fill, (-20 + 40 * u[1], -6 + 46 * u[2], radius), radius))
    return Scene((0, -18, 6), (0, 8, 0), (0, 0, 1), 36, (0.5, 0.7, 1), [(-30, -40, 50)], items)


SCENES = {make.__name__: make for make in (balls, tetra, rings, tree, mount, field)}
