"""The showcase: a tea table."""

import math

from make.materials import Bump, Image, added, diffuse, glass, glossy, material, principled
from make.shapes import (
    add_collection, add_copy, add_cube, add_cylinder, add_instance, add_lathe, add_object, add_plane, add_sphere,
    add_torus, add_tube, bevelled, subdivided)
from make.staging import add_camera, add_light, blur_motion, move, set_world
from make.textures import STUDIO_WHITE

SUGAR = 0.24  # edge of a cube of sugar
ORANGE_SKIN = Bump(Image("dimples.ppm", scale=(2, 1), is_data=True), 0.004)


def teapot(glaze, **where):
    """Body, lid, spout and handle; 2 wide at the body, stands on z = 0. Spout along +x."""
    body = [(0, 0), (0.62, 0), (0.68, 0.06), (0.98, 0.5), (1.0, 0.78), (0.72, 1.18), (0.52, 1.26), (0, 1.27)]
    lid = [(0.56, 1.24), (0.55, 1.31), (0.3, 1.42), (0.09, 1.46), (0.09, 1.53), (0.19, 1.62), (0.1, 1.72), (0, 1.73)]
    spout = [(0.75, 0.42), (1.12, 0.52), (1.36, 0.88), (1.5, 1.2), (1.66, 1.33)]
    handle = [(-0.66, 1.1), (-1.0, 1.3), (-1.42, 1.22), (-1.56, 0.9), (-1.36, 0.56), (-0.86, 0.36)]
    root = add_object("Teapot", None, **where)
    parts = [
        subdivided(add_lathe("Teapot body", body, glaze, 12), 2),
        subdivided(add_lathe("Teapot lid", lid, glaze, 12), 2),
        subdivided(add_tube("Teapot spout", spout, (0.34, 0.27, 0.17, 0.13, 0.12), glaze), 2),
        subdivided(add_tube("Teapot handle", handle, (0.1,) * 6, glaze, 6), 2),
    ]
    for part in parts:
        part.parent = root
    return root


def cup_and_saucer(china, tea):
    """A collection; stands on z = 0, handle along +x."""
    cup = [(0, 0.1), (0.2, 0.1), (0.22, 0.15), (0.46, 0.36), (0.53, 0.72), (0.5, 0.72), (0.43, 0.4), (0, 0.2)]
    handle = [(0.46, 0.62), (0.66, 0.68), (0.76, 0.5), (0.64, 0.34), (0.44, 0.32)]
    saucer = [(0, 0), (0.32, 0), (0.78, 0.11), (0.78, 0.14), (0.32, 0.06), (0, 0.06)]
    group = add_collection("Cup and saucer")
    subdivided(add_lathe("Cup", cup, china, 16, collection=group), 1)
    subdivided(add_tube("Cup handle", handle, (0.05,) * 5, china, 6, collection=group), 1)
    subdivided(add_lathe("Saucer", saucer, china, 16, collection=group), 1)
    add_cylinder("Tea", tea, 0.485, 0.01, shape="disk", location=(0, 0, 0.58), collection=group)
    return group


def showcase():
    """A tea table: most features in one picture."""
    celadon = material("Celadon glaze", principled((0.02, 0.17, 0.17)))
    china = material("China", principled((0.8, 0.77, 0.7)))
    tea = material("Tea", principled((0.2, 0.05, 0.008)))
    steel = material("Steel", glossy((0.92, 0.92, 0.92)))
    crystal = material("Crystal", glass((1, 1, 1), 1.52))
    brass = material("Brass", glossy((0.8, 0.52, 0.2), 0.15))
    sugar = material("Sugar", diffuse((0.86, 0.85, 0.82)))
    paper = material("Blue paper", diffuse((0.06, 0.12, 0.3)))
    dough = material("Chocolate", principled((0.12, 0.045, 0.02), 0.3))
    orange = material("Orange", added(
        diffuse(Image("peel.ppm", scale=(2, 1)), Normal=ORANGE_SKIN),
        glossy((0.04, 0.04, 0.04), 0.35, Normal=ORANGE_SKIN)))
    boards = material("Boards", added(
        diffuse(Image("wood.ppm", scale=(2.5, 3))), glossy((0.05, 0.05, 0.05))))
    wall = material("Wall", diffuse((0.2, 0.25, 0.27)))

    add_plane("Table", boards, (24, 18), location=(0, -1, 0))
    add_plane("Wall", wall, (80, 40), location=(0, 14, 0), rotation=(90, 0, 0))

    teapot(celadon, location=(-1.42, 0.5, 0), rotation=(0, 0, -24))
    cups = cup_and_saucer(china, tea)
    add_instance(cups, "Cup front", location=(1.5, -0.75, 0), rotation=(0, 0, -35))
    add_instance(cups, "Cup right", location=(3.5, 2.5, 0), rotation=(0, 0, 200))
    add_instance(cups, "Cup back", location=(0.15, 3.6, 0), rotation=(0, 0, 160))

    add_sphere("Steel ball", steel, 0.6, location=(0.78, 1.5, 0.6))
    add_sphere("Crystal ball", crystal, 0.36, location=(-0.3, -1.3, 0.36))
    first = add_sphere("Orange", orange, 0.4, shape="", location=(2.62, 0.15, 0.4), rotation=(20, 30, 0))
    add_copy(first, location=(3.25, 0.6, 0.39), rotation=(70, -40, 50), scale=0.97)
    add_torus("Doughnut", dough, 0.33, 0.15, 24, location=(-2.15, -1.1, 0.16))
    add_cylinder("Tin", brass, 0.45, 1.1, location=(-3.0, 1.9, 0))
    add_cylinder("Sugarloaf", paper, 0.38, 1.25, top=0.08, location=(3.0, 4.6, 0))

    for i, (x, y, turn) in enumerate(((0.4, -1.8, 15), (0.73, -1.62, 50), (0.56, -2.02, 80))):
        cube = add_cube("Sugar %d" % i, sugar, SUGAR, location=(x, y, SUGAR / 2), rotation=(0, 0, turn))
        bevelled(cube, 0.03)
    falling = bevelled(add_cube("Falling sugar", sugar, SUGAR), 0.03)
    move(falling, (0, 2), location=((1.5, -0.75, 1.47), (1.5, -0.75, 1.25)),
         rotation_euler=((0.5, 0.4, 0.2), (0.7, 0.5, 0.2)))
    blur_motion()

    add_light("AREA", "Key", (-5.9, -2.2, 6.2), (0, 0.2, 0.2), 2300, (1, 0.94, 0.86), True,
              shape="RECTANGLE", size=3.8, size_y=2.8)
    add_light("AREA", "Rim", (6.2, 3.0, 3.4), (0, 0, 0.6), 190, (1, 0.62, 0.34), True, shape="DISK", size=1.6)
    add_light("SPOT", "Wall glow", (-1.0, 4.5, 7.5), (-0.8, 14, 2.0), 6500, (0.7, 0.88, 1),
              spot_size=math.radians(85), spot_blend=1, shadow_soft_size=0.3)
    set_world(environment="studio.png", strength=0.8 * STUDIO_WHITE)
    camera = add_camera((0.45, -9.2, 3.5), (0.22, 0, 0.66), 51, fstop=0.5, focus=(-0.2, -0.6, 0.6))
    camera.data.dof.aperture_blades = 6
