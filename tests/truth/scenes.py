"""The scenes of the truth tests, by name. Each is a function, so that only what is wanted is made."""
import numpy as np
from scene import Lamp, Material, Mesh, Scene, Shape, aim, ball, box, flat, move, ring, scale, scattered, square, surface, turn

SCENES = {}


def scene(make):
    SCENES[make.__name__] = make
    return make


def named(make, **more):
    return Scene(name=make, **more)


WHITE, RED, GREEN = Material(color=(0.73, 0.73, 0.73)), Material(color=(0.65, 0.05, 0.05)), Material(color=(0.12, 0.45, 0.15))


def lamp_material(*light):
    return Material(color=(0, 0, 0), emission=light)


def room(white="white", left="red", right="green", ceiling=True):
    """Walls of a room of 2 x 2 x 2 that is open towards -y, each seen from inside."""
    walls = [Shape("rectangle", white), Shape("rectangle", white, move(0, 1, 1) @ turn(90, 1, 0, 0)),
             Shape("rectangle", left, move(-1, 0, 1) @ turn(90, 0, 1, 0)),
             Shape("rectangle", right, move(1, 0, 1) @ turn(-90, 0, 1, 0))]
    return walls + ([Shape("rectangle", white, move(0, 0, 2) @ turn(180, 1, 0, 0))] if ceiling else [])


def panel(half, z=1.9, material="lamp"):
    """A square that shines downwards."""
    return Shape("rectangle", material, move(0, 0, z) @ turn(180, 1, 0, 0) @ scale(half, half, 1))


ROOM_VIEW = dict(eye=(0, -3.4, 1), target=(0, 0, 1), fov=40)
TABLE_VIEW = dict(eye=(0, -4.2, 2.4), target=(0, 0, 0.45), fov=38)


def cornell(name, peer):
    boxes = [Shape("cube", "white", move(-0.35, 0.3, 0.61) @ turn(20, 0, 0, 1) @ scale(0.3, 0.3, 0.6)),
             Shape("cube", "white", move(0.35, -0.3, 0.31) @ turn(-20, 0, 0, 1) @ scale(0.3, 0.3, 0.3))]
    return named(name, peer=peer, what="Cornell box: area lamp, diffuse", **ROOM_VIEW, spp=64, peer_spp=256 if peer == "mitsuba" else 128, depth=24,
                 materials={"white": WHITE, "red": RED, "green": GREEN, **({"lamp": lamp_material(15, 15, 15)} if peer == "mitsuba" else {})},
                 shapes=room() + boxes + ([panel(0.25)] if peer == "mitsuba" else []),
                 lamps=[Lamp("rectangle", (15, 15, 15), move(0, 0, 1.9) @ scale(0.25, 0.25, 1))] if peer == "cycles" else [])


@scene
def cornell_mitsuba(): return cornell("cornell_mitsuba", "mitsuba")


@scene
def cornell_cycles(): return cornell("cornell_cycles", "cycles")


def still_life(*kinds):
    """Things of these materials beside each other on a white floor."""
    places = np.linspace(-1.1, 1.1, len(kinds))
    shapes = [Shape("rectangle", "white", scale(4))]
    for x, (kind, material, mesh) in zip(places, kinds):
        size = 0.9 / len(kinds)
        if kind == "cube": place = move(x, 0, size + 0.02) @ turn(25, 0, 0, 1) @ scale(size)
        else: place = move(x, 0, size + 0.02) @ scale(size)
        shapes.append(Shape(kind, material, place, mesh))
    return shapes


@scene
def even_sky():
    return named("even_sky", peer="mitsuba", what="even sky, diffuse", **TABLE_VIEW, background=(0.6, 0.8, 1.0),
                 materials={"white": WHITE, "red": RED, "green": GREEN},
                 shapes=still_life(("sphere", "red", None), ("cube", "white", None), ("sphere", "green", None)))


