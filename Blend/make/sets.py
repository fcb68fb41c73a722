"""What several scenes have in common: colours, grounds, light, and things in rows."""

import math
import random

import bpy
from mathutils import Vector

from make.materials import Image, added, diffuse, glossy, material
from make.shapes import add_copy, add_cube, add_cylinder, add_plane
from make.staging import add_light, set_world

CORAL, MUSTARD, CREAM = (0.72, 0.16, 0.1), (0.76, 0.46, 0.08), (0.78, 0.72, 0.6)
TEAL, SLATE, WHITE = (0.05, 0.34, 0.36), (0.12, 0.15, 0.22), (0.8, 0.8, 0.8)
PALETTE = (CORAL, MUSTARD, CREAM, TEAL, SLATE)


def add_floor(shader=None, size=60):
    """Ground at z = 0: grey unless told; its texture repeats every unit."""
    add_plane("Floor", material("Floor", shader or diffuse((0.5, 0.5, 0.5))), (size, size))


def checkered(size=60, field=1.0, reflects=0.0):
    """Shader of a checkered floor of this size; field: the side of a field."""
    base = diffuse(Image("checker.ppm", scale=(size / (2 * field),) * 2, interpolation="Closest"))
    return added(base, glossy((reflects,) * 3)) if reflects else base


def add_daylight(strength=2.9, angle=1.5, sky=(0.2, 0.23, 0.28), direction=(-0.55, 0.6, -0.75), color=(1, 0.95, 0.88)):
    """A sun and an even sky."""
    add_light("SUN", "Sun", (0, 0, 10), Vector((0, 0, 10)) + Vector(direction), strength, color,
              angle=math.radians(angle))
    set_world(sky)


def add_softbox(power=700, location=(-4, -5, 7), target=(0, 0, 0), size=3.0):
    """One large lamp, seen in mirrors, and a weak sky."""
    add_light("AREA", "Softbox", location, target, power, is_visible=True, size=size)
    set_world((0.12, 0.13, 0.15))


def add_row(count, spacing, make):
    """make(i, x) for `count` things side by side, centred on x = 0."""
    for i in range(count):
        make(i, (i - (count - 1) / 2) * spacing)


def add_posts(count, spacing, radius, place):
    """A row of posts in the colours of the palette; place(i, x) gives foot and height of each."""
    paint = [material("Paint %d" % i, diffuse(color)) for i, color in enumerate(PALETTE)]

    def add_post(i, x):
        foot, height = place(i, x)
        add_cylinder("Post %d" % i, paint[i % len(paint)], radius, height, location=foot)

    add_row(count, spacing, add_post)


def add_towers(count=5):
    """A small town of boxes on a square grid."""
    walls = [material("Wall %d" % i, diffuse(color)) for i, color in enumerate(PALETTE)]
    height = random.Random(4)
    block = add_cube("Block", walls[0], 1)
    bpy.context.scene.collection.objects.unlink(block)
    for i in range(count * count):
        x, y = i % count - (count - 1) / 2, i // count - (count - 1) / 2
        h = round(0.4 + 2.4 * height.random() ** 1.6, 2)
        tower = add_copy(block, "Tower %d" % i, location=(1.25 * x, 1.25 * y, h / 2), scale=(0.9, 0.9, h))
        tower.material_slots[0].link = "OBJECT"
        tower.material_slots[0].material = walls[(i * 7 + i // count) % len(walls)]
