"""The textures: a function each, and one table."""

import math
from dataclasses import dataclass

from make.drawing import LATTICE, ROLLS, clouds, is_ink, mix, noise, step, stored

# Each is a function of u to the right and v upwards, both in 0 to 1, to 3 or 4 numbers: for PPM and
# PNG what is stored, 0 to 1; for PFM radiance.


def checker(u, v):
    return (0.85, 0.83, 0.78) if (int(u * 2) + int(v * 2)) % 2 else (0.16, 0.19, 0.24)


def uv_grid(u, v):
    """8x8 fields A0 to H7: the letter counts upwards, the digit to the right."""
    column, row = int(u * 8), int(v * 8)
    x, y = u * 8 - column, v * 8 - row
    field = mix((0.95, 0.55, 0.25), (0.2, 0.5, 0.8), column / 7)
    field = mix(field, (0.97, 0.95, 0.85), 0.75 * row / 7)
    if (column + row) % 2:
        field = mix(field, (0, 0, 0), 0.22)
    if min(x, y) < 0.04:
        return (0.12, 0.12, 0.14)
    for character, left in (("ABCDEFGH"[row], 0.2), (str(column), 0.55)):
        if is_ink(character, (x - left) / 0.27, (y - 0.28) / 0.45):
            return (0.1, 0.1, 0.12)
    return field


def letters(u, v):
    """16x16 pixels with A B above C D, for looking at pixels."""
    column, row = int(u * 2), int(v * 2)
    x, y = u * 2 - column, v * 2 - row
    ink, paper = (0.1, 0.2, 0.35), (0.95, 0.75, 0.35)
    if (column + row) % 2:
        ink, paper = (0.75, 0.2, 0.15), (0.97, 0.93, 0.85)
    return ink if is_ink("CDAB"[2 * row + column], (x - 0.25) / 0.375, (y - 0.125) / 0.625) else paper


def wood(u, v):
    """Four planks along u, each with its own grain and shade."""
    plank = int(v * 4)
    across = v * 4 - plank
    shift = 0.37 * plank
    bend = clouds((u + shift) * 4, v * 16, 16, 3)
    rings = 0.5 + 0.5 * math.sin(2 * math.pi * (across * 2.2 + 3.2 * bend + shift))
    fibre = noise((u + shift) * 12, v * 64 * 3, LATTICE)
    shade = (0.5, 0.38, 0.62, 0.44)[plank] + 0.2 * (rings - 0.5) + 0.16 * (fibre - 0.5)
    color = mix((0.46, 0.33, 0.23), (0.86, 0.68, 0.5), shade)
    joint = step(0.0, 0.02, min(across, 1 - across))
    return mix((0.14, 0.09, 0.06), color, joint)


def stone(u, v):
    vein = abs(clouds(u * 4, v * 4, 4, 5) - 0.5) * 2
    speck = clouds(u * 32, v * 32, 32, 2)
    color = mix((0.38, 0.36, 0.36), (0.76, 0.73, 0.68), step(0.0, 0.22, vein))
    return mix(color, (0.3, 0.28, 0.28), 0.35 * step(0.6, 0.85, speck))


def peel(u, v):
    """Skin of an orange."""
    blotch = clouds(u * 4, v * 4, 4, 3)
    return mix((0.93, 0.42, 0.05), (0.98, 0.62, 0.14), step(0.25, 0.75, blotch))


def dimples(u, v):
    """Height: round pits on a jittered grid that repeats."""
    cells, depth = 32, 0.0
    x, y = u * cells, v * cells
    for i in range(math.floor(x) - 1, math.floor(x) + 2):
        for j in range(math.floor(y) - 1, math.floor(y) + 2):
            a, b = i % cells, j % cells
            px = i + 0.5 + 0.5 * (ROLLS[b * LATTICE + a] - 0.5)
            py = j + 0.5 + 0.5 * (ROLLS[b * LATTICE + a + cells] - 0.5)
            depth = max(depth, 1 - 2.2 * math.hypot(x - px, y - py))
    return (1 - step(0.0, 1.0, depth),) * 3


def studs_height(u, v):
    x, y = (u * 6) % 1 - 0.5, (v * 6) % 1 - 0.5
    return 0.02 * (1 - step(0.22, 0.38, math.hypot(x, y)))