def sun_picture():
    """A sky of 64 x 32 texels, blue above and brown below, with a sun of four texels that gives most of the light."""
    up = np.linspace(1, -1, 32)[:, None, None]
    sky = np.where(up > 0, 0.2 + up * np.array([0.2, 0.4, 0.9]), 0.1 - up * np.array([0.15, 0.1, 0.05])) * np.ones((1, 64, 1))
    sky *= 1 + 0.3 * np.sin(np.arange(64) * 2 * np.pi / 64)[None, :, None]
    sky[8:10, 20:22] = 400, 350, 250
    return sky


@scene
def sky_with_sun():
    return named("sky_with_sun", peer="mitsuba", what="HDR sky with a small sun, diffuse", **TABLE_VIEW, sky=sun_picture(),
                 materials={"white": WHITE, "red": RED, "green": GREEN},
                 shapes=still_life(("sphere", "red", None), ("cube", "white", None), ("sphere", "green", None)))


@scene
def glowing_torus():
    return named("glowing_torus", peer="mitsuba", what="glowing torus of 2304 triangles, diffuse", **ROOM_VIEW,
                 materials={"white": WHITE, "red": RED, "green": GREEN, "glow": lamp_material(6, 4, 2)},
                 meshes={"torus": flat(ring(0.45, 0.12))},
                 shapes=room() + [Shape("mesh", "glow", move(0, 0, 1) @ turn(50, 1, 0.3, 0), "torus")])


@scene
def many_lights():
    middle = dict(dim=scattered(400, 0.04, (-0.5, -0.5, 0.6), (0.5, 0.5, 1.5), 1), bright=scattered(40, 0.03, (-0.5, 0, 0.9), (0, 0.5, 1.5), 2))
    return named("many_lights", peer="cycles", what="440 glowing triangles (light tree), diffuse", **ROOM_VIEW, spp=512,
                 note="Cycles 4.5 is 0.1 % darker in rooms, as in cornell_cycles; Mitsuba is not (cornell_mitsuba)", peer_spp=128,
                 materials={"white": WHITE, "red": RED, "green": GREEN, "dim": lamp_material(2, 2, 3), "bright": lamp_material(30, 15, 5)},
                 meshes=middle, shapes=room() + [Shape("mesh", "dim", mesh="dim"), Shape("mesh", "bright", mesh="bright")])


@scene
def textured_room():
    random = np.random.default_rng(5)
    pictures = {"tiles": random.uniform(0.05, 0.95, (8, 8, 3)), "wood": random.uniform(0.2, 0.9, (5, 16, 3))}
    tiles = square()
    tiles.uvs = tiles.uvs * (2, 3) + (0.3, 0.1)
    shapes = [Shape("mesh", "tiles", mesh="tiles"), Shape("mesh", "wood", move(0, 1, 1) @ turn(90, 1, 0, 0), "plain"),
              Shape("mesh", "wood", move(-1, 0, 1) @ turn(90, 0, 1, 0), "plain"), Shape("mesh", "tiles", move(1, 0, 1) @ turn(-90, 0, 1, 0), "plain"),
              Shape("rectangle", "white", move(0, 0, 2) @ turn(180, 1, 0, 0)),
              Shape("mesh", "wood", move(0.2, 0, 0.5) @ turn(30, 0, 0, 1) @ scale(0.4), "ball")]
    return named("textured_room", peer="mitsuba", what="room with bilinear pictures on all walls", **ROOM_VIEW, peer_spp=128, spp=64,
                 materials={"lamp": lamp_material(3, 3, 3), "white": WHITE, "tiles": Material(color=(1, 1, 1), texture="tiles"), "wood": Material(color=(0.9, 0.7, 0.5), texture="wood")},
                 meshes={"tiles": tiles, "plain": square(), "ball": flat(ball(16, 32))}, pictures=pictures, shapes=shapes + [panel(0.7)])


@scene
def caustics():
    return named("caustics", peer="mitsuba", what="smooth glass and mirror spheres, caustics of a large lamp", **ROOM_VIEW, spp=256, peer_spp=256, depth=24,
                 materials={"lamp": lamp_material(4, 4, 4), "white": WHITE, "red": RED, "green": GREEN, "glass": Material("glass", ior=1.5), "mirror": Material("mirror", (0.9, 0.8, 0.7))},
                 shapes=room() + [Shape("sphere", "glass", move(0.4, -0.3, 0.42) @ scale(0.4)), Shape("sphere", "mirror", move(-0.4, 0.3, 0.52) @ scale(0.5))] + [panel(0.7)])


