"""Makes the Blender scenes of this project and their textures. Needs nothing but Blender 3.4 or later.

    blender -b --factory-startup --python-exit-code 3 -P Blend/MakeScenes.py                 everything
    blender -b --factory-startup --python-exit-code 3 -P Blend/MakeScenes.py -- glass dof    these scenes only

Writes Blend/NAME.blend for each row of SCENES and Textures/NAME for each row of TEXTURES.
Blend/ExportAll.sh runs this and exports every scene to ASCII/NAME.txt.

A new scene: a function that builds it from the helpers below, and a row in SCENES.

The parts of this file:
     1 noise and drawing   what the textures are made of
     2 textures            one function each, one table
     3 picture files       PPM, PNG, PFM
     4 shapes              grids of points to meshes
     5 materials           node trees
     6 lights and cameras
     7 scenes              one function each, one table
     8 command line
"""

import math
import os
import random
import struct
import sys
import zlib
from array import array
from dataclasses import dataclass
from typing import Optional

import bpy
from mathutils import Matrix, Vector

HERE = os.path.dirname(os.path.abspath(__file__))
TEXTURE_FOLDER = os.path.join(HERE, os.pardir, "Textures")

# ------------------------------------------------------------------------------ 1 noise and drawing

LATTICE = 64  # the noise repeats after this many cells
_dice = random.Random(1)
_lattice = [_dice.random() for _ in range(LATTICE * LATTICE)]


def noise(x, y, period=LATTICE):
    """Smooth noise in 0 to 1 with one random value per unit; repeats after `period` units."""
    i, j = math.floor(x), math.floor(y)
    fx, fy = x - i, y - j
    fx, fy = fx * fx * (3 - 2 * fx), fy * fy * (3 - 2 * fy)
    i0, i1 = i % period, (i + 1) % period
    j0, j1 = j % period * LATTICE, (j + 1) % period * LATTICE
    bottom = _lattice[j0 + i0] + (_lattice[j0 + i1] - _lattice[j0 + i0]) * fx
    top = _lattice[j1 + i0] + (_lattice[j1 + i1] - _lattice[j1 + i0]) * fx
    return bottom + (top - bottom) * fy


def clouds(x, y, period, octaves=4):
    """Noise on noise, each octave half as high and twice as fine; 0 to 1."""
    total, height = 0.0, 0.5
    for _ in range(octaves):
        total += height * noise(x, y, period)
        x, y, period, height = 2 * x, 2 * y, min(2 * period, LATTICE), height / 2
    return total / (1 - height * 2)


def mix(a, b, t):
    return tuple(x + (y - x) * t for x, y in zip(a, b))


def step(low, high, x):
    """0 below low, 1 above high, smooth between."""
    t = min(max((x - low) / (high - low), 0.0), 1.0)
    return t * t * (3 - 2 * t)


def stored(x):
    """Linear light as sRGB."""
    return 12.92 * x if x <= 0.0031308 else 1.055 * x ** (1 / 2.4) - 0.055


GLYPHS = {  # 3x5 pixels, rows from the top
    "0": "7 5 5 5 7", "1": "2 6 2 2 7", "2": "7 1 7 4 7", "3": "7 1 7 1 7", "4": "5 5 7 1 1",
    "5": "7 4 7 1 7", "6": "7 4 7 5 7", "7": "7 1 1 1 1", "A": "7 5 7 5 5", "B": "6 5 6 5 6", "C": "7 4 4 4 7",
    "D": "6 5 5 5 6", "E": "7 4 7 4 7", "F": "7 4 7 4 4", "G": "7 4 5 5 7", "H": "5 5 7 5 5",
}


def is_ink(character, x, y):
    """Whether (x, y) of the unit square, y upwards, is on a stroke of the character."""
    column, row = int(x * 3), int((1 - y) * 5)
    if not (0 <= column < 3 and 0 <= row < 5):
        return False
    return int(GLYPHS[character].split()[row][-1]) >> (2 - column) & 1 == 1


# ----------------------------------------------------------------------------------------- 2 textures
# Each is a function of u to the right and v upwards, both in 0 to 1, to 3 or 4 numbers: for PPM and
# PNG what is stored, 0 to 1; for PFM radiance.


def checker(u, v):
    return (0.85, 0.83, 0.78) if (int(u * 2) + int(v * 2)) % 2 else (0.16, 0.19, 0.24)


def uv_grid(u, v):
    """8x8 fields A0 to H7: the letter counts upwards, the digit to the right."""
    column, row = int(u * 8), int(v * 8)
    x, y = u * 8 - column, v * 8 - row
    field = mix((0.95, 0.55, 0.25), (0.2, 0.5, 0.8), column / 7)
    field = mix(field, (0.97, 0.95, 0.85), 0.75 * row / 7)
    if (column + row) % 2:
        field = mix(field, (0, 0, 0), 0.22)
    if min(x, y) < 0.04:
        return (0.12, 0.12, 0.14)
    for character, left in (("ABCDEFGH"[row], 0.2), (str(column), 0.55)):
        if is_ink(character, (x - left) / 0.27, (y - 0.28) / 0.45):
            return (0.1, 0.1, 0.12)
    return field


def letters(u, v):
    """16x16 pixels with A B above C D, for looking at pixels."""
    column, row = int(u * 2), int(v * 2)
    x, y = u * 2 - column, v * 2 - row
    ink, paper = (0.1, 0.2, 0.35), (0.95, 0.75, 0.35)
    if (column + row) % 2:
        ink, paper = (0.75, 0.2, 0.15), (0.97, 0.93, 0.85)
    return ink if is_ink("CDAB"[2 * row + column], (x - 0.25) / 0.375, (y - 0.125) / 0.625) else paper


