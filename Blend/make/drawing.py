"""Noise and shapes that textures are made of."""

import math
import random

LATTICE = 64  # the noise repeats after this many cells
_dice = random.Random(1)
ROLLS = [_dice.random() for _ in range(LATTICE * LATTICE)]  # the same ones each time


def noise(x, y, period=LATTICE):
    """Smooth noise in 0 to 1 with one random value per unit; repeats after `period` units."""
    i, j = math.floor(x), math.floor(y)
    fx, fy = x - i, y - j
    fx, fy = fx * fx * (3 - 2 * fx), fy * fy * (3 - 2 * fy)
    i0, i1 = i % period, (i + 1) % period
    j0, j1 = j % period * LATTICE, (j + 1) % period * LATTICE
    bottom = ROLLS[j0 + i0] + (ROLLS[j0 + i1] - ROLLS[j0 + i0]) * fx
    top = ROLLS[j1 + i0] + (ROLLS[j1 + i1] - ROLLS[j1 + i0]) * fx
    return bottom + (top - bottom) * fy


def clouds(x, y, period, octaves=4):
    """Noise on noise, each octave half as high and twice as fine; 0 to 1."""
    total, height = 0.0, 0.5
    for _ in range(octaves):
        total += height * noise(x, y, period)
        x, y, period, height = 2 * x, 2 * y, min(2 * period, LATTICE), height / 2
    return total / (1 - height * 2)


def mix(a, b, t):
    return tuple(x + (y - x) * t for x, y in zip(a, b))


def step(low, high, x):
    """0 below low, 1 above high, smooth between."""
    t = min(max((x - low) / (high - low), 0.0), 1.0)
    return t * t * (3 - 2 * t)


def stored(x):
    """Linear light as sRGB."""
    return 12.92 * x if x <= 0.0031308 else 1.055 * x ** (1 / 2.4) - 0.055


GLYPHS = {  # 3x5 pixels, rows from the top
    "0": "7 5 5 5 7", "1": "2 6 2 2 7", "2": "7 1 7 4 7", "3": "7 1 7 1 7", "4": "5 5 7 1 1",
    "5": "7 4 7 1 7", "6": "7 4 7 5 7", "7": "7 1 1 1 1", "A": "7 5 7 5 5", "B": "6 5 6 5 6", "C": "7 4 4 4 7",
    "D": "6 5 5 5 6", "E": "7 4 7 4 7", "F": "7 4 7 4 4", "G": "7 4 5 5 7", "H": "5 5 7 5 5",
}


def is_ink(character, x, y):
    """Whether (x, y) of the unit square, y upwards, is on a stroke of the character."""
    column, row = int(x * 3), int((1 - y) * 5)
    if not (0 <= column < 3 and 0 <= row < 5):
        return False
    return int(GLYPHS[character].split()[row][-1]) >> (2 - column) & 1 == 1
