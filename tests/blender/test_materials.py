"""Shader nodes as materials."""

import math

import bpy

from kit import Nodes, VERSION, export, material_text, mesh_of, new_scene, picture, primitive, test
from scene_text import equal, near


@test
def diffuse_and_none():
    block, _ = material_text(lambda n: n.node("BsdfDiffuse", Color=(0.1, 0.2, 0.3)))
    near(block["diffuse"], [0.1, 0.2, 0.3])
    equal(block.get("specular"), None)
    block, _ = material_text(lambda n: n.node("BsdfDiffuse", Color=(0.1, 0.2, 0.3), Roughness=0.5))
    equal(block.lobes(), [{"kind": "oren_nayar", "color": [0.1, 0.2, 0.3], "roughness": [0.5]}])
    equal(block.get("diffuse"), None)
    equal(material_text(lambda n: n.node("BsdfTranslucent", Color=(1, 0.5, 1)))[0].lobes(), [{"kind": "translucent", "weight": [1, 0.5, 1]}])
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
    lobe = block.lobe("conductor")
    near(lobe["weight"], [0.25, 0.125, 0.05])
    near(lobe["color"] + lobe["roughness"], [1, 1, 1, 0.2])
    equal([block.get("specular"), block.get("mirror")], [None, None])


@test
def glossy_limits():
    lobes = lambda settings={}, expected=(), **inputs: material_text(
        lambda n: n.node("BsdfGlossy", settings, **inputs), expected)[0].lobes()
    near(lobes(Color=(0.9, 0.9, 0.9), Roughness=0.0)[0]["weight"], [0.9] * 3)
    equal([l["kind"] for l in lobes(Roughness=0.0)], ["mirror"])
    equal(lobes(Color=(1, 1, 1), Roughness=1.0), [{"kind": "conductor", "color": [1, 1, 1], "roughness": [1]}])
    near(lobes(Roughness=0.02)[0]["roughness"], [0.02])
    lobe = lobes({"distribution": "ASHIKHMIN_SHIRLEY"}, Color=(0.5, 1, 1), Roughness=0.2)[0]
    near([*lobe["weight"], *lobe["exponent"]], [0.5, 1, 1, 2 / 0.2**4 - 2])
    equal(lobe["kind"], "ashikhmin")
    two = lambda n: n.node("AddShader", Shader=n.node("BsdfGlossy", Color=(0.2,) * 3, Roughness=0.1),
                           Shader_001=n.node("BsdfGlossy", Color=(0.3,) * 3, Roughness=0.4))
    near([x for l in material_text(two)[0].lobes() for x in (l["weight"][0], *l["roughness"])], [0.2, 0.1, 0.3, 0.4])
    same = lambda n: n.mix(0.25, n.node("BsdfGlossy", Color=(0.2,) * 3, Roughness=0.1), n.node("BsdfGlossy", Color=(0.4,) * 3, Roughness=0.1))
    near(material_text(same)[0].lobe("conductor")["weight"], [0.25] * 3)


@test
def brushed_metal():
    kind = "BsdfAnisotropic" if VERSION < (4, 0) else "BsdfGlossy"
    shot = lambda a: material_text(lambda n: n.node(kind, Roughness=0.3, Anisotropy=a, Rotation=0.25))[0].lobe("conductor")
    # Cycles' widths are those of the roughness times and over 1 - a; ours over and times sqrt(1 - 0.9 b).
    for a in (0.5, -0.5):
        lobe = shot(a)
        near(math.sqrt(1 - 0.9 * abs(lobe["anisotropy"][0])), 1 - abs(a))
        equal(lobe["anisotropy"][0] < 0, a > 0)
        near(lobe["rotation"], [0.25])
    block, _ = material_text(lambda n: n.node("BsdfPrincipled", Metallic=1.0, Anisotropic=0.75, Anisotropic_Rotation=0.5))
    near(block.lobe("conductor")["anisotropy"] + block.lobe("conductor")["rotation"], [0.75, 0.5])
    if VERSION >= (4, 3):
        block, _ = material_text(lambda n: n.node("BsdfMetallic", Base_Color=(0.9, 0.6, 0.3), Edge_Tint=(0.5, 0.6, 0.7), Roughness=0.2))
        lobe = block.lobe("conductor")
        near(lobe["color"] + lobe["edge_tint"] + lobe["roughness"], [0.9, 0.6, 0.3, 0.5, 0.6, 0.7, 0.2])