def studs(u, v):
    """Normal map of a field of round studs: x, y, z of the normal as (n + 1) / 2."""
    e = 1 / 1024
    du = (studs_height(u + e, v) - studs_height(u - e, v)) / (2 * e)
    dv = (studs_height(u, v + e) - studs_height(u, v - e)) / (2 * e)
    size = math.sqrt(du * du + dv * dv + 1)
    return (0.5 - 0.5 * du / size, 0.5 - 0.5 * dv / size, 0.5 + 0.5 / size)


def leaf(u, v):
    """A leaf with an alpha channel."""
    x, y = u - 0.5, (v - 0.06) / 0.88
    if not 0 <= y <= 1:
        return (0.2, 0.4, 0.1, 0.0)
    half = 0.42 * math.sin(math.pi * y) ** 0.8 * (1.15 - 0.5 * y)
    edge = half - abs(x) + 0.008 * math.sin(60 * y)
    vein = min(abs(x), abs((y * 7 - 9 * abs(x)) % 1 - 0.5) * 0.1)
    color = mix((0.62, 0.78, 0.3), (0.2, 0.45, 0.12), step(0.0, 0.02, vein))
    return color + (step(0.0, 0.012, edge),)


def panel(azimuth, elevation, center, size, soft=3.0):
    """1 inside of a rectangle on the sky, 0 outside; degrees."""
    across = abs((azimuth - center[0] + 180) % 360 - 180)
    up = abs(elevation - center[1])
    return (1 - step(size[0] - soft, size[0] + soft, across)) * (1 - step(size[1] - soft, size[1] + soft, up))


STUDIO_WHITE = 3.5  # radiance that is stored as 1


def studio(u, v):
    """Room for reflections: dim warm floor, grey walls, two windows and a strip."""
    azimuth, elevation = (0.5 - u) * 360, (v - 0.5) * 180  # azimuth from +x towards +y
    light = mix((0.06, 0.05, 0.045), (0.2, 0.22, 0.25), step(-25, 35, elevation))
    light = mix(light, (0.1, 0.12, 0.15), step(40, 90, elevation))
    for center, size, color in (
            ((-150, 30), (13, 17), (3.2, 3.3, 3.5)),
            ((-178, 30), (11, 17), (2.6, 2.8, 3.2)),
            ((-20, 28), (6, 26), (2.4, 1.9, 1.4))):
        light = mix(light, color, panel(azimuth, elevation, center, size))
    return tuple(stored(x / STUDIO_WHITE) for x in light)


def sky(u, v):
    """Evening: bright towards the horizon, a sun with its glow, clouds, dark ground."""
    azimuth, elevation = (0.5 - u) * 360, (v - 0.5) * 180
    up = max(math.sin(math.radians(elevation)), 0.0)
    light = mix((0.7, 0.52, 0.38), (0.13, 0.27, 0.6), up ** 0.5)
    veil = clouds(u * 8, v * 16, 8, 5)
    light = mix(light, (0.85, 0.74, 0.66), 0.7 * step(0.48, 0.75, veil) * step(0.02, 0.3, up))
    away = math.hypot(((azimuth - 60 + 180) % 360 - 180) * math.cos(math.radians(elevation)), elevation - 16)
    glow = 1.3 * math.exp(-away / 8) + 30 * (1 - step(2.0, 4.0, away))
    light = tuple(x + glow * y for x, y in zip(light, (1.0, 0.75, 0.45)))
    return mix((0.16, 0.14, 0.12), light, step(-1.5, 1.0, elevation))


def dusk(u, v):
    """After sunset: a bright band where the sun went down, a moon, dark ground."""
    azimuth, elevation = (0.5 - u) * 360, (v - 0.5) * 180
    up = max(math.sin(math.radians(elevation)), 0.0)
    light = mix((0.3, 0.26, 0.38), (0.035, 0.06, 0.17), up ** 0.6)
    across = (azimuth - 100 + 180) % 360 - 180
    band = math.exp(-((across / 55) ** 2)) * math.exp(-abs(elevation - 2) / 9)
    light = tuple(x + y * 1.5 * band for x, y in zip(light, (1.0, 0.45, 0.16)))
    streak = clouds(u * 8, v * 64, 8, 4)
    light = mix(light, (0.5, 0.28, 0.3), 0.6 * step(0.5, 0.75, streak) * step(0.02, 0.2, up) * (1 - step(0.3, 0.6, up)))
    moon = math.hypot(((azimuth + 60 + 180) % 360 - 180) * math.cos(math.radians(elevation)), elevation - 38)
    light = mix(light, (14, 15, 17), 1 - step(2.2, 3.4, moon))
    return mix((0.05, 0.045, 0.05), light, step(-1.5, 1.0, elevation))


