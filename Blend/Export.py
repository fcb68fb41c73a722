#!/usr/bin/env python3
"""Writes a Blender scene as the native scene text of the ray tracer (ASCII/README.md).

    blender -b scene.blend --python-exit-code 3 -P Blend/Export.py -- -o ASCII/scene.txt
    python Blend/Export.py scene.blend -o scene.txt        (with the bpy module)
    Text editor, Run Script                                (writes next to the .blend)

Runs in Blender 3.4 to 5.0 with nothing but the standard library: Debian's Blender has no numpy.

Custom properties of an object that are obeyed:
    rt_shape   'sphere' 'cube' 'plane' 'infinite_plane' 'disk' 'cylinder' 'cone': the object becomes this
               record, fitted into its box; 'mesh': it stays a mesh even if it looks like one of these
    rt_light   0: a glowing object is seen, but gives no light

The parts of this file stand in the order in which the data flows:
     1 warnings         what could not be carried over, one number for each kind
     2 text             numbers and blocks of the format
     3 render graph     a throw-away render engine gets the scene as a final render sees it
     4 motion           where things are while the shutter is open
     5 settings         resolution, samples, filter, colour
     6 cameras
     7 lights           energies to radiance, by Blender version
     8 images           finding, copying and converting picture files
     9 values           sockets to numbers and image textures   (a new node: table VALUE_NODES)
    10 shaders          sockets to lobes                        (a new node: table SHADER_NODES)
    11 materials        what stands in the block of a material
    12 world
    13 shapes           spheres, cubes and planes among the meshes
    14 meshes
    15 scene            puts it all together
    16 command line
"""

import argparse
import contextlib
import functools
import hashlib
import itertools
import math
import operator
import os
import re
import shutil
import struct
import subprocess
import sys
import tempfile
import zlib
from array import array
from dataclasses import dataclass, field, replace
from typing import NamedTuple, Optional

try:
    import bpy
    from mathutils import Euler, Matrix, Vector
except ImportError:
    sys.exit("Export.py: error: needs Blender (blender -b FILE -P Export.py) or the bpy module")

VERSION = bpy.app.version  # (3, 4, 1): several units changed their meaning over time
EXIT_ERROR, EXIT_STRICT, EXIT_FAULT = 2, 3, 3
MAX_SAMPLES = 64  # Blender's usual 4096 take hours; --spp of the renderer overrides
MAX_DEPTH = 16
FORMAT_VERSION = 1


class ExportError(Exception):
    """The scene cannot be exported; the message says why. Ends with exit code 2."""


# ---------------------------------------------------------------------------------------- 1 warnings

WARNINGS = {
    1: "view transform, look or curves: only Standard and Raw are known",
    2: "gamma of the view settings",
    3: "no render graph: the viewport's modifiers and visibility are used",
    4: "several view layers: one is exported",
    5: "object of a type that is not exported",
    6: "ray visibility, holdout, shadow catcher, light linking",
    7: "panoramic camera",
    8: "object beyond the clip end",
    9: "shape that changes while the shutter is open",
    10: "moving light",
    11: "numbers that are not finite",
    12: "shader node that is not supported",
    13: "input of a shader that is not supported",
    14: "texture where only a constant is possible",
    15: "more lobes than a material has",
    16: "mixture whose layers or angles have no exact form",
    17: "different normals or heights in one material",
    18: "second UV map or coordinate system in one material",
    19: "texture coordinates or mapping that are not plane",
    20: "projection of an image texture",
    21: "volume or displacement",
    22: "image file not found",
    23: "image that cannot be read or converted",
    24: "image sequence, movie or tiles",
    25: "colour space of an image",
    26: "interpolation or extension of an image texture",
    27: "UV map that the mesh does not have",
    28: "node of a light",
    29: "elliptic spot",
    30: "node of the world",
    31: "mapping or projection of the environment",
    32: "emission of an object that the camera does not see",
    33: "shape asked for by rt_shape that does not fit",
    34: "motion that cannot be followed",
    35: "number beyond what the scene text takes",
    36: "thing without size or direction",
    37: "file that Blender opened with errors",
    38: "view layer without sky or solid objects",
    39: "ray visibility of the world",
    40: "transparent film",
    41: "white balance",
    42: "lens that changes while the shutter is open",
    43: "rolling shutter",
    44: "border without crop",
    45: "compositor or sequencer",
}


class Report:
    """Prints each warning once and counts. `at` names the thing that is being worked on."""

    def __init__(self, verbose):
        self.verbose = verbose
        self.seen = {}
        self.places = []

    @contextlib.contextmanager
    def at(self, kind, name):
        self.places.append("%s '%s'" % (kind, name))
        try:
            yield
        finally:
            self.places.pop()

    def warn(self, number, problem, instead):
        assert number in WARNINGS
        place = " ".join(self.places) + ": " if self.places else ""
        line = "W%03d %s%s -> %s" % (number, place, problem, instead)
        if line not in self.seen:
            self.seen[line] = number
            print(line, file=sys.stderr)

    def note(self, text):
        if self.verbose:
            print(text, file=sys.stderr)

    def summary(self):
        numbers = sorted(self.seen.values())
        if not numbers:
            return
        plural = "" if len(numbers) == 1 else "s"
        kinds = ", ".join("W%03d x%d" % (n, numbers.count(n)) for n in sorted(set(numbers)))
        print("%d warning%s: %s" % (len(numbers), plural, kinds), file=sys.stderr)


# -------------------------------------------------------------------------------------------- 2 text

_FLOAT = struct.Struct("<f")


def single(x):
    """x rounded to single precision, as Blender computes."""
    return _FLOAT.unpack(_FLOAT.pack(x))[0]


def number(x):
    """Shortest text that reads back as x: as a float when x is one, else as a double."""
    x = float(x)
    if x == 0:
        return "0"
    if not math.isfinite(x):
        raise ExportError("a number is not finite (%r)" % x)
    if abs(x) < 3e38 and single(x) == x:
        for digits in (6, 7, 8, 9):
            text = "%.*g" % (digits, x)
            if single(float(text)) == x:
                return text
    return repr(int(x)) if x == int(x) and abs(x) < 1e15 else repr(x)


@functools.lru_cache(maxsize=4096)
def word(name):
    """A name as the format has it: bare or in quotes."""
    name = re.sub(r"[\x00-\x1f\x7f]", "_", name)
    if re.fullmatch(r"[A-Za-z0-9_.+-]+", name):
        return name
    return '"%s"' % name.replace("\\", "\\\\").replace('"', '\\"')