def wood(u, v):
    """Four planks along u, each with its own grain and shade."""
    plank = int(v * 4)
    across = v * 4 - plank
    shift = 0.37 * plank
    bend = clouds((u + shift) * 4, v * 16, 16, 3)
    rings = 0.5 + 0.5 * math.sin(2 * math.pi * (across * 2.2 + 3.2 * bend + shift))
    fibre = noise((u + shift) * 12, v * 64 * 3, LATTICE)
    shade = (0.5, 0.38, 0.62, 0.44)[plank] + 0.2 * (rings - 0.5) + 0.16 * (fibre - 0.5)
    color = mix((0.46, 0.33, 0.23), (0.86, 0.68, 0.5), shade)
    joint = step(0.0, 0.02, min(across, 1 - across))
    return mix((0.14, 0.09, 0.06), color, joint)


def stone(u, v):
    vein = abs(clouds(u * 4, v * 4, 4, 5) - 0.5) * 2
    speck = clouds(u * 32, v * 32, 32, 2)
    color = mix((0.38, 0.36, 0.36), (0.76, 0.73, 0.68), step(0.0, 0.22, vein))
    return mix(color, (0.3, 0.28, 0.28), 0.35 * step(0.6, 0.85, speck))


def peel(u, v):
    """Skin of an orange."""
    blotch = clouds(u * 4, v * 4, 4, 3)
    return mix((0.93, 0.42, 0.05), (0.98, 0.62, 0.14), step(0.25, 0.75, blotch))


def dimples(u, v):
    """Height: round pits on a jittered grid that repeats."""
    cells, depth = 32, 0.0
    x, y = u * cells, v * cells
    for i in range(math.floor(x) - 1, math.floor(x) + 2):
        for j in range(math.floor(y) - 1, math.floor(y) + 2):
            a, b = i % cells, j % cells
            px = i + 0.5 + 0.5 * (_lattice[b * LATTICE + a] - 0.5)
            py = j + 0.5 + 0.5 * (_lattice[b * LATTICE + a + cells] - 0.5)
            depth = max(depth, 1 - 2.2 * math.hypot(x - px, y - py))
    return (1 - step(0.0, 1.0, depth),) * 3


def studs_height(u, v):
    x, y = (u * 6) % 1 - 0.5, (v * 6) % 1 - 0.5
    return 0.02 * (1 - step(0.22, 0.38, math.hypot(x, y)))


def studs(u, v):
    """Normal map of a field of round studs: x, y, z of the normal as (n + 1) / 2."""
    e = 1 / 1024
    du = (studs_height(u + e, v) - studs_height(u - e, v)) / (2 * e)
    dv = (studs_height(u, v + e) - studs_height(u, v - e)) / (2 * e)
    size = math.sqrt(du * du + dv * dv + 1)
    return (0.5 - 0.5 * du / size, 0.5 - 0.5 * dv / size, 0.5 + 0.5 / size)


def leaf(u, v):
    """A leaf with an alpha channel."""
    x, y = u - 0.5, (v - 0.06) / 0.88
    if not 0 <= y <= 1:
        return (0.2, 0.4, 0.1, 0.0)
    half = 0.42 * math.sin(math.pi * y) ** 0.8 * (1.15 - 0.5 * y)
    edge = half - abs(x) + 0.008 * math.sin(60 * y)
    vein = min(abs(x), abs((y * 7 - 9 * abs(x)) % 1 - 0.5) * 0.1)
    color = mix((0.62, 0.78, 0.3), (0.2, 0.45, 0.12), step(0.0, 0.02, vein))
    return color + (step(0.0, 0.012, edge),)


def panel(azimuth, elevation, center, size, soft=3.0):
    """1 inside of a rectangle on the sky, 0 outside; degrees."""
    across = abs((azimuth - center[0] + 180) % 360 - 180)
    up = abs(elevation - center[1])
    return (1 - step(size[0] - soft, size[0] + soft, across)) * (1 - step(size[1] - soft, size[1] + soft, up))


STUDIO_WHITE = 3.5  # radiance that is stored as 1


def studio(u, v):
    """Room for reflections: dim warm floor, grey walls, two windows and a strip."""
    azimuth, elevation = (0.5 - u) * 360, (v - 0.5) * 180  # azimuth from +x towards +y
    light = mix((0.06, 0.05, 0.045), (0.2, 0.22, 0.25), step(-25, 35, elevation))
    light = mix(light, (0.1, 0.12, 0.15), step(40, 90, elevation))
    for center, size, color in (
            ((-150, 30), (13, 17), (3.2, 3.3, 3.5)),
            ((-178, 30), (11, 17), (2.6, 2.8, 3.2)),
            ((-20, 28), (6, 26), (2.4, 1.9, 1.4))):
        light = mix(light, color, panel(azimuth, elevation, center, size))
    return tuple(stored(x / STUDIO_WHITE) for x in light)


def sky(u, v):
    """Evening: bright towards the horizon, a sun with its glow, clouds, dark ground."""
    azimuth, elevation = (0.5 - u) * 360, (v - 0.5) * 180
    up = max(math.sin(math.radians(elevation)), 0.0)
    light = mix((0.7, 0.52, 0.38), (0.13, 0.27, 0.6), up ** 0.5)
    veil = clouds(u * 8, v * 16, 8, 5)
    light = mix(light, (0.85, 0.74, 0.66), 0.7 * step(0.48, 0.75, veil) * step(0.02, 0.3, up))
    away = math.hypot(((azimuth - 60 + 180) % 360 - 180) * math.cos(math.radians(elevation)), elevation - 16)
    glow = 1.3 * math.exp(-away / 8) + 30 * (1 - step(2.0, 4.0, away))
    light = tuple(x + glow * y for x, y in zip(light, (1.0, 0.75, 0.45)))
    return mix((0.16, 0.14, 0.12), light, step(-1.5, 1.0, elevation))


