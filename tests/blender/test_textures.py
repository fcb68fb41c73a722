"""Pictures on surfaces: mapping, alpha, bumps, and where their files are found."""

import math
import os
import shutil
import struct
import tempfile

import bpy

from kit import FOLDER, Nodes, add, export, material_text, mesh_of, new_scene, picture, test
from png import read_png, write_png
from scene_text import equal, near


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
