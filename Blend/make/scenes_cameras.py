"""Scenes of cameras, and of what their pixels gather."""

import bpy

from make.drawing import ROLLS
from make.materials import Image, diffuse, emission, glossy, material
from make.sets import (
    CORAL, CREAM, PALETTE, TEAL, add_daylight, add_floor, add_posts, add_softbox, add_towers, checkered)
from make.shapes import add_cube, add_cylinder, add_sphere, add_torus
from make.staging import add_camera, blur_motion, move, set_world


def camera_perspective():
    add_towers()
    add_floor(diffuse(CREAM))
    add_daylight()
    add_camera((3.9, -6.2, 4.4), (0.2, 0, 0.55), 24)


def camera_fit():
    """A portrait with pixels that are wider than high; the sensor is fitted by its height."""
    add_towers(3)
    add_floor(diffuse(CREAM))
    add_daylight()
    bpy.context.scene.render.pixel_aspect_x = 1.25
    add_camera((3.6, -6.0, 3.6), (0, 0, 0.75), 26, roll=-6, sensor_fit="VERTICAL", sensor_width=32, sensor_height=20)


def camera_ortho():
    add_towers()
    add_floor(diffuse(CREAM))
    add_daylight()
    add_camera((10, -10, 8.5), (0, 0, 0.8), type="ORTHO", ortho_scale=12.5)


def camera_shift():
    """The camera looks level, so upright edges stay upright; the shift moves the picture up."""
    add_towers()
    add_floor(diffuse(CREAM))
    add_daylight(direction=(-0.5, 0.75, -0.6))
    add_camera((4.6, -7.2, 0.9), (0.2, 0, 0.9), 25, shift_y=0.1)


def dof():
    """Sharp at the third column; points of light show the blades of the aperture."""
    add_floor(checkered(reflects=0.05))
    for i in range(7):
        paint = material("Paint %d" % i, diffuse(PALETTE[i % 5]))
        place = (-2.1 + 0.75 * i, -2.6 + 1.7 * i, 0)
        add_cylinder("Column %d" % i, paint, 0.28, 1.0, location=place)
        add_sphere("Ball %d" % i, paint, 0.33, location=(place[0], place[1], 1.33))
    for i in range(24):
        glow = material("Glow %d" % i, emission(((1, 0.6, 0.25), (1, 0.9, 0.7), (0.4, 0.7, 1))[i % 3], 9))
        lamp = add_sphere("Light %d" % i, glow, 0.12, 16,
                          location=(-7 + 14 * ROLLS[i], 13 + 5 * ROLLS[i + 50], 0.8 + 3.6 * ROLLS[i + 100]))
        lamp["rt_light"] = 0
    add_softbox(700, (-4, -3, 6), size=2)
    set_world((0.05, 0.06, 0.09))
    camera = add_camera((0.4, -7.2, 2.2), (0.35, 0, 1.15), 50, fstop=0.16, focus=(-0.6, 0.8, 1))
    camera.data.dof.aperture_blades = 6


def motion_blur():
    """Moving, turning and growing while the shutter is open. --camera "Moving camera" moves as well."""
    add_floor(diffuse(CREAM))
    ball = add_sphere("Moving", material("Red", diffuse(CORAL)), 0.6)
    move(ball, (0, 2), location=((-3.5, 0, 0.6), (-1.9, 0, 1.0)))
    cube = add_cube("Turning", material("Checks", diffuse(Image("checker.ppm"))), 1.1, location=(0, 0, 0.85))
    move(cube, (0, 2), rotation_euler=((0, 0, -0.6), (0, 0, 0.9)))
    ring = add_torus("Growing", material("Green", diffuse(TEAL)), 0.6, 0.2, location=(2.7, 0, 0.8), rotation=(70, 0, 0))
    move(ring, (0, 2), scale=((0.7, 0.7, 0.7), (1.3, 1.3, 1.3)))
    blur_motion()
    add_softbox(700, (-3, -5, 7), size=2)
    set_world((0.3, 0.32, 0.36))
    camera = add_camera((0, -8.4, 3), (-0.2, 0, 0.75), 37, name="Moving camera")
    move(camera, (0, 2), location=((-0.15, -8.4, 3), (0.15, -8.4, 3)))
    add_camera((0, -8.4, 3), (-0.2, 0, 0.75), 37)


def antialiasing():
    """Fields of the floor become smaller than pixels towards the horizon."""
    add_floor(checkered(400, 0.5), 400)
    add_sphere("Ball", material("Red", diffuse(CORAL)), 1, location=(-1.6, 1, 1))
    silver = material("Silver", glossy((0.9, 0.9, 0.9)))
    add_torus("Ring", silver, 0.8, 0.12, 36, location=(1.5, 0.5, 0.9), rotation=(80, 0, 30))
    add_posts(24, 0.4, 0.03, lambda i, x: ((x, 5 + 0.1 * i, 0), 2))
    add_daylight(2.2, 0.5, (0.5, 0.6, 0.75))
    add_camera((0, -6, 1.6), (0, 0, 0.95), 35)
