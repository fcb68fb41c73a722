"""Objects: meshes of grids of points, copies and instances."""

import math

import bpy
from mathutils import Vector


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
    """A round record for the exporter; shape="" where texture coordinates have to be the mesh's."""
    options.setdefault("shape", "sphere")
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