def hills(u, v):
    """A view: the sun over rows of hills, each bluer than the one before it, and a lake."""
    shore = 0.2
    y = v if v > shore else shore + (shore - v) * 1.6 + 0.01 * math.sin(90 * v + 4 * noise(u * 12, v * 60))
    light = mix((1.0, 0.72, 0.42), (0.32, 0.5, 0.74), step(0.35, 1.0, y))
    away = math.hypot((u - 0.66) * 1.5, y - 0.72)
    light = mix(light, (1.0, 0.96, 0.8), (1 - step(0.05, 0.06, away)) + 0.6 * math.exp(-away / 0.08))
    for i in range(5):
        ridge = 0.62 - 0.09 * i + (0.34 - 0.03 * i) * (clouds(u * (3 + i) + 7.7 * i, 3.1 * i, LATTICE, 6) - 0.5)
        if y < ridge:
            light = mix((0.72, 0.6, 0.6), (0.08, 0.15, 0.16), i / 4)
            light = mix(light, (0.85, 0.68, 0.55), 0.35 * step(0.0, 0.2, ridge - y) * (1 - i / 5))
    return light if v > shore else mix(light, (0.1, 0.16, 0.24), 0.45)


def stained_glass(u, v):
    """Light behind panes of coloured glass between strips of lead; up to 3.5."""
    x, y, nearest = u * 6, v * 9, []
    for i in range(math.floor(x) - 1, math.floor(x) + 2):
        for j in range(math.floor(y) - 1, math.floor(y) + 2):
            roll = ROLLS[(j + 3) % LATTICE * LATTICE + (i + 3) % LATTICE]
            turn = ROLLS[(j + 3) % LATTICE * LATTICE + (i + 35) % LATTICE]
            nearest.append((math.hypot(x - i - 0.15 - 0.7 * roll, y - j - 0.15 - 0.7 * turn), roll, turn))
    nearest.sort()
    (first, roll, turn), second = nearest[0], nearest[1][0]
    panes = ((1.0, 0.14, 0.06), (1.0, 0.55, 0.08), (0.1, 0.35, 1.0), (0.08, 0.75, 0.4), (0.75, 0.15, 0.7), (1.0, 0.9, 0.6))
    lamp = 0.5 + 3 * math.exp(-((u - 0.5) ** 2 + 0.45 * (v - 0.55) ** 2) / 0.05)
    lead = 1 - step(0.06, 0.1, second - first)
    if min(u, 1 - u) < 0.03 or min(v, 1 - v) < 0.02:
        lead = 1
    pane = panes[int(6 * (roll * 7.31 % 1))]
    return mix(tuple(lamp * c for c in pane), (0.004, 0.004, 0.004), lead)


@dataclass
class Picture:
    draw: object
    width: int
    height: int


TEXTURES = {
    "checker.ppm": Picture(checker, 64, 64),
    "uv_grid.ppm": Picture(uv_grid, 256, 256),
    "letters.ppm": Picture(letters, 16, 16),
    "wood.ppm": Picture(wood, 512, 256),
    "stone.ppm": Picture(stone, 256, 256),
    "peel.ppm": Picture(peel, 128, 128),
    "dimples.ppm": Picture(dimples, 256, 256),
    "studs.ppm": Picture(studs, 256, 256),
    "leaf.png": Picture(leaf, 128, 128),
    "studio.png": Picture(studio, 256, 128),
    "sky.pfm": Picture(sky, 256, 128),
    "hills.jpg": Picture(hills, 384, 256),
    "leaf.tga": Picture(leaf, 128, 128),
    "stained_glass.hdr": Picture(stained_glass, 128, 192),
    "dusk.exr": Picture(dusk, 256, 128),
}