@test
def sheen():
    if VERSION >= (4, 0):
        block, _ = material_text(lambda n: n.node("BsdfSheen", Color=(0.5, 0.4, 0.3), Roughness=0.25))
        near(block.lobe("sheen")["weight"] + block.lobe("sheen")["roughness"], [0.5, 0.4, 0.3, 0.25])
    else:
        block, _ = material_text(lambda n: n.node("BsdfVelvet", Color=(0.5, 0.4, 0.3), Sigma=0.75), [12])
        near(block.lobe("sheen")["weight"] + block.lobe("sheen")["roughness"], [0.5, 0.4, 0.3, 0.75])


@test
def glass_and_refraction():
    block, _ = material_text(lambda n: n.node("BsdfGlass", Color=(0.9, 0.8, 0.7), IOR=1.33, Roughness=0.0))
    lobe = block.lobe("dielectric")
    near(lobe["reflect_tint"] + lobe["transmit_tint"] + lobe["ior"] + lobe["roughness"], [0.9, 0.8, 0.7] * 2 + [1.33, 0])
    equal([block.get("diffuse"), lobe.get("weight")], [None, None])
    block, _ = material_text(lambda n: n.node("BsdfRefraction", Color=(0.9, 0.8, 0.7), IOR=1.2, Roughness=0.1))
    lobe = block.lobe("refraction")
    near(lobe["weight"] + lobe["ior"] + lobe["roughness"], [0.9, 0.8, 0.7, 1.2, 0.1])
    equal([block.get("transmission"), block.get("diffuse")], [None, None])
    half = lambda n: n.mix(0.5, n.node("BsdfDiffuse", Color=(1, 1, 1)), n.node("BsdfGlass", IOR=1.5, Roughness=0.0))
    block, _ = material_text(half)
    near([block["diffuse"][0], block.lobe("dielectric")["weight"][0]], [0.5, 0.5])


@test
def mixing_by_fresnel():
    def build(n):
        return n.mix(n.node("Fresnel", IOR=1.5), n.node("BsdfDiffuse", Color=(1, 1, 1)),
                     n.node("BsdfGlossy", Color=(1, 1, 1), Roughness=0.3))

    lobes = material_text(build)[0].lobes()
    equal([(l["kind"], l.get("covers")) for l in lobes], [("glossy_dielectric", True), ("diffuse", None)])
    near(lobes[0]["ior"] + lobes[0]["roughness"], [1.5, 0.3])
    weight = lambda n: n.mix(n.node("LayerWeight", Blend=0.5).outputs["Fresnel"], n.node("BsdfDiffuse"), n.node("BsdfGlossy"))
    near(material_text(weight)[0].lobe("glossy_dielectric")["ior"], [2])
    glass = lambda n: n.mix(n.node("Fresnel", IOR=1.4), n.node("BsdfRefraction", Color=(0.5, 1, 1), Roughness=0.0),
                            n.node("BsdfGlossy", Color=(1, 1, 0.5), Roughness=0.0))
    lobe = material_text(glass)[0].lobe("dielectric")
    near(lobe["ior"] + lobe["reflect_tint"] + lobe["transmit_tint"], [1.4, 1, 1, 0.5, 0.5, 1, 1])
    facing = lambda rough: lambda n: n.mix(n.node("LayerWeight", Blend=0.5).outputs["Facing"], n.node("BsdfDiffuse"), n.node("BsdfGlossy", Roughness=rough))
    equal([l["kind"] for l in material_text(facing(0.0), [16])[0].lobes()], ["schlick_mirror"])
    assert material_text(facing(0.5), [16])[0].lobe("conductor")["color"][0] < 0.5
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
    block, _ = material_text(both)
    near(block["opacity"] * block["emission"][0], 3)
    near((1 - block["opacity"]) * block["filter"][0], 1)