@dataclass
class Picture:
    draw: object
    width: int
    height: int


TEXTURES = {
    "checker.ppm": Picture(checker, 64, 64),
    "uv_grid.ppm": Picture(uv_grid, 256, 256),
    "letters.ppm": Picture(letters, 16, 16),
    "wood.ppm": Picture(wood, 512, 256),
    "stone.ppm": Picture(stone, 256, 256),
    "peel.ppm": Picture(peel, 128, 128),
    "dimples.ppm": Picture(dimples, 256, 256),
    "studs.ppm": Picture(studs, 256, 256),
    "leaf.png": Picture(leaf, 128, 128),
    "studio.png": Picture(studio, 256, 128),
    "sky.pfm": Picture(sky, 256, 128),
}

# ------------------------------------------------------------------------------------ 3 picture files


def byte_rows(rows):
    """Rows of pixels -> rows of bytes."""
    return [bytes(min(max(int(x * 255 + 0.5), 0), 255) for pixel in row for x in pixel) for row in rows]


def encode_ppm(width, height, rows):
    return b"P6\n%d %d\n255\n" % (width, height) + b"".join(byte_rows(rows))


def encode_png(width, height, rows):
    def chunk(kind, data):
        body = kind + data
        return struct.pack(">I", len(data)) + body + struct.pack(">I", zlib.crc32(body))

    color_type = {3: 2, 4: 6}[len(rows[0][0])]
    header = struct.pack(">IIBBBBB", width, height, 8, color_type, 0, 0, 0)
    lines = b"".join(b"\0" + row for row in byte_rows(rows))
    return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", zlib.compress(lines, 9))
            + chunk(b"IEND", b""))


def encode_pfm(width, height, rows):
    data = array("f", (x for row in reversed(rows) for pixel in row for x in pixel))
    if sys.byteorder != "little":
        data.byteswap()
    return b"PF\n%d %d\n-1.0\n" % (width, height) + data.tobytes()


ENCODERS = {".ppm": encode_ppm, ".png": encode_png, ".pfm": encode_pfm}


def write_texture(name, picture):
    width, height = picture.width, picture.height
    rows = [[picture.draw((x + 0.5) / width, 1 - (y + 0.5) / height) for x in range(width)]
            for y in range(height)]
    with open(os.path.join(TEXTURE_FOLDER, name), "wb") as file:
        file.write(ENCODERS[os.path.splitext(name)[1]](width, height, rows))


# ------------------------------------------------------------------------------------------- 4 shapes


def add_mesh(name, vertices, faces, material, uvs=None, smooth=False, shape="", collection=None, **where):
    """uvs: one per corner of a face, in the order of the faces. shape: record for the exporter."""
    mesh = bpy.data.meshes.new(name)
    mesh.from_pydata(vertices, [], faces)
    if uvs:
        layer = mesh.uv_layers.new(name="UVMap")
        layer.data.foreach_set("uv", [x for uv in uvs for x in uv])
    mesh.polygons.foreach_set("use_smooth", [smooth] * len(faces))
    mesh.materials.append(material)
    thing = add_object(name, mesh, collection, **where)
    if shape:
        thing["rt_shape"] = shape
    return thing


def add_object(name, data, collection=None, location=(0, 0, 0), rotation=(0, 0, 0), scale=1):
    """rotation: Euler angles in degrees. scale: one number or three."""
    thing = bpy.data.objects.new(name, data)
    (collection or bpy.context.scene.collection).objects.link(thing)
    thing.location = location
    thing.rotation_euler = [math.radians(a) for a in rotation]
    thing.scale = (scale,) * 3 if isinstance(scale, (int, float)) else scale
    return thing


def add_copy(original, name="", **where):
    """Another object with the same mesh."""
    return add_object(name or original.name, original.data, **where)


def add_collection(name):
    """A collection that is seen through its instances only."""
    return bpy.data.collections.new(name)


def add_instance(collection, name, **where):
    empty = add_object(name, None, **where)
    empty.instance_type = "COLLECTION"
    empty.instance_collection = collection
    return empty


def subdivided(thing, levels):
    """Smooth; coarser in the viewport than in the picture."""
    modifier = thing.modifiers.new("Subdivision", "SUBSURF")
    modifier.levels, modifier.render_levels = max(levels - 1, 0), levels
    return thing


def bevelled(thing, width, segments=2):
    modifier = thing.modifiers.new("Bevel", "BEVEL")
    modifier.width, modifier.segments = width, segments
    return thing


def add_grid(name, rows, material, around=False, closed=False, smooth=True, **options):
    """Quads between rows of points. around: the last column joins the first; closed: the last row
    joins the first. A row of equal points becomes one point. The outside is where columns run
    counter-clockwise around rows that go up."""
    vertices, index = [], []
    for row in rows:
        is_pole = all((Vector(p) - Vector(row[0])).length < 1e-9 for p in row)
        first = len(vertices)
        vertices += row[:1] if is_pole else row
        index.append([first if is_pole else first + j for j in range(len(row))])
    count, columns = len(rows), len(rows[0])
    faces, uvs = [], []
    for i in range(count if closed else count - 1):
        for j in range(columns if around else columns - 1):
            k, l = (i + 1) % count, (j + 1) % columns
            corners = [(index[i][j], j, i), (index[i][l], j + 1, i),
                       (index[k][l], j + 1, i + 1), (index[k][j], j, i + 1)]
            if corners[0][0] == corners[1][0]:
                corners = [(corners[0][0], j + 0.5, i)] + corners[2:]
            elif corners[2][0] == corners[3][0]:
                corners = corners[:2] + [(corners[2][0], j + 0.5, i + 1)]
            faces.append([c[0] for c in corners])
            uvs += [(c[1] / (columns if around else columns - 1), c[2] / (count if closed else count - 1))
                    for c in corners]
    return add_mesh(name, vertices, faces, material, uvs, smooth, **options)


