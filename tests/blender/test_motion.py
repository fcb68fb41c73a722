"""What moves while the shutter is open, and frames."""

import math

import bpy

from kit import add, export, mesh_of, new_scene, primitive, test
from scene_text import equal, near


def animate(thing, path, frames):
    """Keys with straight lines between."""
    for frame, value in frames.items():
        setattr(thing, path, value)
        thing.keyframe_insert(path, frame=frame)
    action = thing.id_data.animation_data.action
    curves = action.fcurves if hasattr(action, "fcurves") else [
        c for layer in action.layers for strip in layer.strips for bag in strip.channelbags for c in bag.fcurves]
    for curve in curves:
        for point in curve.keyframe_points:
            point.interpolation = "LINEAR"


def moving_scene():
    scene = new_scene()
    scene.render.use_motion_blur, scene.render.motion_blur_shutter = True, 1.0
    return scene


@test
def straight_motion_has_two_keys():
    scene = moving_scene()
    thing = primitive("cube")
    animate(thing, "location", {0: (0, 0, 0), 2: (4, 0, 0)})
    primitive("uv_sphere", smooth=True, location=(0, 3, 0), segments=64, ring_count=32)
    scene.frame_set(1)
    text = export()
    near([k[0][3] for k in text.one("cube").keys()], [1, 3])
    equal(len(text.one("sphere").keys()), 1)
    owner = scene.render if hasattr(scene.render, "motion_blur_position") else scene.cycles
    for position, wanted in (("START", [2, 4]), ("END", [0, 2])):
        owner.motion_blur_position = position
        near([k[0][3] for k in export().one("cube").keys()], wanted)
    owner.motion_blur_position = "CENTER"
    scene.render.motion_blur_shutter = 0.5
    near([k[0][3] for k in export().one("cube").keys()], [1.5, 2.5])
    scene.render.use_motion_blur = False
    near([k[0][3] for k in export().one("cube").keys()], [2])


@test
def turning_and_curved_motion():
    scene = moving_scene()
    slow = primitive("cube")
    slow.name = "Slow"
    animate(slow, "rotation_euler", {0: (0, 0, 0), 2: (0, 0, 2)})
    fast = primitive("cube", location=(5, 0, 0))
    fast.name = "Fast"
    animate(fast, "rotation_euler", {0: (0, 0, 0), 2: (0, 0, 12)})
    thrown = primitive("cube", location=(9, 0, 0))
    thrown.name = "Thrown"
    animate(thrown, "location", {0: (9, 0, 0), 1: (9, 0, 2), 2: (9, 0, 0)})
    bent = primitive("cube", location=(9, 5, 0))
    bent.name = "Bent"
    animate(bent, "location", {0.5: (9, 5, 0), 0.75: (9, 5, 2), 1: (9, 5, 0), 1.25: (9, 5, 3), 1.5: (9, 5, 0)})
    scene.frame_set(1)
    text = export()
    keys = {name: text.one("cube", name).keys() for name in ("Slow", "Fast", "Thrown", "Bent")}
    equal({name: len(k) for name, k in keys.items()}, {"Slow": 2, "Fast": 3, "Thrown": 3, "Bent": 5})
    near(keys["Slow"][0][0][0], math.cos(0.5))
    near([k[2][3] for k in keys["Thrown"]], [1, 2, 1])


@test
def moving_camera_instances_and_exceptions():
    scene = moving_scene()
    animate(scene.camera, "location", {0: (0, -10, 0), 2: (2, -10, 0)})
    collection = bpy.data.collections.new("C")
    collection.objects.link(bpy.data.objects.new("In", mesh_of([(0, 0, 0), (1, 0, 0), (0, 1, 0)], [(0, 1, 2)])))
    holder = add("Holder", None)
    holder.instance_type, holder.instance_collection = "COLLECTION", collection
    animate(holder, "location", {0: (0, 0, 0), 2: (0, 2, 0)})
    still = primitive("cube")
    animate(still, "location", {0: (0, 0, 0), 2: (4, 0, 0)})
    if hasattr(still, "cycles"):
        still.cycles.use_motion_blur = False
    scene.frame_set(1)
    text = export()
    near([k[0][3] for k in text.one("camera").keys()], [0.5, 1.5])
    near([k[1][3] for k in text.one("instance").keys()], [0.5, 1.5])
    near([k[0][3] for k in text.one("cube").keys()], [2] if hasattr(still, "cycles") else [1, 3])


@test
def deformation_and_flipping_warn():
    scene = moving_scene()
    thing = primitive("monkey")
    thing.shape_key_add(name="Basis")
    key = thing.shape_key_add(name="Key")
    for i in range(50):
        key.data[i].co.x += 1
    animate(key, "value", {0: 0.0, 2: 1.0})
    scene.frame_set(1)
    export([9])
    scene = moving_scene()
    thing = primitive("cube")
    animate(thing, "scale", {0: (-2, 1, 1), 2: (2.5, 1, 1)})
    scene.frame_set(1)
    equal(len(export([34]).one("cube").keys()), 1)


@test
def frames():
    scene = new_scene()
    thing = primitive("cube")
    animate(thing, "location", {1: (0, 0, 0), 11: (10, 0, 0)})
    near(export(arguments=["--frame", "4"]).one("cube").keys()[0][0][3], 3)