@test
def emission_lights():
    """Meshes do; they stay meshes, also where they look like balls and squares."""
    new_scene()
    nodes = Nodes()
    nodes.end(nodes.node("Emission", Color=(1, 0.5, 0.2), Strength=4.0))
    first = primitive("uv_sphere", nodes.owner, smooth=True, radius=0.5, location=(0, 0, 3))
    text = export()
    block = text.one("material")
    near(block["emission"], [4, 2, 0.8])
    equal([block["emission_lights"], block["diffuse"], len(text.all("light"))], [True, [0, 0, 0], 0])
    text.one("instance")
    first["rt_light"] = 0  # seen, and no lamp
    equal(export().one("material").get("emission_lights"), None)
    primitive("plane", nodes.owner)
    text = export()
    equal(sorted(b.get("emission_lights", False) for b in text.all("material")), [False, True])
    equal(sorted(b["material"] for b in text.all("instance", "sphere")), ["M", "M.001"])
    new_scene()
    nodes = Nodes()
    nodes.end(nodes.node("Emission", Strength=5e-4))  # too faint for shadow rays
    primitive("plane", nodes.owner)
    equal(export().one("material").get("emission_lights"), None)


@test
def principled():
    def build(**inputs):
        return lambda n: n.node("BsdfPrincipled", **inputs)

    def shot(expected=(), **inputs):
        return material_text(build(**inputs), expected)[0]

    def kinds(block):
        return [l["kind"] for l in block.lobes()]

    new = VERSION >= (4, 0)
    level, clear, glow, coat, sheen = (
        ("Specular_IOR_Level", "Transmission_Weight", "Emission_Color", "Coat_Weight", "Sheen_Weight") if new
        else ("Specular", "Transmission", "Emission", "Clearcoat", "Sheen"))
    block = shot(Base_Color=(0.5, 0.4, 0.3), Roughness=0.5, IOR=1.45, **{level: 0.5})
    equal([(l["kind"], l.get("covers")) for l in block.lobes()], [("glossy_dielectric", True), ("diffuse", None)])
    lobe = block.lobe("glossy_dielectric")
    near(lobe["ior"] + lobe["roughness"], [1.45 if new else 1.5, 0.5])
    equal([lobe.get("weight"), lobe.get("specular"), block.get("diffuse")], [None, None, None])
    near(block.lobe("diffuse")["weight"], [0.5, 0.4, 0.3])
    lobe = shot(IOR=1.8, **{level: 0.25}).lobe("glossy_dielectric")
    near(lobe["ior"] + lobe["specular"], [1.8 if new else 1.5, 0.25])
    block = shot(Base_Color=(0.9, 0.6, 0.3), Metallic=1.0, Roughness=0.2)
    near(block.lobe("conductor")["color"] + block.lobe("conductor")["roughness"], [0.9, 0.6, 0.3, 0.2])
    equal(kinds(block), ["conductor"])
    block = shot(Base_Color=(0.25, 1, 1), Roughness=0.0, IOR=1.4, **{clear: 1.0})
    near(block.lobe("dielectric")["transmit_tint"] + block.lobe("dielectric")["ior"], [0.5 if new else 0.25, 1, 1, 1.4])
    equal(kinds(block), ["dielectric"])
    block = shot(Base_Color=(1, 1, 1), Metallic=0.25, **{clear: 0.5})  # what is left goes down
    near([block.lobe(k)["weight"][0] for k in kinds(block)], [0.25, 0.375, 0.375, 0.375])
    equal(kinds(block), ["conductor", "dielectric", "glossy_dielectric", "diffuse"])
    block = shot(Alpha=0.3, Base_Color=(0.5, 0.5, 0.5), **{level: 0.0})
    near([block["opacity"], block["diffuse"][0]], [0.3, 0.5])
    block = shot(Emission_Strength=2.0, **{glow: (0.1, 0.2, 0.3)})
    near(block["emission"], [0.2, 0.4, 0.6])
    equal(block["emission_lights"], True)
    block = shot(**{coat: 0.5, sheen: 0.25, "Coat_Roughness" if new else "Clearcoat_Roughness": 0.1})
    equal([(l["kind"], l.get("covers")) for l in block.lobes()],
          [("sheen", True), ("coat", True), ("glossy_dielectric", True), ("diffuse", None)])
    near(block.lobe("coat")["weight"] + block.lobe("coat")["roughness"], [0.5 if new else 0.125] * 3 + [0.1])
    near(block.lobe("sheen")["weight"], [0.25] * 3)
    shot([13], **{"Subsurface_Weight" if new else "Subsurface": 0.5})
    if new:
        block = shot(Metallic=1.0, Specular_Tint=(0.5, 0.6, 0.7))
        near(block.lobe("conductor")["edge_tint"], [0.5, 0.6, 0.7])
        near(shot(Specular_Tint=(0.5, 0.6, 0.7)).lobe("glossy_dielectric")["tint"], [0.5, 0.6, 0.7])
    if VERSION >= (4, 3):
        equal(kinds(shot(Diffuse_Roughness=0.5)), ["glossy_dielectric", "oren_nayar"])