@scene
def hard_lamps():
    return named("hard_lamps", peer="mitsuba", what="point, spot and sun without size", **TABLE_VIEW, spp=128, peer_spp=256,
                 materials={"white": WHITE, "red": RED, "green": GREEN},
                 shapes=still_life(("sphere", "red", None), ("cube", "white", None), ("sphere", "green", None)),
                 lamps=[Lamp("point", (3, 4, 5), move(-1.5, -1.5, 2)), Lamp("spot", (20, 12, 6), aim((1.5, -1, 3), (0.2, 0, 0)), angle=30),
                        Lamp("sun", (0.5, 0.5, 0.4), aim((1, 2, 3), (0, 0, 0)))])


@scene
def round_lamps():
    return named("round_lamps", peer="mitsuba", what="sphere, disk and rectangle lamps, which hide each other", **ROOM_VIEW, spp=128, peer_spp=128,
                 materials={"white": WHITE, "red": RED, "green": GREEN},
                 shapes=room() + [Shape("cube", "white", move(0.3, 0.2, 0.41) @ turn(20, 0, 0, 1) @ scale(0.3, 0.3, 0.4))],
                 lamps=[Lamp("sphere", (8, 6, 3), move(-0.5, -0.2, 0.5), radius=0.2),
                        Lamp("disk", (2, 4, 8), aim((0.3, -0.4, 1.7), (0.2, 0.2, 0.5)) @ scale(0.3, 0.3, 1)),
                        Lamp("rectangle", (3, 5, 3), aim((-0.2, 0.6, 1.1), (-1, -0.5, 0.6)) @ scale(0.25, 0.35, 1))])


@scene
def see_through():
    return named("see_through", peer="mitsuba", what="half see-through panes, one of them before the lamp", **ROOM_VIEW, peer_spp=128, depth=32,
                 materials={"lamp": lamp_material(4, 4, 4), "white": WHITE, "red": RED, "green": GREEN, "pane": Material(color=(0.2, 0.3, 0.8), opacity=0.5)},
                 shapes=room() + [Shape("rectangle", "pane", move(0.1, -0.4, 0.7) @ turn(80, 1, 0, 0.2) @ scale(0.5)),
                                  Shape("rectangle", "pane", move(-0.2, 0.1, 1.5) @ turn(10, 1, 0, 0) @ scale(0.5)),
                                  Shape("sphere", "pane", move(0.3, 0.3, 0.42) @ scale(0.4)), panel(0.8)],
                 note="depth 32: Mitsuba counts straight passages as bounces, we do not")


