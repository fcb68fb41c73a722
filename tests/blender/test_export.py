#!/usr/bin/env python3
"""Tests of Blend/Export.py in every Blender that is named. Standard library only.

    tests/blender/test_export.py --blender blender --blender /path/to/python-with-bpy [--only PART] [--verbose]

Each Blender runs this file again with --inside: there, scenes are built in memory, exported, and the
numbers in the text are compared with what Blender and the formulas say. Then whole runs of the script
are started from outside: exit codes, equal bytes, files. When ./raytracer exists, it checks each text.
Without --blender the `blender` of the PATH is used. The last line is `N passed, N failed`.
"""

import argparse
import glob
import json
import math
import os
import shutil
import struct
import subprocess
import sys
import tempfile
import traceback
import zlib

HERE = os.path.dirname(os.path.abspath(__file__))
TOP = os.path.dirname(os.path.dirname(HERE))
SCRIPT = os.path.join(TOP, "Blend", "Export.py")
RAYTRACER = os.environ.get("RAYTRACER", os.path.join(TOP, "raytracer"))

# ------------------------------------------------------------------------------- reading scene text


def tokens_of(line):
    out, i = [], 0
    while i < len(line):
        if line[i].isspace():
            i += 1
        elif line[i] == "#":
            break
        elif line[i] == '"':
            text, i = "", i + 1
            while line[i] != '"':
                i += line[i] == "\\"
                text += line[i]
                i += 1
            out.append(text)
            i += 1
        else:
            j = i
            while j < len(line) and not line[j].isspace():
                j += 1
            out.append(line[i:j])
            i = j
    return out


def plain(token):
    try:
        return float(token)
    except ValueError:
        return {"true": True, "false": False}.get(token, token)


class Block:
    def __init__(self, kind, name):
        self.kind, self.name, self.lines, self.arrays = kind, name, [], {}

    def __getitem__(self, keyword):
        values = self.get(keyword)
        if values is None:
            raise AssertionError("%s '%s' has no '%s'" % (self.kind, self.name, keyword))
        return values

    def get(self, keyword, default=None):
        for key, values in self.lines:
            if key == keyword:
                return values[0] if len(values) == 1 else values
        return default

    def keys(self):
        """The 3x4 matrices of its positions."""
        rows, out = None, []
        for key, v in self.lines:
            step = None
            if key == "translate":
                step = [[1, 0, 0, v[0]], [0, 1, 0, v[1]], [0, 0, 1, v[2]]]
            elif key == "scale" and self.kind != "texture":
                step = [[v[0], 0, 0, 0], [0, v[1], 0, 0], [0, 0, v[2], 0]]
            elif key == "transform":
                step = [v[0:4], v[4:8], v[8:12]]
            elif key == "key":
                out.append(rows)
                rows = None
            if step:
                rows = step if rows is None else multiply(rows, step)
        out.append(rows)
        identity = [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0]]
        return [r or identity for r in out]


def multiply(a, b):
    return [[sum(a[i][k] * b[k][j] for k in range(3)) + (a[i][3] if j == 3 else 0) for j in range(4)] for i in range(3)]


class SceneText:
    """The blocks of a scene text, by kind and name."""

    def __init__(self, text):
        lines = text.split("\n")
        assert lines[0] == "raytracer 1", lines[0]
        self.text, self.blocks = text, []
        block, counted = None, None
        for line in lines[1:]:
            tokens = tokens_of(line)
            if not tokens:
                continue
            if tokens[-1] == "{":
                block = Block(tokens[0], tokens[1] if len(tokens) > 2 else "")
                self.blocks.append(block)
            elif tokens == ["}"]:
                block = None
            elif block.kind == "mesh":
                if len(tokens) == 2 and not tokens[0].lstrip("-")[:1].isdigit():
                    counted = block.arrays[tokens[0]] = []
                    block.lines.append((tokens[0], [float(tokens[1])]))
                else:
                    counted.append([float(t) for t in tokens])
            else:
                block.lines.append((tokens[0], [plain(t) for t in tokens[1:]]))

    def all(self, *kinds):
        return [b for b in self.blocks if b.kind in kinds]

    def one(self, kind, name=None):
        found = [b for b in self.all(kind) if name is None or b.name == name]
        assert len(found) == 1, "%d blocks '%s %s' in\n%s" % (len(found), kind, name or "", self.text[:3000])
        return found[0]


def near(got, wanted, tolerance=1e-5):
    got = [got] if isinstance(got, (int, float)) else [x for r in got for x in (r if hasattr(r, "__len__") else [r])]
    wanted = [wanted] if isinstance(wanted, (int, float)) else [
        x for r in wanted for x in (r if hasattr(r, "__len__") else [r])]
    size = max([abs(x) for x in wanted] + [1e-9])
    assert len(got) == len(wanted) and all(abs(a - b) <= tolerance * size for a, b in zip(got, wanted)), \
        "got %s, wanted %s" % (got, wanted)


def equal(got, wanted):
    assert got == wanted, "got %r, wanted %r" % (got, wanted)


# --------------------------------------------------------------------------- inside: building scenes

if "--inside" in sys.argv:
    import bpy
    from mathutils import Euler, Matrix, Vector

    sys.dont_write_bytecode = True
    sys.path.insert(0, os.path.dirname(SCRIPT))
    import Export

    VERSION = bpy.app.version
    FOLDER = tempfile.mkdtemp(prefix="export-test-")

TESTS = []  # (name, function), run inside
WHOLE = []  # (name, function(launch, folder)), run outside


def test(function):
    TESTS.append((function.__name__, function))
    return function


def whole(function):
    WHOLE.append((function.__name__, function))
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
    """SceneText of the current scene; the numbers of the warnings must be those expected."""
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
    if os.path.exists(RAYTRACER):
        done = subprocess.run([RAYTRACER, "--check", path], capture_output=True, text=True)
        assert done.returncode == 0, "raytracer --check: %d %s" % (done.returncode, done.stderr[-600:])
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


