"""Shader nodes as materials."""

import math

import bpy

from kit import Nodes, VERSION, export, material_text, mesh_of, new_scene, primitive, test
from scene_text import equal, near


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
    text = export()
    lamp = text.one("light")
    equal([lamp["type"], lamp["visible"]], ["sphere", True])
    near([lamp["radius"], *lamp["translate"]], [0.5005, 0, 0, 3])
    part = sum(f.area for f in bpy.context.object.data.polygons) / math.pi  # of the surface of the ball
    near(lamp["color"], [4 * part, 2 * part, 0.8 * part])
    text.one("instance")  # within it, and blocks light
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


@test
def numbers_that_the_renderer_would_refuse():
    for kind in ("BsdfGlass", "BsdfRefraction"):
        block, _ = material_text(lambda n: n.node(kind, IOR=0.0), [35])
        near(block["ior"], 1e-3)
        block, _ = material_text(lambda n: n.node(kind, IOR=5000.0), [35])
        near(block["ior"], 1000)
    material_text(lambda n: n.mix(n.node("Fresnel", IOR=0.0), n.node("BsdfDiffuse"), n.node("BsdfGlossy")))
    material_text(lambda n: n.node("Emission", Strength=1e30), [32, 35])
    dark = lambda n: n.node("BsdfDiffuse", Color=n.node("Math", {"operation": "LOGARITHM"}, Value=-1.0))
    material_text(dark)


def glowing(kind, shader=None, **arguments):
    """A new scene with a mesh that glows."""
    new_scene()
    nodes = Nodes()
    glow = nodes.node("Emission", Color=(1, 1, 1), Strength=3.0)
    nodes.end(shader(nodes, glow) if shader else glow)
    return primitive(kind, nodes.owner, **arguments)


@test
def what_glows_keeps_its_light_and_blocks_that_of_others():
    glowing("plane", size=2, location=(0, 0, 3))
    text = export()
    lamps = text.all("light")
    equal([(b["type"], b["visible"], b["size"]) for b in lamps], [("rectangle", True, [2, 2])] * 2)
    near(sorted(b.keys()[0][2][3] for b in lamps), [3 - 1e-3, 3 + 1e-3])  # one on each side of the mesh
    for block in lamps:  # which shine away from it
        rows = block.keys()[0]
        assert (rows[2][3] - 3) * -rows[2][2] > 0
    text.one("plane")
    glowing("circle", radius=2, vertices=32, fill_type="NGON").scale = (1, 0.5, 1)
    lamps = export().all("light")
    equal([b["type"] for b in lamps], ["disk", "disk"])
    x, y = sorted(lamps[0]["size"])
    near([math.pi / 4 * x * y, y / x], [32 / 2 * math.sin(math.pi / 16) * 4 / 2, 2], 1e-4)
    glowing("circle", radius=2, vertices=32, fill_type="TRIFAN")
    equal([b["type"] for b in export().all("light")], ["disk", "disk"])
    glowing("uv_sphere", radius=50, smooth=True).data.flip_normals()  # the camera is in it
    text = export()
    near(text.one("light")["radius"], 50)
    equal(text.all("instance", "sphere"), [])
    glowing("cube")
    text = export([32])
    equal(len(text.all("light")), 0)
    text.one("cube")


@test
def what_glows_out_of_sight_or_beside_other_lobes_still_lights():
    glowing("plane").visible_camera = False
    text = export([6])
    equal([(b.get("visible"), b["seen_by"]) for b in text.all("light")], [(None, "reflections")] * 2)
    equal(text.all("plane"), [])
    glowing("cube").visible_camera = False
    text = export([6, 32])
    equal(len(text.all("light", "cube")), 0)
    glowing("plane", lambda n, glow: n.node("AddShader", Shader=n.node("BsdfDiffuse", Color=(0.5, 0.5, 0.5)), Shader_001=glow))
    text = export()
    equal([b.get("visible") for b in text.all("light")], [None, None])
    block = text.one("material", text.one("plane")["material"])
    near([*block["diffuse"], *block["emission"]], [0.5] * 3 + [3] * 3)


@test
def what_has_only_a_volume_is_left_out():
    new_scene()
    nodes = Nodes()
    output = nodes.tree.nodes.new("ShaderNodeOutputMaterial")
    nodes.set(output.inputs["Volume"], nodes.node("VolumeScatter"))
    primitive("cube", nodes.owner)
    equal(export([21]).all("cube", "instance"), [])


@test
def material_override_and_indirect_only():
    new_scene()
    nodes, override = Nodes(), bpy.data.materials.new("Clay")
    nodes.end(nodes.node("BsdfDiffuse", Color=(1, 0, 0)))
    primitive("cube", nodes.owner)
    clay = Nodes(override)
    clay.end(clay.node("BsdfDiffuse", Color=(0.2, 0.3, 0.4)))
    bpy.context.view_layer.material_override = override
    near(export().one("material")["diffuse"], [0.2, 0.3, 0.4])
    new_scene()
    collection = bpy.data.collections.new("Indirect")
    bpy.context.scene.collection.children.link(collection)
    collection.objects.link(bpy.data.objects.new("C", mesh_of([(0, 0, 0), (1, 0, 0), (0, 1, 0)], [(0, 1, 2)])))
    bpy.context.view_layer.layer_collection.children["Indirect"].indirect_only = True
    equal(export([6]).all("instance"), [])