class Text:
    """Collects the lines of the scene file."""

    def __init__(self):
        self.lines = []

    @contextlib.contextmanager
    def block(self, kind, name=None):
        self.lines.append("%s {" % kind if name is None else "%s %s {" % (kind, word(name)))
        yield
        self.lines.append("}")

    def put(self, keyword, *values):
        parts = [keyword]
        for value in values:
            if isinstance(value, bool):
                parts.append("true" if value else "false")
            elif isinstance(value, str):
                parts.append(value)
            elif hasattr(value, "__len__"):
                parts.extend(number(x) for x in value)
            else:
                parts.append(number(value))
        self.lines.append("    " + " ".join(parts))

    def put_unless(self, default, keyword, value):
        """Leaves out what the reader assumes anyway."""
        if value != default:
            self.put(keyword, value)

    def put_keys(self, keys):
        """Transform lines of one or more positions."""
        for i, rows in enumerate(keys):
            if i > 0:
                self.lines.append("    key")
            self.put_rows(rows)

    def put_rows(self, rows):
        (a, b, c, x), (d, e, f, y), (g, h, i, z) = rows
        if any((b, c, d, f, g, h)):
            self.lines.append("    transform " + "  ".join(" ".join(map(number, row)) for row in rows))
            return
        if any((x, y, z)):
            self.put("translate", x, y, z)
        if (a, e, i) != (1, 1, 1):
            self.put("scale", a, e, i)

    def put_array(self, keyword, values, width, form):
        """A counted array of a mesh. Formatting in large pieces is what makes this fast."""
        count = len(values) // width
        self.lines.append("    %s %d" % (keyword, count))
        line = " ".join([form] * width)
        step = 16384
        for first in range(0, count, step):
            rows = min(step, count - first)
            pattern = "\n".join([line] * rows)
            self.lines.append(pattern % tuple(values[first * width : (first + rows) * width]))

    def put_texts(self, keyword, texts, width):
        """The same of numbers that are texts already."""
        self.lines.append("    %s %d" % (keyword, len(texts) // width))
        self.lines.append("\n".join(map(" ".join, zip(*[iter(texts)] * width))))

    def __str__(self):
        return "\n".join(self.lines) + "\n"


UV, SAME_UV = "%.7g", 1e-6  # a hundredth of a pixel of a picture of 8192
NORMAL = "%.5g"  # 1e-5 of a direction is two seconds of arc


def shortest_floats(values):
    """Texts of an array of floats, each with as few digits as read back to the same float. Large pieces
    make this fast."""
    texts, at, rest = [""] * len(values), range(len(values)), values
    for form in ("%.7g ", "%.8g ", "%.9g "):  # %g drops the zeros of what has fewer
        made = (form * len(rest) % tuple(rest)).split()
        if len(made) == len(texts):
            texts = made
        else:
            for i, text in zip(at, made):
                texts[i] = text
        read_back = array("f", map(float, made))
        if read_back == rest:
            break
        wrong = list(map(operator.ne, read_back, rest))
        at, rest = list(itertools.compress(at, wrong)), array("f", itertools.compress(rest, wrong))
    return texts


class Names:
    """Hands out names that are unique within one kind of block."""

    def __init__(self):
        self.taken = set()
        self.last = {}  # wanted name -> number that was handed out last

    def unique(self, wanted):
        """`wanted`, or that and the first number that is free. The search goes on where the last one
        for the same name ended: a hundred thousand instances of one object share a name."""
        wanted = name = wanted or "unnamed"
        i = self.last.get(wanted, 0)
        while name in self.taken:
            i += 1
            name = "%s.%03d" % (wanted, i)
        self.last[wanted] = i
        self.taken.add(name)
        return name


# ------------------------------------------------------------------------------------ 3 render graph


@contextlib.contextmanager
def temporarily(owner, **values):
    """Sets attributes and restores them; those that this Blender does not have are left out."""
    old = {name: getattr(owner, name) for name in values if hasattr(owner, name)}
    try:
        for name in old:
            setattr(owner, name, values[name])
        yield
    finally:
        for name, value in old.items():
            setattr(owner, name, value)


def with_render_graph(scene, layer, report, work):
    """Calls work(depsgraph, set_frame) with the scene as a final render sees it.

    context.evaluated_depsgraph_get() would be the viewport's scene: its subdivision levels and its
    visibility. Only a render engine is handed the other one, so we are one for a moment.
    """
    outcome = {}

    class ExportEngine(bpy.types.RenderEngine):
        bl_idname = "RAYTRACER_EXPORT"
        bl_label = "Ray tracer export"
        bl_use_preview = False

        def render(self, depsgraph):
            if outcome:  # once per view of a stereo camera
                return
            try:
                set_frame = lambda frame, sub: self.frame_set(frame, subframe=sub)
                outcome["result"] = work(depsgraph, set_frame)
            except BaseException as problem:  # Blender would print it and go on
                outcome["problem"] = problem

    problem = "it was not called"
    bpy.utils.register_class(ExportEngine)
    try:
        with temporarily(scene.render, engine=ExportEngine.bl_idname, use_compositing=False,
                         use_sequencer=False, use_freestyle=False):
            bpy.ops.render.render(scene=scene.name, layer=layer.name)
    except (RuntimeError, TypeError) as error:
        problem = str(error).strip()
    finally:
        bpy.utils.unregister_class(ExportEngine)
    if "problem" in outcome:
        raise outcome["problem"]
    if "result" in outcome:
        return outcome["result"]
    report.warn(3, "Blender gave no render graph (%s)" % problem, "the viewport's graph is used")
    set_frame = lambda frame, sub: scene.frame_set(frame, subframe=sub)
    return work(bpy.context.evaluated_depsgraph_get(), set_frame)


# ------------------------------------------------------------------------------------------ 4 motion

KEY_TIMES = (0.0, 0.25, 0.5, 0.75, 1.0)  # of the shutter
IDENTITY = ((1.0, 0.0, 0.0, 0.0), (0.0, 1.0, 0.0, 0.0), (0.0, 0.0, 1.0, 0.0))


def rows_of(matrix):
    return tuple(tuple(row) for row in matrix[:3])


def is_finite(rows):
    return all(math.isfinite(x) for row in rows for x in row)


def times(a, b):
    """Product of two maps given by rows, in double precision."""
    return tuple(
        tuple(sum(a[i][k] * b[k][j] for k in range(3)) + (a[i][3] if j == 3 else 0.0) for j in range(4))
        for i in range(3)
    )


def determinant(rows):
    (a, b, c, _), (d, e, f, _), (g, h, i, _) = rows
    return a * (e * i - f * h) - b * (d * i - f * g) + c * (d * h - e * g)


def column(rows, i):
    return tuple(row[i] for row in rows)


def length(v):
    return math.sqrt(sum(x * x for x in v))


def difference(a, b):
    return [x - y for x, y in zip(a, b)]


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def without_scale(rows):
    """Columns of unit length: cameras and lights have no size of their own."""
    lengths = [length(column(rows, i)) or 1.0 for i in range(3)]
    if all(abs(x - 1) < 1e-6 for x in lengths):
        return rows
    return tuple(tuple(row[i] / lengths[i] for i in range(3)) + (row[3],) for row in rows)


def is_flat(rows):
    """Whether the map has no inverse worth the name: something is scaled to nothing."""
    size = max(max(abs(x) for x in row[:3]) for row in rows)
    return abs(determinant(rows)) <= 1e-12 * size**3


def nearly_equal(a, b):
    size = max(max(abs(x) for row in a for x in row), 1e-30)
    return all(abs(x - y) <= 1e-5 * size for r, s in zip(a, b) for x, y in zip(r, s))


def between(a, b, t):
    """The map at t of the way from a to b, moving as the renderer moves it: by its parts."""
    (p, q, s), (u, v, w) = (Matrix([*m, (0, 0, 0, 1)]).decompose() for m in (a, b))
    return rows_of(Matrix.LocRotScale(p.lerp(u, t), q.slerp(v, t), s.lerp(w, t)))


def fewest_keys(samples):
    """Samples at KEY_TIMES -> 1 key when it rests, 2 when it moves evenly, else 3 or 5."""
    if all(nearly_equal(samples[0], s) for s in samples[1:]):
        return [samples[2]]
    for step in (4, 2):
        inner = [i for i in range(5) if i % step]
        fits = lambda i: nearly_equal(
            between(samples[i - i % step], samples[i - i % step + step], (i % step) / step), samples[i])
        if all(fits(i) for i in inner):
            return samples[::step]
    return samples


def shutter_interval(scene, frame):
    """Frames at which the shutter opens and closes; None without motion blur."""
    render = scene.render
    eevee = getattr(scene, "eevee", None)
    is_eevee = "EEVEE" in render.engine
    # Until 4.1 Eevee had settings of its own.
    own = eevee if is_eevee and hasattr(eevee, "use_motion_blur") else render
    if not own.use_motion_blur:
        return None
    shutter = own.motion_blur_shutter
    position = getattr(own, "motion_blur_position", None)
    if position is None:
        position = getattr(getattr(scene, "cycles", None), "motion_blur_position", "CENTER")
    if shutter <= 0:
        return None
    begin = {"START": 0.0, "CENTER": -shutter / 2, "END": -shutter}[position]
    return frame + begin, frame + begin + shutter


def instance_key(instance):
    """Identifies an instance from one moment of the shutter to the next."""
    thing = instance.object
    if not instance.is_instance:
        return (thing.name_full,)
    parent = instance.parent.name_full if instance.parent else ""
    return (thing.name_full, thing.type, parent, tuple(instance.persistent_id))


def moves_in_blur(thing):
    return getattr(getattr(thing, "cycles", None), "use_motion_blur", True)


def may_deform(thing):
    return bool(thing.modifiers) or getattr(thing.data, "shape_keys", None) is not None \
        or getattr(thing.original.data, "shape_keys", None) is not None


class Motion:
    """Matrices of all instances and cameras at KEY_TIMES; empty without motion blur."""

    def __init__(self, depsgraph, set_frame, scene, frame, cameras, report):
        self.moments = []
        interval = shutter_interval(scene, frame)
        if interval is None:
            return
        if getattr(getattr(scene, "cycles", None), "rolling_shutter_type", "NONE") != "NONE":
            report.warn(43, "the shutter rolls", "all of the picture at once")
        begin, end = interval
        for t in KEY_TIMES:
            moment = begin + (end - begin) * t
            whole = math.floor(moment)
            set_frame(whole, moment - whole)
            self.moments.append(self.look(depsgraph, cameras, with_shapes=t in (0.0, 1.0)))
        set_frame(frame, 0.0)

    @staticmethod
    def look(depsgraph, cameras, with_shapes):
        found = {}
        for instance in depsgraph.object_instances:
            thing = instance.object
            if thing.type in {"MESH", "LIGHT"}:
                found[instance_key(instance)] = rows_of(instance.matrix_world)
            if with_shapes and thing.type == "MESH" and not instance.is_instance and may_deform(thing):
                points = read(thing.data.vertices, "co", "f", 3)
                found[("shape", thing.name_full)] = hashlib.sha1(points.tobytes()).digest()
        for camera in cameras:
            data = camera.evaluated_get(depsgraph).data
            found[("camera", camera.name_full)] = rows_of(camera.evaluated_get(depsgraph).matrix_world)
            found[("lens", camera.name_full)] = (
                data.lens, data.sensor_width, data.sensor_height, data.shift_x, data.shift_y, data.ortho_scale,
                *((data.dof.focus_distance, data.dof.aperture_fstop) if data.dof.use_dof else ()))
        return found

    def samples(self, key, rows):
        """Positions at KEY_TIMES; None when the thing was not there all the time."""
        if not self.moments:
            return [rows] * 5
        samples = [moment.get(key) for moment in self.moments]
        return None if None in samples else samples

    def keys(self, key, rows, thing, report):
        if not self.moments or not moves_in_blur(thing):
            return [rows]
        samples = self.samples(key, rows)
        if samples is None or not all(map(is_finite, samples)):
            report.warn(34, "is not there during the whole shutter", "it stands still")
            return [rows]
        signs = {determinant(s) > 0 for s in samples}
        if len(signs) > 1 or any(map(is_flat, samples)):
            if not all(nearly_equal(samples[0], s) for s in samples):
                report.warn(34, "turns flat or inside out in the shutter", "it stands still")
            return [rows]
        keys = fewest_keys(samples)
        return keys if len(keys) > 1 else [rows]


# ---------------------------------------------------------------------------------------- 5 settings


def picture_size(render):
    percent = render.resolution_percentage
    return max(render.resolution_x * percent // 100, 1), max(render.resolution_y * percent // 100, 1)


def crop_of(render, width, height):
    """Border -> x0 y0 x1 y1 from the top left. Blender multiplies in single precision."""
    x0, x1 = (int(single(f * width)) for f in (render.border_min_x, render.border_max_x))
    y0, y1 = (int(single(f * height)) for f in (render.border_min_y, render.border_max_y))
    return x0, height - y1, x1, height - y0


def within(x, least, most, what, report):
    """x as the scene text takes it."""
    taken = min(max(x, least), most) if math.isfinite(x) else least
    if taken != x:
        report.warn(35, "%s is %s" % (what, "%.6g" % x), "%.6g" % taken)
    return taken


def pixel_filter(scene):
    cycles = getattr(scene, "cycles", None)
    if "EEVEE" in scene.render.engine or not hasattr(cycles, "pixel_filter_type"):
        return "blackman-harris", max(getattr(scene.render, "filter_size", 1.5), 0.01)
    if cycles.pixel_filter_type == "BOX":
        return "box", 1.0  # Cycles ignores the width of this one
    names = {"GAUSSIAN": "gaussian", "BLACKMAN_HARRIS": "blackman-harris"}
    return names[cycles.pixel_filter_type], cycles.filter_width


def samples_of(scene):
    """(samples of the scene, what is exported)"""
    cycles, eevee = getattr(scene, "cycles", None), getattr(scene, "eevee", None)
    if "EEVEE" in scene.render.engine or cycles is None:
        wanted = getattr(eevee, "taa_render_samples", 64)
    else:
        wanted = cycles.samples
    return wanted, min(max(wanted, 1), MAX_SAMPLES)


def exposure_of(scene):
    stops = scene.view_settings.exposure
    film = getattr(getattr(scene, "cycles", None), "film_exposure", 1.0)
    if film > 0 and film != 1 and "EEVEE" not in scene.render.engine:
        stops += math.log2(film)
    return stops


def transfer_of(scene, report):
    view = scene.view_settings
    name = view.view_transform
    if name not in {"Standard", "Raw"}:
        report.warn(1, "view transform '%s'" % name, "Standard")
    if getattr(view, "look", "None") not in {"None", ""}:
        report.warn(1, "look '%s'" % view.look, "no look")
    if view.use_curve_mapping:
        report.warn(1, "view curves", "no curves")
    if getattr(view, "use_white_balance", False):  # 4.3
        report.warn(41, "white balance of %.0f K" % view.white_balance_temperature, "none")
    if abs(view.gamma - 1) > 1e-6:
        report.warn(2, "view gamma %s" % number(view.gamma), "1")
    is_linear = name == "Raw" or scene.display_settings.display_device == "None"
    return "linear" if is_linear else "srgb"


def warn_of_what_comes_after(scene, report):
    """What Blender does with a picture that is rendered."""
    tree = getattr(scene, "node_tree", None) if getattr(scene, "use_nodes", False) else None
    tree = getattr(scene, "compositing_node_group", tree)  # 5.0
    plain = {"CompositorNodeRLayers", "CompositorNodeComposite", "CompositorNodeViewer", "NodeGroupOutput", "NodeReroute"}
    if scene.render.use_compositing and tree and any(n.bl_idname not in plain and not n.mute for n in tree.nodes):
        report.warn(45, "nodes of the compositor", "the picture without them")
    strips = getattr(scene.sequence_editor, "strips", None) or getattr(scene.sequence_editor, "sequences", None)
    if scene.render.use_sequencer and strips:
        report.warn(45, "strips of the sequencer", "the scene itself")


def put_light_paths(text, cycles, integrator):
    text.put_unless("whitted", "integrator", integrator)
    text.put_unless(8, "max_depth", min(getattr(cycles, "max_bounces", 8), MAX_DEPTH))
    for keyword, name, usual in (("diffuse_depth", "diffuse_bounces", 4), ("glossy_depth", "glossy_bounces", 4),
                                 ("transmission_depth", "transmission_bounces", 12),
                                 ("transparent_depth", "transparent_max_bounces", 8)):
        text.put_unless(usual, keyword, getattr(cycles, name, usual))
    text.put_unless(0, "filter_glossy", getattr(cycles, "blur_glossy", 0.0))
    text.put_unless(0, "clamp_indirect", getattr(cycles, "sample_clamp_indirect", 0.0))
    text.put_unless(True, "caustics", getattr(cycles, "caustics_reflective", True)
                    or getattr(cycles, "caustics_refractive", True))


def put_settings(text, scene, integrator, report):
    render, cycles = scene.render, getattr(scene, "cycles", None)
    width, height = picture_size(render)
    name, filter_width = pixel_filter(scene)
    with text.block("settings"):
        text.put("resolution", width, height)
        if render.pixel_aspect_x != render.pixel_aspect_y:
            text.put("pixel_aspect", render.pixel_aspect_x, render.pixel_aspect_y)
        if render.use_border and not render.use_crop_to_border:
            report.warn(44, "the border is not cropped to",
                        "the picture is the border alone; --crop-pad of the renderer gives it the full size")
        if render.film_transparent:
            report.warn(40, "the film is transparent", "the background is opaque")
        warn_of_what_comes_after(scene, report)
        if render.use_border:
            crop = crop_of(render, width, height)
            if crop[0] < crop[2] and crop[1] < crop[3]:
                text.put("crop", *crop)
        samples = samples_of(scene)[1]
        text.put("samples", samples)
        text.put_unless(True, "jitter", samples > 1)  # Cycles puts a single sample in the middle
        put_light_paths(text, cycles, integrator)
        text.put_unless(0, "seed", max(getattr(cycles, "seed", 0), 0))
        text.put("filter", name, filter_width)
        text.put_unless(0, "exposure", exposure_of(scene))
        text.put("transfer", transfer_of(scene, report))


# ----------------------------------------------------------------------------------------- 6 cameras


def focus_distance(camera, rows, depsgraph):
    """Depth of the focus object along the view axis, or the number in the settings."""
    dof = camera.data.dof
    target = dof.focus_object
    if target is None:
        return dof.focus_distance
    target = target.evaluated_get(depsgraph)
    matrix = target.matrix_world
    bone = getattr(dof, "focus_subtarget", "")
    if bone and target.type == "ARMATURE" and bone in target.pose.bones:
        matrix = matrix @ target.pose.bones[bone].matrix
    axis, eye = column(rows, 2), column(rows, 3)
    place = matrix.translation
    return abs(sum(a * (e - p) for a, e, p in zip(axis, eye, place)))


def unscaled(camera):
    """Place of a camera whose world matrix has lost its directions."""
    turn = camera.matrix_basis.to_3x3()
    if camera.rotation_mode == "QUATERNION":
        turn = camera.rotation_quaternion.to_matrix()
    elif camera.rotation_mode != "AXIS_ANGLE":
        turn = camera.rotation_euler.to_matrix()
    rows = rows_of(Matrix.LocRotScale(camera.matrix_world.translation, turn, None))
    place = camera.matrix_world.translation
    return rows if not is_flat(rows) else tuple(IDENTITY[i][:3] + (place[i],) for i in range(3))


def put_camera(text, camera, keys, rows, depsgraph, name, report):
    """`camera` is evaluated; `rows` is its place at the frame, `keys` its places in the shutter."""
    data = camera.data
    is_ortho = data.type == "ORTHO"
    with report.at("camera", camera.name), text.block("camera", name):
        if data.type not in {"PERSP", "ORTHO"}:
            report.warn(7, "camera type %s" % data.type, "perspective")
        text.put("type", "orthographic" if is_ortho else "perspective")
        keys = [without_scale(k) for k in keys]
        if any(map(is_flat, keys)):
            report.warn(36, "its scale is 0", "its own rotation")
            keys = [unscaled(camera)]
        text.put_keys(keys)
        if is_ortho:
            text.put("ortho_scale", within(data.ortho_scale, 1e-6, 1e30, "its orthographic scale", report))
        else:
            text.put("lens", data.lens)
        text.put("sensor", data.sensor_width, data.sensor_height)
        text.put("sensor_fit", data.sensor_fit.lower())
        if data.shift_x or data.shift_y:
            text.put("shift", data.shift_x, data.shift_y)
        text.put("clip_start", data.clip_start)
        dof = data.dof
        if dof.use_dof:
            lens = 1.0 if is_ortho else data.lens * 1e-3
            text.put("aperture_radius", lens / (2 * max(dof.aperture_fstop, 1e-5)))
            text.put("focus_distance", max(focus_distance(camera, without_scale(rows), depsgraph), 1e-5))
            text.put_unless(0, "aperture_blades", dof.aperture_blades)
            text.put_unless(0, "aperture_rotation", math.degrees(dof.aperture_rotation))
            text.put_unless(1, "aperture_ratio", dof.aperture_ratio)


# ------------------------------------------------------------------------------------------ 7 lights


def light_strength(lamp, values, report):
    """Factor from the light's own node tree: a constant Emission, else 1."""
    if not getattr(lamp, "use_nodes", False) or lamp.node_tree is None:
        return (1.0, 1.0, 1.0)
    output = lamp.node_tree.get_output_node("CYCLES") or lamp.node_tree.get_output_node("ALL")
    if output is None:
        return (1.0, 1.0, 1.0)
    found = values.source(Socket(output.inputs["Surface"], ()))
    if found.node is None:
        return (0.0, 0.0, 0.0)
    if found.node.bl_idname != "ShaderNodeEmission":
        report.warn(28, "node '%s'" % found.node.name, "the light's own colour and power")
        return (1.0, 1.0, 1.0)
    color = values.input(found, "Color")
    strength = values.input(found, "Strength")
    if color.texture or strength.texture:
        report.warn(28, "texture in node '%s'" % found.node.name, "its mean")
    return scaled(values.constant(color), gray(values.constant(strength)))


def light_color(lamp):
    color = tuple(lamp.color)
    if getattr(lamp, "use_temperature", False):  # 4.5
        tint = getattr(lamp, "temperature_color", None)
        color = product(color, tuple(tint) if tint else blackbody(lamp.temperature))
    return scaled(color, 2.0 ** getattr(lamp, "exposure", 0.0))  # 4.5


def casts_shadows(lamp):
    cycles = getattr(getattr(lamp, "cycles", None), "cast_shadow", True)
    return bool(lamp.use_shadow and cycles)


def is_sphere_lamp(lamp):
    """Lamps with a radius are disks that face the receiver, but spheres in 4.0 and, later, when
    soft falloff is off."""
    if VERSION < (4, 0):
        return False
    return not getattr(lamp, "use_soft_falloff", False)


def put_light(text, name, lamp, rows, seen_by, values, report):
    place = without_scale(rows)
    scale = [length(column(rows, i)) for i in range(3)]
    power = scaled(product(light_color(lamp), light_strength(lamp, values, report)), lamp.energy)
    if min(power) < 0:
        report.warn(35, "it takes light away", "none")
    power = tuple(max(x, 0.0) for x in power)
    normalize = getattr(lamp, "normalize", True)  # 4.5
    with text.block("light", name):
        LIGHT_TYPES[lamp.type](text, lamp, power, place, scale, normalize, report)
        text.put_unless(True, "shadows", casts_shadows(lamp))
        has_size = {"AREA": 1, "SUN": lamp.angle if lamp.type == "SUN" else 0}.get(
            lamp.type, getattr(lamp, "shadow_soft_size", 0)) > 0
        text.put_unless("none", "seen_by", seen_by if has_size else "none")


def gives_light(lamp, rows, report):
    """False, after a warning, for what the renderer would refuse and Cycles shows nothing of."""
    scale = [length(column(rows, i)) for i in range(3)]
    if not all(map(math.isfinite, (*lamp.color, lamp.energy))):
        report.warn(11, "its colour or power is not finite", "left out")
        return False
    if lamp.type != "POINT" and is_flat(without_scale(rows)):
        report.warn(36, "its scale is 0", "left out")
        return False
    size_y = lamp.size_y if lamp.type == "AREA" and lamp.shape in {"RECTANGLE", "ELLIPSE"} else 1
    if lamp.type == "AREA" and min(lamp.size * scale[0], size_y * scale[1]) < 1e-9:
        report.warn(36, "its area is 0", "left out")
        return False
    return True


def put_color(text, color, report):
    """Radiance or intensity of a light."""
    text.put("color", tuple(within(x, 0.0, 1e15, "its brightness", report) for x in color))


def put_point_light(text, lamp, power, place, _scale, normalize, report):
    radius = lamp.shadow_soft_size
    if radius > 0 and is_sphere_lamp(lamp):
        area = 4 * math.pi * math.pi * radius * radius if normalize else math.pi
        text.put("type", "sphere")
        text.put("translate", column(place, 3))
        put_color(text, scaled(power, 1 / area), report)
        text.put("radius", radius)
        return
    text.put("type", "point")
    text.put("translate", column(place, 3))
    put_color(text, scaled(power, intensity_factor(radius, normalize)), report)
    text.put_unless(0, "radius", radius)


def intensity_factor(radius, normalize):
    """Watts -> W/sr. Without normalisation the power is that of a disk of area 1/4."""
    if normalize:
        return 1 / (4 * math.pi)
    return 1 / math.pi if radius <= 0 else radius * radius


def put_spot(text, lamp, power, place, scale, normalize, report):
    angle = lamp.spot_size
    if VERSION >= (3, 5):  # before, scale did not matter
        if abs(scale[0] - scale[1]) > 1e-4 * scale[0]:
            report.warn(29, "scale makes the cone elliptic", "a round cone")
        across = (scale[0] + scale[1]) / 2
        if abs(across - scale[2]) > 1e-4 * across and scale[2] > 0 and angle < 3.14:
            angle = 2 * math.atan(math.tan(angle / 2) * across / scale[2])
    text.put("type", "spot")
    text.put_rows(place)
    put_color(text, scaled(power, intensity_factor(lamp.shadow_soft_size, normalize)), report)
    text.put_unless(0, "radius", lamp.shadow_soft_size)
    text.put("cone_angle", min(math.degrees(angle), 180.0))
    text.put("blend", lamp.spot_blend)
    text.put_unless(False, "cosine_falloff", VERSION < (3, 5))


def put_sun(text, lamp, power, place, _scale, normalize, report):
    angle = lamp.angle
    factor = 1.0
    if VERSION < (4, 0):  # measured in 3.4: a large sun loses a little
        factor = (1 + math.cos(angle / 2)) / 2
    if not normalize and angle > 0:
        factor *= math.pi * math.sin(angle / 2) ** 2
    text.put("type", "sun")
    text.put_rows(place)
    put_color(text, scaled(power, factor), report)
    text.put_unless(0, "angle", min(math.degrees(angle), 180.0))  # half a turn as a float is more


def put_area_light(text, lamp, power, place, scale, normalize, report):
    is_round = lamp.shape in {"DISK", "ELLIPSE"}
    size_y = lamp.size_y if lamp.shape in {"RECTANGLE", "ELLIPSE"} else lamp.size
    size = (lamp.size * scale[0], size_y * scale[1])
    area = size[0] * size[1] * (math.pi / 4 if is_round else 1)
    if not normalize:
        area = 1.0
    elif VERSION < (4, 0):
        area *= 4 / math.pi
    text.put("type", "disk" if is_round else "rectangle")
    text.put_rows(place)
    put_color(text, scaled(power, 1 / (math.pi * area)), report)
    text.put("size", *size)
    spread = math.degrees(getattr(lamp, "spread", math.pi))
    if spread < 179.99:
        text.put("spread", max(spread, 1e-3))


LIGHT_TYPES = {
    "POINT": put_point_light,
    "SPOT": put_spot,
    "SUN": put_sun,
    "AREA": put_area_light,
}


# ------------------------------------------------------------------------------------------ 8 images

LINEAR_SPACES = {"Non-Color", "Raw", "Linear", "Linear Rec.709", "Generic Data"}


def base_name(path):
    """File name of a path that may come from another system."""
    return re.split(r"[\\/]", path)[-1]


def srgb_to_linear(x):
    return x / 12.92 if x <= 0.04045 else ((x + 0.055) / 1.055) ** 2.4


def linear_to_srgb(x):
    return x * 12.92 if x <= 0.0031308 else 1.055 * x ** (1 / 2.4) - 0.055


def as_byte(x):
    return min(max(int(x * 255 + 0.5), 0), 255)


# What 1 - x makes of an 8-bit code: of plain numbers, and of colours that are inverted in linear light.
INVERSIONS = {
    "alpha": bytes(255 - i for i in range(256)),
    "linear": bytes(255 - i for i in range(256)),
    "srgb": bytes(as_byte(linear_to_srgb(1 - srgb_to_linear(i / 255))) for i in range(256)),
}


# What the renderer reads (Code/image). Everything else is written anew by Blender.

def readable_form(data, name):
    """Extension that fits a picture file which the renderer reads; None for others, among them files
    that are not whole."""
    for start, form, is_sound in FORMS:
        if data.startswith(start):
            return form if is_sound(data) else None
    return ".tga" if name.lower().endswith(".tga") and is_sound_tga(data) else None


def is_sound_png(data):
    i = 8
    while i + 12 <= len(data):
        size, kind = struct.unpack(">I4s", data[i : i + 8])
        end = i + 8 + size
        if end + 4 > len(data) or zlib.crc32(data[i + 4 : end]) != struct.unpack(">I", data[end : end + 4])[0]:
            return False
        if kind == b"IEND":
            return True
        i = end + 4
    return False


def is_sound_jpeg(data):
    """Baseline and progressive, 8 bits, grey or three colours, up to its end."""
    i = 2
    while i + 10 <= len(data) and data[i] == 0xFF:
        marker = data[i + 1]
        if marker == 0xFF or marker == 1 or 0xD0 <= marker <= 0xD8:
            i += 1 if marker == 0xFF else 2
            continue
        if 0xC0 <= marker <= 0xCF and marker not in {0xC4, 0xC8, 0xCC}:
            return marker <= 0xC2 and data[i + 4] == 8 and data[i + 9] in {1, 3} and data.rfind(b"\xff\xd9") > i
        i += 2 + struct.unpack(">H", data[i + 2 : i + 4])[0]
    return False


def is_sound_exr(data):
    """No deep data, no colour differences, compression up to PIZ."""
    kind = re.search(rb"compression\x00compression\x00\x01\x00\x00\x00(.)", data[:65536], re.DOTALL)
    return len(data) > 8 and not data[5] & 0x08 and kind is not None and kind[1][0] <= 4 \
        and b"\x00RY\x00" not in data[:65536]


def is_sound_hdr(data):
    head = data[:65536].partition(b"\n\n")
    return b"32-bit_rle_rgbe" in head[0] and head[2].startswith(b"-Y ")


def is_sound_ppm(data):
    head = re.match(rb"P6\s+(?:#.*\s+)*(\d+)\s+(\d+)\s+(\d+)\s", data[:4096])
    if not head:
        return data[:2] != b"P6"
    width, height, most = map(int, head.groups())
    return len(data) - head.end() >= 3 * width * height * (1 if most < 256 else 2)


def is_sound_pfm(data):
    head = re.match(rb"P([Ff])\s+(\d+)\s+(\d+)\s+(\S+)\s", data[:4096])
    return head is not None and len(data) - head.end() >= 4 * (3 if head[1] == b"F" else 1) * int(head[2]) * int(head[3])


def is_sound_tga(data):
    if len(data) < 18 or data[2] not in {1, 2, 3, 9, 10, 11}:
        return False
    width, height = struct.unpack("<HH", data[12:16])
    return data[2] > 3 or len(data) >= 18 + data[0] + width * height * ((data[16] + 7) // 8)


# (first bytes, extension, whether it is one that the renderer reads)
FORMS = (
    (b"\x89PNG\r\n\x1a\n", ".png", is_sound_png),
    (b"\xff\xd8\xff", ".jpg", is_sound_jpeg),
    (b"\x76\x2f\x31\x01", ".exr", is_sound_exr),
    (b"#?RADIANCE", ".hdr", is_sound_hdr),
    (b"#?RGBE", ".hdr", is_sound_hdr),
    (b"P6", ".ppm", is_sound_ppm),
    (b"P5", ".ppm", is_sound_ppm),
    (b"PF", ".pfm", is_sound_pfm),
    (b"Pf", ".pfm", is_sound_pfm),
)
UNKNOWN_TO_BLENDER = {".ppm", ".pfm"}
FLOAT_FORMS = (".pfm", ".exr", ".hdr")  # the renderer takes their numbers as linear


def encode_png(width, height, channels, rows_bottom_up):
    """8-bit PNG of 3 or 4 channels."""
    stride = width * channels
    lines = bytearray()
    for y in range(height - 1, -1, -1):
        lines.append(0)
        lines += rows_bottom_up[y * stride : (y + 1) * stride]

    def chunk(kind, data):
        body = kind + data
        return struct.pack(">I", len(data)) + body + struct.pack(">I", zlib.crc32(body))

    header = struct.pack(">IIBBBBB", width, height, 8, 2 if channels == 3 else 6, 0, 0, 0)
    return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header)
            + chunk(b"IDAT", zlib.compress(bytes(lines), 6)) + chunk(b"IEND", b""))


def encode_ppm(width, height, rgb_bottom_up):
    rows = [rgb_bottom_up[y * width * 3 : (y + 1) * width * 3] for y in range(height - 1, -1, -1)]
    return b"P6\n%d %d\n255\n" % (width, height) + b"".join(rows)


def encode_pfm(width, height, rgb_bottom_up):
    data = array("f", rgb_bottom_up)
    if sys.byteorder != "little":
        data.byteswap()
    return b"PF\n%d %d\n-1.0\n" % (width, height) + data.tobytes()


def planes_of_file(path):
    """(red, green, blue values, is_float) of an 8-bit P6 or a PFM file, which Blender itself cannot
    always read; None for anything else."""
    with open(path, "rb") as file:
        data = file.read()
    head = re.match(rb"P6\s+(?:#.*\s+)*(\d+)\s+(\d+)\s+255\s", data[:200])
    if head:
        stored = data[head.end():]
        return [[x / 255 for x in thinned(stored[i::3])] for i in range(3)], False
    head = re.match(rb"PF\s+(\d+)\s+(\d+)\s+(\S+)\s", data[:200])
    if head:
        stored = array("f", data[head.end(): head.end() + (len(data) - head.end()) // 12 * 12])
        if (float(head[3]) > 0) == (sys.byteorder == "little"):
            stored.byteswap()
        return [thinned(stored[i::3]) for i in range(3)], True
    return None


def thinned(values):
    """About 4096 of the values, evenly spread: enough for a mean."""
    return values[:: max(1, len(values) // 4096)]


class Pixels(NamedTuple):
    """Planes of an image, red green blue and alpha if it has one, rows from the bottom: bytes, or
    arrays of floats."""
    width: int
    height: int
    planes: list
    is_float: bool

    def interleaved(self):
        joined = array("f", bytes(4 * len(self.planes[0]) * len(self.planes))) if self.is_float \
            else bytearray(len(self.planes[0]) * len(self.planes))
        for i, plane in enumerate(self.planes):
            joined[i :: len(self.planes)] = plane
        return joined


class Facts(NamedTuple):
    """What is known of an image once Blender has loaded it."""
    is_readable: bool
    has_alpha: bool
    is_float: bool


def is_premultiplied(image):
    """Cycles believes this of what lies in Blender's memory; of a file it asks the file's format."""
    return image.alpha_mode == "PREMUL" and getattr(image, "packed_file", None) is not None


class Images:
    """Finds the file of each image, and writes one where there is none that the renderer reads.

    An image has up to three looks, as Cycles makes them of its alpha mode: 'straight' colours beside
    their alpha, colours 'associated' with (multiplied by) alpha, and 'opaque' ones that know no alpha.
    """

    def __init__(self, out_folder, textures, as_ppm, report):
        self.out_folder = out_folder
        self.as_ppm = as_ppm
        self.report = report
        self.files, self.known, self.greys, self.means = {}, {}, {}, {}
        beside = os.path.dirname(out_folder) if os.path.basename(out_folder) == "ASCII" else out_folder
        self.store = os.path.abspath(textures) if textures else os.path.join(beside, "Textures")
        self.searched = [self.store] if textures else []
        self.beside = [out_folder, self.store, os.path.join(beside, "Textures")]

    # ---- finding

    def file(self, image, look="straight", inversion=None, grey=None):
        """Path, relative to the output, of a file with this look of the image; None after a warning.
        inversion: None, or what is inverted (a key of INVERSIONS). grey: None, or the colour space in
        which colours become their luminance."""
        key = (image.name_full, look, inversion, grey)
        if key not in self.files:
            plain = look == "straight" and inversion is None and grey is None
            self.files[key] = self.locate(image) if plain else self.baked(image, look, inversion, grey)
        return self.files[key]

    def locate(self, image):
        if image.source in {"SEQUENCE", "MOVIE", "TILED"}:
            self.report.warn(24, "image '%s' is a %s" % (image.name, image.source.lower()), "one picture")
        if image.source == "GENERATED" or image.is_dirty:
            return self.rewritten(image)
        path, packed = None, getattr(image, "packed_file", None)
        if packed is not None:
            data = bytes(packed.data)
        else:
            path = self.find(image)
            if path is None:
                self.report.warn(22, "image '%s': no file '%s'" % (image.name, base_name(image.filepath)),
                                 "magenta, as Blender shows it")
                return None
            with open(path, "rb") as file:
                data = file.read()
        form = readable_form(data, path or image.filepath)
        if form not in UNKNOWN_TO_BLENDER:
            facts = self.facts(image)
            if not facts.is_readable:
                return self.unreadable(image)
            if form is None or (is_premultiplied(image) and facts.has_alpha and not facts.is_float) or (self.as_ppm and form in {".png", ".jpg", ".tga"}):
                return self.rewritten(image)
        return self.use(path, data, form) if path else self.save(self.stem(image), form, data)

    def unreadable(self, image):
        self.report.warn(23, "image '%s' cannot be read" % image.name, "magenta, as Blender shows it")

    def find(self, image):
        """The image's own file, or one of that name in the folder that --textures names. What only
        has a similar name is another picture."""
        path = image.filepath_raw or image.filepath
        path = path.replace("<UDIM>", "1001").replace("<UVTILE>", "u1_v1")
        own = bpy.path.abspath(path, library=image.library)
        for candidate in [own] + [os.path.join(folder, base_name(path)) for folder in self.searched]:
            if base_name(path) and os.path.isfile(candidate):
                self.report.note("image '%s' is %s" % (image.name, candidate))
                return os.path.abspath(candidate)
        return None

    def use(self, path, data, form):
        """A file that the renderer reads: named where it is if that is beside us, else copied."""
        if any(os.path.realpath(path).startswith(os.path.realpath(f) + os.sep) for f in self.beside):
            return self.relative(path)
        stem, extension = os.path.splitext(os.path.basename(path))
        return self.save(stem, extension.lower() if extension.lower() == ".jpeg" else form, data)

    def relative(self, path):
        return os.path.relpath(path, self.out_folder).replace(os.sep, "/")

    # ---- writing

    def stem(self, image):
        """Stable file name of an image: that of its file, or made of its name and the scene's."""
        if image.source == "FILE" and not image.is_dirty and not getattr(image, "packed_file", None):
            return os.path.splitext(base_name(image.filepath))[0]
        stem = os.path.splitext(base_name(image.name))[0] or "image"
        blend = os.path.splitext(os.path.basename(bpy.data.filepath))[0]
        return re.sub(r"[^A-Za-z0-9_.-]+", "_", "%s_%s" % (blend, stem) if blend else stem)

    def save(self, stem, extension, data):
        os.makedirs(self.store, exist_ok=True)
        path = os.path.join(self.store, stem + extension)
        if os.path.exists(path) and not same_bytes(path, data):
            path = os.path.join(self.store, "%s-%s%s" % (stem, hashlib.sha1(data).hexdigest()[:8], extension))
        if not os.path.exists(path):
            write_atomically(path, data)
        return self.relative(path)

    @contextlib.contextmanager
    def loaded(self, image):
        """The image, or what is loaded from the file that stands in for its own; None if unreadable."""
        substitute, path = None, None
        if image.source == "FILE" and not image.is_dirty and not getattr(image, "packed_file", None):
            own, path = bpy.path.abspath(image.filepath, library=image.library), self.find(image)
            if path and not (os.path.exists(own) and os.path.samefile(own, path)):
                with contextlib.suppress(RuntimeError):
                    substitute = bpy.data.images.load(path, check_existing=False)
                    substitute.colorspace_settings.name = image.colorspace_settings.name
                    substitute.alpha_mode = image.alpha_mode
                image = substitute
        try:
            yield image if image is not None and min(image.size) > 0 else None
        finally:
            if substitute:
                bpy.data.images.remove(substitute)

    def facts(self, image):
        if image.name_full not in self.known:
            was_loaded = image.has_data
            with self.loaded(image) as it:
                self.known[image.name_full] = Facts(False, False, False) if it is None else Facts(
                    True, it.channels == 4 and it.depth in {16, 32, 64, 128}, it.is_float)
            if not was_loaded and image.source == "FILE":
                image.buffers_free()  # all pictures at once may be more than the memory
        return self.known[image.name_full]

    def is_grey(self, image):
        if image.name_full not in self.greys:
            with self.loaded(image) as known:
                pixels = self.pixels(known) if known else None
                self.greys[image.name_full] = pixels is not None and pixels.planes[0] == pixels.planes[1] == pixels.planes[2]
        return self.greys[image.name_full]

    def rewritten(self, image):
        """The image as Blender writes it: PNG, or OpenEXR when it is of floats."""
        with self.loaded(image) as known:
            if known is None:
                return self.unreadable(image)
            if self.as_ppm and not known.is_float:
                pixels = self.pixels(known)
                if len(pixels.planes) == 3 or min(pixels.planes[3]) == 255:
                    pixels = pixels._replace(planes=pixels.planes[:3])
                    return self.save(self.stem(image), ".ppm",
                                     encode_ppm(pixels.width, pixels.height, pixels.interleaved()))
            form, extension = ("OPEN_EXR", ".exr") if known.is_float else ("PNG", ".png")
            data = written_by_blender(known, form)
            return self.save(self.stem(image), extension, data) if data else self.unreadable(image)

    def baked(self, image, look, inversion, grey):
        """A look that the file itself does not have."""
        with self.loaded(image) as known:
            if known is None:
                return self.locate(image)  # it warns, or Blender does not know what the renderer reads
            as_blender = look != "opaque" and is_premultiplied(image)
            pixels = self.pixels(known, None if as_blender else "CHANNEL_PACKED")
        if pixels is None:
            return self.unreadable(image)
        color, alpha = pixels.planes[:3], pixels.planes[3:]
        if alpha and inversion != "alpha" and min(alpha[0]) == (1 if pixels.is_float else 255):
            alpha = []
            if inversion is None and grey is None:
                return self.file(image)
        if look == "associated" and alpha and not pixels.is_float:
            color = [times_alpha(plane, alpha[0]) for plane in color]
        if look != "straight":
            alpha = []
        name = "%s_%s" % (self.stem(image), look) if look != "straight" else self.stem(image)
        if pixels.is_float:
            if inversion is not None or grey is not None or alpha:
                self.report.warn(23, "image '%s' of floats cannot be inverted or made grey" % image.name, "as it is")
                return self.file(image)
            rgb = Pixels(pixels.width, pixels.height, color, True).interleaved()
            return self.save(name, ".pfm", encode_pfm(pixels.width, pixels.height, rgb))
        if grey is not None:
            name += "_grey"
            color = [luminances(color, grey)] * 3
        if inversion is not None:
            name += "_inverted"
            color = [plane.translate(INVERSIONS[inversion]) for plane in color]
            if inversion == "alpha":
                alpha = [plane.translate(INVERSIONS[inversion]) for plane in alpha]
        rows = Pixels(pixels.width, pixels.height, color + alpha, False).interleaved()
        return self.save(name, ".png", encode_png(pixels.width, pixels.height, len(color + alpha), rows))

    @staticmethod
    def pixels(image, alpha_mode=None):
        """Pixels as Blender understands the file (in another alpha mode, if one is given), by way of a file without compression: Python's own loops would
        take half a minute for a large picture."""
        width, height = image.size
        if image.is_float:
            values = array("f", bytes(4 * len(image.pixels)))
            image.pixels.foreach_get(values)
            planes = [values[i :: image.channels] for i in range(image.channels)]
            return Pixels(width, height, planes if len(planes) > 2 else [planes[0]] * 3 + planes[1:], True)
        data = written_by_blender(image, "TARGA_RAW", alpha_mode)
        if not data:
            return None
        channels, start = data[16] // 8, 18 + data[0]
        body = data[start : start + width * height * channels]
        order = (0, 0, 0) if channels == 1 else (2, 1, 0, 3)[:channels]
        return Pixels(width, height, [body[i::channels] for i in order], False)

    # ---- numbers

    def mean(self, texture):
        """Mean colour of a texture in linear light, from some thousand of its pixels."""
        key = (texture.image.name_full, texture.channel, texture.space, texture.look)
        if key not in self.means:
            self.means[key] = self.measure(texture)
        mean = self.means[key]
        mean = (gray(mean),) * 3 if texture.grey else mean
        return tuple(1 - x for x in mean) if texture.inverted else mean

    def measure(self, texture):
        path = self.find(texture.image) if texture.image.source == "FILE" else None
        with self.loaded(texture.image) as known:
            if known is not None:
                channels, is_float = known.channels, known.is_float
                values = array("f", bytes(4 * len(known.pixels)))
                known.pixels.foreach_get(values)
                planes = [thinned(values[i::channels]) for i in range(channels)]
                if texture.channel == "alpha":
                    planes = [planes[3] if channels == 4 else [1.0]] * 3
                elif texture.look == "associated" and channels == 4 and not is_float:
                    planes = [[x * a for x, a in zip(plane, planes[3])] for plane in planes]
                planes = planes[:3] if channels > 2 else [planes[0]] * 3
            else:
                found = planes_of_file(path) if path else None
                if found is None or not found[0][0]:
                    return (0.5, 0.5, 0.5)
                planes, is_float = found
        decode = texture.space == "srgb" and texture.channel == "color" and not is_float
        means = []
        for plane in planes:
            plane = finite(plane)
            means.append(sum(map(srgb_to_linear, plane) if decode else plane) / len(plane))
        return tuple(means)


def times_alpha(plane, alpha):
    """Products of 8-bit codes, by a table of all pairs."""
    pairs = bytearray(2 * len(plane))
    pairs[0::2], pairs[1::2] = plane, alpha
    table = bytes((i % 256 * (i // 256) + 127) // 255 for i in range(65536))
    if sys.byteorder != "little":
        pairs[0::2], pairs[1::2] = alpha, plane
    return bytes(map(table.__getitem__, memoryview(pairs).cast("H")))


def luminances(planes, space):
    """Codes of the luminance of colours, by tables: sums of 16-bit numbers become codes again."""
    decode = srgb_to_linear if space == "srgb" else float
    encode = linear_to_srgb if space == "srgb" else float
    parts = [[round(weight * decode(i / 255) * 65535) for i in range(256)] for weight in LUMINANCE]
    codes = bytes(as_byte(encode(min(i / 65535, 1.0))) for i in range(65535 + 3))
    red, green, blue = (map(part.__getitem__, plane) for part, plane in zip(parts, planes))
    return bytes(map(codes.__getitem__, map(operator.add, map(operator.add, red, green), blue)))


def written_by_blender(image, form, alpha_mode=None):
    """Bytes of the file that Blender writes of an image; None if it cannot. Neither the image nor its
    file is touched."""
    if image.is_dirty or image.is_float:  # a copy would read the file again, floats are to stay linear
        values = array("f", bytes(4 * len(image.pixels)))
        image.pixels.foreach_get(values)
        is_opaque = image.channels < 4 or min(values[3::4]) >= 1
        copy = bpy.data.images.new(image.name, *image.size, alpha=not is_opaque, float_buffer=image.is_float)
        copy.colorspace_settings.name = "Non-Color" if image.is_float else image.colorspace_settings.name
        copy.pixels.foreach_set(values)
    else:
        copy = image.copy()
    try:
        if alpha_mode:
            copy.alpha_mode = alpha_mode
        if min(copy.size) == 0 or not len(copy.pixels):  # this loads it, too
            return None
        copy.pixels[0]
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "picture")
            copy.filepath_raw, copy.file_format = path, form
            with contextlib.suppress(RuntimeError):
                copy.save()
            made = [os.path.join(folder, name) for name in os.listdir(folder)]
            if not made:
                return None
            with open(made[0], "rb") as file:
                return file.read()
    finally:
        bpy.data.images.remove(copy)


def same_bytes(path, data):
    if os.path.getsize(path) != len(data):
        return False
    with open(path, "rb") as file:
        return file.read() == data


def write_atomically(path, data):
    """Nobody ever sees half a file."""
    temporary = "%s.%d.tmp" % (path, os.getpid())
    try:
        with open(temporary, "wb") as file:
            file.write(data)
        os.replace(temporary, path)
    except BaseException:
        with contextlib.suppress(OSError):
            os.remove(temporary)
        raise


# ------------------------------------------------------------------------------------------ 9 values

BLACK, WHITE, GRAY = (0.0, 0.0, 0.0), (1.0, 1.0, 1.0), (0.8, 0.8, 0.8)
LUMINANCE = (0.2126, 0.7152, 0.0722)
MISSING = (1.0, 0.0, 1.0)  # what Blender shows instead of a picture that it cannot read


def scaled(rgb, factor):
    return tuple(x * factor for x in rgb)


def product(a, b):
    return tuple(x * y for x, y in zip(a, b))


def plus(a, b):
    return tuple(x + y for x, y in zip(a, b))


def mixed(a, b, t):
    return tuple(x + (y - x) * t for x, y in zip(a, b))


def gray(rgb):
    """A colour that goes into a number socket."""
    r, g, b = rgb
    return r if r == g == b else sum(map(operator.mul, LUMINANCE, rgb))


def clamped(rgb):
    return tuple(min(max(x, 0.0), 1.0) for x in rgb)


class Socket(NamedTuple):
    """An input socket and the group nodes around it, from the outside inwards."""
    socket: object
    path: tuple


class Source(NamedTuple):
    """What feeds a socket: a node's output, or (node None) the default of `socket`."""
    node: object
    output: object
    path: tuple
    socket: object


@dataclass(frozen=True)
class Texture:
    """A texture block of the format, and the coordinates it is looked up with."""
    image: object = field(compare=False)
    file: str
    space: str
    interpolation: str = "bilinear"
    extension: str = "repeat"
    channel: str = "color"
    scale: tuple = (1.0, 1.0)
    rotation: float = 0.0
    offset: tuple = (0.0, 0.0)
    coordinates: tuple = ("uv", "")
    inverted: bool = False
    look: str = "straight"  # see Images
    grey: bool = False  # its luminance


@dataclass(frozen=True)
class Value:
    """A colour, times a texture if there is one. Numbers are grey."""
    rgb: tuple
    texture: Optional[Texture] = None


def number_value(x):
    return Value((x, x, x))


# svm_math_blackbody_color_rec709 of Cycles: fitted curves, r and g as a/t + b*t + c.
_BLACKBODY_STARTS = (965.0, 1167.0, 1449.0, 1902.0, 3315.0, 6365.0)
_BLACKBODY_R = (
    (1.61919106e+03, -2.05010916e-03, 5.02995757e+00), (2.48845471e+03, -1.11330907e-03, 3.22621544e+00),
    (3.34143193e+03, -4.86551192e-04, 1.76486769e+00), (4.09461742e+03, -1.27446582e-04, 7.25731635e-01),
    (4.67028036e+03, 2.91258199e-05, 1.26703442e-01), (4.59509185e+03, 2.87495649e-05, 1.50345020e-01),
    (3.78717450e+03, 9.35907826e-06, 3.99075871e-01))
_BLACKBODY_G = (
    (-4.88999748e+02, 6.04330754e-04, -7.55807526e-02), (-7.55994277e+02, 3.16730098e-04, 4.78306139e-01),
    (-1.02363977e+03, 1.20223470e-04, 9.36662319e-01), (-1.26571316e+03, 4.87340896e-06, 1.27054498e+00),
    (-1.42529332e+03, -4.01150431e-05, 1.43972784e+00), (-1.17554822e+03, -2.16378048e-05, 1.30408023e+00),
    (-5.00799571e+02, -4.59832026e-06, 1.09098763e+00))
_BLACKBODY_B = (
    (5.96945309e-11, -4.85742887e-08, -9.70622247e-05, -4.07936148e-03),
    (2.40430366e-11, 5.55021075e-08, -1.98503712e-04, 2.89312858e-02),
    (-1.40949732e-11, 1.89878968e-07, -3.56632824e-04, 9.10767778e-02),
    (-3.61460868e-11, 2.84822009e-07, -4.93211319e-04, 1.56723440e-01),
    (-1.97075738e-11, 1.75359352e-07, -2.50542825e-04, -2.22783266e-02),
    (-1.61997957e-13, -1.64216008e-08, 3.86216271e-04, -7.38077418e-01),
    (6.72650283e-13, -2.73078809e-08, 4.24098264e-04, -7.52335691e-01))


def blackbody(t):
    if t >= 12000:
        return (0.8262954810464208, 0.9945080501520986, 1.566307710274283)
    if t < 800:
        return (5.413294490189271, 0.0, 0.0)
    i = sum(t >= start for start in _BLACKBODY_STARTS)
    r, g, b = _BLACKBODY_R[i], _BLACKBODY_G[i], _BLACKBODY_B[i]
    rgb = (r[0] / t + r[1] * t + r[2], g[0] / t + g[1] * t + g[2], ((b[0] * t + b[1]) * t + b[2]) * t + b[3])
    return tuple(max(x, 0.0) for x in rgb)


def fresnel_dielectric(cosine, ior):
    sine2 = (1 - cosine * cosine) / (ior * ior)
    if sine2 >= 1:
        return 1.0
    out = math.sqrt(1 - sine2)
    parallel = (ior * cosine - out) / (ior * cosine + out)
    perpendicular = (cosine - ior * out) / (cosine + ior * out)
    return (parallel * parallel + perpendicular * perpendicular) / 2


def fresnel_mean(ior):
    """Reflectance of a boundary for light that comes from everywhere."""
    n = 64
    return sum(2 * c * fresnel_dielectric(c, ior) for c in ((i + 0.5) / n for i in range(n))) / n


def rotation_2d(degrees):
    c, s = math.cos(math.radians(degrees)), math.sin(math.radians(degrees))
    return c, s


def plane_map(node_type, location, rotation, scale):
    """Mapping node -> ((a, b, tx), (c, d, ty)) on the plane, and whether that is all of it."""
    turn = Euler(rotation, "XYZ").to_matrix()
    stretch = Matrix.Diagonal(Vector(scale))
    if node_type == "TEXTURE":  # the inverse of what the node says
        safe = Vector([1 / s if s else 0.0 for s in scale])
        linear = Matrix.Diagonal(safe) @ turn.transposed()
        shift = linear @ (-Vector(location))
    else:
        linear = turn @ stretch
        shift = Vector(location) if node_type == "POINT" else Vector((0, 0, 0))
    is_plane = abs(linear[0][2]) < 1e-6 and abs(linear[1][2]) < 1e-6
    rows = tuple((linear[i][0], linear[i][1], shift[i]) for i in range(2))
    return rows, is_plane


def compose_plane(outer, inner):
    return tuple(
        (o[0] * inner[0][0] + o[1] * inner[1][0], o[0] * inner[0][1] + o[1] * inner[1][1],
         o[0] * inner[0][2] + o[1] * inner[1][2] + o[2])
        for o in outer
    )


def tidy(x):
    """Removes the dust of single-precision rotations."""
    nearest = round(x, 6)
    return nearest + 0.0 if abs(x - nearest) < 1e-7 else x


def split_plane(rows):
    """Plane map -> (scale, rotation in degrees, offset, exact) of a texture block."""
    (a, b, tx), (c, d, ty) = rows
    along = math.hypot(a, c)
    angle = math.atan2(c, a) if along > 0 else math.atan2(-b, d)
    across = -b * math.sin(angle) + d * math.cos(angle)
    shear = b * math.cos(angle) + d * math.sin(angle)
    exact = abs(shear) <= 1e-5 * max(along, abs(across), 1e-9)
    degrees = math.degrees(angle)
    if abs(abs(degrees) - 180) < 1e-4:  # two mirrors read better than half a turn
        along, across, degrees = -along, -across, 0.0
    return (tidy(along), tidy(across)), tidy(degrees), (tidy(tx), tidy(ty)), exact


class Values:
    """Evaluates sockets that are not shaders. Constants are folded, image textures are kept."""

    def __init__(self, images, report):
        self.images = images
        self.report = report

    # ---- the graph

    def source(self, at):
        """Follows links through reroutes, muted nodes and groups."""
        socket, path = at
        for _ in range(1000):
            link = next((l for l in socket.links if l.is_valid and not l.is_muted), None) \
                if socket.is_linked else None
            if link is None:
                return Source(None, None, path, socket)
            node, output = link.from_node, link.from_socket
            if node.mute:
                inner = next((l.from_socket for l in node.internal_links if l.to_socket == output), None)
                if inner is None:
                    return Source(None, None, path, None)
                socket = inner
            elif node.bl_idname == "NodeReroute":
                socket = node.inputs[0]
            elif node.bl_idname == "ShaderNodeGroup":
                end = group_output(node.node_tree) if node.node_tree else None
                inner = by_identifier(end.inputs, output.identifier) if end else None
                if inner is None:
                    return Source(None, None, path, None)
                socket, path = inner, path + (node,)
            elif node.bl_idname == "NodeGroupInput":
                if not path:
                    return Source(None, None, path, None)
                group, path = path[-1], path[:-1]
                socket = by_identifier(group.inputs, output.identifier)
                if socket is None:
                    return Source(None, None, path, None)
            else:
                return Source(node, output, path, None)
        raise ExportError("the links of node tree '%s' go in circles" % socket.id_data.name)

    def socket(self, found, *names):
        """Input of a node by name or identifier; names changed over the versions."""
        for name in names:
            for socket in found.node.inputs:
                if name in (socket.identifier, socket.name) and getattr(socket, "enabled", True):
                    return Socket(socket, found.path)
        for name in names:
            for socket in found.node.inputs:
                if name in (socket.identifier, socket.name):
                    return Socket(socket, found.path)
        return None

    def input(self, found, *names, default=0.0):
        at = self.socket(found, *names)
        return number_value(default) if at is None else self.value(at)

    def at_index(self, found, i):
        return self.value(Socket(found.node.inputs[i], found.path))

    def value(self, at):
        found = self.source(at)
        if found.node is None:
            return default_value(found.socket)
        convert = VALUE_NODES.get(found.node.bl_idname)
        if convert is None:
            self.report.warn(12, "node '%s' (%s)" % (found.node.name, kind_of(found.node)), "grey 0.5")
            return number_value(0.5)
        return convert(self, found)

    # ---- results

    def constant(self, value):
        """The colour of a value; a texture counts with its mean."""
        if value.texture is None:
            return value.rgb
        return product(value.rgb, self.images.mean(value.texture))

    def number(self, found, *names, default=0.0):
        """Input that must be a constant number."""
        value = self.input(found, *names, default=default)
        if value.texture is not None:
            self.report.warn(14, "node '%s' has a texture at '%s'" % (found.node.name, names[0]), "its mean")
        return gray(self.constant(value))

    def color(self, found, *names):
        value = self.input(found, *names)
        if value.texture is not None:
            self.report.warn(14, "node '%s' has a texture at '%s'" % (found.node.name, names[0]), "its mean")
        return self.constant(value)

    def fold(self, found, values, compute):
        """compute(colours) when all are constant; else the texture passes unchanged."""
        textured = next((v for v in values if v.texture is not None), None)
        if textured is None:
            return Value(tuple(compute(*[v.rgb for v in values])))
        self.report.warn(12, "node '%s' (%s) on a texture" % (found.node.name, kind_of(found.node)),
                         "the texture without it")
        return textured

    # ---- nodes

    def rgb(self, found):
        return Value(tuple(found.output.default_value)[:3])

    def plain_number(self, found):
        return number_value(found.output.default_value)

    def image_texture(self, found):
        is_alpha = found.output.name == "Alpha"
        texture = self.texture(found)
        if texture is None:
            return Value(WHITE if is_alpha else MISSING)
        if is_alpha and texture.image.alpha_mode == "NONE":
            return Value(WHITE)
        return Value(WHITE, texture)

    def mix(self, found):
        node = found.node
        if node.bl_idname == "ShaderNodeMixRGB":
            t, a, b = (self.at_index(found, i) for i in range(3))
            blend, clamp_factor, clamp_result = node.blend_type, True, node.use_clamp
        else:
            kind = {"RGBA": "Color", "VECTOR": "Vector"}.get(node.data_type, "Float")
            uniform = kind != "Vector" or node.factor_mode == "UNIFORM"
            t = self.input(found, "Factor_Float" if uniform else "Factor_Vector")
            a, b = self.input(found, "A_" + kind), self.input(found, "B_" + kind)
            blend = node.blend_type if kind == "Color" else "MIX"
            clamp_factor, clamp_result = node.clamp_factor, kind == "Color" and node.clamp_result
        if t.texture is None:
            factor = gray(t.rgb)
            factor = min(max(factor, 0.0), 1.0) if clamp_factor else factor
            if blend == "MIX" and factor in (0.0, 1.0):
                return b if factor else a
            clamps = clamp_result and max(a.rgb + b.rgb) > 1
            if blend == "MULTIPLY" and factor == 1 and (a.texture is None or b.texture is None) and not clamps:
                return Value(product(a.rgb, b.rgb), a.texture or b.texture)
            if factor == 0:
                return a
        operation = BLENDS.get(blend)
        if operation is None:
            self.report.warn(12, "blend type %s of node '%s'" % (blend, node.name), "a plain mix")
            operation = BLENDS["MIX"]
        if a.texture and b.texture is None and t.texture is None and blend == "MIX" and factor > 0.5:
            a, b, factor = b, a, 1 - factor  # keep what counts more
        finish = clamped if clamp_result else lambda rgb: rgb
        compute = lambda t, a, b: finish(
            tuple(x + (operation(x, y) - x) * gray(t) for x, y in zip(a, b)))
        return self.fold(found, (t, a, b), compute)

    def math(self, found):
        node = found.node
        values = [self.as_number(found, self.value(Socket(s, found.path))) for s in node.inputs]
        operation = MATH.get(node.operation)
        if node.operation == "SUBTRACT" and values[1].texture \
                and values[0] == number_value(1.0) and values[1].rgb == WHITE:
            return Value(WHITE, replace(values[1].texture, inverted=not values[1].texture.inverted))
        clamps = node.use_clamp and max(abs(x) for v in values[:2] for x in v.rgb) > 1
        if node.operation == "MULTIPLY" and sum(v.texture is not None for v in values[:2]) == 1 and not clamps:
            return Value(product(values[0].rgb, values[1].rgb), values[0].texture or values[1].texture)
        if operation is None:
            self.report.warn(12, "operation %s of node '%s'" % (node.operation, node.name), "its first input")
            return values[0]
        finish = (lambda x: min(max(x, 0.0), 1.0)) if node.use_clamp else (lambda x: x)

        def compute(*rgbs):
            try:
                x = finish(operation(*[gray(rgb) for rgb in rgbs]))
            except (ArithmeticError, ValueError):  # as Blender: impossible is 0
                x = 0.0
            return (x, x, x)

        used = 3 if node.operation in {"MULTIPLY_ADD", "COMPARE"} else 1 if node.operation in UNARY else 2
        return self.fold(found, (values + [number_value(0.0)] * 3)[: max(used, 1)], compute)

    def vector_math(self, found):
        node = found.node
        operation = VECTOR_MATH.get(node.operation)
        a, b = self.at_index(found, 0), self.at_index(found, 1)
        if operation is None:
            self.report.warn(12, "operation %s of node '%s'" % (node.operation, node.name), "its first input")
            return a
        return self.fold(found, (a, b), lambda a, b: tuple(map(operation, a, b)))

    def invert(self, found):
        t, color = self.input(found, "Fac"), self.input(found, "Color")
        if color.texture and t.rgb == WHITE and t.texture is None and color.rgb == WHITE:
            return Value(WHITE, replace(color.texture, inverted=not color.texture.inverted))
        return self.fold(found, (t, color), lambda t, c: mixed(c, tuple(1 - x for x in c), gray(t)))

    def gamma(self, found):
        values = self.input(found, "Color"), self.input(found, "Gamma")
        return self.fold(found, values, lambda c, g: tuple(max(x, 0.0) ** gray(g) for x in c))

    def bright_contrast(self, found):
        values = self.input(found, "Color"), self.input(found, "Bright"), self.input(found, "Contrast")
        compute = lambda c, b, k: tuple(
            max((1 + gray(k)) * x + gray(b) - gray(k) * 0.5, 0.0) for x in c)
        return self.fold(found, values, compute)

    def hue_saturation(self, found):
        values = [self.input(found, n) for n in ("Hue", "Saturation", "Value", "Fac", "Color")]
        if all(v.texture is None for v in values[:4]):
            hue, saturation, value, factor = (gray(v.rgb) for v in values[:4])
            if hue == 0.5 and saturation == 1 and factor == 1:
                return replace(values[4], rgb=scaled(values[4].rgb, value))

        def compute(h, s, v, t, c):
            import colorsys
            a, b, d = colorsys.rgb_to_hsv(*c)
            turned = colorsys.hsv_to_rgb((a + gray(h) + 0.5) % 1.0, min(max(b * gray(s), 0), 1), d * gray(v))
            return tuple(max(x, 0.0) for x in mixed(c, turned, gray(t)))

        return self.fold(found, values, compute)

    def color_ramp(self, found):
        ramp = found.node.color_ramp
        alpha = found.output.name == "Alpha"
        pick = lambda c: (c[3],) * 3 if alpha else tuple(c[:3])
        return self.fold(found, (self.input(found, "Fac"),), lambda t: pick(ramp.evaluate(gray(t))))

    def clamp(self, found):
        values = [self.input(found, n) for n in ("Value", "Min", "Max")]
        return self.fold(found, values, lambda v, a, b: (min(max(gray(v), gray(a)), gray(b)),) * 3)

    def map_range(self, found):
        names = ("Value", "From Min", "From Max", "To Min", "To Max")
        values = [self.input(found, n) for n in names]

        def compute(*rgbs):
            v, a, b, c, d = map(gray, rgbs)
            t = (v - a) / (b - a) if a != b else 0.0
            t = min(max(t, 0.0), 1.0) if found.node.clamp else t
            return (c + t * (d - c),) * 3

        return self.fold(found, values, compute)

    def combine(self, found):
        values = [self.at_index(found, i) for i in range(3)]
        compute = lambda a, b, c: from_mode(getattr(found.node, "mode", "RGB"), gray(a), gray(b), gray(c))
        return self.fold(found, values, compute)

    def combine_hsv(self, found):
        values = [self.at_index(found, i) for i in range(3)]
        return self.fold(found, values, lambda a, b, c: from_mode("HSV", gray(a), gray(b), gray(c)))

    def separate(self, found):
        i = [o.identifier for o in found.node.outputs].index(found.output.identifier)
        value = self.at_index(found, 0)
        mode = getattr(found.node, "mode", "RGB")
        return self.fold(found, (value,), lambda c: (to_mode(mode, c)[i],) * 3)

    def separate_hsv(self, found):
        i = [o.identifier for o in found.node.outputs].index(found.output.identifier)
        return self.fold(found, (self.at_index(found, 0),), lambda c: (to_mode("HSV", c)[i],) * 3)

    def to_gray(self, found):
        return self.as_number(found, self.at_index(found, 0))

    def as_number(self, found, value):
        """The luminance of a colour, as where a colour goes into a number."""
        if value.texture is None:
            return number_value(gray(value.rgb))
        r, g, b = value.rgb
        if r != g or r != b:
            self.report.warn(12, "node '%s' (%s) on a coloured texture" % (found.node.name, kind_of(found.node)),
                             "the luminance of the texture times that of its colour")
        is_colour = value.texture.channel == "color" and not self.images.is_grey(value.texture.image)
        return Value(number_value(gray(value.rgb)).rgb, replace(value.texture, grey=is_colour))

    def black_body(self, found):
        return self.fold(found, (self.at_index(found, 0),), lambda t: blackbody(gray(t)))

    def fresnel(self, found):
        """As a plain value: its mean. Where it mixes shaders, Shaders.mix does better."""
        mean = fresnel_mean(max(fresnel_ior(self, found), 1.0)) if fresnel_ior(self, found) else 0.5
        self.report.warn(14, "node '%s' outside of the Fac of a Mix Shader" % found.node.name, "its mean")
        return number_value(mean)

    def light_path(self, found):
        is_camera = found.output.name == "Is Camera Ray"
        self.report.warn(12, "node '%s' (Light Path)" % found.node.name, "as seen by the camera")
        return number_value(1.0 if is_camera else 0.0)

    def checker(self, found):
        self.report.warn(12, "node '%s' (Checker Texture)" % found.node.name, "the mean of its colours")
        a, b = self.constant(self.input(found, "Color1")), self.constant(self.input(found, "Color2"))
        return Value(mixed(a, b, 0.5))

    # ---- image textures

    def texture(self, found):
        node = found.node
        image = node.image
        if image is None:
            self.report.warn(22, "node '%s' has no image" % node.name, "magenta, as Blender shows it")
            return None
        image = image.original if image.original else image
        is_alpha = found.output.name == "Alpha"
        look = "straight" if is_alpha else self.look(node, image)
        file = self.images.file(image, look)
        if file is None:
            return None
        if getattr(node, "projection", "FLAT") != "FLAT" and node.bl_idname == "ShaderNodeTexImage":
            self.report.warn(20, "node '%s' projection %s" % (node.name, node.projection), "flat")
        scale, rotation, offset, coordinates = self.lookup(found)
        return Texture(
            image=image, file=file, space=self.space(image, file),
            interpolation=self.interpolation(node), extension=self.extension(node),
            channel="alpha" if is_alpha else "color", look=look,
            scale=scale, rotation=rotation, offset=offset, coordinates=coordinates)

    def look(self, node, image):
        """How Cycles gives colours to a node: multiplied by alpha, unless the node's alpha is used or
        the image says that colours and alpha have nothing to do with each other."""
        if image.alpha_mode in {"CHANNEL_PACKED", "NONE"} or is_data(image):
            return "opaque" if self.images.facts(image).has_alpha else "straight"
        is_used = any(o.name == "Alpha" and o.is_linked for o in node.outputs)
        return "straight" if is_used or not self.images.facts(image).has_alpha else "associated"

    def space(self, image, file):
        name = image.colorspace_settings.name
        if is_data(image) or name in LINEAR_SPACES:
            return "linear"
        if file.endswith(FLOAT_FORMS):
            if name not in {"sRGB", ""} and file.endswith((".exr", ".hdr")) and image.source == "FILE":
                self.report.warn(25, "image '%s' has the colour space '%s'" % (image.name, name), "linear Rec.709")
            return "linear"
        if name not in {"sRGB", ""}:
            self.report.warn(25, "image '%s' has the colour space '%s'" % (image.name, name), "sRGB")
        return "srgb"

    def interpolation(self, node):
        if node.interpolation not in {"Linear", "Closest"}:
            self.report.warn(26, "node '%s' interpolation %s" % (node.name, node.interpolation), "bilinear")
        return "nearest" if node.interpolation == "Closest" else "bilinear"

    def extension(self, node):
        name = getattr(node, "extension", "REPEAT")
        if name not in {"REPEAT", "EXTEND", "CLIP"}:
            self.report.warn(26, "node '%s' extension %s" % (node.name, name), "repeat")
            name = "REPEAT"
        return name.lower()

    def lookup(self, found):
        """Texture coordinates of an image node: scale, rotation, offset, where they come from."""
        rows = ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0))
        at = self.socket(found, "Vector")
        while True:
            before = self.source(at)
            if before.node is None or before.node.bl_idname != "ShaderNodeMapping":
                break
            vectors = [self.color(before, n) for n in ("Location", "Rotation", "Scale")]
            place, _, scale = vectors
            if found.node.bl_idname == "ShaderNodeTexEnvironment" and (place[2] or len(set(scale)) > 1):
                self.report.warn(31, "node '%s' moves or stretches the environment" % before.node.name,
                                 "its rotation about Z")
            step, is_plane = plane_map(before.node.vector_type, *vectors)
            if not is_plane or before.node.vector_type == "NORMAL":
                self.report.warn(19, "node '%s' turns out of the plane" % before.node.name,
                                 "its part in the plane")
            rows = compose_plane(rows, step)
            at = self.socket(before, "Vector")
        scale, rotation, offset, exact = split_plane(rows)
        if not exact:
            self.report.warn(19, "the mapping of node '%s' shears" % found.node.name, "no shear")
        return scale, rotation, offset, self.coordinates(found, before)

    def coordinates(self, texture, found):
        """('uv', name), ('generated',) or ('object',)"""
        if found.node is None:
            return ("uv", "")
        node = found.node
        if node.bl_idname == "ShaderNodeUVMap":
            return ("uv", node.uv_map)
        if node.bl_idname == "ShaderNodeAttribute" and node.attribute_type == "GEOMETRY":
            return ("uv", node.attribute_name)
        if node.bl_idname == "ShaderNodeTexCoord":
            if found.output.name == "UV":
                return ("uv", "")
            if found.output.name == "Generated":
                return ("generated",)
            if found.output.name == "Object" and node.object is None:
                return ("object",)
        self.report.warn(19, "coordinates of node '%s' from node '%s' (%s)"
                         % (texture.node.name, node.name, found.output.name), "the UV map")
        return ("uv", "")


def is_data(image):
    """Numbers without a colour space."""
    settings = image.colorspace_settings
    return getattr(settings, "is_data", False) or settings.name in {"Non-Color", "Raw", "Generic Data"}


def group_output(tree):
    outputs = [n for n in tree.nodes if n.bl_idname == "NodeGroupOutput"]
    return next((n for n in outputs if n.is_active_output), outputs[0] if outputs else None)


def by_identifier(sockets, identifier):
    return next((s for s in sockets if s.identifier == identifier), None)


def default_value(socket):
    value = getattr(socket, "default_value", None)
    if value is None or isinstance(value, str):
        return number_value(0.0)
    if hasattr(value, "__len__"):
        return Value(tuple(value)[:3])
    return number_value(float(value))


def kind_of(node):
    """ShaderNodeTexNoise -> Tex Noise"""
    return re.sub(r"(?<=[a-z])(?=[A-Z])", " ", node.bl_idname.replace("ShaderNode", ""))


def fresnel_ior(values, found):
    """ior when the node is Fresnel or the Fresnel of a Layer Weight; None else."""
    if found.node is None:
        return None
    if found.node.bl_idname == "ShaderNodeFresnel":
        return values.number(found, "IOR", default=1.5)
    if found.node.bl_idname == "ShaderNodeLayerWeight" and found.output.name == "Fresnel":
        return 1 / max(1 - values.number(found, "Blend", default=0.5), 1e-5)
    return None


def facing_mean(values, found):
    """Mean of the Facing output of a Layer Weight over directions; None for other nodes."""
    if found.node is None or found.node.bl_idname != "ShaderNodeLayerWeight" or found.output.name != "Facing":
        return None
    blend = min(max(values.number(found, "Blend", default=0.5), 0.0), 1 - 1e-5)
    exponent = 2 * blend if blend < 0.5 else 0.5 / (1 - blend)
    return exponent / (exponent + 2)  # of 1 - cos^exponent


def from_mode(mode, a, b, c):
    import colorsys
    return {"HSV": colorsys.hsv_to_rgb, "HSL": lambda h, s, l: colorsys.hls_to_rgb(h, l, s)}.get(
        mode, lambda *rgb: rgb)(a, b, c)


def to_mode(mode, rgb):
    import colorsys
    if mode == "HSV":
        return colorsys.rgb_to_hsv(*rgb)
    if mode == "HSL":
        h, l, s = colorsys.rgb_to_hls(*rgb)
        return (h, s, l)
    return rgb


BLENDS = {
    "MIX": lambda a, b: b,
    "ADD": lambda a, b: a + b,
    "MULTIPLY": lambda a, b: a * b,
    "SUBTRACT": lambda a, b: a - b,
    "DIVIDE": lambda a, b: a / b if b else a,
    "DIFFERENCE": lambda a, b: abs(a - b),
    "DARKEN": min,
    "LIGHTEN": max,
    "SCREEN": lambda a, b: 1 - (1 - a) * (1 - b),
    "OVERLAY": lambda a, b: 2 * a * b if a < 0.5 else 1 - 2 * (1 - a) * (1 - b),
}

UNARY = {"SQRT", "ABSOLUTE", "ROUND", "FLOOR", "CEIL", "TRUNC", "FRACT", "SINE", "COSINE", "TANGENT",
         "EXPONENT", "INVERSE_SQRT", "RADIANS", "DEGREES", "SIGN"}
MATH = {
    "ADD": lambda a, b: a + b,
    "SUBTRACT": lambda a, b: a - b,
    "MULTIPLY": lambda a, b: a * b,
    "DIVIDE": lambda a, b: a / b,
    "MULTIPLY_ADD": lambda a, b, c: a * b + c,
    "POWER": lambda a, b: float(a**b) if a >= 0 or b == int(b) else 0.0,
    "LOGARITHM": lambda a, b: math.log(a) / math.log(b),
    "SQRT": math.sqrt,
    "INVERSE_SQRT": lambda a: 1 / math.sqrt(a),
    "ABSOLUTE": abs,
    "EXPONENT": math.exp,
    "MINIMUM": min,
    "MAXIMUM": max,
    "LESS_THAN": lambda a, b: float(a < b),
    "GREATER_THAN": lambda a, b: float(a > b),
    "COMPARE": lambda a, b, c: float(abs(a - b) <= max(c, 1e-5)),
    "SIGN": lambda a: float((a > 0) - (a < 0)),
    "ROUND": lambda a: math.floor(a + 0.5),
    "FLOOR": math.floor,
    "CEIL": math.ceil,
    "TRUNC": math.trunc,
    "FRACT": lambda a: a - math.floor(a),
    "MODULO": math.fmod,
    "SINE": math.sin,
    "COSINE": math.cos,
    "TANGENT": math.tan,
    "ARCTAN2": math.atan2,
    "RADIANS": math.radians,
    "DEGREES": math.degrees,
}
VECTOR_MATH = {
    "ADD": lambda a, b: a + b,
    "SUBTRACT": lambda a, b: a - b,
    "MULTIPLY": lambda a, b: a * b,
    "DIVIDE": lambda a, b: a / b if b else 0.0,
    "MINIMUM": min,
    "MAXIMUM": max,
}

VALUE_NODES = {
    "ShaderNodeRGB": Values.rgb,
    "ShaderNodeValue": Values.plain_number,
    "ShaderNodeTexImage": Values.image_texture,
    "ShaderNodeTexEnvironment": Values.image_texture,
    "ShaderNodeMixRGB": Values.mix,
    "ShaderNodeMix": Values.mix,
    "ShaderNodeMath": Values.math,
    "ShaderNodeVectorMath": Values.vector_math,
    "ShaderNodeInvert": Values.invert,
    "ShaderNodeGamma": Values.gamma,
    "ShaderNodeBrightContrast": Values.bright_contrast,
    "ShaderNodeHueSaturation": Values.hue_saturation,
    "ShaderNodeValToRGB": Values.color_ramp,
    "ShaderNodeClamp": Values.clamp,
    "ShaderNodeMapRange": Values.map_range,
    "ShaderNodeCombineColor": Values.combine,
    "ShaderNodeCombineRGB": Values.combine,
    "ShaderNodeCombineXYZ": Values.combine,
    "ShaderNodeCombineHSV": Values.combine_hsv,
    "ShaderNodeSeparateColor": Values.separate,
    "ShaderNodeSeparateRGB": Values.separate,
    "ShaderNodeSeparateXYZ": Values.separate,
    "ShaderNodeSeparateHSV": Values.separate_hsv,
    "ShaderNodeRGBToBW": Values.to_gray,
    "ShaderNodeBlackbody": Values.black_body,
    "ShaderNodeFresnel": Values.fresnel,
    "ShaderNodeLayerWeight": Values.fresnel,
    "ShaderNodeLightPath": Values.light_path,
    "ShaderNodeTexChecker": Values.checker,
}


# ---------------------------------------------------------------------------------------- 10 shaders


@dataclass(frozen=True)
class Normal:
    """What bends the normal: a normal map, a height map, or both."""
    normal_map: Optional[Texture] = None
    normal_strength: float = 1.0
    bump_map: Optional[Texture] = None
    bump_strength: float = 1.0
    bump_distance: float = 1.0


@dataclass(frozen=True)
class Factor:
    """A texture that multiplies a weight or a field: by its colour, or by 1 - strength times that."""
    texture: Texture
    without: bool = False
    strength: float = 1.0


@dataclass(frozen=True)
class Part:
    """A weight: a colour times textures."""
    rgb: tuple = WHITE
    factors: tuple = ()


def part_of(value):
    """A colour or number as a weight."""
    texture = value.texture
    if texture is None:
        return Part(value.rgb)
    return Part(value.rgb, (Factor(replace(texture, inverted=False), texture.inverted),))


def rest_of(value):
    """1 minus a number from 0 to 1, as a weight; None where no factor says it."""
    x, texture = gray(value.rgb), value.texture
    if texture is None:
        return Part(scaled(WHITE, 1 - x))
    if not texture.inverted:
        return Part(WHITE, (Factor(texture, True, x),))
    return Part(WHITE, (Factor(replace(texture, inverted=False)),)) if x == 1 else None


def all_of(*parts):
    """The product of weights."""
    rgb, factors = WHITE, ()
    for part in parts:
        rgb, factors = product(rgb, part.rgb), factors + part.factors
    return Part(rgb, factors)


# What fields are when they are left out, of those that often are.
USUAL = {"anisotropy": BLACK, "rotation": BLACK, "tint": WHITE, "edge_tint": WHITE, "reflect_tint": WHITE,
         "transmit_tint": WHITE, "specular": (0.5, 0.5, 0.5)}
COLORS = {"color", "tint", "edge_tint", "reflect_tint", "transmit_tint"}


@dataclass(frozen=True)
class Lobe:
    """One way in which a surface scatters light. A material is a sum of lobes, but that one that covers
    lies on those behind it, which get what it lets through. `kind` is the format's word; or 'emission', or
    'transparent', straight on.
    """
    kind: str
    part: Part = Part()
    fields: tuple = ()  # (name, Value)
    covers: bool = False
    normal: Optional[Normal] = None
    cover: Optional[Value] = None  # transparent: opacity of all the rest, when it is a texture

    @property
    def rgb(self):
        return self.part.rgb

    def times(self, part):
        return replace(self, part=all_of(part, self.part))

    def field(self, name):
        return dict(self.fields).get(name)

    def is_plain(self):
        """Reflects all colours at all angles alike."""
        return self.kind == "mirror" or (self.kind == "conductor" and self.field("color") == Value(WHITE))


def lobe(kind, part=Part(), normal=None, covers=False, **fields):
    """A lobe with these fields: Values, which end where the format's do."""
    given = []
    for name, value in fields.items():
        rgb = value.rgb if name in COLORS else (gray(value.rgb),) * 3
        if name == "ior":
            rgb = tuple(min(max(x, 1e-3 if kind in {"dielectric", "refraction"} else 1.0), 1000.0) for x in rgb)
        elif name == "anisotropy":
            rgb = tuple(min(max(x, -1.0), 1.0) for x in rgb)
        elif name != "rotation":
            rgb = clamped(rgb)
        if value.texture is not None and name not in COLORS:  # the renderer makes them grey
            value = replace(value, texture=replace(value.texture, grey=False))
        if value.texture is not None or rgb != USUAL.get(name):
            given.append((name, replace(value, rgb=rgb)))
    return Lobe(kind, part, tuple(given), covers, normal)


def all_times(lobes, factor):
    """`factor` is a number or a Part."""
    part = factor if isinstance(factor, Part) else Part(scaled(WHITE, factor))
    return [l if l.cover else l.times(part) for l in lobes] if any(part.rgb) else []


def is_transparent(lobes):
    return bool(lobes) and all(l.kind == "transparent" and not l.cover for l in lobes)


def segments_of(lobes):
    """([lobes before the first cover, behind it, behind the second ...], [covers])"""
    between, covers = [[]], []
    for l in lobes:
        if l.covers:
            covers.append(l)
            between.append([])
        else:
            between[-1].append(l)
    return between, covers


def mean_of_cover(l):
    """About the part of the light that a cover sends back, where its weight is 1."""
    if l.kind == "sheen":
        return 0.1
    level = gray((l.field("specular") or Value(USUAL["specular"])).rgb)
    return min(fresnel_mean(max(gray(l.field("ior").rgb), 1.0)) * 2 * level, 1.0)


class Shaders:
    """Evaluates shader sockets to lists of lobes."""

    def __init__(self, values, report):
        self.values = values
        self.report = report

    def lobes(self, at):
        found = self.values.source(at)
        if found.node is None:
            return []
        convert = SHADER_NODES.get(found.node.bl_idname)
        return convert(self, found) if convert else self.unknown(found)

    def unknown(self, found):
        """A node that we do not know: diffuse, in its own colour if it has one."""
        node = found.node
        color = self.values.socket(found, "Color", "Base Color")
        value = self.values.value(color) if color else Value(GRAY)
        if node.bl_idname in VALUE_NODES:  # Blender shows a colour as emission
            value = VALUE_NODES[node.bl_idname](self.values, found)
            return [Lobe("emission", part_of(value))]
        self.report.warn(12, "node '%s' (%s)" % (node.name, kind_of(node)), "diffuse")
        return [Lobe("diffuse", part_of(value))]

    # ---- sums

    def add(self, found):
        first, second = (self.lobes(Socket(s, found.path)) for s in found.node.inputs[:2])
        return self.joined(found, first, second)

    def mix(self, found):
        first, second = (self.lobes(Socket(s, found.path)) for s in found.node.inputs[1:3])
        at = Socket(found.node.inputs[0], found.path)
        chooser = self.values.source(at)
        ior = fresnel_ior(self.values, chooser)
        if ior is not None:
            return self.mix_by_fresnel(found, first, second, min(max(ior, 1.0), 1000.0))
        facing = facing_mean(self.values, chooser)
        if facing is not None:
            return self.mix_by_facing(found, first, second, facing)
        factor = self.values.as_number(found, self.values.value(at))
        if factor.texture is not None:
            if is_transparent(first):
                return second + self.cut_out(first, factor)
            if is_transparent(second) and factor.rgb == WHITE:
                texture = replace(factor.texture, inverted=not factor.texture.inverted)
                return first + self.cut_out(second, Value(WHITE, texture))
        see_through = any(l.kind == "transparent" for l in first + second)
        factor = self.fraction(found, factor, needs_constant=see_through)
        return self.joined(found, first, second, rest_of(factor), part_of(factor))

    def fraction(self, found, value, needs_constant=False):
        """A number from 0 to 1 whose rest can be said, too."""
        value = replace(value, rgb=clamped(value.rgb))
        if value.texture is not None and (needs_constant or rest_of(value) is None):
            self.report.warn(14, "node '%s' mixes by a texture" % found.node.name, "its mean")
            value = Value(self.values.constant(value))
        return value

    def joined(self, found, first, second, part=None, other=None):
        """The sum of two lists, times their parts. Layers that both have alike are one; a list without
        layers lies beside the other's."""
        lists = [all_times(l, p) if p else l for l, p in ((first, part), (second, other))]
        if not all(lists):
            return lists[0] + lists[1]
        (between, covers), (between2, covers2) = map(segments_of, lists)
        if covers and not covers2:
            return lists[1] + lists[0]
        if covers:
            own, own2 = segments_of(first)[1], segments_of(second)[1]
            if part is None or own != own2:
                self.report.warn(16, "node '%s' has layers on both sides" % found.node.name, "the mean of the second's")
                return self.joined(found, lists[0], self.unlayered(lists[1]))
            out = between[0] + between2[0]
            for cover, a, b in zip(own, between[1:], between2[1:]):
                out += [cover] + a + b
            return out
        return lists[0] + lists[1]

    @staticmethod
    def unlayered(lobes):
        """Covers as lobes beside the others, which get less in turn."""
        out, left = [], 1.0
        for l in lobes:
            out.append(replace(l.times(Part(scaled(WHITE, left))), covers=False) if not l.cover else l)
            if l.covers:
                left *= 1 - min(max(l.rgb), 1.0) * mean_of_cover(l)
        return out

    @staticmethod
    def cut_out(transparent, opacity):
        filter_color = BLACK
        for l in transparent:
            filter_color = plus(filter_color, l.rgb)
        return [Lobe("transparent", Part(filter_color), cover=opacity)]

    def mix_by_fresnel(self, found, first, second, ior):
        """The usual lacquer: a layer that reflects as a dielectric, or, on refraction, glass."""
        plain = [l for l in second if l.is_plain()]
        if len(plain) < len(second):
            self.report.warn(16, "node '%s' mixes %s by Fresnel" % (found.node.name, next(
                l.kind for l in second if not l.is_plain())), "its mean")
            return self.joined(found, all_times(first, 1 - fresnel_mean(ior)), all_times(second, fresnel_mean(ior)))
        ior = number_value(ior)
        rough = lambda l: l.field("roughness") or number_value(0.0)
        if len(plain) == 1 and [l.kind for l in first] == ["refraction"] and not first[0].part.factors \
                and not plain[0].part.factors:
            return [lobe("dielectric", Part(), plain[0].normal, ior=ior, reflect_tint=Value(plain[0].rgb),
                         transmit_tint=Value(first[0].rgb), roughness=rough(plain[0]))]
        layers = [lobe("glossy_dielectric", l.part, l.normal, True, ior=ior, roughness=rough(l),
                       **{n: v for n, v in l.fields if n in ("anisotropy", "rotation")}) for l in plain]
        return [l for l in first if l.kind in {"emission", "transparent"}] + layers + [
            l for l in first if l.kind not in {"emission", "transparent"}]

    def mix_by_facing(self, found, first, second, mean):
        """Schlick's curve with the same mean; (1 - cos) and its powers have no exact form here."""
        self.report.warn(16, "node '%s' mixes by Facing" % found.node.name, "Schlick's Fresnel of the same mean")
        f0 = number_value(max((mean - 1 / 21) * 21 / 20, 0.0))
        out = []
        for l in second:
            if l.kind == "mirror":
                out.append(lobe("schlick_mirror", l.part, l.normal, color=f0))
            elif l.is_plain():
                out.append(lobe("conductor", l.part, l.normal, **{**dict(l.fields), "color": f0}))
            else:
                out.append(l.times(Part(scaled(WHITE, mean))))
        return self.joined(found, all_times(first, 1 - mean), out)

    # ---- single lobes

    def diffuse(self, found):
        color, roughness = part_of(self.values.input(found, "Color")), self.values.input(found, "Roughness")
        return [self.rough_diffuse(color, roughness, self.normal(found))]

    @staticmethod
    def rough_diffuse(part, roughness, normal):
        if roughness.texture is None and not any(roughness.rgb):
            return Lobe("diffuse", part, normal=normal)
        if part.factors or max(part.rgb) > 1:
            return lobe("oren_nayar", part, normal, roughness=roughness)
        return lobe("oren_nayar", Part(), normal, color=Value(part.rgb), roughness=roughness)

    def like_diffuse(self, found):
        """Shaders that scatter light in ways that we lack."""
        self.report.warn(12, "node '%s' (%s)" % (found.node.name, kind_of(found.node)), "diffuse")
        return [Lobe("diffuse", part_of(self.values.input(found, "Color", "Base Color")), normal=self.normal(found))]

    def translucent(self, found):
        return [Lobe("translucent", part_of(self.values.input(found, "Color")), normal=self.normal(found))]

    def sheen(self, found):
        if found.node.bl_idname == "ShaderNodeBsdfVelvet" or found.node.distribution == "ASHIKHMIN":
            self.report.warn(12, "node '%s' (velvet of Ashikhmin)" % found.node.name, "fibres")
        roughness = self.values.input(found, "Roughness", "Sigma", default=0.5)
        return [lobe("sheen", part_of(self.values.input(found, "Color")), self.normal(found), roughness=roughness)]

    def glossy(self, found):
        """The same reflectance at all angles."""
        part, normal = part_of(self.values.input(found, "Color")), self.normal(found)
        roughness = self.roughness(found)
        if roughness.texture is None and gray(roughness.rgb) < SHARP:
            return [Lobe("mirror", part, normal=normal)]
        if getattr(found.node, "distribution", "") == "ASHIKHMIN_SHIRLEY" and roughness.texture is None:
            return [Lobe("ashikhmin", part, (("exponent", number_value(exponent_of(gray(roughness.rgb)))),), normal=normal)]
        return [lobe("conductor", part, normal, color=Value(WHITE), roughness=roughness, **self.stretch(found))]

    def stretch(self, found):
        """Anisotropy and rotation of a node whose widths are those of the roughness times and over
        1 - anisotropy; the format has the aspect of Principled, sqrt(1 - 0.9 anisotropy)."""
        a = self.values.number(found, "Anisotropy")
        square = (1 - min(abs(a), 1.0)) ** 2
        return dict(anisotropy=number_value(math.copysign(min((1 - square) / 0.9, 1.0), -a) if a else 0.0),
                    rotation=number_value(self.values.number(found, "Rotation")))

    def metallic(self, found):
        """Metallic BSDF (4.3): reflectance straight on and near the edge."""
        self.ignored(found, (("Thin Film Thickness",),))
        if getattr(found.node, "fresnel_type", "F82") != "F82":
            self.report.warn(13, "node '%s' is a metal by its IOR" % found.node.name, "by its colours")
        return [lobe("conductor", Part(), self.normal(found), color=self.values.input(found, "Base Color"),
                     edge_tint=self.values.input(found, "Edge Tint", default=1.0), roughness=self.roughness(found),
                     **self.stretch(found))]

    def glass(self, found):
        color = self.values.input(found, "Color")
        self.ignored(found, (("Thin Film Thickness",),))
        return [lobe("dielectric", Part(), self.normal(found), ior=number_value(self.ior(found, 1.45)),
                     reflect_tint=color, transmit_tint=color, roughness=self.roughness(found))]

    def refraction(self, found):
        return [lobe("refraction", part_of(self.values.input(found, "Color")), self.normal(found),
                     ior=number_value(self.ior(found, 1.45)), roughness=self.roughness(found))]

    def transparent(self, found):
        return [Lobe("transparent", Part(self.values.color(found, "Color")))]

    def emission(self, found):
        strength = self.values.number(found, "Strength", default=1.0)
        return all_times([Lobe("emission", part_of(self.values.input(found, "Color")))], strength)

    def holdout(self, found):
        self.report.warn(12, "node '%s' (Holdout)" % found.node.name, "black")
        return []

    def eevee_specular(self, found):
        color, normal = self.values.input(found, "Specular"), self.normal(found)
        lobes = [
            Lobe("diffuse", part_of(self.values.input(found, "Base Color")), normal=normal),
            lobe("conductor", Part(), normal, color=color, roughness=self.roughness(found)),
            Lobe("emission", part_of(self.values.input(found, "Emissive Color"))),
        ]
        clear = self.values.number(found, "Transparency")
        return all_times(lobes, 1 - clear) + all_times([Lobe("transparent")], clear)

    # ---- Principled

    def principled(self, found):
        """Cycles' all-purpose shader as 4.x layers it: sheen on varnish on metal, glass, and plastic, which
        is a layer that reflects on a diffuse base. Before 4.0 some sockets had other names and scales."""
        values, normal = self.values, self.normal(found)
        is_new = values.socket(found, "Coat Weight") is not None
        number = lambda *names: self.fraction(found, values.as_number(found, values.input(found, *names)))
        base = values.input(found, "Base Color")
        metal, clear = number("Metallic"), number("Transmission Weight", "Transmission")
        solid = rest_of(metal)
        glass, plastic = all_of(solid, part_of(clear)), all_of(solid, rest_of(clear))
        ior = number_value(max(self.ior(found, 1.45), 1.0))
        tint = values.input(found, "Specular Tint") if is_new else Value(WHITE)
        roughness = self.roughness(found)
        turned = dict(anisotropy=number_value(values.number(found, "Anisotropic")),
                      rotation=number_value(values.number(found, "Anisotropic Rotation")))
        self.ignored(found, PRINCIPLED_IGNORED + (() if is_new else (("Specular Tint",),)))

        sheen, coat = number("Sheen Weight", "Sheen"), number("Coat Weight", "Clearcoat")
        sheen_tint = values.input(found, "Sheen Tint") if is_new else Value(WHITE)
        coat_tint = values.input(found, "Coat Tint") if is_new else Value(WHITE)
        level = values.input(found, "Specular IOR Level", "Specular", default=0.5)
        lobes = [
            lobe("sheen", all_of(part_of(sheen), part_of(sheen_tint)), normal, True,
                 roughness=values.input(found, "Sheen Roughness", default=0.5)),
            lobe("coat", all_of(part_of(coat), Part(scaled(WHITE, 1.0 if is_new else 0.25))), normal, True,
                 ior=number_value(values.number(found, "Coat IOR", default=1.5)), tint=coat_tint,
                 roughness=values.input(found, "Coat Roughness", "Clearcoat Roughness", default=0.03)),
            lobe("conductor", part_of(metal), normal, color=base, edge_tint=tint, roughness=roughness, **turned),
        ]
        if any(glass.rgb):
            through = base
            if is_new:  # light is coloured by the base colour after two boundaries, before 4.0 at each
                if base.texture:
                    self.report.warn(14, "node '%s' has a texture on transmission" % found.node.name, "its mean")
                through = Value(tuple(math.sqrt(max(x, 0.0)) for x in values.constant(base)))
            lobes.append(lobe("dielectric", glass, normal, ior=ior, reflect_tint=tint, transmit_tint=through,
                              roughness=roughness))
        if any(level.rgb):  # before 4.0 it alone said how much is reflected
            lobes.append(lobe("glossy_dielectric", plastic, normal, True, ior=ior if is_new else number_value(1.5),
                              tint=tint, roughness=roughness, specular=level, **turned))
        diffuse_roughness = values.input(found, "Diffuse Roughness") if is_new else number_value(0.0)
        lobes.append(self.rough_diffuse(all_of(plastic, part_of(base)), diffuse_roughness, normal))

        glow = values.input(found, "Emission Color", "Emission")
        strength = values.number(found, "Emission Strength", default=0.0)
        lobes = all_times([Lobe("emission", part_of(glow))], strength) + [l for l in lobes if any(l.rgb)]
        return self.with_alpha(lobes, values.input(found, "Alpha", default=1.0))

    @staticmethod
    def with_alpha(lobes, alpha):
        if alpha.texture is not None:
            return lobes + [Lobe("transparent", cover=alpha)]
        a = min(max(gray(alpha.rgb), 0.0), 1.0)
        return lobes if a == 1 else all_times(lobes, a) + [Lobe("transparent", Part(scaled(WHITE, 1 - a)))]

    # ---- inputs

    def ior(self, found, default):
        """As Cycles and the renderer take it."""
        ior = self.values.number(found, "IOR", default=default)
        return within(ior, 1e-3, 1000.0, "the IOR of node '%s'" % found.node.name, self.report)

    def roughness(self, found):
        if getattr(found.node, "distribution", "") == "SHARP":  # up to 3.6
            return number_value(0.0)
        return self.values.input(found, "Roughness")

    def ignored(self, found, inputs):
        """Warns of each input that has an effect in Blender and none here."""
        for names in inputs:
            at = self.values.socket(found, *names)
            if at is None:
                continue
            value = self.values.value(at)
            if value.texture is not None or any(abs(x) > 1e-6 for x in value.rgb):
                self.report.warn(13, "node '%s' uses '%s'" % (found.node.name, at.socket.name), "0")

    def normal(self, found):
        at = self.values.socket(found, "Normal")
        return self.normal_at(at) if at else None

    def normal_at(self, at):
        found = self.values.source(at)
        if found.node is None:
            return None
        if found.node.bl_idname == "ShaderNodeNormalMap":
            return self.normal_map(found)
        if found.node.bl_idname == "ShaderNodeBump":
            return self.bump(found)
        self.report.warn(12, "node '%s' (%s) as a normal" % (found.node.name, kind_of(found.node)),
                         "the plain normal")
        return None

    def normal_map(self, found):
        color = self.values.input(found, "Color")
        if color.texture is None:
            return None
        if found.node.space != "TANGENT":
            self.report.warn(12, "node '%s' space %s" % (found.node.name, found.node.space), "no normal map")
            return None
        return Normal(normal_map=color.texture, normal_strength=max(self.values.number(found, "Strength"), 0.0))

    def bump(self, found):
        below = self.values.socket(found, "Normal")
        normal = self.normal_at(below) if below else None
        height = self.values.input(found, "Height")
        if height.texture is None:
            return normal
        sign = -1.0 if found.node.invert else 1.0
        sign *= -1.0 if height.texture.inverted else 1.0
        if normal is not None and normal.bump_map is not None:
            self.report.warn(17, "node '%s' on another bump" % found.node.name, "this one alone")
        return replace(
            normal or Normal(), bump_map=replace(height.texture, inverted=False),
            bump_strength=min(max(self.values.number(found, "Strength"), 0.0), 1.0),
            bump_distance=sign * self.values.number(found, "Distance") * gray(height.rgb))


PRINCIPLED_IGNORED = (
    ("Subsurface Weight", "Subsurface"),
    ("Thin Film Thickness",),
)

SHADER_NODES = {
    "ShaderNodeAddShader": Shaders.add,
    "ShaderNodeMixShader": Shaders.mix,
    "ShaderNodeBsdfDiffuse": Shaders.diffuse,
    "ShaderNodeBsdfGlossy": Shaders.glossy,
    "ShaderNodeBsdfAnisotropic": Shaders.glossy,
    "ShaderNodeBsdfMetallic": Shaders.metallic,
    "ShaderNodeBsdfGlass": Shaders.glass,
    "ShaderNodeBsdfRefraction": Shaders.refraction,
    "ShaderNodeBsdfTransparent": Shaders.transparent,
    "ShaderNodeBsdfPrincipled": Shaders.principled,
    "ShaderNodeEeveeSpecular": Shaders.eevee_specular,
    "ShaderNodeEmission": Shaders.emission,
    "ShaderNodeBackground": Shaders.emission,
    "ShaderNodeHoldout": Shaders.holdout,
    "ShaderNodeBsdfTranslucent": Shaders.translucent,
    "ShaderNodeBsdfVelvet": Shaders.sheen,
    "ShaderNodeBsdfSheen": Shaders.sheen,
    "ShaderNodeBsdfToon": Shaders.like_diffuse,
    "ShaderNodeBsdfHair": Shaders.like_diffuse,
    "ShaderNodeBsdfHairPrincipled": Shaders.like_diffuse,
    "ShaderNodeSubsurfaceScattering": Shaders.like_diffuse,
}


# -------------------------------------------------------------------------------------- 11 materials

SHARP = 1e-3  # below this roughness Cycles takes a mirror
FAINT = 1e-3  # what glows less lights nothing that could be seen
MOST_LOBES = 8


def exponent_of(roughness):
    return min(max(2 / max(roughness, 1e-3) ** 4 - 2, 1.0), 1e5)


@dataclass
class Material:
    """A material block."""
    name: str
    diffuse: tuple = BLACK
    diffuse_texture: Optional[Texture] = None
    emission: tuple = BLACK
    emission_texture: Optional[Texture] = None
    gives_light: bool = True
    opacity: float = 1.0
    opacity_texture: Optional[Texture] = None
    filter: tuple = WHITE
    normal: Normal = Normal()
    lobes: tuple = ()
    is_volume: bool = False  # has no surface

    def textures(self):
        found = [self.diffuse_texture, self.emission_texture, self.opacity_texture,
                 self.normal.normal_map, self.normal.bump_map]
        for l in self.lobes:
            found += [f.texture for f in l.part.factors] + [v.texture for _, v in l.fields]
        return [t for t in found if t is not None]

    def coordinates(self):
        """Where its texture coordinates come from; None when it needs none."""
        textures = self.textures()
        return textures[0].coordinates if textures else None

    def lights(self):
        return self.gives_light and max(self.emission) > FAINT

    def put(self, text, name_of):
        """`name_of` gives the name of a texture."""
        with text.block("material", self.name):
            if any(self.diffuse) or not self.lobes:
                text.put("diffuse", self.diffuse)
                self.put_texture(text, "diffuse_texture", self.diffuse_texture, name_of)
            for l in self.lobes:
                self.put_lobe(text, l, name_of)
            text.put_unless(BLACK, "emission", self.emission)
            self.put_texture(text, "emission_texture", self.emission_texture, name_of)
            text.put_unless(False, "emission_lights", self.lights())
            text.put_unless(1, "opacity", self.opacity)
            self.put_texture(text, "opacity_texture", self.opacity_texture, name_of)
            text.put_unless(WHITE, "filter", self.filter)
            normal = self.normal
            if normal.normal_map:
                self.put_texture(text, "normal_map", normal.normal_map, name_of)
                text.put_unless(1, "normal_strength", normal.normal_strength)
            if normal.bump_map:
                self.put_texture(text, "bump_map", normal.bump_map, name_of)
                text.put_unless(1, "bump_strength", normal.bump_strength)
                text.put_unless(1, "bump_distance", normal.bump_distance)

    @staticmethod
    def put_texture(text, keyword, texture, name_of):
        if texture is not None:
            text.put(keyword, word(name_of(texture)))

    @staticmethod
    def put_lobe(text, l, name_of):
        words = [l.kind]

        def value(keyword, rgb, factors, is_color):
            words.extend([keyword, *map(number, rgb if is_color else rgb[:1])])
            for factor in factors:
                words.extend(["without" if factor.without else "times", word(name_of(factor.texture))])
                if factor.strength != 1:
                    words.append(number(factor.strength))

        if l.part != Part():
            value("weight", l.part.rgb, l.part.factors, True)
        for name, given in l.fields:
            value(name, given.rgb, part_of(given).factors, name in COLORS)
        text.put("lobe", *words, *(["covers"] if l.covers else []))


class Folder:
    """Makes a Material of lobes."""

    def __init__(self, values, report):
        self.values = values
        self.report = report

    def fold(self, name, lobes):
        material = Material(name)
        solid = self.fold_opacity(material, [l for l in lobes if any(l.rgb) or l.cover])
        material.emission, material.emission_texture = self.sum("emission", solid)
        rest = self.united([l for l in solid if l.kind != "emission"])
        if not any(l.covers for l in rest):
            rest = self.fold_diffuse(material, rest)
        material.lobes = tuple(self.fewer(rest))
        self.fold_normal(material, solid)
        coordinates = {t.coordinates for t in material.textures()}
        if len(coordinates) > 1:
            self.report.warn(18, "its textures use several coordinates", "those of the first")
        return self.safe(material)

    def fold_opacity(self, material, lobes):
        """Takes the transparent lobes out; the others are scaled up to what is left for them."""
        solid = [l for l in lobes if l.kind != "transparent"]
        for l in lobes:
            if l.cover:
                material.opacity = min(max(gray(l.cover.rgb), 0.0), 1.0)
                material.opacity_texture = l.cover.texture
                material.filter = l.rgb
        through = BLACK
        for l in lobes:
            if l.kind == "transparent" and not l.cover:
                through = plus(through, l.rgb)
        part = max(through)
        if part <= 0:
            return solid
        if not solid:
            material.opacity, material.filter = 0.0, through
            return solid
        if part > 1 - 1e-6:  # added, not mixed: opacity only has to be neither 0 nor 1
            part = 0.5
        material.opacity, material.filter = 1 - part, scaled(through, 1 / part)
        return all_times(solid, 1 / (1 - part))

    @staticmethod
    def texture_of(l):
        """(whether a keyword with one texture says its weight, that texture)"""
        factors = l.part.factors
        if len(factors) > 1 or any(f.strength != 1 for f in factors):
            return False, None
        return True, replace(factors[0].texture, inverted=factors[0].without) if factors else None

    def constant(self, l):
        """Its weight; textures count with their means."""
        rgb = l.rgb
        for f in l.part.factors:
            mean = self.values.images.mean(f.texture)
            rgb = product(rgb, [1 - f.strength * x for x in mean] if f.without else mean)
        return rgb

    def sum(self, kind, lobes):
        """Sum of one kind of lobes: (colour, texture). A texture survives when it is alone."""
        lobes = [l for l in lobes if l.kind == kind]
        found = {self.texture_of(l) for l in lobes}
        total = BLACK
        if len(found) == 1 and next(iter(found))[0]:
            for l in lobes:
                total = plus(total, l.rgb)
            return total, found.pop()[1]
        for l in lobes:
            total = plus(total, self.constant(l))
        if any(l.part.factors for l in lobes):
            self.report.warn(14, "a texture in a sum of %s parts" % kind, "its mean")
        return total, None

    @staticmethod
    def united(lobes):
        """Lobes that differ in nothing but their weights are one, as long as no cover lies between."""
        out = []
        for l in lobes:
            same = next((i for i, o in enumerate(out) if not l.covers and not any(c.covers for c in out[i:])
                         and replace(o, part=l.part) == l and o.part.factors == l.part.factors), None)
            if same is None:
                out.append(l)
            else:
                out[same] = replace(l, part=Part(plus(out[same].rgb, l.rgb), l.part.factors))
        return out

    def fold_diffuse(self, material, lobes):
        """The keywords for diffuse say one such lobe with at most one texture; returns the others."""
        found = [l for l in lobes if l.kind == "diffuse"]
        if len(found) != 1 or not self.texture_of(found[0])[0]:
            return lobes
        material.diffuse, material.diffuse_texture = found[0].rgb, self.texture_of(found[0])[1]
        return [l for l in lobes if l.kind != "diffuse"]

    def fewer(self, lobes):
        if len(lobes) > MOST_LOBES:
            self.report.warn(15, "%d lobes" % len(lobes), "the strongest %d" % MOST_LOBES)
            strong = sorted(lobes, key=lambda l: -max(self.constant(l)))[:MOST_LOBES]
            lobes = [l for l in lobes if l in strong]
        return lobes

    def fold_normal(self, material, lobes):
        bent = [l.normal for l in lobes if l.kind not in {"emission", "transparent"}]
        normals = {n for n in bent if n is not None}
        if not normals:
            return
        material.normal = next(n for n in bent if n is not None)
        if len(normals) > 1 or None in bent:
            self.report.warn(17, "its parts have different normals", "one for all")

    def safe(self, material):
        """The format takes no negative colours."""
        for name in ("diffuse", "emission", "filter"):
            setattr(material, name, self.safe_color(name, getattr(material, name)))
        material.lobes = tuple(
            replace(l, part=replace(l.part, rgb=self.safe_color("weight of " + l.kind, l.rgb)),
                    fields=tuple((n, replace(v, rgb=tuple(x if math.isfinite(x) else 0.0 for x in v.rgb)))
                                 for n, v in l.fields)) for l in material.lobes)
        normal = material.normal
        distance = normal.bump_distance
        if not math.isfinite(distance):
            self.report.warn(11, "its bump distance is not finite", "0")
            distance = 0.0
        material.normal = replace(
            normal, bump_distance=distance,
            normal_strength=within(normal.normal_strength, 0.0, 1000.0, "its normal strength", self.report))
        return material

    def safe_color(self, name, color):
        if not all(math.isfinite(x) for x in color):
            self.report.warn(11, "its %s is not finite" % name, "0")
            color = BLACK
        return tuple(within(max(x, 0.0), 0.0, 1e15, "its %s" % name, self.report) for x in color)


# ------------------------------------------------------------------------------------------ 12 world

SKY = (0.3, 0.45, 0.7)


def sky_texture(values, found):
    values.report.warn(30, "node '%s' (Sky Texture)" % found.node.name, "an even blue")
    return Value(SKY)


VALUE_NODES["ShaderNodeTexSky"] = sky_texture


def world_light(scene, shaders, folder, report):
    """(colour, texture, rotation of the texture in degrees, whether it lights surfaces)"""
    world = scene.world
    if world is None:
        return BLACK, None, 0.0, False
    with report.at("world", world.name):
        rays = getattr(world, "cycles_visibility", None)
        hidden = [kind for kind in ("camera", "glossy", "transmission") if not getattr(rays, kind, True)]
        lights = getattr(rays, "diffuse", True)
        if hidden:
            report.warn(39, "it is hidden from %s rays" % ", ".join(hidden), "all rays see it")
        if not getattr(world, "use_nodes", True) or world.node_tree is None:
            return folder.safe(Material("world", emission=tuple(world.color))).emission, None, 0.0, lights
        output = world.node_tree.get_output_node("CYCLES") or world.node_tree.get_output_node("ALL")
        if output is None:
            return BLACK, None, 0.0, False
        if output.inputs["Volume"].is_linked:
            report.warn(21, "a volume", "none")
        lobes = shaders.lobes(Socket(output.inputs["Surface"], ()))
        if any(l.kind != "emission" for l in lobes):
            report.warn(30, "shaders other than Background", "left out")
        material = folder.fold("world", [l for l in lobes if l.kind == "emission"])
        texture = material.emission_texture
        return material.emission, texture, environment_rotation(texture, report) if texture else 0.0, lights


def environment_rotation(texture, report):
    """The node turns the direction that is looked up; the picture turns the other way."""
    scale, rotation = texture.scale, texture.rotation
    if scale == (-1, -1):
        scale, rotation = (1.0, 1.0), rotation + 180
    if scale != (1, 1) or texture.offset != (0, 0):
        report.warn(31, "mapping of the environment", "its rotation about Z")
    return -rotation


def environment_texture(values, found):
    if found.node.projection != "EQUIRECTANGULAR":
        values.report.warn(31, "projection %s" % found.node.projection, "equirectangular")
    return values.image_texture(found)


VALUE_NODES["ShaderNodeTexEnvironment"] = environment_texture


# ----------------------------------------------------------------------------------------- 13 shapes

# A mesh counts as a sphere when its vertices lie on an ellipsoid along its axes to SPHERE_ERROR of
# the radius, it is closed and smooth, faces outwards, and its faces come within SAGITTA of the
# ellipsoid, so that it renders as the mesh does and no tight shell lies between. A UV sphere of 64x32
# is off by 0.0024, of 32x16 by 0.0096.
SPHERE_ERROR = 1e-5
SPHERE_MAX_VERTICES = 40000
SAGITTA = 0.0025


@dataclass
class Shape:
    """A record of the format: its kind and how it sits inside its object."""
    kind: str
    rows: tuple = IDENTITY
    corners: Optional[list] = None
    top_radius: float = 0.0


def read(collection, attribute, code, width):
    """foreach_get into an array; without numpy this is the fast way."""
    data = array(code, bytes(array(code).itemsize * len(collection) * width))
    if len(data):
        collection.foreach_get(attribute, data)
    return data


def box_rows(low, high):
    """Maps [-1,1]^3 onto a box."""
    center = [tidy((a + b) / 2) for a, b in zip(low, high)]
    half = [tidy((b - a) / 2) for a, b in zip(low, high)]
    return tuple(tuple(half[i] if i == j else 0.0 for j in range(3)) + (center[i],) for i in range(3))


def bounds(points):
    planes = [points[i::3] for i in range(3)]
    return [min(p) for p in planes], [max(p) for p in planes]


def is_closed(mesh):
    return len(mesh.loops) == 2 * len(mesh.edges) and len(mesh.vertices) - len(mesh.edges) + len(mesh.polygons) == 2


def recognise(mesh):
    """The record that renders as the mesh does; None when it is just a mesh."""
    if mesh.has_custom_normals:
        return None
    vertices, faces = len(mesh.vertices), len(mesh.polygons)
    if vertices == 4 and faces == 1:
        return recognise_plane(mesh)
    if not is_closed(mesh):
        return None
    if vertices == 8 and faces == 6:
        return recognise_cube(mesh)
    if 42 <= vertices <= SPHERE_MAX_VERTICES and normals_domain(mesh) == "POINT":
        shape = recognise_sphere(mesh, SAGITTA)
        return shape if shape and faces_outwards(mesh, column(shape.rows, 3)) else None
    return None


def recognise_plane(mesh):
    """A flat convex quadrilateral by the renderer's own rule (faultOfCorners in Code/desc), in double as
    there, with narrower limits."""
    face = mesh.polygons[0]
    if len(face.vertices) != 4:
        return None
    c = [tuple(mesh.vertices[i].co) for i in face.vertices]
    normal = cross(difference(c[2], c[0]), difference(c[3], c[1]))
    size = max(length(difference(c[2], c[0])), length(difference(c[3], c[1])))
    if not length(normal) > 1e-9 * size * size:
        return None
    normal = [x / length(normal) for x in normal]
    if not abs(dot(normal, difference(c[1], c[0]))) <= 1e-6 * size:
        return None
    for i in range(4):
        turn = cross(difference(c[(i + 1) % 4], c[i]), difference(c[(i + 2) % 4], c[(i + 1) % 4]))
        if not dot(turn, normal) > 1e-6 * size * size:
            return None
    return Shape("plane", corners=[x for corner in c for x in corner])


def faces_outwards(mesh, center):
    normals, centers = read(mesh.polygons, "normal", "f", 3), read(mesh.polygons, "center", "f", 3)
    return all(
        sum(normals[i + k] * (centers[i + k] - center[k]) for k in range(3)) > 0
        for i in range(0, len(normals), 3))


def recognise_cube(mesh):
    points = read(mesh.vertices, "co", "f", 3)
    low, high = bounds(points)
    if any(read(mesh.polygons, "use_smooth", "b", 1)):
        return None
    size = max(b - a for a, b in zip(low, high))
    if min(b - a for a, b in zip(low, high)) <= 1e-6 * size:
        return None
    corners = set()
    for i in range(0, 24, 3):
        at = []
        for k in range(3):
            nearest = low[k] if abs(points[i + k] - low[k]) < abs(points[i + k] - high[k]) else high[k]
            if abs(points[i + k] - nearest) > 1e-6 * size:
                return None
            at.append(nearest)
        corners.add(tuple(at))
    if len(corners) != 8 or not faces_outwards(mesh, [(a + b) / 2 for a, b in zip(low, high)]):
        return None
    if any(max(abs(x) for x in face.normal) < 0.999 for face in mesh.polygons):
        return None
    return Shape("cube", box_rows(low, high))


def solve3(m, v):
    """Cramer's rule; None for a singular system."""
    det = lambda a: (a[0][0] * (a[1][1] * a[2][2] - a[1][2] * a[2][1])
                     - a[0][1] * (a[1][0] * a[2][2] - a[1][2] * a[2][0])
                     + a[0][2] * (a[1][0] * a[2][1] - a[1][1] * a[2][0]))
    whole = det(m)
    if whole == 0:
        return None
    return [det([[v[i] if k == j else m[i][k] for k in range(3)] for i in range(3)]) / whole for j in range(3)]


def recognise_sphere(mesh, sagitta):
    """A ball whose faces lie no deeper than that part of its radius, whichever way they face. Least squares for a x^2 + b y^2 + c z^2 = 1 about the centroid."""
    points = read(mesh.vertices, "co", "f", 3)
    count = len(points) // 3
    low, high = bounds(points)
    half = [(b - a) / 2 for a, b in zip(low, high)]
    if min(half) <= 0:
        return None
    center = [sum(points[k::3]) / count for k in range(3)]
    squares = [[((x - center[k]) / half[k]) ** 2 for x in points[k::3]] for k in range(3)]
    total = [sum(a + b + c for a, b, c in zip(*squares)) / count]
    if not 0.8 < total[0] < 1.3:  # of a sphere about 1; most meshes stop here
        return None
    m = [[sum(x * y for x, y in zip(a, b)) for b in squares] for a in squares]
    fit = solve3(m, [sum(a) for a in squares])
    if fit is None or min(fit) <= 0:
        return None
    if any(abs(sum(f * s for f, s in zip(fit, at)) - 1) > 2 * SPHERE_ERROR for at in zip(*squares)):
        return None
    axes = [h / math.sqrt(f) for h, f in zip(half, fit)]
    centers = read(mesh.polygons, "center", "f", 3)
    if min(length([(centers[i + k] - center[k]) / axes[k] for k in range(3)])
           for i in range(0, len(centers), 3)) < 1 - sagitta:
        return None
    if max(axes) - min(axes) < 4 * SPHERE_ERROR * max(axes):
        axes = [sum(axes) / 3] * 3
    near = lambda x, size: round(x / size, 5) * size if abs(x / size - round(x / size, 5)) < 2e-6 else x
    size = max(axes)
    center = [0.0 if abs(x) < SPHERE_ERROR * size else x for x in center]
    axes = [near(x, 1.0) for x in axes]
    rows = tuple(tuple(axes[i] if i == j else 0.0 for j in range(3)) + (center[i],) for i in range(3))
    return Shape("sphere", rows)


def wanted_shape(mesh, wanted):
    """The record that the custom property rt_shape asks for, fitted into the mesh's box."""
    points = read(mesh.vertices, "co", "f", 3)
    if not points:
        return None
    low, high = bounds(points)
    if wanted in {"plane", "disk", "infinite_plane"}:
        high[2] = low[2] = (low[2] + high[2]) / 2
        if wanted == "plane":
            found = recognise_plane(mesh) if len(mesh.vertices) == 4 and len(mesh.polygons) == 1 else None
            (a, b, z), (c, d, _) = low, high
            return found or Shape("plane", corners=[a, b, z, c, b, z, c, d, z, a, d, z])
        high[2], low[2] = high[2] + 1, low[2] - 1
    if any(b - a <= 0 for a, b in zip(low, high)):
        return None
    shape = Shape(wanted, box_rows(low, high))
    if wanted == "cone":
        middle = [(a + b) / 2 for a, b in zip(low, high)]
        radius = lambda z: max((math.hypot(points[i] - middle[0], points[i + 1] - middle[1])
                                for i in range(0, len(points), 3)
                                if abs(points[i + 2] - z) < 1e-4 * (high[2] - low[2])), default=0.0)
        base = radius(low[2])
        if base <= 0:
            return None
        shape.top_radius = tidy(radius(high[2]) / base)
    return shape


RECORDS = {"sphere", "cube", "plane", "infinite_plane", "disk", "cylinder", "cone"}


# ----------------------------------------------------------------------------------------- 14 meshes


@dataclass
class Geometry:
    """What stands for the data of an object; shared by all its instances."""
    shape: Optional[Shape]  # None: a mesh block
    mesh: str
    slots: list  # material slots that its faces use, in order


class Meshes:
    """Reads meshes out of Blender, once each, and writes them as blocks."""

    def __init__(self, report):
        self.report = report
        self.text = Text()
        self.names = Names()
        self.written = {}  # digest of a block -> its name: equal copies are written once
        self.used_slots = {}  # (mesh pointer, number of slots) -> those in use

    def slots(self, mesh, count):
        """Material slots in use. As Blender does, numbers beyond the last slot mean the last."""
        key = (mesh.as_pointer(), count)
        if key not in self.used_slots:
            indices = set(read(mesh.polygons, "material_index", "i", 1))
            self.used_slots[key] = sorted({min(max(i, 0), max(count - 1, 0)) for i in indices})
        return self.used_slots[key]

    def put(self, mesh, coordinates, slots, slot_count, flatten=None):
        """Writes a mesh block; its name, or None when nothing of it can be seen.

        coordinates: per slot, where texture coordinates come from. flatten: rows that flatten the
        mesh, so that it has to be written in world space.
        """
        mesh.calc_loop_triangles()
        triangles = read(mesh.loop_triangles, "vertices", "i", 3)
        loops = read(mesh.loop_triangles, "loops", "i", 3)
        materials = read(mesh.loop_triangles, "material_index", "i", 1)
        points = read(mesh.vertices, "co", "f", 3)
        if not math.isfinite(sum(points)):
            self.report.warn(11, "mesh '%s' has points that are not finite" % mesh.name, "0")
            points = array("f", (x if math.isfinite(x) else 0.0 for x in points))
        areas = read(mesh.loop_triangles, "area", "f", 1)
        if not all(areas):
            keep = [i for i, area in enumerate(areas) if area > 0]
            self.report.note("mesh '%s': %d triangles without area left out" % (mesh.name, len(areas) - len(keep)))
            pick3 = lambda a: array("i", (a[3 * i + k] for i in keep for k in range(3)))
            triangles, loops = pick3(triangles), pick3(loops)
            materials = array("i", (materials[i] for i in keep))
        if not triangles:
            return None

        body = Text()
        if flatten:
            points = [sum(row[k] * points[i + k] for k in range(3)) + row[3]
                      for i in range(0, len(points), 3) for row in flatten]
        body.put_texts("points", shortest_floats(points) if not flatten else list(map(number, points)), 3)
        body.put_array("triangles", triangles, 3, "%d")
        if not flatten:
            self.put_normals(body, mesh, triangles, loops)
        used = {coordinates[s] for s in slots if coordinates[s] is not None}
        if used:
            self.put_uvs(body, mesh, loops, materials, coordinates, used, slot_count)
        if len(slots) > 1:
            last = max(slot_count - 1, 0)
            rank = {s: i for i, s in enumerate(slots)}
            body.put_array("triangle_materials", [rank[min(max(m, 0), last)] for m in materials], 1, "%d")

        digest = hashlib.sha1()
        for line in body.lines:
            digest.update(line.encode())
        digest = digest.digest()
        if digest not in self.written:
            name = self.written[digest] = self.names.unique(mesh.name)
            with self.text.block("mesh", name):
                self.text.lines += body.lines
        return self.written[digest]

    # ---- normals

    def put_normals(self, text, mesh, triangles, loops):
        """Flat meshes need none, smooth ones one per vertex, others one per corner."""
        domain = normals_domain(mesh)
        if domain == "FACE":
            return
        if domain == "POINT":
            text.put_array("normals", finite(vertex_normals(mesh)), 3, NORMAL)  # one for each point
            return
        normals = finite(corner_normals(mesh))
        indices = {}
        corner = index_corners(normals, 12, indices)
        text.put_array("normals", unique_floats(indices), 3, NORMAL)
        text.put_array("normal_triangles", [corner[i] for i in loops], 3, "%d")

    # ---- texture coordinates

    def put_uvs(self, text, mesh, loops, materials, coordinates, used, slot_count):
        if len(used) == 1:
            shared = uvs_of_points(mesh, self.corner_uvs(mesh, next(iter(used))))
            if shared:
                text.put_array("uvs", shared, 2, UV)
                return
        indices = {}
        tables = {c: index_corners(self.corner_uvs(mesh, c), 8, indices) for c in sorted(used)}
        if len(used) == 1:
            table = tables[next(iter(used))]
            corners = [table[i] for i in loops]
        else:
            last = max(slot_count - 1, 0)
            any_table = next(iter(tables.values()))
            by_slot = [tables.get(c, any_table) for c in coordinates]
            corners = []
            for i, m in enumerate(materials):
                table = by_slot[min(max(m, 0), last)]
                corners += (table[loops[3 * i]], table[loops[3 * i + 1]], table[loops[3 * i + 2]])
        text.put_array("uvs", unique_floats(indices), 2, UV)
        text.put_array("uv_triangles", corners, 3, "%d")

    def corner_uvs(self, mesh, coordinates):
        if coordinates[0] == "uv":
            layer = self.uv_layer(mesh, coordinates[1])
            if layer is None:
                return array("f", bytes(8 * len(mesh.loops)))
            return finite(read(layer.data, "uv", "f", 2))
        points = read(mesh.vertices, "co", "f", 3)
        corners = read(mesh.loops, "vertex_index", "i", 1)
        planes = [points[0::3], points[1::3]]
        if coordinates[0] == "generated":
            center, half = mesh.texspace_location, mesh.texspace_size
            planes = [[(x - center[k]) / (2 * half[k]) + 0.5 if half[k] else 0.0 for x in planes[k]]
                      for k in range(2)]
        out = array("f", bytes(8 * len(corners)))
        for k in range(2):
            out[k::2] = array("f", (planes[k][i] for i in corners))
        return finite(out)

    def uv_layer(self, mesh, name):
        layers = mesh.uv_layers
        if name:
            found = layers.get(name)
            if found is None:
                self.report.warn(27, "mesh '%s' has no UV map '%s'" % (mesh.name, name), "uv 0 0")
            return found
        found = next((layer for layer in layers if layer.active_render), None)
        if found is None:
            self.report.warn(27, "mesh '%s' has no UV map" % mesh.name, "uv 0 0")
        return found


def finite(values):
    if math.isfinite(sum(values)):
        return values
    return array("f", (x if math.isfinite(x) else 0.0 for x in values))


def normals_domain(mesh):
    """FACE: all flat; POINT: one normal per vertex; CORNER: everything else."""
    domain = getattr(mesh, "normals_domain", None)  # 4.1
    if domain is not None:
        return domain
    if mesh.has_custom_normals:
        return "CORNER"
    smooth = read(mesh.polygons, "use_smooth", "b", 1)
    if not any(smooth):
        return "FACE"
    return "CORNER" if getattr(mesh, "use_auto_smooth", False) or not all(smooth) else "POINT"


@contextlib.contextmanager
def all_set(collection, attribute, value):
    """Sets a flag of all edges or faces and restores it: an evaluated mesh may share its data."""
    old = read(collection, attribute, "b", 1)
    differs = any(bool(x) != value for x in old)
    if differs:
        collection.foreach_set(attribute, [value] * len(old))
    try:
        yield
    finally:
        if differs:
            collection.foreach_set(attribute, [bool(x) for x in old])


def vertex_normals(mesh):
    if not hasattr(mesh, "calc_normals_split"):
        return read(mesh.vertices, "normal", "f", 3)
    # Blender 3.4 sums vertex normals in another order in each run. The corner normals of an entirely
    # smooth mesh are the same numbers, summed in a fixed order.
    with temporarily(mesh, use_auto_smooth=True, auto_smooth_angle=math.pi), \
            all_set(mesh.edges, "use_edge_sharp", False), all_set(mesh.polygons, "use_smooth", True):
        mesh.calc_normals_split()
        corners = read(mesh.loops, "normal", "f", 3)
    vertices = read(mesh.loops, "vertex_index", "i", 1)
    normals = array("f", bytes(12 * len(mesh.vertices)))
    for k in range(3):
        of_vertex = dict(zip(vertices, corners[k::3]))
        normals[k::3] = array("f", (of_vertex.get(i, 0.0) for i in range(len(mesh.vertices))))
    return normals


def corner_normals(mesh):
    if not hasattr(mesh, "calc_normals_split"):
        return read(mesh.corner_normals, "vector", "f", 3)
    if mesh.use_auto_smooth or mesh.has_custom_normals:
        mesh.calc_normals_split()
        return read(mesh.loops, "normal", "f", 3)
    # Some faces smooth, some flat: the smooth ones have the normals of their vertices.
    smooth, of_vertex = read(mesh.polygons, "use_smooth", "b", 1), vertex_normals(mesh)
    starts, of_face = read(mesh.polygons, "loop_start", "i", 1), read(mesh.polygons, "normal", "f", 3)
    vertices = read(mesh.loops, "vertex_index", "i", 1)
    ends = list(starts[1:]) + [len(vertices)]
    normals = array("f")
    for face, (start, end) in enumerate(zip(starts, ends)):
        if smooth[face]:
            for i in vertices[start:end]:
                normals += of_vertex[3 * i : 3 * i + 3]
        else:
            normals += of_face[3 * face : 3 * face + 3] * (end - start)
    return normals


def index_corners(values, size, indices):
    """Number of each corner's value among the different ones; `indices` collects those as bytes."""
    data = values.tobytes()
    number_of = indices.setdefault
    return [number_of(data[i : i + size], len(indices)) for i in range(0, len(data), size)]


def uvs_of_points(mesh, uvs):
    """Texture coordinates by vertex, where all corners of each agree; None at seams."""
    if min(uvs) == max(uvs):
        return None  # one for all is shorter
    corners = read(mesh.loops, "vertex_index", "i", 1)
    out = array("f", bytes(8 * len(mesh.vertices)))
    for k in range(2):
        plane = uvs[k::2]
        of_vertex = dict(zip(corners, plane))
        if max(map(abs, map(operator.sub, plane, map(of_vertex.__getitem__, corners)))) > SAME_UV:
            return None
        out[k::2] = array("f", map(of_vertex.get, range(len(mesh.vertices)), itertools.repeat(0.0)))
    return out


def unique_floats(indices):
    return array("f", b"".join(indices))


# ------------------------------------------------------------------------------------------ 15 scene

# Without a shape of their own, or given a second time as MESH.
SILENT_TYPES = {"CAMERA", "EMPTY", "ARMATURE", "LATTICE", "SPEAKER", "LIGHT_PROBE", "LIGHTPROBE",
                "FONT", "CURVE", "SURFACE", "META"}
NO_MATERIAL = "No material"


class SceneExport:
    """One frame of a scene. Everything that Blender evaluates is read inside `collect`."""

    def __init__(self, scene, layer, frame, camera, images, report, recognises=True, integrator=None):
        self.recognises = recognises  # spheres, cubes and planes among the meshes
        self.integrator = integrator or ("path" if scene.render.engine == "CYCLES" else "whitted")
        self.scene, self.layer, self.frame, self.camera = scene, layer, frame, camera
        self.images, self.report = images, report
        self.values = Values(images, report)
        self.shaders = Shaders(self.values, report)
        self.folder = Folder(self.values, report)
        self.meshes = Meshes(report)
        self.geometries = {}  # (mesh pointer, coordinates per slot, ...) -> Geometry or None
        self.materials = {}  # (pointer of Blender's material or None, whether it may give light) -> Material
        self.textures = {}  # Texture -> name
        self.used_materials = set()  # names of those that objects have
        self.material_names, self.texture_names = Names(), Names()
        self.object_names, self.light_names, self.camera_names = Names(), Names(), Names()
        self.objects, self.lights = [], []  # (name, text lines)
        self.head, self.cameras = Text(), Text()

    def run(self):
        """The text of the scene file."""
        with_render_graph(self.scene, self.layer, self.report, self.collect)
        return self.assemble()

    def collect(self, depsgraph, set_frame):
        cameras = [self.camera] + sorted(
            (o for o in self.scene.objects if o.type == "CAMERA" and o != self.camera), key=lambda o: o.name)
        motion = Motion(depsgraph, set_frame, self.scene, self.frame, cameras, self.report)
        self.collect_world()
        for flag, what, instead in (("use_sky", "sky", "the world is seen"), ("use_solid", "solid objects", "they are drawn")):
            if not getattr(self.layer, flag, True):
                self.report.warn(38, "view layer '%s' has no %s" % (self.layer.name, what), instead)
        for camera in cameras:
            self.collect_camera(camera.evaluated_get(depsgraph), motion, depsgraph)
        camera = self.camera.evaluated_get(depsgraph)
        for instance in depsgraph.object_instances:
            self.collect_instance(instance, motion, camera)
        self.warn_of_deformation(motion)

    # ---- camera and world

    def collect_camera(self, camera, motion, depsgraph):
        rows = rows_of(camera.matrix_world)
        with self.report.at("camera", camera.name):
            keys = motion.keys(("camera", camera.name_full), rows, camera, self.report)
        name = self.camera_names.unique(camera.name)
        put_camera(self.cameras, camera, keys, rows, depsgraph, name, self.report)

    def collect_world(self):
        color, texture, rotation, lights = world_light(self.scene, self.shaders, self.folder, self.report)
        self.head = Text()
        with self.head.block("world"):
            self.head.put("background", color)
            self.head.put_unless(False, "environment_lights", lights and any(color))
            if texture is not None:
                plain = replace(texture, scale=(1.0, 1.0), rotation=0.0, offset=(0.0, 0.0), extension="repeat")
                self.head.put("environment", word(self.texture_name(plain)))
                self.head.put_unless(0, "environment_rotation", rotation)

    # ---- objects

    def collect_instance(self, instance, motion, camera):
        if not instance.show_self:
            return
        thing = instance.object
        with self.report.at("object", thing.name):
            rows = rows_of(instance.matrix_world)
            if not is_finite(rows):
                self.report.warn(11, "its place is not finite", "left out")
            elif thing.type == "MESH":
                if not instance.is_instance:
                    self.warn_of_hair(thing)
                    self.warn_of_clip_end(thing, rows, camera)
                self.collect_mesh(instance, thing, rows, motion)
            elif thing.type == "LIGHT":
                self.collect_light(instance, thing, rows, motion)
            elif thing.type not in SILENT_TYPES:
                self.report.warn(5, "it is a %s" % thing.type.lower(), "left out")

    def name_of(self, instance, names):
        thing, parent = instance.object, instance.parent
        if instance.is_instance and parent is not None and parent.name != thing.name:
            return names.unique("%s/%s" % (parent.name, thing.name))
        return names.unique(thing.name)

    def collect_light(self, instance, thing, rows, motion):
        lamp = thing.data
        if getattr(getattr(lamp, "cycles", None), "is_portal", False):
            return
        self.warn_of_linking(thing)
        samples = motion.samples(instance_key(instance), rows)
        if samples and not all(nearly_equal(samples[0], s) for s in samples[1:]):
            self.report.warn(10, "the light moves", "it stands still")
        if not gives_light(lamp, rows, self.report):
            return
        text, name = Text(), self.name_of(instance, self.light_names)
        put_light(text, name, lamp, rows, self.seen_by(thing), self.values, self.report)
        self.lights.append((name, text))

    def seen_by(self, thing):
        """Which rays see a lamp: by default Blender shows lamps in mirrors and glass, not to the camera."""
        if not getattr(thing, "visible_diffuse", True):
            self.report.warn(6, "it is hidden from diffuse rays", "it lights diffuse surfaces")
        camera = getattr(thing, "visible_camera", False)
        glossy, through = (getattr(thing, "visible_" + kind, True) for kind in ("glossy", "transmission"))
        mixed = getattr(getattr(thing.data, "cycles", None), "use_multiple_importance_sampling", True)
        if glossy != through and mixed:
            self.report.warn(6, "mirrors and glass see it differently", "both see it" if glossy else "none sees it")
        reflections = glossy and mixed
        return {(True, True): "all", (True, False): "camera", (False, True): "reflections"}.get(
            (camera, reflections), "none")

    def collect_mesh(self, instance, thing, rows, motion):
        self.warn_of_linking(thing)
        # A file that was saved in edit mode: the faces are in the editor's own mesh, data has none.
        mesh = thing.to_mesh() if thing.mode == "EDIT" else thing.data
        if len(mesh.polygons) == 0:
            self.report.note("object '%s' has no faces" % thing.name)
            return
        slots = self.material_slots(thing, mesh, bool(thing.get("rt_light", True)))
        keys = motion.keys(instance_key(instance), rows, thing, self.report)
        if not any(x for row in rows for x in row[:3]):
            self.report.note("object '%s' has the scale 0" % thing.name)
            return
        flat, used = is_flat(rows), self.meshes.slots(mesh, len(slots))
        if not self.is_seen(thing):
            return self.collect_lamp(instance, thing, mesh, [slots[s] for s in used], keys)
        if all(slots[s].is_volume for s in used):
            return
        geometry = self.geometry(thing, mesh, slots, rows if flat else None)
        if geometry is None:
            return
        materials = [slots[s] for s in geometry.slots]
        name = self.name_of(instance, self.object_names)
        keys = [IDENTITY] if flat else keys
        self.objects.append((name, self.object_text(name, geometry, keys, materials)))

    def geometry(self, thing, mesh, slots, flatten):
        """Shape or mesh block of a mesh, made on first use. None: nothing to see."""
        used = self.meshes.slots(mesh, len(slots))
        coordinates = tuple(m.coordinates() if i in used else None for i, m in enumerate(slots))
        wanted = thing.get("rt_shape", mesh.get("rt_shape", "")) if hasattr(thing, "get") else ""
        wanted = wanted if isinstance(wanted, str) else ""
        lights = any(slots[s].lights() for s in used)  # triangles do
        key = (mesh.as_pointer(), coordinates, wanted, flatten, lights)
        if key not in self.geometries:
            self.geometries[key] = self.make_geometry(mesh, slots, used, coordinates, wanted, flatten, lights)
        return self.geometries[key]

    def make_geometry(self, mesh, slots, used, coordinates, wanted, flatten, lights):
        shape = None
        if wanted in RECORDS and not flatten:
            shape = wanted_shape(mesh, wanted)
            if shape is None or len(used) > 1:
                self.report.warn(33, "rt_shape '%s'" % wanted, "a mesh")
                shape = None
        elif wanted and wanted != "mesh":
            self.report.warn(33, "rt_shape '%s'" % wanted, "a mesh")
        elif self.recognises and not lights and not wanted and not flatten and len(used) == 1 and coordinates[used[0]] is None:
            shape = recognise(mesh)
        if shape is not None:
            return Geometry(shape, "", used[:1])
        name = self.meshes.put(mesh, coordinates, used, len(slots), flatten)
        return Geometry(None, name, used) if name else None

    def object_text(self, name, geometry, keys, materials):
        text, shape = Text(), geometry.shape
        with text.block(shape.kind if shape else "instance", name):
            if shape:
                keys = [times(k, shape.rows) if shape.rows != IDENTITY else k for k in keys]
            text.put_keys(keys)
            if shape and shape.corners:
                text.put("corners", shape.corners)
            if shape and shape.kind == "cone":
                text.put_unless(0, "top_radius", shape.top_radius)
            if not shape:
                text.put("mesh", word(geometry.mesh))
            self.used_materials.update(m.name for m in materials)
            if len(materials) == 1:
                text.put("material", word(materials[0].name))
            else:
                text.put("materials", *[word(m.name) for m in materials])
        return text

    def collect_lamp(self, instance, thing, mesh, materials, keys):
        """Lamps for a mesh that glows and that the camera does not see: a rectangle, a disk or a ball."""
        glowing = next((m for m in materials if m.lights()), None)
        if glowing is None:
            return
        material = materials[0]
        is_whole = len(materials) == 1 and len(keys) == 1 and material.opacity == 1 and not material.opacity_texture
        lamps, part = lamps_of(mesh, keys[0]) if is_whole else ([], 1.0)
        if not lamps:
            return self.report.warn(32, "material '%s' glows" % glowing.name, "it lights nothing")
        color = scaled(self.values.constant(Value(material.emission, material.emission_texture)), part)
        if material.emission_texture:
            self.report.warn(32, "material '%s' glows with a texture" % glowing.name, "it lights with its mean")
        for kind, rows, size in lamps:
            text, name = Text(), self.name_of(instance, self.light_names)
            with text.block("light", name):
                text.put("type", kind)
                text.put_rows(rows)
                put_color(text, color, self.report)
                text.put(*(("radius", size[0]) if kind == "sphere" else ("size", *size)))
                text.put_unless("none", "seen_by", self.seen_by(thing))
            self.lights.append((name, text))

    # ---- materials

    def material_slots(self, thing, mesh, gives_light):
        """Material of each slot. Generated geometry may have more slots than the object."""
        slots = [slot.material for slot in thing.material_slots]
        slots += list(mesh.materials)[len(slots):]
        if self.layer.material_override:
            slots = [self.layer.material_override] * max(len(slots), 1)
        return [self.material(m, gives_light) for m in slots] or [self.material(None, gives_light)]

    def material(self, source, gives_light):
        pointer = source.as_pointer() if source else None
        if (pointer, True) not in self.materials:
            self.materials[pointer, True] = self.make_material(source)
        material = self.materials[pointer, True]
        if gives_light or not material.lights():
            return material
        if (pointer, False) not in self.materials:
            self.materials[pointer, False] = replace(
                material, name=self.material_names.unique(material.name), gives_light=False)
        return self.materials[pointer, False]

    def make_material(self, source):
        if source is None:
            return Material(self.material_names.unique(NO_MATERIAL), diffuse=GRAY)
        name = self.material_names.unique(source.name)
        with self.report.at("material", source.name):
            if not getattr(source, "use_nodes", True) or source.node_tree is None:
                return Material(name, diffuse=tuple(source.diffuse_color)[:3])
            output = source.node_tree.get_output_node("CYCLES") or source.node_tree.get_output_node("ALL")
            if output is None:
                return Material(name)
            for socket in ("Volume", "Displacement"):
                if output.inputs[socket].is_linked:
                    self.report.warn(21, "%s of node '%s'" % (socket.lower(), output.name), "none")
            if output.inputs["Volume"].is_linked and not output.inputs["Surface"].is_linked:
                return Material(name, opacity=0.0, is_volume=True)  # what has nothing else is left out
            lobes = self.shaders.lobes(Socket(output.inputs["Surface"], ()))
            return self.folder.fold(name, lobes)

    def texture_name(self, texture):
        texture = replace(texture, coordinates=("uv", ""))
        if texture.inverted or texture.grey:
            inversion = "alpha" if texture.channel == "alpha" else texture.space
            file = self.images.file(texture.image, texture.look, inversion if texture.inverted else None,
                                    texture.space if texture.grey else None)
            texture = replace(texture, file=file or texture.file, inverted=False, grey=False)
        if texture not in self.textures:
            stem = os.path.splitext(texture.file.split("/")[-1])[0]
            self.textures[texture] = self.texture_names.unique(stem)
        return self.textures[texture]

    # ---- what is lost

    def is_seen(self, thing):
        is_indirect = bool(thing.original.indirect_only_get(view_layer=self.layer))
        if is_indirect or not getattr(thing, "visible_camera", True):
            self.report.warn(6, "it is %s" % ("indirect only" if is_indirect else "hidden from the camera"),
                             "no ray sees it")
            return False
        hidden = [a[8:] for a in ("visible_diffuse", "visible_glossy", "visible_transmission", "visible_shadow")
                  if not getattr(thing, a, True)]
        if hidden:
            self.report.warn(6, "it is hidden from %s rays" % ", ".join(hidden), "all rays see it")
        is_holdout = getattr(thing, "is_holdout", False) or thing.original.holdout_get(view_layer=self.layer)
        for flag, name in ((is_holdout, "holdout"), (getattr(thing, "is_shadow_catcher", False), "shadow catcher")):
            if flag:
                self.report.warn(6, name, "a plain object")
        return True

    def warn_of_linking(self, thing):
        linking = getattr(thing, "light_linking", None)  # 4.0
        if linking is not None and (linking.receiver_collection or linking.blocker_collection):
            self.report.warn(6, "light linking", "it lights everything")

    def warn_of_hair(self, thing):
        for system in thing.particle_systems:
            if system.settings.type == "HAIR" and system.settings.render_type == "PATH":
                self.report.warn(5, "hair '%s'" % system.name, "left out")

    def warn_of_clip_end(self, thing, rows, camera):
        view = rows_of(camera.matrix_world)
        axis, eye = column(view, 2), column(view, 3)
        corners = [[sum(row[k] * c[k] for k in range(3)) + row[3] for row in rows] for c in thing.bound_box]
        depths = [sum(axis[k] * (eye[k] - corner[k]) for k in range(3)) for corner in corners]
        if min(depths) > camera.data.clip_end:
            self.report.warn(8, "all of it is beyond the clip end", "it is drawn")

    def warn_of_deformation(self, motion):
        if not motion.moments:
            return
        first, last = motion.moments[0], motion.moments[-1]
        for key, value in first.items():
            if key[0] == "lens" and any(m.get(key) != value for m in motion.moments):
                with self.report.at("camera", key[1]):
                    self.report.warn(42, "its lens changes while the shutter is open", "as at the frame")
            if len(key) == 2 and key[0] == "shape" and last.get(key) != value:
                with self.report.at("object", key[1]):
                    self.report.warn(9, "its shape changes while the shutter is open", "its shape at the frame")

    # ---- text

    def assemble(self):
        scene, text = self.scene, Text()
        blend = os.path.basename(bpy.data.filepath) or "an unsaved file"
        one_line = lambda s: "".join(c if ord(c) >= 32 else "_" for c in s)
        text.lines += [
            "raytracer %d" % FORMAT_VERSION,
            "# %s, scene '%s', frame %d; Blender %s, Blend/Export.py"
            % (one_line(blend), one_line(scene.name), self.frame, bpy.app.version_string),
            "# Lengths in Blender units (%s m), angles in degrees, light in linear RGB."
            % number(scene.unit_settings.scale_length),
        ]
        wanted, exported = samples_of(scene)
        if wanted != exported:
            text.lines.append("# The scene asks for %d samples; more than %d are left to --spp." % (wanted, exported))
        put_settings(text, scene, self.integrator, self.report)
        materials, textures = Text(), Text()
        for material in sorted(self.materials.values(), key=lambda m: natural(m.name)):
            if material.name in self.used_materials:
                material.put(materials, self.texture_name)
        for texture, name in sorted(self.textures.items(), key=lambda item: natural(item[1])):
            put_texture(textures, texture, name)
        parts = [self.head, self.cameras, textures, materials]
        parts += [t for _, t in sorted(self.lights, key=lambda item: natural(item[0]))]
        parts.append(self.meshes.text)
        parts += [t for _, t in sorted(self.objects, key=lambda item: natural(item[0]))]
        return str(text) + "".join(str(p) for p in parts if p.lines)


def put_texture(text, texture, name):
    with text.block("texture", name):
        text.put("file", '"%s"' % texture.file.replace("\\", "\\\\").replace('"', '\\"'))
        text.put_unless("srgb", "space", texture.space)
        text.put_unless("bilinear", "interpolation", texture.interpolation)
        text.put_unless("repeat", "extension", texture.extension)
        text.put_unless("color", "channel", texture.channel)
        text.put_unless((1.0, 1.0), "scale", texture.scale)
        text.put_unless(0, "rotation", texture.rotation)
        text.put_unless((0.0, 0.0), "offset", texture.offset)


BALL_SAGITTA = 0.1  # a ball of light is taken from rougher meshes than a sphere that is looked at


def lamps_of(mesh, rows):
    """([(light type, place, sizes)], part of the radiance) of a rectangle, a disk or a ball; no lamps for
    other meshes. Blender's faces glow on both sides, our lamps on one: flat ones become two."""
    shape = recognise_plane(mesh) if len(mesh.polygons) == 1 and len(mesh.vertices) == 4 else None
    disk = recognise_disk(mesh) if shape is None else None
    if shape:
        return flat_lamps("rectangle", rectangle_of(shape.corners, rows)), 1.0
    if disk:
        return flat_lamps("disk", ellipse_of(disk, rows)), 1.0
    ball = recognise_sphere(mesh, BALL_SAGITTA) if is_closed(mesh) and len(mesh.vertices) >= 42 else None
    if ball is None:
        return [], 1.0
    whole = times(rows, ball.rows)
    radii = [length(column(whole, i)) for i in range(3)]
    if max(radii) - min(radii) > 1e-4 * max(radii) or ball.rows[0][0] != ball.rows[2][2]:
        return [], 1.0
    center = column(whole, 3)
    place = tuple(IDENTITY[i][:3] + (center[i],) for i in range(3))
    # From afar a mesh without dents gives light by its area, of which rough ones have less than the ball.
    part = sum(read(mesh.polygons, "area", "f", 1)) / (4 * math.pi * ball.rows[0][0] ** 2)
    return [("sphere", place, (radii[0],))], min(part, 1.0)


def placed(rows, point):
    return [sum(row[k] * point[k] for k in range(3)) + row[3] for row in rows]


def rectangle_of(corners, rows):
    """(centre, axis, axis, sizes) of a placed parallelogram with right angles; None for others."""
    c = [placed(rows, corners[i : i + 3]) for i in (0, 3, 6, 9)]
    side = [difference(c[i], c[0]) for i in (1, 3)]
    x, y = length(side[0]), length(side[1])
    is_parallelogram = all(abs(c[0][k] + c[2][k] - c[1][k] - c[3][k]) < 1e-4 * (x + y) for k in range(3))
    if not is_parallelogram or abs(dot(*side)) > 1e-4 * x * y:
        return None
    return [(c[0][k] + c[2][k]) / 2 for k in range(3)], [a / x for a in side[0]], [a / y for a in side[1]], (x, y)


def recognise_disk(mesh):
    """(centre, radius along one vertex, radius across) of a regular polygon of at least twelve corners, as
    one face or as a fan, so long that the disk has its area; None for others."""
    count = len(mesh.polygons[0].vertices) if len(mesh.polygons) == 1 else len(mesh.polygons)
    if count < 12 or len(mesh.vertices) not in {count, count + 1} or len(mesh.vertices) > 4096:
        return None
    points = [tuple(v.co) for v in mesh.vertices]
    center = [sum(p[k] for p in points) / len(points) for k in range(3)]
    arms = [a for a in (difference(p, center) for p in points) if length(a) > 0]
    radius = max(map(length, arms))
    arms = [a for a in arms if length(a) > 1e-4 * radius]
    if len(arms) != count or (len(mesh.vertices) > count) != (len(mesh.polygons) > 1):
        return None
    normal = max((cross(arms[0], a) for a in arms), key=length)
    normal = [x / length(normal) for x in normal]
    if any(abs(length(a) - radius) > 1e-4 * radius or abs(dot(a, normal)) > 1e-4 * radius for a in arms):
        return None
    x, y = arms[0], cross(normal, arms[0])
    angles = sorted(math.atan2(dot(a, y), dot(a, x)) % (2 * math.pi) for a in arms)
    if any(abs(b - a - 2 * math.pi / count) > 1e-3 for a, b in zip(angles, angles[1:])):
        return None
    same_area = math.sqrt(count * math.sin(2 * math.pi / count) / (2 * math.pi))
    return center, [same_area * a for a in x], [same_area * a for a in y]


def ellipse_of(disk, rows):
    """(centre, axis, axis, diameters) of a placed disk: the axes of the ellipse that it becomes."""
    center, x, y = disk
    turned = [[sum(row[k] * v[k] for k in range(3)) for row in rows] for v in (x, y)]
    angle = math.atan2(2 * dot(*turned), dot(turned[0], turned[0]) - dot(turned[1], turned[1])) / 2
    c, s = math.cos(angle), math.sin(angle)
    u = [c * a + s * b for a, b in zip(*turned)]
    v = [c * b - s * a for a, b in zip(*turned)]
    a, b = length(u), length(v)
    if min(a, b) <= 1e-6 * max(a, b):
        return None
    return placed(rows, center), [x / a for x in u], [x / b for x in v], (2 * a, 2 * b)


def flat_lamps(kind, outline):
    """A lamp for each side, which shine along their -Z."""
    if outline is None:
        return []
    center, u, v, size = outline
    w = cross(u, v)
    lamps = []
    for sign in (1, -1):
        lamps.append((kind, tuple((sign * u[k], v[k], sign * w[k], center[k]) for k in range(3)), size))
    return lamps


def natural(name):
    """Sorts 'Cube 9' before 'Cube 10'."""
    return [(int(part), "") if part.isdigit() else (-1, part) for part in re.split(r"(\d+)", name)] + [(-1, name)]


# ----------------------------------------------------------------------------------- 16 command line


INTEGRATORS = ("whitted", "path")


def parse(arguments, is_module):
    parser = argparse.ArgumentParser(
        prog="Export.py", formatter_class=argparse.RawDescriptionHelpFormatter,
        usage="blender -b SCENE.blend --python-exit-code 3 -P Export.py -- [options]\n"
              "       python Export.py SCENE.blend [options]",
        description="Writes a Blender scene as the scene text of the ray tracer.",
        epilog="Exit codes: 0 written, 2 error, 3 warnings under --strict or a fault of this script.\n\n"
               "Warnings, one for each thing that the scene text cannot say:\n"
               + "\n".join("  W%03d  %s" % item for item in sorted(WARNINGS.items())))
    if is_module:
        parser.add_argument("blend", metavar="SCENE.blend", nargs="?", help="file to open")
    parser.add_argument("-o", "--output", metavar="FILE",
                        help="scene text to write, #### stands for the frame; default: next to the .blend")
    parser.add_argument("--frame", metavar="N|A:B", help="frame or range of frames; default: the current one")
    parser.add_argument("--camera", metavar="NAME", help="camera to look through; default: the active one")
    parser.add_argument("--textures", metavar="DIR",
                        help="where pictures are looked for and copied to; default: Textures beside the output")
    parser.add_argument("--integrator", metavar="NAME", choices=INTEGRATORS,
                        help="what the renderer does unless it is told otherwise: %s; default: path where the scene is "
                             "for Cycles, else whitted" % " or ".join(INTEGRATORS))
    parser.add_argument("--ppm", action="store_true", help="turn 8-bit pictures without alpha into PPM files")
    parser.add_argument("--no-shapes", action="store_true",
                        help="take no mesh for a sphere, cube or plane (rt_shape still does)")
    parser.add_argument("--no-check", action="store_true",
                        help="do not run `raytracer --check` on what was written; it runs when the program named by "
                             "the environment variable RAYTRACER, beside the folder of this script, or on the PATH is "
                             "there, and what it refuses is an error")
    parser.add_argument("--strict", action="store_true", help="exit with 3 when there were warnings")
    parser.add_argument("--verbose", action="store_true", help="say what is being done")
    parser.add_argument("--list-warnings", action="store_true", help="print the table of warnings and stop")
    return parser.parse_args(arguments)


def frames_of(options, scene):
    if options.frame is None:
        return [scene.frame_current]
    match = re.fullmatch(r"(-?\d+)(?::(-?\d+))?", options.frame)
    if not match:
        raise ExportError("--frame takes a number or a range like 1:10, not '%s'" % options.frame)
    first = int(match.group(1))
    last = int(match.group(2) or first)
    if last < first:
        raise ExportError("--frame %s is empty" % options.frame)
    return list(range(first, last + 1))


def output_of(options, frame, is_many):
    path = options.output
    if path is None:
        path = os.path.splitext(bpy.data.filepath)[0] + ".txt" if bpy.data.filepath else "untitled.txt"
        if is_many:
            path = path[:-4] + "-####.txt"
    numbered = re.sub(r"#+", lambda m: str(frame).zfill(len(m.group())), os.path.basename(path))
    if is_many and numbered == os.path.basename(path):
        raise ExportError("-o needs #### for the number when there are several frames")
    return os.path.abspath(os.path.join(os.path.dirname(path), numbered))


def camera_of(options, scene):
    if options.camera is None:
        if scene.camera is None:
            raise ExportError("scene '%s' has no active camera" % scene.name)
        return scene.camera
    cameras = {o.name: o for o in scene.objects if o.type == "CAMERA"}
    if options.camera not in cameras:
        known = ", ".join(sorted(cameras)) or "none"
        raise ExportError("no camera '%s'; known: %s" % (options.camera, known))
    return cameras[options.camera]


def layer_of(scene, report):
    layers = [layer for layer in scene.view_layers if layer.use] or list(scene.view_layers)
    current = bpy.context.view_layer
    layer = next((l for l in layers if l == current), layers[0])
    if len(layers) > 1:
        report.warn(4, "%d view layers" % len(layers), "'%s'" % layer.name)
    return layer


def export(options, report):
    scene = bpy.context.scene
    frames = frames_of(options, scene)
    current, old_camera = scene.frame_current, scene.camera
    layer = layer_of(scene, report)
    try:
        for frame in frames:
            path = output_of(options, frame, len(frames) > 1)
            if frame != scene.frame_current:
                scene.frame_set(frame)
            scene.camera = camera = camera_of(options, scene)  # markers may have changed it
            os.makedirs(os.path.dirname(path), exist_ok=True)
            images = Images(os.path.dirname(path), options.textures, options.ppm, report)
            text = SceneExport(scene, layer, frame, camera, images, report, not options.no_shapes,
                               options.integrator).run()
            write_atomically(path, text.encode("utf-8"))
            report.note("wrote %s" % path)
            if not options.no_check:
                check(path, report)
    finally:
        if scene.frame_current != current:
            scene.frame_set(current)
        scene.camera = old_camera


def renderer():
    """Path of the ray tracer; None if it is not there."""
    script = os.path.dirname(os.path.abspath(globals().get("__file__", "")))
    beside = os.path.join(os.path.dirname(script), "raytracer")
    return os.environ.get("RAYTRACER") or (beside if os.path.isfile(beside) else shutil.which("raytracer"))


def check(path, report):
    """Lets the renderer read the scene: what it refuses shall not look like a success."""
    program = renderer()
    if program is None:
        report.note("no raytracer is there to check %s" % path)
        return
    try:
        done = subprocess.run([program, "--check", path], capture_output=True, text=True, errors="replace")
    except OSError as problem:
        report.note("%s cannot be started: %s" % (program, problem))
        return
    if done.returncode != 0:
        raise ExportError("raytracer --check refuses what was written (exit code %d):\n%s"
                          % (done.returncode, done.stderr.strip()[-2000:]))


def open_file(options, is_module, report):
    if is_module and options.blend:
        if not os.path.isfile(options.blend):
            raise ExportError("no file '%s'" % options.blend)
        try:
            bpy.ops.wm.open_mainfile(filepath=os.path.abspath(options.blend))
        except RuntimeError as problem:
            # Blender raises what it reports as an error, a missing library too, though the file is open.
            opened = bpy.data.filepath
            if not opened or not os.path.samefile(opened, options.blend):
                raise ExportError("'%s' cannot be opened: %s" % (options.blend, str(problem).strip())) from None
            report.warn(37, "Blender says: %s" % " ".join(str(problem).split()), "what is there of the file")
    elif is_module:
        raise ExportError("which .blend file? See --help")
    elif bpy.app.background and not bpy.data.filepath:
        # Blender only prints a line and goes on with an empty scene.
        before = sys.argv[: sys.argv.index("--")] if "--" in sys.argv else sys.argv
        wanted = [a for a in before[1:] if a.endswith(".blend")]
        if wanted:
            raise ExportError("Blender could not open '%s'" % wanted[0])


def main():
    """Exit code."""
    is_module = not bpy.app.binary_path
    if is_module:
        arguments = sys.argv[1:]
    else:
        arguments = sys.argv[sys.argv.index("--") + 1 :] if "--" in sys.argv else []
    options = parse(arguments, is_module)
    if options.list_warnings:
        print("\n".join("W%03d  %s" % item for item in sorted(WARNINGS.items())))
        return 0
    report = Report(options.verbose)
    try:
        open_file(options, is_module, report)
        export(options, report)
    except (ExportError, OSError) as problem:
        print("Export.py: error: %s" % problem, file=sys.stderr)
        return EXIT_ERROR
    report.summary()
    return EXIT_STRICT if options.strict and report.seen else 0


def run_and_leave():
    """Ends the process with the exit code."""
    try:
        code = main()
    except SystemExit as stop:  # argparse
        code = stop.code or 0
    except Exception:
        import traceback
        traceback.print_exc()
        code = EXIT_FAULT
    sys.stdout.flush()
    sys.stderr.flush()
    if not bpy.app.binary_path:
        os._exit(code)  # the bpy module can hang when it cleans up
    sys.exit(code)


if __name__ == "__main__":
    if bpy.app.background:
        run_and_leave()
    elif main():  # in the user interface sys.exit would close Blender
        raise RuntimeError("the scene was not exported; the console says why")