def add_lathe(name, profile, material, segments=32, **options):
    """Turns a profile of (radius, height), from below to above on its outside, about the z axis."""
    turn = [2 * math.pi * j / segments for j in range(segments)]
    rows = [[(r * math.cos(a), r * math.sin(a), z) for a in turn] for r, z in profile]
    return add_grid(name, rows, material, around=True, **options)


def add_tube(name, path, radii, material, segments=8, **options):
    """A round tube along a path in the plane y = 0; radii: one per point of the path."""
    rows = []
    points = [Vector((x, 0, z)) for x, z in path]
    for i, (center, radius) in enumerate(zip(points, radii)):
        along = (points[min(i + 1, len(points) - 1)] - points[max(i - 1, 0)]).normalized()
        side = Vector((0, 1, 0))
        up = along.cross(side)
        turn = [2 * math.pi * j / segments for j in range(segments)]
        rows.append([tuple(center + radius * (math.cos(a) * side + math.sin(a) * up)) for a in turn])
    return add_grid(name, rows, material, around=True, **options)


def arc(radius, start, end, count, center=(0, 0)):
    """Points on a circle; degrees, both ends included."""
    angles = [math.radians(start + (end - start) * i / count) for i in range(count + 1)]
    return [(center[0] + radius * math.cos(a), center[1] + radius * math.sin(a)) for a in angles]


