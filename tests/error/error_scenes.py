"""The scenes of the benchmark of error against time, by name. What a scene says is the same for every renderer that can show it
(peer="all"). Scenes of lamps alone have a depth of 0, or only mirrors after that, so that all renderers estimate one integral."""
import sys, os
sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "truth"))
import numpy as np
from scene import Lamp, Material, Mesh, Scene, Shape, aim, move, scale, square, turn
from scenes import GREEN, RED, ROOM_VIEW, WHITE, lamp_material, panel, room

SCENES = {}
LIGHT, DARK = Material(color=(0.75, 0.75, 0.7)), Material(color=(0.15, 0.2, 0.3))
PAINTS = {"white": WHITE, "red": RED, "green": GREEN, "light": LIGHT, "dark": DARK}
SQUARES = Shape("ground", "light", other="dark")
VIEW = dict(eye=(0, -5, 2.6), target=(0, 0, 0.5), fov=40)
ONE_LAMP = dict(depth=0, integrator="whitted")


def scene(make):
    SCENES[make.__name__] = make
    return make


def levels(scene):
    """RMSE of the picture as shown, at which times are compared: 0.004 is a step of eight bits."""
    noisy = {"glossy": 2, "depth_of_field": 2, "glass": 4, "interior": 2, "many_lights": 2, "sky": 1}
    return tuple(noisy.get(scene.name, 0.5) * e for e in (0.02, 0.01, 0.005))


def made(what, materials=None, **more):
    """A scene by the name of the function that calls this, with those of the materials that it uses."""
    name, materials = sys._getframe(1).f_code.co_name, materials or PAINTS
    used = {n for s in more["shapes"] for n in (s.material, s.other) if n}
    return Scene(name, peer="all", what=what, materials={n: m for n, m in materials.items() if n in used}, block=8, **{**VIEW, **more})


def wavy_ball(rows=112, columns=224):
    """50,176 triangles about the origin: a ball of radius about 1 with waves on it. Flat, as ours and the peers' normals of smooth
    ones differ behind the horizon of a triangle."""
    points = []
    for i in range(1, rows):
        a = np.pi * i / rows
        b = np.arange(columns) * 2 * np.pi / columns
        r = 1 + 0.06 * np.sin(7 * a) * np.cos(9 * b)
        points.append(np.stack([r * np.sin(a) * np.cos(b), r * np.sin(a) * np.sin(b), r * np.cos(a)], -1))
    top, bottom = (rows - 1) * columns, (rows - 1) * columns + 1
    points = np.concatenate(points + [[(0, 0, 1), (0, 0, -1)]])
    i, j = np.arange(columns), (np.arange(columns) + 1) % columns
    faces = [np.stack([np.full(columns, top), i, j], 1), np.stack([np.full(columns, bottom), j + top - columns, i + top - columns], 1)]
    for row in range(rows - 2):
        p, q, r, s = row * columns + i, row * columns + j, (row + 1) * columns + i, (row + 1) * columns + j
        faces += [np.stack([p, r, q], 1), np.stack([q, r, s], 1)]
    return Mesh(points, np.concatenate(faces))


def balls_and_box(left="red", right="green"):
    return [Shape("sphere", left, move(-1.1, 0.2, 0.7) @ scale(0.7)), Shape("sphere", right, move(1.2, -0.3, 0.5) @ scale(0.5)),
            Shape("cube", "white", move(0.2, 0.9, 0.6) @ turn(25, 0, 0, 1) @ scale(0.5, 0.5, 0.6))]


TWO_POINTS = [Lamp("point", (24, 22, 18), move(-3, -3, 4)), Lamp("point", (6, 8, 12), move(3, -2, 3))]


@scene
def hard_shadows():
    return made("two point lamps, diffuse balls and box on squares", shapes=[SQUARES] + balls_and_box(), lamps=TWO_POINTS, **ONE_LAMP)


@scene
def mirrors():
    return made("two point lamps, mirror balls and diffuse box on squares; six reflections", {**PAINTS, "mirror": Material("mirror", (0.85, 0.8, 0.7))},
                shapes=[SQUARES] + balls_and_box("mirror", "mirror"), lamps=TWO_POINTS, depth=6, diffuse_depth=0, integrator="whitted")


@scene
def soft_shadows():
    return made("rectangle lamp on a mesh of 50,176 triangles and a floor", meshes={"waves": wavy_ball()},
                shapes=[Shape("rectangle", "white", scale(30)), Shape("mesh", "red", move(0, 0, 1.1), "waves")],
                lamps=[Lamp("rectangle", (9, 8, 7), aim((-2.5, -2, 4.5), (0, 0, 0.7)) @ scale(0.8, 0.8, 1))], **ONE_LAMP)


@scene
def glossy():
    looks = (0.08, (0.9, 0.8, 0.6)), (0.13, (0.8, 0.85, 0.9)), (0.18, (0.7, 0.9, 0.7))
    metals = {"g%d" % i: Material("glossy", color, roughness=roughness) for i, (roughness, color) in enumerate(looks)}
    shapes = [Shape("rectangle", "white", scale(30))] + [Shape("sphere", "g%d" % i, move(1.5 * (i - 1), 0, 0.65) @ scale(0.65)) for i in range(3)]
    lamps = [Lamp("rectangle", (k, k, k), aim((x, -1, 3.5), (0, 0, 0.5)) @ scale(h, h, 1))
             for x, h, k in ((-2, 0.4, 9), (0, 0.6, 4), (2.4, 1.0, 1.5))]
    return made("GGX balls of roughness 0.08, 0.13, 0.18 under three rectangle lamps", {**PAINTS, **metals},
                shapes=shapes, lamps=lamps, depth=1, fov=46, spp=256, peer_spp=256)


