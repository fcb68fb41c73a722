"""Meshes as Blender renders them: modifiers, normals, uv, material slots, instances, other kinds of objects."""

import math

import bpy

from kit import Export, Nodes, VERSION, add, export, mesh_of, new_scene, picture, primitive, test
from scene_text import equal, near


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
    equal([block.get("normals"), block.get("normal_triangles")], [block.get("points"), None])  # those of the points

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


@test
def instances_take_linear_work():
    """Looks at names that are taken, and at arrays of Blender, for n and for 2 n copies of one object."""
    class Counted(set):
        looks = 0

        def __contains__(self, name):
            Counted.looks += 1
            return super().__contains__(name)

    def work(count):
        new_scene()
        thing = primitive("monkey")
        thing.parent = add("Points", mesh_of([(i, 0, 0) for i in range(count)], []))
        thing.parent.instance_type = "VERTS"
        reads, plain = [], (Export.Names.__init__, Export.read)

        def counting(names):
            plain[0](names)
            names.taken = Counted()

        Export.Names.__init__ = counting
        Export.read = lambda *arguments: reads.append(arguments) or plain[1](*arguments)
        Counted.looks = 0
        try:
            text = export()
        finally:
            Export.Names.__init__, Export.read = plain
        names = [b.name for b in text.all("instance")]
        equal([len(names), len(set(names))], [count, count])
        return Counted.looks, len(reads)

    (few, few_reads), (many, many_reads) = work(300), work(600)
    assert many - few <= 2 * 300, "%d looks for 300 copies, %d for 600" % (few, many)
    equal(many_reads, few_reads)


@test
def names_that_are_taken_are_passed_over():
    names = Export.Names()
    equal([names.unique(n) for n in ("A", "A.002", "A", "A", "A", "", "")],
          ["A", "A.002", "A.001", "A.003", "A.004", "unnamed", "unnamed.001"])


@test
def corners_that_points_share_are_not_written():
    """Normals and texture coordinates, one for each point, go without corners of their own; seams need them."""
    def grid(change=lambda mesh: None):
        new_scene()
        nodes = Nodes()
        nodes.end(nodes.node("BsdfDiffuse", Color=nodes.node("TexImage", {"image": picture()})))
        thing = primitive("grid", nodes.owner, smooth=True, x_subdivisions=4, y_subdivisions=3)
        change(thing.data)
        return export().one("mesh"), thing.data

    block, mesh = grid()
    equal([block.get(k) for k in ("normals", "uvs", "normal_triangles", "uv_triangles")],
          [len(mesh.vertices), len(mesh.vertices), None, None])
    for loop, place in zip(mesh.loops, mesh.uv_layers[0].data):
        near(block.arrays["uvs"][loop.vertex_index], list(place.uv), 1e-5)

    def cut(mesh):
        vertices = [loop.vertex_index for loop in mesh.loops]
        inner = next(i for i, v in enumerate(vertices) if vertices.count(v) == 4)
        mesh.uv_layers[0].data[inner].uv = (0.5, 0.7)

    block, mesh = grid(cut)
    equal([block.get("uv_triangles"), [0.5, 0.7] in block.arrays["uvs"]], [block.get("triangles"), True])
