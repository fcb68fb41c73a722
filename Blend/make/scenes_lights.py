"""Scenes of lights."""

import math

from mathutils import Vector

from make.materials import diffuse, emission, glass, glossy, material, principled
from make.sets import CORAL, CREAM, WHITE, add_daylight, add_floor, add_posts, add_row
from make.shapes import add_cube, add_cylinder, add_plane, add_sphere
from make.staging import add_camera, add_light, set_world


def lights_point():
    add_floor()
    white = material("White", diffuse(WHITE))
    add_sphere("Ball", white, 1, location=(0, 0, 1))
    add_cube("Left box", white, 1, location=(-2.6, 0.6, 0.5), rotation=(0, 0, 30))
    add_cylinder("Right post", white, 0.45, 1.6, location=(2.5, 0.5, 0))
    add_row(3, 2.6, lambda i, x: add_light(
        "POINT", "Lamp %d" % i, (x, -2.4, 3.0), (0, 0, 0), 200, ((1, 0.25, 0.12), (0.3, 1, 0.35), (0.2, 0.4, 1))[i]))
    set_world((0.02, 0.02, 0.025))
    add_camera((0, -8.8, 4), (0, 0, 0.7), 44)


def lights_spot():
    add_floor()
    add_plane("Wall", material("Back", diffuse((0.55, 0.55, 0.57))), (40, 20), location=(0, 3, 0), rotation=(90, 0, 0))
    white = material("White", diffuse(WHITE))

    def add_spot(i, x):
        add_light("SPOT", "Spot blend %s" % (0, 0.3, 1)[i], (x, -2.4, 4.4), (x, 1.4, 0.9), 900,
                  ((1, 0.75, 0.5), (0.6, 1, 0.75), (0.6, 0.75, 1))[i],
                  spot_size=math.radians(38), spot_blend=(0, 0.3, 1)[i])
        add_sphere("Ball %d" % i, white, 0.6, location=(x, 1.0, 0.6))

    add_row(3, 3.0, add_spot)
    set_world((0.06, 0.06, 0.07))
    add_camera((0, -9, 3.2), (0, 0, 1.15), 42)


def lights_sun():
    """A low sun as wide as the real one: long shadows, a little soft at their far ends."""
    add_floor(diffuse(CREAM))
    add_posts(9, 0.85, 0.18, lambda i, x: ((x, 0, 0), 0.7 + 0.2 * (4 - abs(i - 4))))
    add_daylight(3.4, 0.53, (0.16, 0.2, 0.28), (0.75, -0.7, -0.42), (1, 0.82, 0.6))
    add_camera((1.2, -8.8, 4.2), (0.8, -0.8, 0.3), 38)


def lights_area():
    """The four shapes of area lights and a glowing sphere, each in a bay of its own."""
    add_floor()
    white, wall = material("White", diffuse(WHITE)), material("Bay", diffuse((0.6, 0.58, 0.55)))
    glow = material("Glow", emission((1, 0.93, 0.84), 14))
    add_plane("Back", wall, (30, 8), location=(0, 1.6, 0), rotation=(90, 0, 0))
    add_row(6, 2.4, lambda i, x: add_cube("Partition %d" % i, wall, 1, location=(x, 0, 1.5), scale=(0.06, 3.2, 3)))

    def add_bay(i, x):
        add_sphere("Ball %d" % i, white, 0.5, location=(x, -0.3, 0.5))
        if i == 4:
            add_sphere("Sphere", glow, 0.32, location=(x, 0.7, 2.35))
            return
        shape = ("SQUARE", "RECTANGLE", "DISK", "ELLIPSE")[i]
        add_light("AREA", shape.title(), (x, 0.7, 2.35), (x, -0.5, 0.4), 70, (1, 0.93, 0.84), True, shape=shape,
                  size=(0.9, 1.5, 1.0, 1.5)[i], size_y=(0.9, 0.45, 1.0, 0.5)[i])

    add_row(5, 2.4, add_bay)
    set_world((0.14, 0.14, 0.14))
    add_camera((0, -10.5, 1.5), (0, 0, 1.35), 27)


def soft_shadows():
    """Shadows are sharp where things touch the floor and soften with the distance."""
    add_floor(diffuse((0.62, 0.6, 0.57)))
    add_posts(9, 0.55, 0.09, lambda i, x: ((x - 0.8, 0.6, 0), 1.7))
    add_sphere("Ball", material("Red", diffuse(CORAL)), 0.7, location=(2.9, -0.1, 0.7))
    add_light("AREA", "Disk", (2.5, 7.0, 6.5), (0, 0, 0), 1300, (1, 0.95, 0.88), shape="DISK", size=1.6)
    set_world((0.14, 0.15, 0.17))
    add_camera((0.3, -7.5, 4.4), (0.3, -0.3, 0.6), 40)


def world_environment():
    """An evening sky as background, in reflections and through glass."""
    add_cylinder("Ground", material("Ground", diffuse((0.3, 0.28, 0.26))), 4.2, 0.2, location=(0, 0, -0.2))
    shaders = (glossy((0.95, 0.95, 0.95)), glass((1, 1, 1), 1.5), principled(CORAL), glossy((0.9, 0.75, 0.5), 0.25))
    add_row(4, 1.75, lambda i, x: add_sphere("Ball %d" % i, material("Ball %d" % i, shaders[i]), 0.75,
                                             location=(x, 0, 0.75)))
    set_world(environment="sky.pfm", rotation=-25)
    # The picture lights diffuse things evenly; the sun in it casts its shadows as a lamp.
    add_light("SUN", "Sun", (0, 0, 5), Vector((0, 0, 5)) - Vector((0.05, 0.95, 0.3)), 1.5, (1, 0.7, 0.4),
              angle=math.radians(4))
    add_camera((0.6, -8, 1.5), (0, 0, 0.95), 38)
