"""Meshes that are written as spheres, cubes and planes, and those that are not."""

import bpy
from mathutils import Vector

from kit import Nodes, add, export, mesh_of, new_scene, picture, primitive, test
from scene_text import equal, near


@test
def spheres_are_recognised():
    new_scene()
    primitive("uv_sphere", smooth=True, radius=2, location=(1, 2, 3), segments=64, ring_count=32)
    near(export().one("sphere").keys()[0], [[2, 0, 0, 1], [0, 2, 0, 2], [0, 0, 2, 3]])
    new_scene()
    thing = primitive("ico_sphere", smooth=True, subdivisions=5, radius=0.5)
    for v in thing.data.vertices:  # size and place sit in the mesh
        v.co = (v.co.x * 2 + 5, v.co.y * 3, v.co.z)
    thing.location, thing.scale = (0, 0, 1), (2, 1, 1)
    near(export().one("sphere").keys()[0], [[2, 0, 0, 10], [0, 1.5, 0, 0], [0, 0, 0.5, 1]], 1e-5)


@test
def other_balls_stay_meshes():
    for change in ("flat", "dent", "inside out", "open", "coarse"):
        new_scene()
        segments = 32 if change == "coarse" else 64  # off by a hundredth of the radius
        thing = primitive("uv_sphere", smooth=change != "flat", segments=segments, ring_count=segments // 2)
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
    new_scene()  # facets are seen, however fine
    primitive("uv_sphere", smooth=False, segments=128, ring_count=64)
    export().one("instance")


@test
def custom_normals_stay_meshes_and_no_shapes_leaves_all():
    for kind, record in (("cube", "cube"), ("plane", "plane"), ("uv_sphere", "sphere")):
        fine = {"segments": 64, "ring_count": 32} if kind == "uv_sphere" else {}
        new_scene()
        thing = primitive(kind, smooth=kind == "uv_sphere", **fine)
        export().one(record)
        export(arguments=["--no-shapes"]).one("instance")
        thing["rt_shape"] = record
        export(arguments=["--no-shapes"]).one(record)
        del thing["rt_shape"]
        if hasattr(thing.data, "use_auto_smooth"):
            thing.data.use_auto_smooth = True
        thing.data.normals_split_custom_set([(0, 0.6, 0.8)] * len(thing.data.loops))
        block = export().one("instance")


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


@test
def convex_by_a_hair_is_one_rule():
    """Corners that float arithmetic takes for convex and double for concave: whatever they are written as, the
    renderer takes it (export() lets it check)."""
    for step in range(40):
        new_scene()
        depth = 0.5 + (step - 20) * 3e-8
        far = 1e4 * (step % 3)
        add("Q", mesh_of([(far, 0, 0), (far + 1, 0, 0), (far + depth, depth, 0), (far, 1, 0)], [(0, 1, 2, 3)]))
        equal(len(export().all("plane", "instance")), 1)
