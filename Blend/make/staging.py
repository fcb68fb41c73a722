"""Lights, cameras, what is around the scene, and movement."""

import math

import bpy
from mathutils import Matrix, Vector

from make.materials import load_image
from make.shapes import add_object


def look_at(thing, target, roll=0):
    """Turns -Z of an object towards a point, +Y upwards; roll in degrees."""
    away = Vector(thing.location) - Vector(target)
    turn = away.to_track_quat("Z", "Y").to_matrix() @ Matrix.Rotation(math.radians(roll), 3, "Z")
    thing.rotation_euler = turn.to_euler()


def add_light(kind, name, location, target, power, color=(1, 1, 1), is_visible=False, **settings):
    """settings: properties of Blender's light, angles in radians as there."""
    lamp = bpy.data.lights.new(name, kind)
    lamp.energy, lamp.color = power, color
    if kind in {"POINT", "SPOT"}:
        lamp.shadow_soft_size = 0
    if kind == "SUN":
        lamp.angle = 0
    for key, value in settings.items():
        setattr(lamp, key, value)
    thing = add_object(name, lamp, location=location)
    thing.visible_camera = is_visible
    look_at(thing, target)
    return thing


def add_camera(location, target, lens=50, roll=0, fstop=None, focus=None, name="Camera", **settings):
    """fstop and focus (a point): depth of field. settings: properties of Blender's camera."""
    data = bpy.data.cameras.new(name)
    data.lens = lens
    for key, value in settings.items():
        setattr(data, key, value)
    thing = add_object(name, data, location=location)
    look_at(thing, target, roll)
    if fstop:
        axis = (Vector(target) - Vector(location)).normalized()
        data.dof.use_dof, data.dof.aperture_fstop = True, fstop
        data.dof.focus_distance = axis.dot(Vector(focus) - Vector(location))
    bpy.context.scene.camera = thing
    return thing


def set_world(color=(0.05, 0.05, 0.05), strength=1.0, environment="", rotation=0):
    """environment: a panorama; rotation about +z in degrees."""
    world = bpy.data.worlds.new("World")
    world.use_nodes = True
    tree = world.node_tree
    background = next(n for n in tree.nodes if n.bl_idname == "ShaderNodeBackground")
    background.inputs["Strength"].default_value = strength
    background.inputs["Color"].default_value = tuple(color) + (1,)
    if environment:
        node, mapping = tree.nodes.new("ShaderNodeTexEnvironment"), tree.nodes.new("ShaderNodeMapping")
        source = tree.nodes.new("ShaderNodeTexCoord")
        node.image = load_image(environment, False)
        mapping.inputs["Rotation"].default_value = (0, 0, math.radians(rotation))
        tree.links.new(source.outputs["Generated"], mapping.inputs["Vector"])
        tree.links.new(mapping.outputs["Vector"], node.inputs["Vector"])
        tree.links.new(node.outputs["Color"], background.inputs["Color"])
    bpy.context.scene.world = world


def move(thing, frames, **ends):
    """Moves properties evenly; ends: property = (value at the first frame, value at the last)."""
    for key, values in ends.items():
        for frame, value in zip(frames, values):
            setattr(thing, key, value)
            thing.keyframe_insert(key, frame=frame)


def blur_motion(shutter=0.5):
    render = bpy.context.scene.render
    render.use_motion_blur, render.motion_blur_shutter = True, shutter