@test
def mixtures_of_layers():
    level = "Specular_IOR_Level" if VERSION >= (4, 0) else "Specular"
    plastic = lambda n, red, **inputs: n.node("BsdfPrincipled", Base_Color=(red, 0, 0), **inputs)
    # The same layer on both is one layer, whatever mixes them.
    block, _ = material_text(lambda n: n.mix(0.25, plastic(n, 0.2), plastic(n, 0.6)))
    equal([l["kind"] for l in block.lobes()], ["glossy_dielectric", "diffuse"])
    equal(block.lobe("glossy_dielectric").get("weight"), None)
    near(block.lobe("diffuse")["weight"], [0.3, 0, 0])
    # What has no layer lies beside the other's.
    block, _ = material_text(lambda n: n.mix(0.5, plastic(n, 0.2), n.node("BsdfGlossy", Roughness=0.3)))
    equal([l["kind"] for l in block.lobes()], ["conductor", "glossy_dielectric", "diffuse"])
    near([l["weight"][0] for l in block.lobes()], [0.4, 0.5, 0.1])
    block, _ = material_text(lambda n: n.mix(0.5, plastic(n, 0.2), plastic(n, 0.6, Roughness=0.1)), [16])
    near(sum(l["weight"][0] for l in block.lobes() if l["kind"] == "diffuse"), 0.1 + 0.3, 0.1)
    equal([l.get("covers") for l in block.lobes() if l["kind"] == "glossy_dielectric"], [None, True])


