"""Lamps of every kind, in the units of the scene text."""

import math

from mathutils import Euler, Matrix

from kit import Export, Nodes, VERSION, add_light, export, new_scene, test
from scene_text import equal, near
from test_motion import animate


def light_text(kind, expected=(), scale=(1, 1, 1), **settings):
    new_scene()
    add_light(kind, scale, **settings)
    return export(expected).one("light")


@test
def point_light():
    block = light_text("POINT", energy=100, color=(1, 0.5, 0.25))
    equal(block["type"], "point")
    near(block["color"], [c * 100 / (4 * math.pi) for c in (1, 0.5, 0.25)])
    near(block["translate"], [1, 2, 3])
    equal(block.get("radius"), None)


@test
def point_light_with_radius():
    block = light_text("POINT", energy=100, shadow_soft_size=0.5)
    sphere = (100 / (4 * math.pi**2 * 0.25), "sphere")
    disk = (100 / (4 * math.pi), "point")
    wanted = disk if VERSION < (4, 0) else sphere if VERSION < (4, 1) else disk
    near(block["color"], [wanted[0]] * 3)
    equal([block["type"], block["radius"]], [wanted[1], 0.5])
    if VERSION >= (4, 1):
        block = light_text("POINT", energy=100, shadow_soft_size=0.5, use_soft_falloff=False)
        near(block["color"], [sphere[0]] * 3)
        equal([block["type"], block["radius"]], ["sphere", 0.5])


@test
def sun():
    block = light_text("SUN", energy=3, angle=0)
    equal([block["type"], block["color"], block.get("angle")], ["sun", [3, 3, 3], None])
    block = light_text("SUN", energy=3, angle=0.35)
    near(block["angle"], math.degrees(0.35))
    near(block["color"], [3 * ((1 + math.cos(0.175)) / 2 if VERSION < (4, 0) else 1)] * 3)
    rows = block.keys()[0]
    near(rows, Export.rows_of(Matrix.LocRotScale((1, 2, 3), Euler((0.3, 0.2, 0.1)), None)))


@test
def spot():
    block = light_text("SPOT", energy=50, spot_size=1.0, spot_blend=0.3)
    near(block["color"], [50 / (4 * math.pi)] * 3)
    near([block["cone_angle"], block["blend"]], [math.degrees(1), 0.3])
    equal(block.get("cosine_falloff", False), VERSION < (3, 5))
    block = light_text("SPOT", scale=(2, 2, 1), spot_size=1.0)
    near(block["cone_angle"], math.degrees(1 if VERSION < (3, 5) else 2 * math.atan(2 * math.tan(0.5))))
    light_text("SPOT", scale=(2, 1, 1), expected=[] if VERSION < (3, 5) else [29])


@test
def area_lights():
    for shape, round_part in (("SQUARE", 1), ("RECTANGLE", 1), ("DISK", math.pi / 4), ("ELLIPSE", math.pi / 4)):
        block = light_text("AREA", scale=(2, 3, 1), energy=10, shape=shape, size=0.5, size_y=0.2)
        x, y = 1.0, 3 * (0.2 if shape in {"RECTANGLE", "ELLIPSE"} else 0.5)
        area = x * y * round_part
        near(block["color"], [10 / (4 * area) if VERSION < (4, 0) else 10 / (math.pi * area)] * 3)
        near(block["size"], [x, y])
        equal(block["type"], "disk" if round_part < 1 else "rectangle")
        rows = block.keys()[0]
        near([math.hypot(*(row[i] for row in rows)) for i in range(3)], [1, 1, 1])
    near(light_text("AREA", spread=1.0)["spread"], math.degrees(1))


