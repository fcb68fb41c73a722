"""Scenes of shapes and materials."""

import math

import bpy

from make.materials import (
    Bump, Image, NormalMap, added, diffuse, glass, glossy, material, mixed, principled, roughness_of, transparent)
from make.sets import (
    CORAL, CREAM, PALETTE, SLATE, TEAL, add_daylight, add_floor, add_posts, add_row, add_softbox, checkered)
from make.shapes import (
    add_copy, add_cube, add_cylinder, add_monkey, add_plane, add_sphere, add_torus, bevelled, subdivided)
from make.staging import add_camera, add_light, set_world
from make.textures import STUDIO_WHITE


def shapes():
    paint = [material("Paint %d" % i, diffuse(color)) for i, color in enumerate(PALETTE)]
    add_floor(checkered(reflects=0.04))
    back, front = 1.6, -0.9
    add_sphere("Sphere", paint[0], 0.7, location=(-4, back, 0.7))
    add_sphere("Ellipsoid", paint[1], 1, location=(-2, back, 0.95), rotation=(0, 25, 0), scale=(0.5, 0.7, 1))
    add_cube("Cube", paint[2], 1.1, location=(0, back, 0.83), rotation=(45, 35.264, 20))
    add_monkey("Mesh", paint[3], location=(2, back, 0.82), rotation=(-30, 0, 20), scale=0.8)
    add_monkey("Mirrored mesh", paint[3], location=(4, back, 0.82), rotation=(-30, 0, -20), scale=(-0.8, 0.8, 0.8))
    add_cylinder("Cylinder", paint[3], 0.5, 1.1, location=(-4, front, 0))
    add_cylinder("Cone", paint[4], 0.6, 1.3, top=0, location=(-2.4, front, 0))
    add_cylinder("Frustum", paint[0], 0.6, 0.9, top=0.3, location=(-0.8, front, 0))
    add_torus("Torus", paint[1], 0.48, 0.2, location=(0.8, front, 0.2))
    add_plane("Plane", paint[2], (1.1, 1.1), location=(2.4, front, 0.6), rotation=(65, 0, 25))
    add_cylinder("Disk", paint[0], 0.6, 0.01, shape="disk", location=(4, front, 0.6),
                 rotation=(60, 0, -20))
    add_softbox(900, size=2)
    add_camera((0, -9.6, 4.6), (0, 0, 0.5), 34)


def instances():
    """One mesh, 233 times, on the spiral of a sunflower."""
    paint = [material("Paint %d" % i, principled(color, 0.35)) for i, color in enumerate(PALETTE)]
    add_floor(diffuse((0.42, 0.42, 0.44)))
    first = add_monkey("Monkey", paint[0])
    bpy.context.scene.collection.objects.unlink(first)
    for i in range(233):
        angle, radius = 2.399963 * i, 0.52 * math.sqrt(i + 0.5)
        x, y = radius * math.cos(angle), radius * math.sin(angle)
        size = 0.24 + 0.014 * radius
        copy = add_copy(first, "Monkey %d" % i, location=(x, y, 0.72 * size), scale=size,
                        rotation=(-25, 0, math.degrees(angle) + 90))
        subdivided(copy, 1)
        copy.material_slots[0].link, copy.material_slots[0].material = "OBJECT", paint[i % 5]
    add_softbox(2600, (-8, -6, 10), size=3)
    add_camera((0, -13.5, 8.6), (0, -0.5, 0), 37)