def add_sphere(name, material, radius=1, segments=32, **options):
    profile = [(max(r, 0.0) if abs(r) > 1e-9 else 0.0, z) for r, z in arc(radius, -90, 90, segments // 2)]
    return add_lathe(name, profile, material, segments, **options)


def add_torus(name, material, radius=1, thickness=0.3, segments=32, **options):
    profile = arc(thickness, 0, 360, segments // 2, (radius, 0))[:-1]
    return add_lathe(name, profile, material, segments, closed=True, **options)


def add_cylinder(name, material, radius=1, height=2, segments=48, top=None, **options):
    """Stands on z = 0. top: radius above, for a cone. A round record for the exporter."""
    top = radius if top is None else top
    profile = [(0, 0), (radius, 0), (top, height)] + ([(0, height)] if top > 0 else [])
    options.setdefault("shape", "cylinder" if top == radius else "cone")
    return add_lathe(name, profile, material, segments, smooth=False, **options)


CUBE_FACES = ((0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5))


def add_cube(name, material, size=2, **options):
    corners = [((i & 1) - 0.5, (i >> 1 & 1) - 0.5, (i >> 2) - 0.5) for i in range(8)]
    vertices = [tuple(size * x for x in corner) for corner in corners]
    uvs = [(0, 0), (1, 0), (1, 1), (0, 1)] * 6
    return add_mesh(name, vertices, CUBE_FACES, material, uvs, **options)


def add_plane(name, material, size=(2, 2), **options):
    x, y = size[0] / 2, size[1] / 2
    vertices = [(-x, -y, 0), (x, -y, 0), (x, y, 0), (-x, y, 0)]
    return add_mesh(name, vertices, [(0, 1, 2, 3)], material, [(0, 0), (1, 0), (1, 1), (0, 1)], **options)


def add_monkey(name, material, levels=1, **where):
    bpy.ops.mesh.primitive_monkey_add()
    made = bpy.context.object
    mesh = made.data
    bpy.data.objects.remove(made)
    mesh.name = name
    mesh.polygons.foreach_set("use_smooth", [True] * len(mesh.polygons))
    mesh.materials.append(material)
    return subdivided(add_object(name, mesh, **where), levels)


# ---------------------------------------------------------------------------------------- 5 materials


@dataclass(frozen=True)
class Image:
    """An image texture as an input of a shader."""
    file: str
    scale: tuple = (1, 1)
    rotation: float = 0  # degrees
    offset: tuple = (0, 0)
    extension: str = "REPEAT"  # REPEAT EXTEND CLIP
    interpolation: str = "Linear"  # Linear Closest
    output: str = "Color"  # Color Alpha
    is_data: bool = False  # numbers, not colours


@dataclass(frozen=True)
class Bump:
    height: Image
    distance: float
    strength: float = 1.0


@dataclass(frozen=True)
class NormalMap:
    image: Image
    strength: float = 1.0


@dataclass(frozen=True)
class Shader:
    """A shader node and its inputs: numbers, colours, Image, Bump, NormalMap or another Shader."""
    node: str
    inputs: dict
    distribution: Optional[str] = None


def load_image(file, is_data):
    image = bpy.data.images.get(file)
    if image is None:
        image = bpy.data.images.load(os.path.join(TEXTURE_FOLDER, file))
        image.name, image.filepath = file, "//../Textures/" + file
    # Set even where it is the default: Blender cannot read all of these itself, and leaves it open.
    image.colorspace_settings.name = "Non-Color" if is_data or file.endswith(".pfm") else "sRGB"
    return image


def add_image_node(tree, image):
    node = tree.nodes.new("ShaderNodeTexImage")
    node.image = load_image(image.file, image.is_data)
    node.extension, node.interpolation = image.extension, image.interpolation
    if (image.scale, image.rotation, image.offset) != ((1, 1), 0, (0, 0)):
        mapping, source = tree.nodes.new("ShaderNodeMapping"), tree.nodes.new("ShaderNodeUVMap")
        mapping.inputs["Location"].default_value = image.offset + (0,)
        mapping.inputs["Rotation"].default_value = (0, 0, math.radians(image.rotation))
        mapping.inputs["Scale"].default_value = image.scale + (1,)
        tree.links.new(source.outputs["UV"], mapping.inputs["Vector"])
        tree.links.new(mapping.outputs["Vector"], node.inputs["Vector"])
    return node.outputs[image.output]


def add_bump_node(tree, bump):
    node = tree.nodes.new("ShaderNodeBump")
    node.inputs["Strength"].default_value, node.inputs["Distance"].default_value = bump.strength, bump.distance
    connect(tree, node.inputs["Height"], bump.height)
    return node.outputs["Normal"]


def add_normal_node(tree, normal):
    node = tree.nodes.new("ShaderNodeNormalMap")
    node.inputs["Strength"].default_value = normal.strength
    connect(tree, node.inputs["Color"], normal.image)
    return node.outputs["Normal"]


def add_shader_node(tree, shader):
    node = tree.nodes.new("ShaderNode" + shader.node)
    if shader.distribution:
        node.distribution = shader.distribution
    for name, value in shader.inputs.items():
        connect(tree, node.inputs[name], value)
    return node.outputs[0]


NODE_MAKERS = {Image: add_image_node, Bump: add_bump_node, NormalMap: add_normal_node, Shader: add_shader_node}


def connect(tree, socket, value):
    """Gives a socket a constant, or a link from what `value` describes."""
    make = NODE_MAKERS.get(type(value))
    if make:
        tree.links.new(make(tree, value), socket)
    elif isinstance(value, (int, float)):
        socket.default_value = value
    else:
        socket.default_value = tuple(value) + ((1,) if len(value) == 3 and socket.type == "RGBA" else ())


def material(name, shader):
    made = bpy.data.materials.new(name)
    made.use_nodes = True
    tree = made.node_tree
    tree.nodes.clear()
    output = tree.nodes.new("ShaderNodeOutputMaterial")
    connect(tree, output.inputs["Surface"], shader)
    return made


def diffuse(color, **inputs):
    return Shader("BsdfDiffuse", {"Color": color, **inputs})


def glossy(color, roughness=0.0, **inputs):
    # Ashikhmin-Shirley is the lobe that Cycles and we compute alike.
    kind = "ASHIKHMIN_SHIRLEY" if roughness > 0 else None
    return Shader("BsdfGlossy", {"Color": color, "Roughness": roughness, **inputs}, kind)


def glass(color, ior=1.5, roughness=0.0):
    return Shader("BsdfGlass", {"Color": color, "IOR": ior, "Roughness": roughness})


def emission(color, strength=1.0):
    return Shader("Emission", {"Color": color, "Strength": strength})


def transparent(color=(1, 1, 1)):
    return Shader("BsdfTransparent", {"Color": color})


def principled(color, roughness=0.0, metallic=0.0, **inputs):
    return Shader("BsdfPrincipled",
                  {"Base Color": color, "Roughness": roughness, "Metallic": metallic, **inputs})


def added(first, second):
    return Shader("AddShader", {0: first, 1: second})


def mixed(factor, first, second):
    return Shader("MixShader", {0: factor, 1: first, 2: second})


def roughness_of(exponent):
    """Blender's roughness with a Blinn-Phong exponent."""
    return (2 / (exponent + 2)) ** 0.25


# ------------------------------------------------------------------------------- 6 lights and cameras


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


# ------------------------------------------------------------------------------------------- 7 scenes

SUGAR = 0.24  # edge of a cube of sugar
ORANGE_SKIN = Bump(Image("dimples.ppm", scale=(2, 1), is_data=True), 0.004)


def teapot(glaze, **where):
    """Body, lid, spout and handle; 2 wide at the body, stands on z = 0. Spout along +x."""
    body = [(0, 0), (0.62, 0), (0.68, 0.06), (0.98, 0.5), (1.0, 0.78), (0.72, 1.18), (0.52, 1.26), (0, 1.27)]
    lid = [(0.56, 1.24), (0.55, 1.31), (0.3, 1.42), (0.09, 1.46), (0.09, 1.53), (0.19, 1.62), (0.1, 1.72), (0, 1.73)]
    spout = [(0.75, 0.42), (1.12, 0.52), (1.36, 0.88), (1.5, 1.2), (1.66, 1.33)]
    handle = [(-0.66, 1.1), (-1.0, 1.3), (-1.42, 1.22), (-1.56, 0.9), (-1.36, 0.56), (-0.86, 0.36)]
    root = add_object("Teapot", None, **where)
    parts = [
        subdivided(add_lathe("Teapot body", body, glaze, 12), 2),
        subdivided(add_lathe("Teapot lid", lid, glaze, 12), 2),
        subdivided(add_tube("Teapot spout", spout, (0.34, 0.27, 0.17, 0.13, 0.12), glaze), 2),
        subdivided(add_tube("Teapot handle", handle, (0.1,) * 6, glaze, 6), 2),
    ]
    for part in parts:
        part.parent = root
    return root


def cup_and_saucer(china, tea):
    """A collection; stands on z = 0, handle along +x."""
    cup = [(0, 0.1), (0.2, 0.1), (0.22, 0.15), (0.46, 0.36), (0.53, 0.72), (0.5, 0.72), (0.43, 0.4), (0, 0.2)]
    handle = [(0.46, 0.62), (0.66, 0.68), (0.76, 0.5), (0.64, 0.34), (0.44, 0.32)]
    saucer = [(0, 0), (0.32, 0), (0.78, 0.11), (0.78, 0.14), (0.32, 0.06), (0, 0.06)]
    group = add_collection("Cup and saucer")
    subdivided(add_lathe("Cup", cup, china, 16, collection=group), 1)
    subdivided(add_tube("Cup handle", handle, (0.05,) * 5, china, 6, collection=group), 1)
    subdivided(add_lathe("Saucer", saucer, china, 16, collection=group), 1)
    add_cylinder("Tea", tea, 0.485, 0.01, shape="disk", location=(0, 0, 0.58), collection=group)
    return group


def showcase():
    """A tea table: most features in one picture."""
    celadon = material("Celadon glaze", principled((0.02, 0.17, 0.17)))
    china = material("China", principled((0.8, 0.77, 0.7)))
    tea = material("Tea", principled((0.2, 0.05, 0.008)))
    steel = material("Steel", glossy((0.92, 0.92, 0.92)))
    crystal = material("Crystal", glass((1, 1, 1), 1.52))
    brass = material("Brass", glossy((0.8, 0.52, 0.2), 0.15))
    sugar = material("Sugar", diffuse((0.86, 0.85, 0.82)))
    paper = material("Blue paper", diffuse((0.06, 0.12, 0.3)))
    dough = material("Chocolate", principled((0.12, 0.045, 0.02), 0.3))
    orange = material("Orange", added(
        diffuse(Image("peel.ppm", scale=(2, 1)), Normal=ORANGE_SKIN),
        glossy((0.04, 0.04, 0.04), 0.35, Normal=ORANGE_SKIN)))
    boards = material("Boards", added(
        diffuse(Image("wood.ppm", scale=(2.5, 3))), glossy((0.05, 0.05, 0.05))))
    wall = material("Wall", diffuse((0.2, 0.25, 0.27)))

    add_plane("Table", boards, (24, 18), location=(0, -1, 0))
    add_plane("Wall", wall, (80, 40), location=(0, 14, 0), rotation=(90, 0, 0))

    teapot(celadon, location=(-1.42, 0.5, 0), rotation=(0, 0, -24))
    cups = cup_and_saucer(china, tea)
    add_instance(cups, "Cup front", location=(1.5, -0.75, 0), rotation=(0, 0, -35))
    add_instance(cups, "Cup right", location=(3.5, 2.5, 0), rotation=(0, 0, 200))
    add_instance(cups, "Cup back", location=(0.15, 3.6, 0), rotation=(0, 0, 160))

    add_sphere("Steel ball", steel, 0.6, location=(0.78, 1.5, 0.6))
    add_sphere("Crystal ball", crystal, 0.36, location=(-0.3, -1.3, 0.36))
    first = add_sphere("Orange", orange, 0.4, location=(2.62, 0.15, 0.4), rotation=(20, 30, 0))
    add_copy(first, location=(3.25, 0.6, 0.39), rotation=(70, -40, 50), scale=0.97)
    add_torus("Doughnut", dough, 0.33, 0.15, 24, location=(-2.15, -1.1, 0.16))
    add_cylinder("Tin", brass, 0.45, 1.1, location=(-3.0, 1.9, 0))
    add_cylinder("Sugarloaf", paper, 0.38, 1.25, top=0.08, location=(3.0, 4.6, 0))

    for i, (x, y, turn) in enumerate(((0.4, -1.8, 15), (0.73, -1.62, 50), (0.56, -2.02, 80))):
        cube = add_cube("Sugar %d" % i, sugar, SUGAR, location=(x, y, SUGAR / 2), rotation=(0, 0, turn))
        bevelled(cube, 0.03)
    falling = bevelled(add_cube("Falling sugar", sugar, SUGAR), 0.03)
    move(falling, (0, 2), location=((1.5, -0.75, 1.47), (1.5, -0.75, 1.25)),
         rotation_euler=((0.5, 0.4, 0.2), (0.7, 0.5, 0.2)))
    blur_motion()

    add_light("AREA", "Key", (-5.9, -2.2, 6.2), (0, 0.2, 0.2), 2300, (1, 0.94, 0.86), True,
              shape="RECTANGLE", size=3.8, size_y=2.8)
    add_light("AREA", "Rim", (6.2, 3.0, 3.4), (0, 0, 0.6), 190, (1, 0.62, 0.34), True, shape="DISK", size=1.6)
    add_light("SPOT", "Wall glow", (-1.0, 4.5, 7.5), (-0.8, 14, 2.0), 6500, (0.7, 0.88, 1),
              spot_size=math.radians(85), spot_blend=1, shadow_soft_size=0.3)
    set_world(environment="studio.png", strength=0.8 * STUDIO_WHITE)
    camera = add_camera((0.45, -9.2, 3.5), (0.22, 0, 0.66), 51, fstop=0.5, focus=(-0.2, -0.6, 0.6))
    camera.data.dof.aperture_blades = 6


CORAL, MUSTARD, CREAM = (0.72, 0.16, 0.1), (0.76, 0.46, 0.08), (0.78, 0.72, 0.6)
TEAL, SLATE, WHITE = (0.05, 0.34, 0.36), (0.12, 0.15, 0.22), (0.8, 0.8, 0.8)
PALETTE = (CORAL, MUSTARD, CREAM, TEAL, SLATE)


def add_floor(shader=None, size=60):
    """Ground at z = 0: grey unless told; its texture repeats every unit."""
    add_plane("Floor", material("Floor", shader or diffuse((0.5, 0.5, 0.5))), (size, size))


def checkered(size=60, field=1.0, reflects=0.0):
    """Shader of a checkered floor of this size; field: the side of a field."""
    base = diffuse(Image("checker.ppm", scale=(size / (2 * field),) * 2, interpolation="Closest"))
    return added(base, glossy((reflects,) * 3)) if reflects else base


def add_daylight(strength=2.9, angle=1.5, sky=(0.2, 0.23, 0.28), direction=(-0.55, 0.6, -0.75), color=(1, 0.95, 0.88)):
    """A sun and an even sky."""
    add_light("SUN", "Sun", (0, 0, 10), Vector((0, 0, 10)) + Vector(direction), strength, color,
              angle=math.radians(angle))
    set_world(sky)


def add_softbox(power=700, location=(-4, -5, 7), target=(0, 0, 0), size=3.0):
    """One large lamp, seen in mirrors, and a weak sky."""
    add_light("AREA", "Softbox", location, target, power, is_visible=True, size=size)
    set_world((0.12, 0.13, 0.15))


def add_row(count, spacing, make):
    """make(i, x) for `count` things side by side, centred on x = 0."""
    for i in range(count):
        make(i, (i - (count - 1) / 2) * spacing)


def add_posts(count, spacing, radius, place):
    """A row of posts in the colours of the palette; place(i, x) gives foot and height of each."""
    paint = [material("Paint %d" % i, diffuse(color)) for i, color in enumerate(PALETTE)]

    def add_post(i, x):
        foot, height = place(i, x)
        add_cylinder("Post %d" % i, paint[i % len(paint)], radius, height, location=foot)

    add_row(count, spacing, add_post)


def add_towers(count=5):
    """A small town of boxes on a square grid."""
    walls = [material("Wall %d" % i, diffuse(color)) for i, color in enumerate(PALETTE)]
    height = random.Random(4)
    block = add_cube("Block", walls[0], 1)
    bpy.context.scene.collection.objects.unlink(block)
    for i in range(count * count):
        x, y = i % count - (count - 1) / 2, i // count - (count - 1) / 2
        h = round(0.4 + 2.4 * height.random() ** 1.6, 2)
        tower = add_copy(block, "Tower %d" % i, location=(1.25 * x, 1.25 * y, h / 2), scale=(0.9, 0.9, h))
        tower.material_slots[0].link = "OBJECT"
        tower.material_slots[0].material = walls[(i * 7 + i // count) % len(walls)]


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


def lights_point():
    add_floor()
    white = material("White", diffuse(WHITE))
    add_sphere("Ball", white, 1, location=(0, 0, 1))
    add_cube("Left box", white, 1, location=(-2.6, 0.6, 0.5), rotation=(0, 0, 30))
    add_cylinder("Right post", white, 0.45, 1.6, location=(2.5, 0.5, 0))
    add_row(3, 2.6, lambda i, x: add_light(
        "POINT", "Lamp %d" % i, (x, -2.4, 3.0), (0, 0, 0), 200, ((1, 0.25, 0.12), (0.3, 1, 0.35), (0.2, 0.4, 1))[i]))
    set_world((0.02, 0.02, 0.025))
    add_camera((0, -8.8, 4), (0, 0, 0.7), 44)


def lights_spot():
    add_floor()
    add_plane("Wall", material("Back", diffuse((0.55, 0.55, 0.57))), (40, 20), location=(0, 3, 0), rotation=(90, 0, 0))
    white = material("White", diffuse(WHITE))

    def add_spot(i, x):
        add_light("SPOT", "Spot blend %s" % (0, 0.3, 1)[i], (x, -2.4, 4.4), (x, 1.4, 0.9), 900,
                  ((1, 0.75, 0.5), (0.6, 1, 0.75), (0.6, 0.75, 1))[i],
                  spot_size=math.radians(38), spot_blend=(0, 0.3, 1)[i])
        add_sphere("Ball %d" % i, white, 0.6, location=(x, 1.0, 0.6))

    add_row(3, 3.0, add_spot)
    set_world((0.06, 0.06, 0.07))
    add_camera((0, -9, 3.2), (0, 0, 1.15), 42)


def lights_sun():
    """A low sun as wide as the real one: long shadows, a little soft at their far ends."""
    add_floor(diffuse(CREAM))
    add_posts(9, 0.85, 0.18, lambda i, x: ((x, 0, 0), 0.7 + 0.2 * (4 - abs(i - 4))))
    add_daylight(3.4, 0.53, (0.16, 0.2, 0.28), (0.75, -0.7, -0.42), (1, 0.82, 0.6))
    add_camera((1.2, -8.8, 4.2), (0.8, -0.8, 0.3), 38)


def lights_area():
    """The four shapes of area lights and a glowing sphere, each in a bay of its own."""
    add_floor()
    white, wall = material("White", diffuse(WHITE)), material("Bay", diffuse((0.6, 0.58, 0.55)))
    glow = material("Glow", emission((1, 0.93, 0.84), 14))
    add_plane("Back", wall, (30, 8), location=(0, 1.6, 0), rotation=(90, 0, 0))
    add_row(6, 2.4, lambda i, x: add_cube("Partition %d" % i, wall, 1, location=(x, 0, 1.5), scale=(0.06, 3.2, 3)))

    def add_bay(i, x):
        add_sphere("Ball %d" % i, white, 0.5, location=(x, -0.3, 0.5))
        if i == 4:
            add_sphere("Sphere", glow, 0.32, location=(x, 0.7, 2.35))
            return
        shape = ("SQUARE", "RECTANGLE", "DISK", "ELLIPSE")[i]
        add_light("AREA", shape.title(), (x, 0.7, 2.35), (x, -0.5, 0.4), 70, (1, 0.93, 0.84), True, shape=shape,
                  size=(0.9, 1.5, 1.0, 1.5)[i], size_y=(0.9, 0.45, 1.0, 0.5)[i])

    add_row(5, 2.4, add_bay)
    set_world((0.14, 0.14, 0.14))
    add_camera((0, -10.5, 1.5), (0, 0, 1.35), 27)


def soft_shadows():
    """Shadows are sharp where things touch the floor and soften with the distance."""
    add_floor(diffuse((0.62, 0.6, 0.57)))
    add_posts(9, 0.55, 0.09, lambda i, x: ((x - 0.8, 0.6, 0), 1.7))
    add_sphere("Ball", material("Red", diffuse(CORAL)), 0.7, location=(2.9, -0.1, 0.7))
    add_light("AREA", "Disk", (2.5, 7.0, 6.5), (0, 0, 0), 1300, (1, 0.95, 0.88), shape="DISK", size=1.6)
    set_world((0.14, 0.15, 0.17))
    add_camera((0.3, -7.5, 4.4), (0.3, -0.3, 0.6), 40)


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
    add_sphere("Globe", material("Globe", diffuse(Image("uv_grid.ppm", scale=(2, 1)))), 0.95,
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
        location=(x, 0, 1)))
    add_softbox(620, (-6, -4, 5), size=1.5)
    add_camera((0, -9, 2.6), (0, 0, 0.95), 38)


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
                          location=(-7 + 14 * _lattice[i], 13 + 5 * _lattice[i + 50], 0.8 + 3.6 * _lattice[i + 100]))
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


def world_environment():
    """An evening sky as background, in reflections and through glass."""
    add_cylinder("Ground", material("Ground", diffuse((0.3, 0.28, 0.26))), 4.2, 0.2, location=(0, 0, -0.2))
    shaders = (glossy((0.95, 0.95, 0.95)), glass((1, 1, 1), 1.5), principled(CORAL), glossy((0.9, 0.75, 0.5), 0.25))
    add_row(4, 1.75, lambda i, x: add_sphere("Ball %d" % i, material("Ball %d" % i, shaders[i]), 0.75,
                                             location=(x, 0, 0.75)))
    set_world(environment="sky.pfm", rotation=-25)
    # The picture lights diffuse things evenly; the sun in it casts its shadows as a lamp.
    add_light("SUN", "Sun", (0, 0, 5), Vector((0, 0, 5)) - Vector((0.05, 0.95, 0.3)), 1.5, (1, 0.7, 0.4),
              angle=math.radians(4))
    add_camera((0.6, -8, 1.5), (0, 0, 0.95), 38)


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


def antialiasing():
    """Fields of the floor become smaller than pixels towards the horizon."""
    add_floor(checkered(400, 0.5), 400)
    add_sphere("Ball", material("Red", diffuse(CORAL)), 1, location=(-1.6, 1, 1))
    silver = material("Silver", glossy((0.9, 0.9, 0.9)))
    add_torus("Ring", silver, 0.8, 0.12, 36, location=(1.5, 0.5, 0.9), rotation=(80, 0, 30))
    add_posts(24, 0.4, 0.03, lambda i, x: ((x, 5 + 0.1 * i, 0), 2))
    add_daylight(2.2, 0.5, (0.5, 0.6, 0.75))
    add_camera((0, -6, 1.6), (0, 0, 0.95), 35)


@dataclass
class Row:
    build: object
    width: int = 640
    height: int = 360
    samples: int = 16
    bounces: int = 6


SCENES = {
    "showcase": Row(showcase, 960, 540, 32),
    "camera_perspective": Row(camera_perspective),
    "camera_fit": Row(camera_fit, 300, 420),
    "camera_ortho": Row(camera_ortho),
    "camera_shift": Row(camera_shift),
    "lights_point": Row(lights_point),
    "lights_spot": Row(lights_spot),
    "lights_sun": Row(lights_sun),
    "lights_area": Row(lights_area),
    "soft_shadows": Row(soft_shadows),
    "shapes": Row(shapes),
    "instances": Row(instances),
    "mirror": Row(mirror, bounces=16),
    "glass": Row(glass_scene, bounces=12),
    "glossy": Row(glossy_scene),
    "blinn": Row(blinn),
    "textures": Row(textures),
    "bump_normal": Row(bump_normal),
    "dof": Row(dof, samples=64),
    "motion_blur": Row(motion_blur),
    "world_environment": Row(world_environment),
    "transparent": Row(transparent_scene),
    "antialiasing": Row(antialiasing),
}

# ------------------------------------------------------------------------------------- 8 command line


def new_file(row):
    """An empty scene with our settings."""
    bpy.ops.wm.read_factory_settings(use_empty=True)
    preferences = bpy.context.preferences
    preferences.filepaths.save_version = 0  # no .blend1
    preferences.edit.keyframe_new_interpolation_type = "LINEAR"
    scene = bpy.context.scene
    scene.render.engine = "CYCLES"
    scene.render.filepath = "//"
    scene.render.resolution_x, scene.render.resolution_y = row.width, row.height
    scene.render.resolution_percentage = 100
    cycles = scene.cycles
    cycles.samples = row.samples
    cycles.max_bounces = cycles.glossy_bounces = cycles.transmission_bounces = row.bounces
    cycles.use_denoising = cycles.use_adaptive_sampling = False
    scene.view_settings.view_transform = "Standard"
    scene.render.dither_intensity = 0


def save_file(name):
    bpy.ops.wm.save_as_mainfile(
        filepath=os.path.join(HERE, name + ".blend"), compress=True, relative_remap=False)


def main():
    wanted = sys.argv[sys.argv.index("--") + 1:] if "--" in sys.argv else []
    for name in wanted:
        if name not in SCENES:
            sys.exit("MakeScenes.py: error: no scene '%s'; known: %s" % (name, ", ".join(SCENES)))
    os.makedirs(TEXTURE_FOLDER, exist_ok=True)
    for name, picture in TEXTURES.items():
        if not wanted or not os.path.exists(os.path.join(TEXTURE_FOLDER, name)):
            write_texture(name, picture)
    for name in wanted or SCENES:
        new_file(SCENES[name])
        SCENES[name].build()
        save_file(name)


main()