@scene
def depth_of_field():
    shapes = [SQUARES] + [Shape("sphere", ("red", "white", "green")[i % 3], move(0.9 * (i - 2), 1.6 * (i - 1.5), 0.45) @ scale(0.45)) for i in range(5)]
    return made("lens of radius 0.12, sun, diffuse balls on squares", shapes=shapes, lamps=[Lamp("sun", (2.4, 2.3, 2), aim((-2, -1, 3), (0, 0, 0)))],
                aperture=0.12, focus=5.0, **ONE_LAMP)


@scene
def motion_blur():
    shapes = [SQUARES, Shape("sphere", "red", move(-1.4, 0, 0.6) @ scale(0.6), motion=(0.9, 0, 0.3)),
              Shape("cube", "white", move(1.1, 0.3, 0.5) @ turn(30, 0, 0, 1) @ scale(0.4), motion=(0, -0.8, 0))]
    return made("ball and box that move, point lamp and sun", shapes=shapes,
                lamps=[Lamp("point", (20, 20, 18), move(-3, -3, 4)), Lamp("sun", (0.8, 0.8, 1), aim((2, -1, 3), (0, 0, 0)))],
                note="the mean of 256 pictures in which nothing moves agrees with ours to 0.04 % in blocks (RMS), with Cycles to 0.15 %", **ONE_LAMP)


@scene
def glass():
    return made("glass ball and cube under a large lamp, with caustics",
                {"lamp": lamp_material(5, 5, 5), "white": WHITE, "red": RED, "green": GREEN, "glass": Material("glass", ior=1.5)},
                shapes=room() + [Shape("sphere", "glass", move(0.4, -0.2, 0.42) @ scale(0.4)),
                                 Shape("cube", "glass", move(-0.4, 0.2, 0.41) @ turn(25, 0, 0, 1) @ scale(0.28, 0.28, 0.4)), panel(0.6)],
                spp=256, peer_spp=128, depth=24, **ROOM_VIEW)


@scene
def far_plane():
    return made("squares up to the horizon, sun, three balls", eye=(0.3, -6, 1.2), target=(0.3, 0, 0.5), shapes=[SQUARES] + balls_and_box(),
                lamps=[Lamp("sun", (2.4, 2.3, 2), aim((-2, -1, 3), (0, 0, 0)))], **ONE_LAMP)


def sky_picture(width=256):
    """A sky with a gradient, clouds and a sun of some texels that gives half of the light."""
    height = width // 2
    v, u = np.meshgrid((np.arange(height) + 0.5) / height, (np.arange(width) + 0.5) / width, indexing="ij")
    up = np.cos(np.pi * v)
    sky = np.where(up[..., None] > 0, [0.25, 0.4, 0.8] * (1.2 - 0.8 * up[..., None]), [0.12, 0.1, 0.08] * np.ones((height, width, 1)))
    sky += np.where(up > 0, 0.5, 0)[..., None] * np.maximum(np.sin(8 * np.pi * u + 3 * np.sin(6 * v)) * np.sin(14 * v), 0)[..., None]
    sun = np.exp(-((u - 0.3) ** 2 * 4 + (v - 0.25) ** 2) / 0.004 ** 2)
    return sky + sun[..., None] * np.array([4000, 3600, 3000.0])


@scene
def sky():
    return made("HDR sky of 256 x 128 with a small sun, diffuse, four bounces", sky=sky_picture(), shapes=[Shape("rectangle", "white", scale(4))] + balls_and_box(), depth=4,
                spp=128, peer_spp=128)


@scene
def interior():
    random = np.random.default_rng(5)
    boxes = [Shape("cube", "white", move(-0.35, 0.3, 0.61) @ turn(20, 0, 0, 1) @ scale(0.3, 0.3, 0.6)),
             Shape("cube", "white", move(0.35, -0.3, 0.31) @ turn(-20, 0, 0, 1) @ scale(0.3, 0.3, 0.3))]
    walls = room()
    walls[1] = Shape("mesh", "tiles", walls[1].place, "wall")
    return made("Cornell box with a picture on its back wall, eight bounces",
                {"white": WHITE, "red": RED, "green": GREEN, "lamp": lamp_material(15, 15, 15), "tiles": Material(color=(1, 1, 1), texture="tiles")},
                meshes={"wall": square()}, pictures={"tiles": random.uniform(0.2, 0.9, (8, 8, 3))},
                shapes=walls + boxes + [panel(0.25)], spp=128, peer_spp=128, depth=8, **ROOM_VIEW)


@scene
def many_lights():
    random = np.random.default_rng(9)
    places = np.concatenate([random.uniform(-4, 4, (256, 2)), random.uniform(1.8, 3, (256, 1))], 1)
    colors = random.uniform(0.02, 1, (256, 3)) * random.uniform(0.05, 1, (256, 1)) ** 2
    return made("256 point lamps, diffuse balls and box on squares", shapes=[SQUARES] + balls_and_box(),
                lamps=[Lamp("point", tuple(c), move(*p)) for p, c in zip(places, colors)], depth=0, spp=256, peer_spp=128)