@scene
def instances():
    random = np.random.default_rng(3)
    turns = [turn(random.uniform(0, 360), *random.normal(size=3)) for _ in range(24)]
    shapes = [Shape("mesh", "red" if i % 2 else "green", move(0.45 * (i % 6) - 1.1, 0.5 * (i // 6) - 0.8, 0.3) @ t @ scale(0.22, 0.17, 0.2), "torus")
              for i, t in enumerate(turns)]
    return named("instances", peer="mitsuba", what="24 instances of a torus, stretched, in an even sky and a sun", **TABLE_VIEW, shared=True,
                 background=(0.5, 0.6, 0.8), materials={"white": WHITE, "red": RED, "green": GREEN}, meshes={"torus": flat(ring(0.8, 0.3, 24, 12))},
                 shapes=[Shape("rectangle", "white", scale(4))] + shapes, lamps=[Lamp("sun", (2, 1.8, 1.5), aim((1, -2, 3), (0, 0, 0)))])


@scene
def smooth_normals():
    return named("smooth_normals", peer="mitsuba", what="ball and torus with interpolated normals", **TABLE_VIEW,
                 background=(0.5, 0.6, 0.8), materials={"lamp": lamp_material(6, 6, 6), "white": WHITE, "red": RED, "green": GREEN},
                 meshes={"ball": ball(128, 256), "torus": ring(0.7, 0.3, 256, 128)},
                 shapes=still_life(("mesh", "red", "ball"), ("mesh", "green", "torus")) +
                 [Shape("disk", "lamp", aim((1, -1.5, 2.5), (0, 0, 0)) @ turn(180, 0, 1, 0) @ scale(0.5, 0.5, 1))])


# Against Cycles: what Mitsuba has another model of, or none. Curved things are meshes of flat triangles.

TABLE_LAMP = Lamp("rectangle", (9, 9, 9), aim((-0.6, -1.4, 3), (0, 0, 0.3)) @ scale(0.5, 0.5, 1))


def table(name, what, things, **more):
    materials = {"white": Material(color=(0.5, 0.5, 0.5)), **{"m%d" % i: m for i, m in enumerate(things)}}
    return named(name, peer="cycles", what=what, **TABLE_VIEW, **{"spp": 128, "peer_spp": 128, "depth": 24,
        "materials": materials, "meshes": {"ball": flat(ball(32, 64))}, "background": (0.1, 0.12, 0.15), "lamps": [TABLE_LAMP],
        "shapes": still_life(*(("mesh", "m%d" % i, "ball") for i in range(len(things)))), **more})


@scene
def rough_glass():
    return table("rough_glass", "GGX glass of roughness 0.2 and 0.5, with multiple scattering",
                 [Material("rough_glass", ior=1.5, roughness=0.2), Material("rough_glass", ior=1.4, roughness=0.5)], spp=128, peer_spp=128)


@scene
def metals():
    gold = dict(color=(0.95, 0.7, 0.3), edge_tint=(0.9, 0.95, 1))
    return table("metals", "GGX metal of roughness 0.1, 0.3 and 0.6, by lamp and lobe (MIS)",
                 [Material("metal", roughness=r, **gold) for r in (0.1, 0.3, 0.6)], spp=128, peer_spp=128)


@scene
def anisotropic():
    return table("anisotropic", "anisotropic GGX metal, turned by 0 and 0.1",
                 [Material("metal", (0.9, 0.8, 0.7), roughness=0.2, anisotropy=0.8),
                  Material("metal", (0.9, 0.8, 0.7), roughness=0.25, anisotropy=0.6, rotation=0.1)],
                 note="narrow lobes: of wide ones neither keeps all light, and the scales that give it back differ by direction (4 % each at 0.4)")


@scene
def plastic():
    return table("plastic", "Principled plastic of roughness 0.1, 0.3 and 0.7",
                 [Material("plastic", (0.7, 0.1, 0.05), roughness=0.1), Material("plastic", (0.1, 0.5, 0.2), roughness=0.3),
                  Material("plastic", (0.2, 0.3, 0.8), roughness=0.7, ior=1.8)], spp=128, peer_spp=128)


@scene
def oren_nayar():
    return table("oren_nayar", "white rough diffuse (Oren and Nayar) of roughness 0.3 and 1",
                 [Material("oren_nayar", (1, 1, 1), roughness=0.3), Material("oren_nayar", (1, 1, 1), roughness=1)],
                 note="white alone: Cycles 4.5 multiplies later bounces by the color once more (color^3 where two bounces have color^2)")


@scene
def translucent():
    return table("translucent", "translucent ball and half see-through ball",
                 [Material("translucent", (0.7, 0.6, 0.3)), Material("diffuse", (0.2, 0.5, 0.7), opacity=0.5)], spp=128, peer_spp=128)


@scene
def soft_lamps():
    return table("soft_lamps", "point, spot and sun with sizes", [RED, GREEN], lamps=[
        Lamp("point", (3, 4, 5), move(-1.5, -1.5, 2), radius=0.2), Lamp("spot", (30, 20, 10), aim((1.5, -1, 3), (0.2, 0, 0)), radius=0.1, angle=40, blend=0.5),
        Lamp("sun", (0.5, 0.5, 0.4), aim((1, 2, 3), (0, 0, 0)), angle=10)])