def write_png(path, pixels, width, height, channels=3):
    rows = b"".join(b"\0" + bytes(pixels[y * width * channels:(y + 1) * width * channels]) for y in range(height))
    chunk = lambda k, d: struct.pack(">I", len(d)) + k + d + struct.pack(">I", zlib.crc32(k + d))
    head = struct.pack(">IIBBBBB", width, height, 8, {1: 0, 3: 2, 4: 6}[channels], 0, 0, 0)
    with open(path, "wb") as file:
        file.write(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", head) + chunk(b"IDAT", zlib.compress(rows)) + chunk(b"IEND", b""))


def read_png(path):
    """(width, height, channels, rows from the top without filter bytes) of the script's own PNG."""
    with open(path, "rb") as file:
        data = file.read()
    width, height, depth, kind = struct.unpack(">IIBB", data[16:26])
    equal(depth, 8)
    i, packed = 8, b""
    while i < len(data):
        size, name = struct.unpack(">I4s", data[i:i + 8])
        packed += data[i + 8:i + 8 + size] if name == b"IDAT" else b""
        i += size + 12
    channels = {0: 1, 2: 3, 6: 4}[kind]
    raw, stride = zlib.decompress(packed), 1 + width * channels
    assert all(raw[y * stride] == 0 for y in range(height)), "filtered PNG"
    return width, height, channels, b"".join(raw[y * stride + 1:(y + 1) * stride] for y in range(height))


def picture(name="pic.png", channels=3, width=2, height=2, color=None):
    path = os.path.join(FOLDER, name)
    values = [40, 80, 120, 255][:channels] * (width * height) if color is None else color
    write_png(path, values, width, height, channels)
    return bpy.data.images.load(path, check_existing=False)


# ------------------------------------------------------------------------------------------- cameras


def check_camera(scene, text, name="Camera"):
    """Rays through the corners of the picture, by the format's formulas, against view_frame()."""
    settings, block = text.one("settings"), text.one("camera", name)
    width, height = settings["resolution"]
    ax, ay = settings.get("pixel_aspect", [1, 1])
    xr, yr = width * ax, height * ay
    sensor, fit = block["sensor"], block["sensor_fit"]
    horizontal = xr > yr if fit == "auto" else fit == "horizontal"
    size = sensor[1] if fit == "vertical" else sensor[0]
    fitted = xr if horizontal else yr
    shift = block.get("shift", [0, 0])
    rows = block.keys()[0]
    r0, r1, r2, eye = ([row[i] for row in rows] for i in range(4))
    camera = scene.camera
    place = camera.matrix_world.normalized()
    for (px, py), corner in zip(((width, height), (width, 0), (0, 0), (0, height)), camera.data.view_frame(scene=scene)):
        u = (px / width - 0.5) * xr / fitted + shift[0]
        v = (py / height - 0.5) * yr / fitted + shift[1]
        if block["type"] == "orthographic":
            k = block["ortho_scale"]
            got = [e + u * k * a + v * k * b for e, a, b in zip(eye, r0, r1)]
            wanted = place @ Vector((corner.x, corner.y, 0))
        else:
            k = size / block["lens"]
            got = Vector([u * k * a + v * k * b - c for a, b, c in zip(r0, r1, r2)]).normalized()
            wanted = (place.to_3x3() @ corner).normalized()
        near(list(got), list(wanted), 2e-5)


@test
def camera_rays_for_all_fits_and_aspects():
    scene = new_scene()
    camera = scene.camera
    camera.data.lens, camera.data.sensor_width, camera.data.sensor_height = 35, 30, 21
    for fit in ("AUTO", "HORIZONTAL", "VERTICAL"):
        for size in ((160, 90), (90, 160), (100, 100)):
            for aspect in ((1, 1), (1.5, 1), (1, 2)):
                for kind in ("PERSP", "ORTHO"):
                    camera.data.sensor_fit, camera.data.type = fit, kind
                    camera.data.shift_x, camera.data.shift_y = 0.1, -0.2
                    scene.render.resolution_x, scene.render.resolution_y = size
                    scene.render.pixel_aspect_x, scene.render.pixel_aspect_y = aspect
                    check_camera(scene, export())


@test
def camera_scale_parent_and_constraint():
    scene = new_scene()
    target = add("Target", None, (1, 2, 0))
    parent = add("Parent", None, (0, 0, 1), (0, 0, 0.4), (2, 3, 2))
    scene.camera.parent = parent
    constraint = scene.camera.constraints.new("TRACK_TO")
    constraint.target, constraint.track_axis, constraint.up_axis = target, "TRACK_NEGATIVE_Z", "UP_Y"
    bpy.context.view_layer.update()
    text = export()
    check_camera(scene, text)
    rows = text.one("camera").keys()[0]
    near([math.hypot(*(row[i] for row in rows)) for i in range(3)], [1, 1, 1])


@test
def depth_of_field():
    scene = new_scene()
    data = scene.camera.data
    data.lens, data.clip_start = 80, 0.25
    dof = data.dof
    dof.use_dof, dof.aperture_fstop, dof.focus_distance = True, 2.8, 7
    dof.aperture_blades, dof.aperture_rotation, dof.aperture_ratio = 6, 0.5, 2
    block = export().one("camera")
    near(block["aperture_radius"], 0.08 / 5.6)
    near([block["focus_distance"], block["aperture_blades"], block["aperture_ratio"], block["clip_start"]], [7, 6, 2, 0.25])
    near(block["aperture_rotation"], math.degrees(0.5))
    dof.focus_object = add("Focus", None, (1, 4, 0.5))
    bpy.context.view_layer.update()
    axis = scene.camera.matrix_world.col[2].to_3d()
    wanted = abs(axis.dot(scene.camera.matrix_world.translation - Vector((1, 4, 0.5))))
    near(export().one("camera")["focus_distance"], wanted)
    data.type = "ORTHO"
    near(export().one("camera")["aperture_radius"], 1 / 5.6)
    dof.use_dof = False
    equal(export().one("camera").get("aperture_radius"), None)


@test
def other_cameras_follow_the_active_one():
    scene = new_scene()
    add_camera("Another", (3, 0, 0))
    scene.camera = bpy.data.objects["Camera"]
    equal([b.name for b in export().all("camera")], ["Camera", "Another"])
    equal([b.name for b in export(arguments=["--camera", "Another"]).all("camera")], ["Another", "Camera"])
    equal(scene.camera.name, "Camera")


@test
def panorama_warns():
    new_scene().camera.data.type = "PANO"
    equal(export([7]).one("camera")["type"], "perspective")


# ------------------------------------------------------------------------------------------ settings


@test
def resolution_border_and_samples():
    scene = new_scene()
    render = scene.render
    render.resolution_x, render.resolution_y, render.resolution_percentage = 1921, 1001, 50
    render.use_border = True
    render.border_min_x, render.border_max_x, render.border_min_y, render.border_max_y = 0.1, 0.7, 0.25, 0.6
    block = export().one("settings")
    equal(block["resolution"], [960, 500])
    equal(block["crop"], [96, 200, 672, 375])
    equal(block["samples"], 16)
    scene.cycles.samples, scene.cycles.max_bounces, scene.cycles.seed = 4096, 5, 7
    block = export().one("settings")
    equal([block["samples"], block["max_depth"], block["seed"]], [64, 5, 7])
    scene.cycles.samples = 1
    equal(export().one("settings")["jitter"], False)


@test
def filter_exposure_and_transfer():
    scene = new_scene()
    equal(export().one("settings")["filter"], ["blackman-harris", 1.5])
    scene.cycles.pixel_filter_type, scene.cycles.filter_width = "BOX", 0.01
    equal(export().one("settings")["filter"], ["box", 1])
    scene.cycles.pixel_filter_type, scene.cycles.filter_width = "GAUSSIAN", 2
    equal(export().one("settings")["filter"], ["gaussian", 2])
    scene.view_settings.exposure, scene.cycles.film_exposure = 0.5, 4
    near(export().one("settings")["exposure"], 2.5)
    equal(export().one("settings")["transfer"], "srgb")
    scene.view_settings.view_transform = "Raw"
    equal(export().one("settings")["transfer"], "linear")
    scene.view_settings.view_transform = "Filmic"
    equal(export([1]).one("settings")["transfer"], "srgb")
    scene.view_settings.view_transform, scene.view_settings.gamma = "Standard", 1.5
    export([2])


@test
def settings_are_restored():
    scene = new_scene()
    scene.render.use_compositing = True
    before = (scene.render.engine, scene.render.use_compositing, scene.frame_current, scene.render.filepath, scene.camera)
    export(arguments=["--frame", "7"])
    equal((scene.render.engine, scene.render.use_compositing, scene.frame_current, scene.render.filepath, scene.camera), before)


# -------------------------------------------------------------------------------------------- lights


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
    equal([block["shadows"], block["visible"]], [False, True])
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


# -------------------------------------------------------------------------------------------- shapes


@test
def spheres_are_recognised():
    new_scene()
    primitive("uv_sphere", smooth=True, radius=2, location=(1, 2, 3))
    near(export().one("sphere").keys()[0], [[2, 0, 0, 1], [0, 2, 0, 2], [0, 0, 2, 3]])
    new_scene()
    thing = primitive("ico_sphere", smooth=True, subdivisions=3, radius=0.5)
    for v in thing.data.vertices:  # size and place sit in the mesh
        v.co = (v.co.x * 2 + 5, v.co.y * 3, v.co.z)
    thing.location, thing.scale = (0, 0, 1), (2, 1, 1)
    near(export().one("sphere").keys()[0], [[2, 0, 0, 10], [0, 1.5, 0, 0], [0, 0, 0.5, 1]], 1e-5)


@test
def other_balls_stay_meshes():
    for change in ("flat", "dent", "inside out", "open", "coarse"):
        new_scene()
        thing = primitive("uv_sphere", smooth=change != "flat", **({"segments": 6, "ring_count": 3} if change == "coarse" else {}))
        if change == "dent":
            thing.data.vertices[40].co *= 0.999
        if change == "inside out":
            thing.data.flip_normals()
        if change == "open":
            bpy.ops.object.mode_set(mode="EDIT")
            bpy.ops.mesh.select_all(action="DESELECT")
            bpy.ops.object.mode_set(mode="OBJECT")
            thing.data.polygons[0].select = True
            bpy.ops.object.mode_set(mode="EDIT")
            bpy.ops.mesh.delete(type="FACE")
            bpy.ops.object.mode_set(mode="OBJECT")
        equal([b.kind for b in export().all("sphere", "instance")], ["instance"])
    new_scene()  # flat, but fine enough
    primitive("uv_sphere", smooth=False, segments=128, ring_count=64)
    export().one("sphere")


@test
def cubes_and_planes_are_recognised():
    new_scene()
    thing = primitive("cube", size=1, location=(1, 0, 0))
    for v in thing.data.vertices:
        v.co = (v.co.x * 4 + 3, v.co.y * 2, v.co.z)
    thing.scale = (1, -1, 2)
    near(export().one("cube").keys()[0], [[2, 0, 0, 4], [0, -1, 0, 0], [0, 0, 1, 0]])
    new_scene()
    primitive("plane", size=6)
    block = export().one("plane")
    corners = [tuple(block["corners"][i:i + 3]) for i in range(0, 12, 3)]
    equal(sorted(corners), [(-3, -3, 0), (-3, 3, 0), (3, -3, 0), (3, 3, 0)])
    near(list((Vector(corners[1]) - Vector(corners[0])).cross(Vector(corners[2]) - Vector(corners[1])).normalized()), [0, 0, 1])
    for points in ([(0, 0, 0), (1, 0, 0), (1, 1, 0.1), (0, 1, 0)], [(0, 0, 0), (1, 0, 0), (0.2, 0.2, 0), (0, 1, 0)]):
        new_scene()
        add("Q", mesh_of(points, [(0, 1, 2, 3)]))
        export().one("instance")
    new_scene()
    primitive("cube").data.flip_normals()
    export().one("instance")
    new_scene()
    thing = primitive("cube")
    thing.data.vertices[0].co.x -= 0.1
    export().one("instance")


@test
def textured_shapes_stay_meshes():
    new_scene()
    nodes = Nodes()
    nodes.end(nodes.node("BsdfDiffuse", Color=nodes.node("TexImage", {"image": picture()})))
    for kind in ("cube", "plane", "uv_sphere"):
        primitive(kind, nodes.owner)
    text = export()
    equal(len(text.all("instance")), 3)
    assert all("uvs" in b.arrays for b in text.all("mesh"))


@test
def rt_shape_overrides():
    for wanted in ("sphere", "cube", "disk", "cylinder", "infinite_plane", "plane"):
        new_scene()
        primitive("cylinder", radius=2, depth=3)["rt_shape"] = wanted
        block = export().one(wanted)
        if wanted == "cylinder":
            near(block.keys()[0], [[2, 0, 0, 0], [0, 2, 0, 0], [0, 0, 1.5, 0]])
    new_scene()
    primitive("cone", radius1=2, radius2=0.5, depth=3)["rt_shape"] = "cone"
    near(export().one("cone")["top_radius"], 0.25)
    new_scene()
    primitive("cube")["rt_shape"] = "mesh"
    export().one("instance")
    new_scene()
    primitive("cube")["rt_shape"] = "dodecahedron"
    export([33]).one("instance")


@test
def negative_zero_and_uneven_scale():
    new_scene()
    mesh = mesh_of([(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)], [(0, 2, 1), (0, 1, 3), (1, 2, 3), (0, 3, 2)])
    add("A", mesh, scale=(-1, 2, 3))
    add("Flat", mesh, (0, 0, 5), scale=(2, 1, 0))
    add("Nothing", mesh, scale=(0, 0, 0))
    text = export()
    near(text.one("instance", "A").keys()[0], [[-1, 0, 0, 0], [0, 2, 0, 0], [0, 0, 3, 0]])
    flat = text.one("instance", "Flat")
    near(flat.keys()[0], [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0]])
    near(text.one("mesh", flat["mesh"]).arrays["points"], [[0, 0, 5], [2, 0, 5], [0, 1, 5], [0, 0, 5]])
    equal(len(text.all("instance")), 2)