@test
def light_settings_of_4_5():
    if VERSION < (4, 5):
        return
    near(light_text("POINT", energy=10, exposure=2)["color"], [40 / (4 * math.pi)] * 3)
    near(light_text("POINT", energy=10, normalize=False)["color"], [10 / math.pi] * 3)
    near(light_text("POINT", energy=10, normalize=False, shadow_soft_size=0.3)["color"], [10 * 0.09] * 3)
    ball = light_text("POINT", energy=10, normalize=False, shadow_soft_size=0.3, use_soft_falloff=False)
    near(ball["color"], [10 / math.pi] * 3)
    equal(ball["type"], "sphere")
    near(light_text("AREA", energy=10, normalize=False, size=0.5)["color"], [10 / math.pi] * 3)
    near(light_text("SUN", energy=10, normalize=False, angle=0.6)["color"], [10 * math.pi * math.sin(0.3) ** 2] * 3)
    block = light_text("POINT", energy=4 * math.pi, use_temperature=True, temperature=2700)
    near(block["color"], [1.93507, 0.80353, 0.19172], 1e-4)


@test
def light_shadows_visibility_and_nodes():
    equal(light_text("POINT")["type"], "point")
    new_scene()
    lamp = add_light("AREA", energy=math.pi, size=1)
    cycles = getattr(lamp.data, "cycles", None)
    if hasattr(cycles, "cast_shadow"):
        cycles.cast_shadow = False
    else:
        lamp.data.use_shadow = False
    lamp.visible_camera = True
    block = export().one("light")
    equal([block["shadows"], block["seen_by"]], [False, "all"])
    nodes = Nodes(lamp.data)
    nodes.end(nodes.node("Emission", Color=(0.5, 1, 0.25), Strength=3.0), "ShaderNodeOutputLight")
    near(export().one("light")["color"], [x * (1 if VERSION >= (4, 0) else math.pi / 4) for x in (1.5, 3, 0.75)])
    nodes = Nodes(lamp.data)
    nodes.end(nodes.node("BsdfTransparent"), "ShaderNodeOutputLight")
    export([28])


@test
def moving_light_warns():
    scene = new_scene()
    scene.render.use_motion_blur = True
    lamp = add_light("POINT")
    animate(lamp, "location", {0: (0, 0, 0), 2: (2, 0, 0)})
    scene.frame_set(1)
    near(export([10]).one("light")["translate"], [1, 0, 0])


@test
def lamps_that_the_renderer_would_refuse():
    """Each is clamped or left out with one warning; export() lets the renderer check the text."""
    for kind in ("SUN", "SPOT", "AREA"):
        new_scene()
        add_light(kind, (0, 0, 0))
        equal(export([36]).all("light"), [])
        new_scene()
        add_light(kind, (1, 1, 0))
        equal(export([36]).all("light"), [])
    equal(light_text("POINT", scale=(0, 0, 0))["type"], "point")
    equal(light_text("SUN", angle=math.pi)["angle"], 180)
    for settings in ({"size": 0}, {"shape": "RECTANGLE", "size": 1, "size_y": 0}, {"shape": "DISK", "size": 0}):
        new_scene()
        add_light("AREA", **settings)
        equal(export([36]).all("light"), [])
    equal(light_text("POINT", [35], energy=1e30)["color"], [1e15] * 3)
    near(light_text("SPOT", spot_size=math.pi)["cone_angle"], 180)
    equal(light_text("POINT", [35], energy=-5)["color"], [0, 0, 0])


@test
def lamps_are_seen_by_the_rays_that_blender_says():
    """Without any setting: in mirrors and glass, not by the camera."""
    for kind, settings in (("AREA", {}), ("POINT", {"shadow_soft_size": 0.5}), ("SPOT", {"shadow_soft_size": 0.5}), ("SUN", {"angle": 0.3})):
        for camera, mirrors, wanted in ((None, True, "reflections"), (True, True, "all"), (True, False, "camera"), (False, False, None)):
            new_scene()
            lamp = add_light(kind, **settings)
            if camera is not None:
                lamp.visible_camera = camera
            lamp.visible_glossy = lamp.visible_transmission = mirrors
            equal((kind, export().one("light").get("seen_by")), (kind, wanted))
    equal(light_text("POINT").get("seen_by"), None)  # of no size
    equal(light_text("SUN", angle=0).get("seen_by"), None)
