"""What the tests inside Blender share: the list of them, scenes to build, and their export."""

import os
import sys
import tempfile

import bpy

from places import SCRIPT
from png import write_png
from scene_text import SceneText

sys.dont_write_bytecode = True
sys.path.insert(0, os.path.dirname(SCRIPT))
import Export

VERSION = bpy.app.version
FOLDER = tempfile.mkdtemp(prefix="export-test-")
TESTS = []  # (name, function)


def test(function):
    TESTS.append((function.__name__, function))
    return function


def new_scene(with_camera=True):
    bpy.ops.wm.read_factory_settings(use_empty=True)
    scene = bpy.context.scene
    scene.render.engine = "CYCLES"
    scene.view_settings.view_transform = "Standard"
    scene.cycles.samples = 16
    if with_camera:
        add_camera()
    return scene


def link(thing):
    bpy.context.scene.collection.objects.link(thing)
    return thing


def add(name, data, location=(0, 0, 0), rotation=(0, 0, 0), scale=(1, 1, 1)):
    thing = link(bpy.data.objects.new(name, data))
    thing.location, thing.rotation_euler, thing.scale = location, rotation, scale
    return thing


def add_camera(name="Camera", location=(0, -10, 2), rotation=(1.4, 0.1, 0.2), **settings):
    data = bpy.data.cameras.new(name)
    for key, value in settings.items():
        setattr(data, key, value)
    thing = add(name, data, location, rotation)
    bpy.context.scene.camera = thing
    return thing


def add_light(kind, scale=(1, 1, 1), **settings):
    data = bpy.data.lights.new("Lamp", kind)
    if kind in {"POINT", "SPOT"}:
        data.shadow_soft_size = 0
    for key, value in settings.items():
        setattr(data, key, value)
    return add("Lamp", data, (1, 2, 3), (0.3, 0.2, 0.1), scale)


def primitive(kind, material=None, smooth=None, **arguments):
    getattr(bpy.ops.mesh, "primitive_%s_add" % kind)(**arguments)
    thing = bpy.context.object
    if material:
        thing.data.materials.append(material)
    if smooth is not None:
        for face in thing.data.polygons:
            face.use_smooth = smooth
    return thing


def mesh_of(points, faces, name="Mesh"):
    mesh = bpy.data.meshes.new(name)
    mesh.from_pydata(points, [], faces)
    return mesh


def export(expected=(), arguments=()):
    """SceneText of the current scene, which the script lets the renderer check; the numbers of the
    warnings must be those expected."""
    path = os.path.join(FOLDER, "scene.txt")
    options = Export.parse(["-o", path, *arguments], False)
    report = Export.Report(False)
    quiet, sys.stderr = sys.stderr, open(os.devnull, "w")
    try:
        Export.export(options, report)
    finally:
        sys.stderr.close()
        sys.stderr = quiet
    got = sorted(set(report.seen.values()))
    assert got == sorted(set(expected)), "warnings %s, wanted %s: %s" % (got, sorted(set(expected)), list(report.seen))
    with open(path, encoding="utf-8") as file:
        text = file.read()
    return SceneText(text)


class Nodes:
    """Builds a node tree; inputs by name, a socket links, anything else is its value."""

    def __init__(self, owner=None):
        self.owner = owner or bpy.data.materials.new("M")
        self.owner.use_nodes = True
        self.tree = self.owner.node_tree
        self.tree.nodes.clear()

    def node(self, kind, settings=None, **inputs):
        node = self.tree.nodes.new(kind if kind.startswith("Node") else "ShaderNode" + kind)
        for key, value in (settings or {}).items():
            setattr(node, key, value)
        for key, value in inputs.items():
            names = (key, key.replace("_", " "))
            fits = [s for s in node.inputs if s.name in names or s.identifier in names]
            socket = next((s for s in fits if s.enabled and s.identifier == key), None) or next(
                (s for s in fits if s.enabled), fits[0])
            self.set(socket, value)
        return node

    def set(self, socket, value):
        if isinstance(value, bpy.types.NodeSocket):
            self.tree.links.new(value, socket)
        elif isinstance(value, bpy.types.Node):
            self.tree.links.new(value.outputs[0], socket)
        elif hasattr(value, "__len__") and len(value) == 3 and len(socket.default_value) == 4:
            socket.default_value = (*value, 1)
        else:
            socket.default_value = value

    def mix(self, factor, first, second):
        node = self.tree.nodes.new("ShaderNodeMixShader")
        for socket, value in zip(node.inputs, (factor, first, second)):
            if value is not None:
                self.set(socket, value)
        return node

    def end(self, shader, kind="ShaderNodeOutputMaterial"):
        output = self.tree.nodes.new(kind)
        self.set(output.inputs["Surface"], shader)
        return self.owner


def material_text(build, expected=(), uv=True):
    """Exports a triangle with the material that build(nodes) makes; (its block, the scene)."""
    new_scene()
    nodes = Nodes()
    nodes.end(build(nodes))
    mesh = mesh_of([(0, 0, 0), (1, 0, 0), (0, 1, 0)], [(0, 1, 2)])
    if uv:
        mesh.uv_layers.new(name="UVMap").data.foreach_set("uv", [0, 0, 1, 0, 0, 1])
    mesh.materials.append(nodes.owner)
    add("T", mesh)
    scene = export(expected)
    return scene.one("material"), scene


def picture(name="pic.png", channels=3, width=2, height=2, color=None):
    path = os.path.join(FOLDER, name)
    values = [40, 80, 120, 255][:channels] * (width * height) if color is None else color
    write_png(path, values, width, height, channels)
    return bpy.data.images.load(path, check_existing=False)