@test
def textures_of_lobes():
    image = lambda n, name="mask.png": n.node("TexImage", {"image": picture(name, 3, 1, 1, [90, 90, 90])})
    coloured = lambda n: n.node("TexImage", {"image": picture("wood.png", 3, 1, 1, [200, 100, 40])})
    # A mask between two shaders: times and without.
    block, _ = material_text(lambda n: n.mix(image(n), n.node("BsdfDiffuse", Color=(0.5, 0, 0)), n.node("BsdfGlossy", Color=(1, 1, 1), Roughness=0.5)))
    equal(block.lobe("conductor")["weight", "x"], [["times", "mask"]])
    near(block["diffuse"], [0.5, 0, 0])
    # Metallic, roughness and base colour of Principled.
    build = lambda n: n.node("BsdfPrincipled", Base_Color=coloured(n), Metallic=image(n), Roughness=image(n, "rough.png"))
    block, _ = material_text(build)
    lobe = block.lobe("conductor")
    equal([lobe["weight", "x"], lobe["color", "x"], lobe["roughness", "x"]], [[["times", "mask"]], [["times", "wood"]], [["times", "rough"]]])
    equal(block.lobe("glossy_dielectric")["weight", "x"], [["without", "mask"]])
    equal(block.lobe("diffuse")["weight", "x"], [["without", "mask"], ["times", "wood"]])
    # Half of a mask, and an inverted one.
    half = lambda n: n.node("Math", {"operation": "MULTIPLY"}, Value=image(n), Value_001=0.5)
    block, _ = material_text(lambda n: n.node("BsdfPrincipled", Metallic=half(n)))
    near(block.lobe("conductor")["weight"], [0.5] * 3)
    equal(block.lobe("diffuse")["weight", "x"], [["without", "mask", 0.5]])
    block, _ = material_text(lambda n: n.node("BsdfPrincipled", Roughness=n.node("Invert", Color=image(n))))
    equal(block.lobe("glossy_dielectric")["roughness", "x"], [["without", "mask"]])
    # Transmission, specular and base colour; since 4.0 the format has no root of a picture.
    new = VERSION >= (4, 0)
    clear, level = ("Transmission_Weight", "Specular_IOR_Level") if new else ("Transmission", "Specular")
    build = lambda n: n.node("BsdfPrincipled", Base_Color=coloured(n), **{clear: image(n), level: image(n, "level.png")})
    block, _ = material_text(build, [14] if new else [])
    equal([block.lobe("dielectric")["weight", "x"], block.lobe("glossy_dielectric")["weight", "x"],
           block.lobe("glossy_dielectric")["specular", "x"]], [[["times", "mask"]], [["without", "mask"]], [["times", "level"]]])
    equal(block.lobe("dielectric").get(("transmit_tint", "x")), None if new else [["times", "wood"]])
    block, _ = material_text(lambda n: n.node("BsdfGlass", Color=coloured(n)))
    equal([block.lobe("dielectric")[t, "x"] for t in ("reflect_tint", "transmit_tint")], [[["times", "wood"]]] * 2)
    # A mask with colours is grey where it mixes; with see-through parts its mean counts.
    block, text = material_text(lambda n: n.mix(coloured(n), n.node("BsdfDiffuse"), n.node("BsdfGlossy", Roughness=0.5)))
    name = block.lobe("conductor")["weight", "x"][0][1]
    equal(text.one("texture", name)["file"], "Textures/wood_grey.png")
    see = lambda n: n.mix(image(n), n.node("BsdfDiffuse"), n.mix(0.5, n.node("BsdfTransparent"), n.node("BsdfDiffuse")))
    material_text(see, [14])


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
        for ior, taken in ((0.0, 1e-3), (5000.0, 1000)):
            block, _ = material_text(lambda n: n.node(kind, IOR=ior), [35])
            near(block.lobes()[0]["ior"], taken)
    material_text(lambda n: n.mix(n.node("Fresnel", IOR=0.0), n.node("BsdfDiffuse"), n.node("BsdfGlossy")))
    material_text(lambda n: n.node("Emission", Strength=1e30), [35])
    near(material_text(lambda n: n.node("BsdfGlossy", Roughness=2.0))[0].lobe("conductor")["roughness"], [1])
    near(material_text(lambda n: n.node("BsdfGlossy", Color=(-1, 0.5, 0), Roughness=0.5))[0].lobe("conductor")["weight"], [0, 0.5, 0])
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
def what_glows_out_of_sight_is_a_lamp():
    def hidden(kind, expected=(6,), **arguments):
        thing = glowing(kind, **arguments)
        thing.visible_camera = False
        return thing, lambda: export(expected)

    thing, shot = hidden("plane", size=2, location=(0, 0, 3))
    text = shot()
    lamps = text.all("light")
    equal([(b["type"], b["size"], b.get("visible"), b["seen_by"]) for b in lamps],
          [("rectangle", [2, 2], None, "reflections")] * 2)
    equal(sorted(round(b.keys()[0][2][2]) for b in lamps), [-1, 1])  # one for each side
    equal(text.all("plane", "instance"), [])
    thing, shot = hidden("circle", radius=2, vertices=32, fill_type="NGON")
    thing.scale = (1, 0.5, 1)
    lamps = shot().all("light")
    equal([b["type"] for b in lamps], ["disk", "disk"])
    x, y = sorted(lamps[0]["size"])
    near([math.pi / 4 * x * y, y / x], [32 / 2 * math.sin(math.pi / 16) * 4 / 2, 2], 1e-4)
    thing, shot = hidden("circle", radius=2, vertices=32, fill_type="TRIFAN")
    equal([b["type"] for b in shot().all("light")], ["disk", "disk"])
    thing, shot = hidden("uv_sphere", radius=0.5, smooth=True, location=(0, 0, 3))
    lamp = shot().one("light")
    near([lamp["radius"], *lamp["translate"]], [0.5, 0, 0, 3])
    part = sum(f.area for f in thing.data.polygons) / math.pi  # of the surface of the ball
    near(lamp["color"], [3 * part] * 3)
    thing, shot = hidden("cube", [6, 32])
    equal(len(shot().all("light", "cube")), 0)


@test
def what_glows_beside_other_lobes_lights():
    glowing("plane", lambda n, glow: n.node("AddShader", Shader=n.node("BsdfDiffuse", Color=(0.5, 0.5, 0.5)), Shader_001=glow))
    text = export()
    block = text.one("material", text.one("instance")["material"])
    near([*block["diffuse"], *block["emission"]], [0.5] * 3 + [3] * 3)
    equal([block["emission_lights"], text.all("light")], [True, []])


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