# -------------------------------------------------------------------------------------------- meshes


@test
def modifiers_at_render_level_and_visibility():
    new_scene()
    thing = primitive("cube")
    modifier = thing.modifiers.new("S", "SUBSURF")
    modifier.levels, modifier.render_levels = 1, 3
    hidden = primitive("cube", location=(5, 0, 0))
    hidden.name, hidden.hide_render = "No render", True
    shown = primitive("cube", location=(9, 0, 0))
    shown.name, shown.hide_viewport = "No viewport", True
    text = export()
    equal(text.one("mesh").get("triangles"), 6 * 4**3 * 2)
    equal([b.name for b in text.all("cube")], ["No viewport"])
    if VERSION >= (2, 80):
        layer = bpy.context.view_layer
        collection = bpy.data.collections.new("Excluded")
        bpy.context.scene.collection.children.link(collection)
        collection.objects.link(bpy.data.objects.new("Out", shown.data))
        layer.layer_collection.children["Excluded"].exclude = True
        equal([b.name for b in export().all("cube")], ["No viewport"])


@test
def normals_only_where_smooth():
    def ball(change):
        new_scene()
        thing = primitive("torus", smooth=True)
        change(thing)
        return export().one("mesh")

    block = ball(lambda t: None)
    equal(block.get("normals"), block.get("points"))
    equal(block.arrays["normal_triangles"], block.arrays["triangles"])

    def flatten(thing):
        for face in thing.data.polygons:
            face.use_smooth = False

    assert "normals" not in ball(flatten).arrays

    def half(thing):
        for face in thing.data.polygons[: len(thing.data.polygons) // 2]:
            face.use_smooth = False

    block = ball(half)
    assert block.get("normals") > block.get("points")
    equal(block.get("normal_triangles"), block.get("triangles"))
    for n in block.arrays["normals"]:
        near(math.hypot(*n), 1, 1e-3)

    def sharp(thing):  # without auto smooth 3.4 ignores it, later versions do not
        thing.data.edges[0].use_edge_sharp = True

    block = ball(sharp)
    if VERSION < (4, 1):
        equal(block.get("normals"), block.get("points"))
        mesh = bpy.context.object.data
        equal([mesh.edges[0].use_edge_sharp, mesh.use_auto_smooth, mesh.polygons[0].use_smooth], [True, False, True])
        for got, vertex in zip(block.arrays["normals"], mesh.vertices):
            near(got, list(vertex.normal), 1e-5)
    else:
        assert block.get("normals") > block.get("points") // 2


@test
def normals_are_the_same_each_time():
    def shot():
        new_scene()
        thing = primitive("monkey", smooth=True)
        modifier = thing.modifiers.new("S", "SUBSURF")
        modifier.render_levels = 4
        return export().text

    first = shot()
    for _ in range(4):
        assert shot() == first


@test
def material_slots_and_ngons():
    new_scene()
    materials = [bpy.data.materials.new(n) for n in "ABC"]
    mesh = mesh_of([(0, 0, 0), (2, 0, 0), (3, 1, 0), (2, 2, 0), (0, 2, 0), (0, 0, 1)], [(0, 1, 2, 3, 4), (0, 1, 5)])
    for m in materials:
        mesh.materials.append(m)
    mesh.polygons[0].material_index, mesh.polygons[1].material_index = 2, 0
    thing = add("N", mesh)
    text = export()
    equal(text.one("instance")["materials"], ["A", "C"])
    equal(text.one("mesh").arrays["triangle_materials"], [[1], [1], [1], [0]])
    equal([b.name for b in text.all("material")], ["A", "C"])
    thing.material_slots[2].link = "OBJECT"
    equal(export().one("instance")["materials"], ["A", "C"])  # Blender falls back to the mesh's
    thing.material_slots[2].material = bpy.data.materials.new("D")
    equal(export().one("instance")["materials"], ["A", "D"])
    mesh.materials[0] = None
    equal(export().one("instance")["materials"], ["No material", "D"])


@test
def degenerate_and_infinite_geometry():
    new_scene()
    add("D", mesh_of([(0, 0, 0), (1, 0, 0), (2, 0, 0), (0, 1, 0)], [(0, 1, 2), (0, 1, 3)]))
    equal(export().one("mesh").get("triangles"), 1)
    new_scene()
    add("I", mesh_of([(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, float("inf"))], [(0, 1, 2), (0, 1, 3)]))
    export([11])
    new_scene()
    add("Empty mesh", mesh_of([(0, 0, 0)], []))
    equal(export().all("instance", "mesh"), [])


@test
def uv_maps_and_coordinates():
    def shot(build, expected=()):
        new_scene()
        nodes = Nodes()
        image = nodes.node("TexImage", {"image": picture()})
        vector = build(nodes)
        if vector is not None:
            nodes.set(image.inputs["Vector"], vector)
        nodes.end(nodes.node("BsdfDiffuse", Color=image))
        mesh = mesh_of([(1, 2, 0), (3, 2, 0), (3, 6, 0), (1, 6, 0)], [(0, 1, 2, 3)])
        mesh.uv_layers.new(name="First").data.foreach_set("uv", [0, 0, 1, 0, 1, 1, 0, 1])
        mesh.uv_layers.new(name="Second").data.foreach_set("uv", [0, 0, 5, 0, 5, 5, 0, 5])
        mesh.uv_layers["First"].active_render = True
        mesh.materials.append(nodes.owner)
        add("Q", mesh)
        return sorted(export(expected).one("mesh").arrays["uvs"])

    square = lambda x: sorted([[0, 0], [0, x], [x, 0], [x, x]])
    equal(shot(lambda n: None), square(1))
    equal(shot(lambda n: n.node("TexCoord").outputs["UV"]), square(1))
    equal(shot(lambda n: n.node("UVMap", {"uv_map": "Second"})), square(5))
    equal(shot(lambda n: n.node("TexCoord").outputs["Generated"]), square(1))
    equal(shot(lambda n: n.node("TexCoord").outputs["Object"]), sorted([[1, 2], [3, 2], [3, 6], [1, 6]]))
    equal(shot(lambda n: n.node("UVMap", {"uv_map": "Third"}), [27]), [[0, 0]])
    equal(shot(lambda n: n.node("TexCoord").outputs["Reflection"], [19]), square(1))


@test
def instances_share_meshes():
    new_scene()
    mesh = mesh_of([(0, 0, 0), (1, 0, 0), (0, 1, 0)], [(0, 1, 2)])
    collection = bpy.data.collections.new("C")
    for i in range(3):
        thing = bpy.data.objects.new("In %d" % i, mesh)
        thing.location = (i, 0, 0)
        collection.objects.link(thing)
    for i in range(4):
        holder = add("Holder %d" % i, None, (0, i, 0))
        holder.instance_type, holder.instance_collection = "COLLECTION", collection
    add("Alone", mesh)
    add("Copy", mesh.copy())
    text = export()
    equal([len(text.all("mesh")), len(text.all("instance"))], [1, 14])
    near(text.one("instance", "Holder 2/In 1").keys()[0], [[1, 0, 0, 1], [0, 1, 0, 2], [0, 0, 1, 0]])


@test
def particles():
    new_scene()
    emitter = primitive("plane", size=4)
    leaf = primitive("torus", location=(0, 0, -5))
    leaf.name = "Leaf"
    emitter.modifiers.new("P", "PARTICLE_SYSTEM")
    settings = emitter.particle_systems[0].settings
    settings.count, settings.frame_start, settings.frame_end, settings.lifetime = 20, 0, 0, 100
    settings.render_type, settings.instance_object = "OBJECT", leaf
    bpy.context.scene.frame_set(1)
    text = export()
    equal([len(text.all("mesh")), len(text.all("instance")), len(text.all("plane"))], [1, 21, 1])


@test
def curves_and_text_come_once():
    scene = new_scene()
    for operator in ("object.text_add", "curve.primitive_bezier_circle_add", "object.metaball_add",
                     "surface.primitive_nurbs_surface_sphere_add"):
        group, name = operator.split(".")
        getattr(getattr(bpy.ops, group), name)()
        if bpy.context.object.type == "CURVE":
            bpy.context.object.data.bevel_depth = 0.1
    text = export()
    equal(len(text.all("mesh")), 4)
    equal(len(text.all("instance")), 4)


@test
def unknown_types_and_visibility_warn():
    new_scene()
    add("Fog", bpy.data.volumes.new("Fog"))
    export([5])
    new_scene()
    primitive("cube").visible_camera = False
    equal(export([6]).all("cube"), [])
    new_scene()
    primitive("cube").visible_shadow = False
    export([6]).one("cube")
    new_scene().camera.data.clip_end = 5
    primitive("cube", location=(0, 60, 0))
    export([8]).one("cube")


# -------------------------------------------------------------------------------------------- motion


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
    primitive("uv_sphere", smooth=True, location=(0, 3, 0))
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


# ----------------------------------------------------------------------------------------- materials


@test
def diffuse_and_none():
    block, _ = material_text(lambda n: n.node("BsdfDiffuse", Color=(0.1, 0.2, 0.3)))
    near(block["diffuse"], [0.1, 0.2, 0.3])
    equal(block.get("specular"), None)
    block, _ = material_text(lambda n: n.node("BsdfDiffuse", Roughness=0.5), [13])
    new_scene()
    primitive("cube")
    text = export()
    near(text.one("material")["diffuse"], [0.8] * 3)
    if VERSION < (5, 0):
        new_scene()
        material = bpy.data.materials.new("Plain")
        material.use_nodes, material.diffuse_color = False, (0.1, 0.2, 0.3, 1)
        primitive("cube", material)
        near(export().one("material")["diffuse"], [0.1, 0.2, 0.3])


@test
def the_courses_material():
    def build(n):
        return n.mix(0.25, n.node("BsdfDiffuse", Color=(0.4, 0.8, 0.2)), n.node("BsdfGlossy", Color=(1, 0.5, 0.2), Roughness=0.2))

    block, _ = material_text(build)
    near(block["diffuse"], [0.3, 0.6, 0.15])
    near(block["specular"], [0.25, 0.125, 0.05])
    near(block["mirror"], [0.25, 0.125, 0.05])
    near([block["exponent"], block["roughness"]], [2 / 0.2**4 - 2, 0.2])
    equal([block["specular_model"], block.get("fresnel")], ["ashikhmin", None])


@test
def glossy_limits():
    block, _ = material_text(lambda n: n.node("BsdfGlossy", Color=(0.9, 0.9, 0.9), Roughness=0.0))
    equal([block.get("specular"), block.get("roughness")], [None, None])
    near(block["mirror"], [0.9] * 3)
    near(block["diffuse"], [0, 0, 0])
    near(material_text(lambda n: n.node("BsdfGlossy", Roughness=1.0))[0]["exponent"], 1)
    near(material_text(lambda n: n.node("BsdfGlossy", Roughness=0.02))[0]["exponent"], 1e5)
    two = lambda n: n.node("AddShader", Shader=n.node("BsdfGlossy", Color=(0.2,) * 3, Roughness=0.1),
                           Shader_001=n.node("BsdfGlossy", Color=(0.3,) * 3, Roughness=0.4))
    near(material_text(two, [15])[0]["mirror"], [0.5] * 3)


@test
def glass_and_refraction():
    block, _ = material_text(lambda n: n.node("BsdfGlass", Color=(0.9, 0.8, 0.7), IOR=1.33, Roughness=0.0))
    near(block["mirror"], [0.9, 0.8, 0.7])
    near(block["transmission"], [0.9, 0.8, 0.7])
    near(block["ior"], 1.33)
    equal([block["fresnel"], block.get("roughness")], ["dielectric", None])
    block, _ = material_text(lambda n: n.node("BsdfRefraction", Color=(0.9, 0.8, 0.7), IOR=1.2, Roughness=0.1))
    near([block["ior"], block["roughness"]], [1.2, 0.1])
    equal([block.get("mirror"), block.get("fresnel")], [None, None])
    half = lambda n: n.mix(0.5, n.node("BsdfDiffuse", Color=(1, 1, 1)), n.node("BsdfGlass", IOR=1.5, Roughness=0.0))
    block, _ = material_text(half)
    near([block["diffuse"][0], block["transmission"][0], block["mirror"][0]], [0.5, 0.5, 0.5])


@test
def mixing_by_fresnel():
    def build(n):
        return n.mix(n.node("Fresnel", IOR=1.5), n.node("BsdfDiffuse", Color=(1, 1, 1)),
                     n.node("BsdfGlossy", Color=(1, 1, 1), Roughness=0.3))

    block, _ = material_text(build)
    equal(block["fresnel"], "dielectric")
    near([block["ior"], block["mirror"][0], block["specular"][0]], [1.5, 1, 0.04])
    near(block["diffuse"][0], 1 - 0.0918, 2e-3)
    weight = lambda n: n.mix(n.node("LayerWeight", Blend=0.5).outputs["Fresnel"], n.node("BsdfDiffuse"), n.node("BsdfGlossy"))
    near(material_text(weight)[0]["ior"], 2)
    facing = lambda n: n.mix(n.node("LayerWeight", Blend=0.5).outputs["Facing"], n.node("BsdfDiffuse"), n.node("BsdfGlossy"))
    equal(material_text(facing, [16])[0]["fresnel"], "schlick")
    dull = lambda n: n.mix(n.node("Fresnel"), n.node("BsdfDiffuse", Color=(1, 1, 1)), n.node("BsdfDiffuse", Color=(1, 1, 1)))
    near(material_text(dull, [16])[0]["diffuse"], [1, 1, 1])


@test
def transparency():
    def build(n):
        return n.mix(0.25, n.node("BsdfTransparent", Color=(1, 0.5, 0.2)), n.node("BsdfDiffuse", Color=(0.4, 0.4, 0.4)))

    block, _ = material_text(build)
    near(block["opacity"], 0.25)
    near(block["filter"], [1, 0.5, 0.2])
    near(block["diffuse"], [0.4] * 3)
    block, _ = material_text(lambda n: n.node("BsdfTransparent", Color=(0.5, 0.5, 0.5)))
    near([block["opacity"], *block["filter"]], [0, 0.5, 0.5, 0.5])
    both = lambda n: n.node("AddShader", Shader=n.node("BsdfTransparent", Color=(1, 1, 1)), Shader_001=n.node("Emission", Color=(1, 1, 1), Strength=3.0))
    block, _ = material_text(both, [32])
    near(block["opacity"] * block["emission"][0], 3)
    near((1 - block["opacity"]) * block["filter"][0], 1)


@test
def emission_and_lamps():
    new_scene()
    nodes = Nodes()
    nodes.end(nodes.node("Emission", Color=(1, 0.5, 0.2), Strength=4.0))
    primitive("uv_sphere", nodes.owner, smooth=True, radius=0.5, location=(0, 0, 3))
    lamp = export().one("light")
    equal([lamp["type"], lamp["visible"]], ["sphere", True])
    near([lamp["radius"], *lamp["color"], *lamp["translate"]], [0.5, 4, 2, 0.8, 0, 0, 3])
    new_scene()
    nodes = Nodes()
    nodes.end(nodes.node("Emission", Color=(1, 1, 1), Strength=2.0))
    thing = primitive("plane", nodes.owner, size=2, location=(0, 0, 3))
    thing.scale = (1, 2, 1)
    lamps = export().all("light")
    equal([b["type"] for b in lamps], ["rectangle", "rectangle"])
    equal(sorted(lamps[0]["size"]), [2, 4])
    equal(sorted(round(b.keys()[0][2][2]) for b in lamps), [-1, 1])
    thing["rt_light"] = 0
    text = export()
    equal([len(text.all("light")), len(text.all("plane"))], [0, 1])
    new_scene()
    nodes = Nodes()
    nodes.end(nodes.node("Emission"))
    primitive("torus", nodes.owner)
    export([32])


@test
def principled():
    def build(**inputs):
        return lambda n: n.node("BsdfPrincipled", **inputs)

    new = VERSION >= (4, 0)
    level, clear, glow = (("Specular_IOR_Level", "Transmission_Weight", "Emission_Color") if new
                          else ("Specular", "Transmission", "Emission"))
    block, _ = material_text(build(Base_Color=(0.5, 0.4, 0.3), Roughness=0.5, IOR=1.5, **{level: 0.5}))
    near(block["specular"], [0.04] * 3)
    near(block["diffuse"], [x * (1 - 0.04 - 0.96 / 21 if new else 1) for x in (0.5, 0.4, 0.3)])
    equal([block["fresnel"], block["roughness"]], ["schlick", 0.5])
    block, _ = material_text(build(IOR=1.8, **{level: 0.25}))
    near(block["mirror"][0], (0.8 / 2.8) ** 2 * 0.5 if new else 0.02)
    block, _ = material_text(build(Base_Color=(0.9, 0.6, 0.3), Metallic=1.0, Roughness=0.2))
    near(block["mirror"], [0.9, 0.6, 0.3])
    near(block["diffuse"], [0, 0, 0])
    block, _ = material_text(build(Base_Color=(0.25, 1, 1), Roughness=0.0, IOR=1.4, **{clear: 1.0}))
    near(block["transmission"], [0.5 if new else 0.25, 1, 1])
    near([block["ior"], *block["mirror"]], [1.4, 1, 1, 1])
    equal(block["fresnel"], "dielectric")
    block, _ = material_text(build(Alpha=0.3, Base_Color=(0.5, 0.5, 0.5), **{level: 0.0}))
    near([block["opacity"], block["diffuse"][0]], [0.3, 0.5])
    block, _ = material_text(build(Emission_Strength=2.0, **{glow: (0.1, 0.2, 0.3)}), [32])
    near(block["emission"], [0.2, 0.4, 0.6])
    material_text(build(Metallic=0.5, **{"Coat_Weight" if new else "Clearcoat": 0.5}), [13])


@test
def constants_are_folded():
    def shot(build, expected=()):
        return material_text(lambda n: n.node("BsdfDiffuse", Color=build(n)), expected)[0]["diffuse"]

    def rgb(n, *color):
        node = n.node("RGB")
        node.outputs[0].default_value = (*color, 1)
        return node

    def number(n, x):
        node = n.node("Value")
        node.outputs[0].default_value = x
        return node

    near(shot(lambda n: rgb(n, 0.1, 0.2, 0.3)), [0.1, 0.2, 0.3])
    near(shot(lambda n: number(n, 0.4)), [0.4] * 3)
    near(shot(lambda n: n.node("MixRGB", {"blend_type": "MULTIPLY"}, Fac=1.0, Color1=(0.5, 1, 1), Color2=(0.5, 0.4, 0.2))), [0.25, 0.4, 0.2])
    near(shot(lambda n: n.node("MixRGB", Fac=0.25, Color1=(0, 0, 0), Color2=(1, 0.4, 0.2))), [0.25, 0.1, 0.05])
    near(shot(lambda n: n.node("Math", {"operation": "POWER"}, Value=0.5, Value_001=2.0)), [0.25] * 3)
    near(shot(lambda n: n.node("Math", {"operation": "SUBTRACT"}, Value=1.0, Value_001=number(n, 0.25))), [0.75] * 3)
    near(shot(lambda n: n.node("Gamma", Color=(0.25, 0.5, 1), Gamma=2.0)), [0.0625, 0.25, 1])
    near(shot(lambda n: n.node("Invert", Fac=1.0, Color=(0.25, 0.5, 1))), [0.75, 0.5, 0])
    near(shot(lambda n: n.node("Blackbody", Temperature=6500.0)), [1.04254, 0.98405, 1.03527], 1e-4)
    near(shot(lambda n: n.node("HueSaturation", Hue=0.5, Saturation=0.0, Value=1.0, Fac=1.0, Color=(0.8, 0.2, 0.2))), [0.8] * 3)
    near(shot(lambda n: n.node("ValToRGB", Fac=0.25)), [0.25] * 3, 1e-3)
    near(shot(lambda n: n.node("MapRange", Value=0.5, To_Min=0.0, To_Max=0.4).outputs[0]), [0.2] * 3)
    near(shot(lambda n: n.node("CombineColor", Red=0.1, Green=0.2, Blue=0.3)), [0.1, 0.2, 0.3])
    near(shot(lambda n: n.node("SeparateColor", Color=(0.1, 0.2, 0.3)).outputs[1]), [0.2] * 3)
    near(shot(lambda n: n.node("NodeReroute", Input=rgb(n, 0.3, 0.2, 0.1))), [0.3, 0.2, 0.1])
    near(shot(lambda n: n.node("TexNoise"), [12]), [0.5] * 3)
    mix = lambda n: n.node("Mix", {"data_type": "RGBA", "blend_type": "MULTIPLY"}, Factor_Float=1.0, A_Color=(0.5, 1, 1), B_Color=(0.5, 0.4, 0.2)).outputs[2]
    near(shot(mix), [0.25, 0.4, 0.2])


@test
def groups_and_muted_nodes():
    def build(n):
        tree = bpy.data.node_groups.new("G", "ShaderNodeTree")
        if hasattr(tree, "interface"):
            tree.interface.new_socket("Tint", in_out="INPUT", socket_type="NodeSocketColor")
            tree.interface.new_socket("Out", in_out="OUTPUT", socket_type="NodeSocketShader")
        else:
            tree.inputs.new("NodeSocketColor", "Tint")
            tree.outputs.new("NodeSocketShader", "Out")
        begin, end = tree.nodes.new("NodeGroupInput"), tree.nodes.new("NodeGroupOutput")
        inner = tree.nodes.new("ShaderNodeBsdfDiffuse")
        tree.links.new(begin.outputs[0], inner.inputs["Color"])
        tree.links.new(inner.outputs[0], end.inputs[0])
        group = n.node("Group", {"node_tree": tree})
        color = n.node("RGB")
        color.outputs[0].default_value = (0.2, 0.4, 0.6, 1)
        gamma = n.node("Gamma", {"mute": True}, Color=color, Gamma=3.0)
        n.set(group.inputs[0], gamma)
        return group

    near(material_text(build)[0]["diffuse"], [0.2, 0.4, 0.6])


@test
def nodes_without_a_counterpart_warn():
    near(material_text(lambda n: n.node("SubsurfaceScattering", Color=(0.1, 0.2, 0.3)), [12])[0]["diffuse"], [0.1, 0.2, 0.3])
    near(material_text(lambda n: n.node("BsdfToon", Color=(0.1, 0.2, 0.3)), [12])[0]["diffuse"], [0.1, 0.2, 0.3])
    new_scene()
    nodes = Nodes()
    nodes.end(nodes.node("BsdfDiffuse"))
    output = next(n for n in nodes.tree.nodes if n.bl_idname == "ShaderNodeOutputMaterial")
    nodes.set(output.inputs["Volume"], nodes.node("VolumeScatter"))
    primitive("cube", nodes.owner)
    export([21])


# ------------------------------------------------------------------------------------------ textures


@test
def image_texture_and_mapping():
    def build(n, **settings):
        mapping = n.node("Mapping", {"vector_type": settings.pop("kind", "POINT")}, Vector=n.node("TexCoord").outputs["UV"],
                         Location=(0.1, 0.2, 0), Rotation=(0, 0, math.radians(30)), Scale=(2, 3, 1))
        image = n.node("TexImage", {"image": picture(), **settings}, Vector=mapping)
        return n.node("BsdfDiffuse", Color=image)

    _, text = material_text(lambda n: build(n, interpolation="Closest", extension="CLIP"))
    block = text.one("texture")
    near([*block["scale"], block["rotation"], *block["offset"]], [2, 3, 30, 0.1, 0.2])
    equal([block["interpolation"], block["extension"], block["file"]], ["nearest", "clip", "pic.png"])
    material_text(lambda n: build(n, kind="TEXTURE"), [19])  # a shear
    material_text(lambda n: build(n, interpolation="Cubic"), [26])
    material_text(lambda n: build(n, projection="BOX"), [20])


@test
def textures_times_constants():
    def build(n):
        image = n.node("TexImage", {"image": picture()})
        color = n.node("MixRGB", {"blend_type": "MULTIPLY"}, Fac=1.0, Color1=image, Color2=(0.8, 0.3, 0.1))
        return n.mix(0.4, n.node("BsdfDiffuse", Color=color), n.node("BsdfGlossy", Color=(1, 1, 1), Roughness=0.1))

    block, _ = material_text(build)
    near(block["diffuse"], [0.48, 0.18, 0.06])
    equal(block["diffuse_texture"], "pic")
    both = lambda n: n.node("AddShader", Shader=n.node("BsdfDiffuse", Color=n.node("TexImage", {"image": picture()})),
                            Shader_001=n.node("BsdfDiffuse", Color=(0.1, 0.1, 0.1)))
    block, _ = material_text(both, [14])
    linear = [((x / 255 + 0.055) / 1.055) ** 2.4 for x in (40, 80, 120)]
    near(block["diffuse"], [x + 0.1 for x in linear], 1e-4)
    equal(block.get("diffuse_texture"), None)


@test
def alpha_from_texture():
    image = lambda n: n.node("TexImage", {"image": picture("alpha.png", 4)})

    def cut(n, flip):
        node = image(n)
        sides = [n.node("BsdfTransparent"), n.node("BsdfDiffuse", Color=node)]
        return n.mix(node.outputs["Alpha"], *(sides[::-1] if flip else sides))

    block, text = material_text(lambda n: cut(n, False))
    alpha = text.one("texture", block["opacity_texture"])
    equal([alpha["channel"], alpha["file"]], ["alpha", "alpha.png"])
    block, text = material_text(lambda n: cut(n, True))
    file = text.one("texture", block["opacity_texture"])["file"]
    width, height, channels, data = read_png(os.path.join(FOLDER, file))
    equal([channels, list(data[:4])], [4, [215, 175, 135, 0]])
    both = lambda n: n.node("BsdfPrincipled", Base_Color=image(n), Alpha=image(n).outputs["Alpha"])
    block, _ = material_text(both)
    assert block["opacity_texture"] != block["diffuse_texture"]


@test
def normal_and_bump_maps():
    def data_image(n, name):
        image = picture(name)
        image.colorspace_settings.name = "Non-Color"
        return n.node("TexImage", {"image": image})

    def build(n):
        normal = n.node("NormalMap", Strength=0.5, Color=data_image(n, "normal.png"))
        bump = n.node("Bump", {"invert": True}, Strength=0.7, Distance=0.05, Height=data_image(n, "height.png"), Normal=normal)
        return n.node("BsdfDiffuse", Normal=bump)

    block, text = material_text(build)
    near([block["normal_strength"], block["bump_strength"], block["bump_distance"]], [0.5, 0.7, -0.05])
    equal([text.one("texture", block["bump_map"])["space"], text.one("texture", block["normal_map"])["file"]], ["linear", "normal.png"])
    uneven = lambda n: n.mix(0.5, n.node("BsdfDiffuse", Normal=n.node("Bump", Height=data_image(n, "height.png"))), n.node("BsdfGlossy"))
    material_text(uneven, [17])


@test
def where_pictures_are_found():
    def shot(image, expected=(), arguments=()):
        nodes = Nodes()
        nodes.end(nodes.node("BsdfDiffuse", Color=nodes.node("TexImage", {"image": image})))
        mesh = mesh_of([(0, 0, 0), (1, 0, 0), (0, 1, 0)], [(0, 1, 2)])
        mesh.uv_layers.new()
        mesh.materials.append(nodes.owner)
        add("T", mesh)
        text = export(expected, arguments)
        found = text.all("texture")
        return found[0]["file"] if found else None

    new_scene()
    elsewhere = tempfile.mkdtemp(prefix="export-pictures-")
    path = os.path.join(elsewhere, "far.png")
    write_png(path, [1, 2, 3], 1, 1)
    equal(shot(bpy.data.images.load(path)), "Textures/far.png")  # copied, no machine path
    with open(os.path.join(FOLDER, "Textures", "far.png"), "rb") as a, open(path, "rb") as b:
        equal(a.read(), b.read())

    new_scene()  # a dead path of another system, the same stem in another format
    image = bpy.data.images.load(path)
    image.name = "dead"
    image.filepath_raw = "C:\\Users\\me\\pictures\\dead.jpg"
    with open(os.path.join(elsewhere, "dead.ppm"), "wb") as file:
        file.write(b"P6\n1 1\n255\n\1\2\3")
    equal(shot(image, arguments=["--textures", elsewhere]),
          os.path.relpath(os.path.join(elsewhere, "dead.ppm"), FOLDER).replace(os.sep, "/"))
    new_scene()
    image = bpy.data.images.load(path)
    image.filepath_raw = "//nowhere/missing.png"
    equal(shot(image, [22]), None)

    new_scene()
    image = bpy.data.images.load(path)
    image.name = "Packed one"
    image.pack()
    image.filepath_raw = "//nowhere/packed.png"
    equal(shot(image), "Textures/Packed_one.png")

    new_scene()
    image = bpy.data.images.new("Made", 3, 2)
    image.pixels[:] = [x / 255 for x in (10, 20, 30, 255) * 3 + (40, 50, 60, 255) * 3]
    equal(shot(image), "Textures/Made.png")
    width, height, channels, data = read_png(os.path.join(FOLDER, "Textures", "Made.png"))
    equal([width, height, channels, list(data[:3]), list(data[9:12])], [3, 2, 3, [40, 50, 60], [10, 20, 30]])
    new_scene()
    image = bpy.data.images.new("Made", 3, 2)
    image.pixels[:] = [x / 255 for x in (10, 20, 30, 255) * 3 + (40, 50, 60, 255) * 3]
    equal(shot(image, arguments=["--ppm"]), "Textures/Made.ppm")

    new_scene()
    image = bpy.data.images.new("Bright", 2, 1, float_buffer=True)
    image.pixels[:] = [5, 6, 7, 1, 0.5, 0.25, 0.125, 1]
    equal(shot(image), "Textures/Bright.pfm")
    with open(os.path.join(FOLDER, "Textures", "Bright.pfm"), "rb") as file:
        equal(file.read(), b"PF\n2 1\n-1.0\n" + struct.pack("<6f", 5, 6, 7, 0.5, 0.25, 0.125))

    new_scene()  # another format is turned into PNG
    image = bpy.data.images.new("Tga", 2, 2)
    image.pixels[:] = [x / 255 for x in (100, 20, 30, 255) * 4]
    image.filepath_raw, image.file_format = os.path.join(elsewhere, "other.tga"), "TARGA"
    image.save()
    bpy.data.images.remove(image)
    equal(shot(bpy.data.images.load(os.path.join(elsewhere, "other.tga"))), "Textures/other.png")
    equal(list(read_png(os.path.join(FOLDER, "Textures", "other.png"))[3][:3]), [100, 20, 30])
    shutil.rmtree(elsewhere)


# --------------------------------------------------------------------------------------------- world


def world_text(build, expected=()):
    scene = new_scene()
    scene.world = bpy.data.worlds.new("World")
    nodes = Nodes(scene.world)
    nodes.end(build(nodes), "ShaderNodeOutputWorld")
    text = export(expected)
    return text.one("world"), text


@test
def world_colour():
    block, _ = world_text(lambda n: n.node("Background", Color=(0.1, 0.2, 0.3), Strength=2.0))
    near(block["background"], [0.2, 0.4, 0.6])
    near(block["ambient"], [0.2, 0.4, 0.6])
    new_scene().world = None
    equal(export().one("world")["background"], [0, 0, 0])


@test
def world_environment():
    def build(n, kind="POINT", **settings):
        mapping = n.node("Mapping", {"vector_type": kind}, Vector=n.node("TexCoord").outputs["Generated"],
                         Rotation=(0, 0, math.radians(50)))
        image = n.node("TexEnvironment", {"image": picture("env.png", width=4, height=2), **settings}, Vector=mapping)
        return n.node("Background", Color=image, Strength=3.0)

    block, text = world_text(build)
    near(block["background"], [3, 3, 3])
    near(block["environment_rotation"], -50)  # measured with Cycles in 3.4, 4.5 and 5.0
    equal(text.one("texture", block["environment"])["file"], "env.png")
    near(block["ambient"], [3 * ((x / 255 + 0.055) / 1.055) ** 2.4 for x in (40, 80, 120)], 1e-4)
    near(world_text(lambda n: build(n, "TEXTURE"))[0]["environment_rotation"], 50)
    world_text(lambda n: build(n, projection="MIRROR_BALL"), [31])
    world_text(lambda n: n.node("Background", Color=n.node("TexSky")), [30])


# ---------------------------------------------------------------------------------------- agreement


def cycles_pixels(scene):
    """RGB rows from the bottom of a picture that Cycles renders, one sample in the middle of each pixel."""
    path = os.path.join(FOLDER, "cycles.exr")
    settings = scene.render.image_settings
    if hasattr(settings, "media_type"):
        settings.media_type = "IMAGE"
    settings.file_format, settings.color_depth = "OPEN_EXR", "32"
    scene.render.filepath = path
    bpy.ops.render.render(write_still=True)
    image = bpy.data.images.load(path, check_existing=False)
    values = list(image.pixels)
    bpy.data.images.remove(image)
    return [x for i, x in enumerate(values) if i % 4 < 3]


@test
def pictures_agree_with_cycles():
    """Camera, placement, materials and lamps at once: direct light without noise is the same picture."""
    if not os.path.exists(RAYTRACER) or not hasattr(bpy.context.scene, "cycles"):
        return
    for kind, settings in (("POINT", {"energy": 800}), ("SUN", {"energy": 3, "angle": 0}),
                           ("SPOT", {"energy": 800, "spot_size": 0.9, "spot_blend": 0.6})):
        scene = new_scene(with_camera=False)
        cycles, render = scene.cycles, scene.render
        cycles.samples, cycles.max_bounces, cycles.blur_glossy, cycles.use_denoising = 1, 0, 0, False
        cycles.use_adaptive_sampling, cycles.light_sampling_threshold, cycles.sample_clamp_indirect = False, 0, 0
        render.resolution_x, render.resolution_y, render.pixel_aspect_x = 120, 90, 1.3
        scene.world = bpy.data.worlds.new("Black")
        Nodes(scene.world).end(bpy.data.worlds["Black"].node_tree.nodes.new("ShaderNodeBackground"), "ShaderNodeOutputWorld")
        next(n for n in scene.world.node_tree.nodes if n.type == "BACKGROUND").inputs[0].default_value = (0, 0, 0, 1)

        def material(*color):
            n = Nodes()
            shine = n.node("BsdfGlossy", {"distribution": "ASHIKHMIN_SHIRLEY"}, Color=(1, 1, 1), Roughness=0.35)
            return n.end(n.mix(0.3, n.node("BsdfDiffuse", Color=color), shine))

        primitive("plane", material(0.6, 0.5, 0.4), size=20)
        primitive("cube", material(0.2, 0.5, 0.7), location=(0, 0, 1)).rotation_euler = (0.3, 0.2, 0.5)
        primitive("monkey", material(0.7, 0.3, 0.2), location=(2.2, -0.5, 1)).scale = (-1, 1.2, 1)
        ball = primitive("uv_sphere", material(0.7, 0.7, 0.2), smooth=True, location=(-2.2, 0, 1))
        ball["rt_shape"] = "mesh"  # the sphere record is rounder than Cycles' mesh
        lamp = add_light(kind, **settings)
        lamp.location = (2, -3, 6)
        lamp.rotation_euler = Vector((2, -3, 6)).to_track_quat("Z", "Y").to_euler()
        add_camera(location=(4, -8, 4.5), rotation=(1.08, 0.05, 0.45), lens=38, shift_x=0.06, sensor_fit="VERTICAL",
                   sensor_width=34, sensor_height=27)
        wanted = cycles_pixels(scene)
        export()
        out = os.path.join(FOLDER, "scene.pfm")
        subprocess.run([RAYTRACER, os.path.join(FOLDER, "scene.txt"), out, "--quiet", "--max-depth", "0"], check=True)
        with open(out, "rb") as file:
            data = file.read()[-4 * len(wanted):]
        errors = sorted(abs(a - b) for a, b in zip(struct.unpack("<%df" % len(wanted), data), wanted))
        peak = max(wanted)
        # Rays that hit an edge may fall on either side.
        assert errors[int(0.99 * len(errors))] < 1e-4 * peak and sum(e > 0.01 * peak for e in errors) <= 12, \
            "%s: median %g, 99 %% %g, %d above 1 %%" % (
                kind, errors[len(errors) // 2], errors[int(0.99 * len(errors))], sum(e > 0.01 * peak for e in errors))


# ---------------------------------------------------------------------------------------------- text


@test
def names_and_numbers():
    new_scene()
    thing = primitive("cube")
    thing.name = 'A "quoted" \\ name, ü'
    primitive("cube", location=(1 / 3, 1e-7, 0)).name = "plain_name-1.0+"
    text = export()
    equal([b.name for b in text.all("cube")], ['A "quoted" \\ name, ü', "plain_name-1.0+"])
    assert 'cube "A \\"quoted\\" \\\\ name, ü" {' in text.text and "cube plain_name-1.0+ {" in text.text
    for x, wanted in ((0.0, "0"), (-0.0, "0"), (Export.single(0.1), "0.1"), (1.0, "1"), (0.1, "0.1"), (1e20, "1e+20"),
                      (1920.0, "1920"), (2 / 3, repr(2 / 3)), (Export.single(2 / 3), "0.6666667")):
        equal(Export.number(x), wanted)
    assert not any(part in text.text for part in (FOLDER, os.path.expanduser("~") + "/", TOP + "/"))


@test
def warnings_have_one_table():
    with open(SCRIPT, encoding="utf-8") as file:
        source = file.read()
    import re
    used = {int(n) for n in re.findall(r"\.warn\(\s*(\d+),", source)}
    equal(used, set(Export.WARNINGS))


# ------------------------------------------------------------------------------- outside: whole runs


def small_scene(folder):
    """Code that saves a scene with a camera, a lamp, a cube, and a second file without a camera."""
    return """
import bpy
bpy.ops.wm.read_factory_settings(use_empty=True)
scene = bpy.context.scene
scene.render.engine = "CYCLES"
scene.view_settings.view_transform = "Standard"
bpy.ops.mesh.primitive_monkey_add()
bpy.ops.mesh.primitive_cube_add(location=(3, 0, 0))
lamp = bpy.data.lights.new("Lamp", "POINT")
scene.collection.objects.link(bpy.data.objects.new("Lamp", lamp))
bpy.ops.wm.save_as_mainfile(filepath=r"%(f)s/nocamera.blend")
camera = bpy.data.objects.new("Camera", bpy.data.cameras.new("Camera"))
scene.collection.objects.link(camera)
scene.camera = camera
bpy.ops.wm.save_as_mainfile(filepath=r"%(f)s/good.blend")
scene.view_settings.gamma = 2
bpy.ops.wm.save_as_mainfile(filepath=r"%(f)s/warns.blend")
""" % {"f": folder}


class Launch:
    """Starts one Blender, or the Python of a bpy module."""

    def __init__(self, program):
        self.program = program
        self.is_python = "python" in os.path.basename(program)

    def script(self, path, arguments=(), blend=None):
        """The arguments that run a script."""
        if self.is_python:
            return [self.program, path, *([blend] if blend else []), *arguments]
        start = ["-b", blend] if blend else ["-b", "--factory-startup"]
        return [self.program, *start, "--python-exit-code", "3", "-P", path, "--", *arguments]

    def run(self, path, arguments=(), blend=None, timeout=600):
        return subprocess.run(self.script(path, arguments, blend), capture_output=True, text=True, timeout=timeout,
                              env={**os.environ, "PYTHONDONTWRITEBYTECODE": "1"})


def expect(done, code, *parts):
    assert done.returncode == code, "exit code %d, wanted %d\n%s" % (done.returncode, code, done.stderr[-2000:])
    for part in parts:
        assert part in done.stderr + done.stdout, "'%s' is not in\n%s" % (part, done.stderr[-2000:])
    assert code == 3 or "Traceback" not in done.stderr, done.stderr[-2000:]


@whole
def exit_codes(launch, folder):
    out = os.path.join(folder, "out.txt")
    good, warns, none = (os.path.join(folder, n + ".blend") for n in ("good", "warns", "nocamera"))
    expect(launch.run(SCRIPT, ["-o", out], good), 0)
    expect(launch.run(SCRIPT, ["-o", out, "--strict"], good), 0)
    expect(launch.run(SCRIPT, ["-o", out], warns), 0, "W002", "1 warning: W002 x1")
    expect(launch.run(SCRIPT, ["-o", out, "--strict"], warns), 3, "W002")
    expect(launch.run(SCRIPT, ["-o", out], none), 2, "no active camera")
    expect(launch.run(SCRIPT, ["-o", out, "--camera", "Kamera"], good), 2, "known: Camera")
    expect(launch.run(SCRIPT, ["-o", out, "--frame", "x"], good), 2, "--frame")
    expect(launch.run(SCRIPT, ["-o", out, "--frame", "1:3"], good), 2, "####")
    expect(launch.run(SCRIPT, ["-o", out, "--nonsense"], good), 2)
    expect(launch.run(SCRIPT, ["--help"], good), 0, "W012", "--strict")
    expect(launch.run(SCRIPT, ["--list-warnings"], good), 0, "W012")
    expect(launch.run(SCRIPT, ["-o", os.path.join(folder, "good.blend", "x.txt")], good), 2)
    missing = launch.run(SCRIPT, ["-o", out], os.path.join(folder, "missing.blend"))
    assert missing.returncode != 0


@whole
def a_fault_of_the_script_is_3(launch, folder):
    broken = os.path.join(folder, "broken.py")
    with open(SCRIPT, encoding="utf-8") as file:
        source = file.read()
    with open(broken, "w", encoding="utf-8") as file:
        file.write(source.replace("def put_world", "def put_world").replace(
            "    def collect_world(self):\n", "    def collect_world(self):\n        1 / 0\n"))
    out = os.path.join(folder, "broken.txt")
    expect(launch.run(broken, ["-o", out], os.path.join(folder, "good.blend")), 3, "ZeroDivisionError")
    assert not os.path.exists(out) and not glob.glob(out + "*")


@whole
def same_bytes_twice(launch, folder):
    texts = []
    for name in ("a", "b"):
        out = os.path.join(folder, "twice", name, "scene.txt")
        expect(launch.run(SCRIPT, ["-o", out], os.path.join(folder, "good.blend")), 0)
        with open(out, "rb") as file:
            texts.append(file.read())
    equal(texts[0], texts[1])


@whole
def frames_and_default_output(launch, folder):
    good = os.path.join(folder, "good.blend")
    expect(launch.run(SCRIPT, ["-o", os.path.join(folder, "f-####.txt"), "--frame", "8:10"], good), 0)
    equal(sorted(os.path.basename(p) for p in glob.glob(os.path.join(folder, "f-*"))), ["f-0008.txt", "f-0009.txt", "f-0010.txt"])
    expect(launch.run(SCRIPT, [], good), 0)
    assert os.path.exists(os.path.join(folder, "good.txt"))


@whole
def speed_of_large_meshes(launch, folder):
    """Half a million triangles in a few seconds, most of it Blender's own start."""
    code = os.path.join(folder, "large.py")
    with open(code, "w") as file:
        file.write(small_scene(folder).split("bpy.ops.mesh")[0] + """
bpy.ops.mesh.primitive_grid_add(x_subdivisions=500, y_subdivisions=500)
for v in bpy.context.object.data.vertices: v.co.z = 0.1 * v.co.x * v.co.y
bpy.ops.object.shade_smooth()
camera = bpy.data.objects.new("Camera", bpy.data.cameras.new("Camera"))
scene.collection.objects.link(camera)
scene.camera = camera
bpy.ops.wm.save_as_mainfile(filepath=r"%s/large.blend")
import os, sys; sys.stdout.flush(); os._exit(0)
""" % folder)
    expect(launch.run(code), 0)
    import time
    start = time.time()
    expect(launch.run(SCRIPT, ["-o", os.path.join(folder, "large.txt")], os.path.join(folder, "large.blend")), 0)
    seconds = time.time() - start
    print("      500k triangles: %.1f s" % seconds)
    assert seconds < 60, "%.1f s" % seconds


@whole
def scenes_of_this_project(launch, folder):
    if launch.is_python and "--all-scenes" not in sys.argv:
        return  # once is enough; other versions have other defaults, not other code
    scenes = sorted(glob.glob(os.path.join(TOP, "Blend", "*.blend")))
    problems = []
    for blend in scenes:
        name = os.path.splitext(os.path.basename(blend))[0]
        out = os.path.join(folder, "project", "ASCII", name + ".txt")
        done = launch.run(SCRIPT, ["-o", out, "--textures", os.path.join(TOP, "Textures")], blend)
        if done.returncode != 0 or " warning" in done.stderr:
            problems.append("%s: %d %s" % (name, done.returncode, done.stderr[-500:]))
        elif os.path.exists(RAYTRACER):
            check = subprocess.run([RAYTRACER, "--check", out], capture_output=True, text=True)
            if check.returncode != 0:
                problems.append("%s: raytracer --check %d %s" % (name, check.returncode, check.stderr[-500:]))
    assert not problems, "\n".join(problems)


# -------------------------------------------------------------------------------------------- driver


def run_inside(only):
    results = []
    for name, function in TESTS:
        if only and only not in name:
            continue
        problem = None
        try:
            function()
        except AssertionError as error:
            lines = [f.lineno for f in traceback.extract_tb(error.__traceback__) if f.filename == __file__]
            problem = "lines %s: %s" % (lines[1:], error)
        except BaseException:
            problem = traceback.format_exc()
        results.append((name, problem))
    shutil.rmtree(FOLDER, ignore_errors=True)
    print("RESULTS " + json.dumps({"version": bpy.app.version_string, "results": results}))
    sys.stdout.flush()
    os._exit(0)


def run_program(program, only):
    launch = Launch(program)
    arguments = ["--inside"] + (["--only", only] if only else [])
    done = launch.run(os.path.abspath(__file__), arguments, timeout=1800)
    line = next((l for l in done.stdout.splitlines() if l.startswith("RESULTS ")), None)
    if line is None:
        return program, [("start", "no results\n" + done.stdout[-1500:] + done.stderr[-1500:])]
    answer = json.loads(line[8:])
    results = [tuple(r) for r in answer["results"]]
    folder = tempfile.mkdtemp(prefix="export-whole-")
    chosen = [(n, f) for n, f in WHOLE if not only or only in n]
    try:
        if chosen:
            code = os.path.join(folder, "make.py")
            with open(code, "w") as file:
                file.write(small_scene(folder) + "import os, sys; sys.stdout.flush(); os._exit(0)\n")
            expect(launch.run(code), 0)
        for name, function in chosen:
            problem = None
            try:
                function(launch, folder)
            except AssertionError as error:
                problem = str(error) or traceback.format_exc()
            except Exception:
                problem = traceback.format_exc()
            results.append((name, problem))
    finally:
        shutil.rmtree(folder, ignore_errors=True)
    return "Blender " + answer["version"], results


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--blender", action="append", metavar="PROGRAM", help="Blender, or a Python that has bpy")
    parser.add_argument("--only", metavar="PART", help="tests whose name contains this")
    parser.add_argument("--all-scenes", action="store_true", help="Blend/*.blend in every version")
    parser.add_argument("--verbose", action="store_true", help="name every test")
    options = parser.parse_args()
    programs = options.blender or [p for p in [shutil.which("blender")] if p]
    if not programs:
        print("no Blender found; name one with --blender")
    passed = failed = 0
    for program in programs:
        version, results = run_program(program, options.only)
        print("%s: %d tests" % (version, len(results)))
        for name, problem in results:
            passed, failed = passed + (problem is None), failed + (problem is not None)
            if problem or options.verbose:
                print("  %s  %s%s" % ("FAIL" if problem else "ok  ", name, "\n" + problem if problem else ""))
    print("%d passed, %d failed" % (passed, failed))
    return 1 if failed else 0


if __name__ == "__main__":
    if "--inside" in sys.argv:
        rest = sys.argv[sys.argv.index("--inside"):]
        run_inside(rest[rest.index("--only") + 1] if "--only" in rest else None)
    sys.exit(main())