def mirror():
    """Two mirrors face each other; what stands between them repeats."""
    silver = material("Mirror", glossy((0.92, 0.94, 0.95)))
    frame = material("Frame", diffuse(SLATE))
    add_floor(checkered())
    for y, turn, name in ((3.0, 90, "Back"), (-12.0, -90, "Front")):
        add_plane(name + " mirror", silver, (6.4, 3.6), location=(0, y, 2.1), rotation=(turn, 0, 0))
        add_cube(name + " frame", frame, 1, location=(0, y + math.copysign(0.08, y), 2.1), scale=(6.8, 0.1, 4.0))
    metals = ((0.95, 0.93, 0.9), (0.95, 0.7, 0.32), (0.9, 0.5, 0.36))
    add_row(3, 1.9, lambda i, x: add_sphere("Ball %d" % i, material("Metal %d" % i, glossy(metals[i])), 0.75,
                                            location=(x, (0.4, -0.6, 0.4)[i], 0.75)))
    add_cube("Box", material("Red", diffuse(CORAL)), 0.6, location=(-2.6, -1.2, 0.3), rotation=(0, 0, 25))
    add_cylinder("Post", material("Green", diffuse(TEAL)), 0.25, 1.5, location=(2.6, -1.0, 0))
    add_softbox(1100, (-5, -5, 7.5), size=2)
    set_world((0.4, 0.46, 0.55))
    add_camera((1.6, -8.2, 2.7), (0.1, 0, 1.1), 42)


def glass_scene():
    """Solid, hollow, filled with water, and coloured."""
    clear, water = material("Glass", glass((1, 1, 1), 1.5)), material("Water", glass((0.8, 0.93, 1), 1.33))
    air, green = material("Air", glass((1, 1, 1), 1.0)), material("Green glass", glass((0.45, 0.85, 0.6), 1.5))
    add_floor(checkered())
    fillings = (None, air, water)

    def add_ball(i, x):
        add_sphere("Ball %d" % i, clear, 0.8, location=(x, 0, 0.8))
        if fillings[i]:
            add_sphere("Filling %d" % i, fillings[i], 0.7, location=(x, 0, 0.8))

    add_row(3, 1.9, lambda i, x: add_ball(i, x - 1.1))
    bevelled(add_cube("Block", green, 1.2, location=(2.9, 0.2, 0.6), rotation=(0, 0, 32)), 0.08, 3)
    add_posts(7, 1.1, 0.22, lambda i, x: ((x, 2.6, 0), 1.6))
    add_softbox(1000, (-4, 3, 7), size=2.5)
    set_world((0.45, 0.5, 0.58))
    add_camera((0.3, -8.2, 2.5), (0.3, 0, 0.7), 37)


def glossy_scene():
    """Roughness 0, 0.1, 0.2, 0.3, 0.45 and 0.6 under a sky with a window."""
    add_floor(checkered(field=0.5))
    steps = (0.0, 0.1, 0.2, 0.3, 0.45, 0.6)
    add_row(6, 1.35, lambda i, x: add_sphere(
        "Roughness %s" % steps[i], material("Metal %s" % steps[i], glossy((0.9, 0.72, 0.5), steps[i])), 0.6,
        location=(x, 0, 0.6)))
    set_world(environment="studio.png", strength=STUDIO_WHITE)
    add_light("SUN", "Sun", (-3, -2, 5), (0, 0, 0), 1.2)
    add_camera((0, -8.8, 2.9), (0, 0, 0.5), 36)


def blinn():
    """Blinn-Phong exponents 4 to 4000; strengths so that the highlights keep about the same light."""
    exponents = (4, 16, 63, 250, 1000, 4000)
    add_floor(diffuse((0.2, 0.2, 0.22)))

    def add_ball(i, x):
        shader = added(diffuse((0.03, 0.2, 0.42)), glossy((0.22, 0.22, 0.22), roughness_of(exponents[i])))
        add_sphere("Exponent %d" % exponents[i], material("n = %d" % exponents[i], shader), 0.6, location=(x, 0, 0.6))

    add_row(6, 1.35, add_ball)
    add_light("POINT", "Lamp", (-3.5, -5, 6), (0, 0, 0), 1500)
    add_light("POINT", "Fill", (6, -4, 3), (0, 0, 0), 220, (1, 0.7, 0.45))
    set_world((0.02, 0.02, 0.025))
    add_camera((0, -8.8, 2.2), (0, 0, 0.5), 36)


def textures():
    """Above: repeat, extend, clip. Below: nearest, bilinear, turned and scaled."""
    thrice = dict(scale=(2.4, 2.4), offset=(-0.7, -0.7))
    panels = (
        Image("uv_grid.ppm", **thrice),
        Image("uv_grid.ppm", extension="EXTEND", **thrice),
        Image("uv_grid.ppm", extension="CLIP", **thrice),
        Image("letters.ppm", interpolation="Closest"),
        Image("letters.ppm"),
        Image("uv_grid.ppm", scale=(0.7, 1.4), rotation=30),
    )
    add_plane("Wall", material("Back", diffuse((0.5, 0.48, 0.45))), (40, 20), location=(0, 0.1, 0), rotation=(90, 0, 0))
    for i, image in enumerate(panels):
        add_plane("Panel %d" % i, material("Panel %d" % i, diffuse(image)), (1.8, 1.8),
                  location=((i % 3 - 1) * 2.1, 0, 1.05 - i // 3 * 2.1), rotation=(90, 0, 0))
    add_sphere("Globe", material("Globe", diffuse(Image("uv_grid.ppm", scale=(2, 1)))), 0.95, shape="",
               location=(4.1, -0.9, 1.05), rotation=(15, 0, -60))
    add_cube("Box", material("Boards", diffuse(Image("wood.ppm"))), 1.4,
             location=(4.1, -0.9, -1.05), rotation=(20, 0, 35))
    add_cylinder("Pillar", material("Stone", diffuse(Image("stone.ppm", scale=(2, 1)))), 0.65, 4.0, shape="mesh",
                 location=(-4.0, -0.7, -2.0))
    add_softbox(1100, (-5, -9, 6), size=3)
    set_world((0.25, 0.25, 0.25))
    add_camera((0, -10.8, 0), (0, 0, 0), 34)


def bump_normal():
    """The same clay plain, with a height map and with a normal map."""
    add_floor()
    bent = (
        {},
        {"Normal": Bump(Image("dimples.ppm", scale=(1, 0.5), is_data=True), 0.06)},
        {"Normal": NormalMap(Image("studs.ppm", scale=(2, 1), is_data=True))},
    )
    add_row(3, 2.5, lambda i, x: add_sphere(
        ("Plain", "Bump", "Normal map")[i], material("Clay %d" % i, diffuse((0.6, 0.3, 0.2), **bent[i])), 1, 48,
        shape="", location=(x, 0, 1)))
    add_softbox(620, (-6, -4, 5), size=1.5)
    add_camera((0, -9, 2.6), (0, 0, 0.95), 38)


def transparent_scene():
    """Cut out by a picture, half there, and coloured light through panes."""
    add_floor(diffuse(CREAM))
    picture = Image("leaf.png", extension="CLIP")
    cut = mixed(Image("leaf.png", extension="CLIP", output="Alpha"), transparent(), diffuse(picture))
    leaf_material = material("Leaf", cut)
    for i, (x, y, turn) in enumerate(((-3.6, 0.2, 20), (-2.9, 0.7, -25), (-2.3, 0, 10))):
        add_plane("Leaf %d" % i, leaf_material, (1.1, 2.2), location=(x, y, 1.1), rotation=(80, 0, turn))
    half = material("Half", mixed(0.5, diffuse(CORAL), transparent()))
    add_sphere("Half there", half, 0.8, location=(-0.4, 0.2, 0.8))
    colors = ((0.95, 0.25, 0.15), (0.2, 0.8, 0.3), (0.2, 0.4, 0.95))
    add_row(3, 0.95, lambda i, x: add_plane(
        "Pane %d" % i, material("Pane %d" % i, transparent(colors[i])), (0.85, 1.9),
        location=(x + 2.5, 0.4, 0.95), rotation=(90, 0, 15)))
    add_daylight(2.4, 1, (0.35, 0.38, 0.42), (0.3, -0.75, -0.75))
    add_camera((0, -8.8, 3.3), (-0.1, -0.2, 0.65), 37)
