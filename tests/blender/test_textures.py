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
    equal(material_text(both)[0].lobes(), [{"kind": "diffuse", ("weight", "x"): [["times", "pic"]], "weight": [1, 1, 1]},
                                           {"kind": "diffuse", "weight": [0.1, 0.1, 0.1]}])
    both = lambda n: n.node("AddShader", Shader=n.node("Emission", Color=n.node("TexImage", {"image": picture()})),
                            Shader_001=n.node("Emission", Color=(0.1, 0.1, 0.1)))
    block, _ = material_text(both, [14])
    linear = [((x / 255 + 0.055) / 1.055) ** 2.4 for x in (40, 80, 120)]
    near(block["emission"], [x + 0.1 for x in linear], 1e-4)
    equal(block.get("emission_texture"), None)


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
    assert [["times", block["opacity_texture"]]] != block.lobe("diffuse")["weight", "x"]


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

    new_scene()  # a dead path of another system, the file in the folder that is named
    image = bpy.data.images.load(path)
    image.name = "dead"
    image.filepath_raw = "C:\\Users\\me\\pictures\\dead.ppm"
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
    equal(read_png_rows("Textures/Made.png"), [[(10, 20, 30)] * 3, [(40, 50, 60)] * 3])
    new_scene()
    image = bpy.data.images.new("Made", 3, 2)
    image.pixels[:] = [x / 255 for x in (10, 20, 30, 255) * 3 + (40, 50, 60, 255) * 3]
    equal(shot(image, arguments=["--ppm"]), "Textures/Made.ppm")

    new_scene()
    image = bpy.data.images.new("Bright", 2, 1, float_buffer=True)
    image.pixels[:] = [5, 6, 7, 1, 0.5, 0.25, 0.125, 1]
    equal(shot(image), "Textures/Bright.exr")
    reread = bpy.data.images.load(os.path.join(FOLDER, "Textures", "Bright.exr"))
    reread.colorspace_settings.name = "Non-Color"
    equal(list(reread.pixels), [5, 6, 7, 1, 0.5, 0.25, 0.125, 1])
    shutil.rmtree(elsewhere)


def shown(image, expected=(), link_alpha=False, space=None):
    """Exports a triangle with the image as its colour: (block of the material, of the texture or None)."""
    if space:
        image.colorspace_settings.name = space
    nodes = Nodes()
    node = nodes.node("TexImage", {"image": image})
    surface = nodes.node("BsdfDiffuse", Color=node)
    if link_alpha:
        surface = nodes.mix(node.outputs["Alpha"], nodes.node("BsdfTransparent"), surface)
    nodes.end(surface)
    mesh = mesh_of([(0, 0, 0), (1, 0, 0), (0, 1, 0)], [(0, 1, 2)])
    mesh.uv_layers.new()
    mesh.materials.append(nodes.owner)
    add("T", mesh)
    text = export(expected)
    material = text.one("material")
    name = material.get("diffuse_texture")
    return material, text.one("texture", name) if name else None


def written(name, form, values=(100, 20, 30, 255), size=8, **settings):
    """A picture file that Blender writes, loaded again."""
    path = os.path.join(FOLDER, name)
    image = bpy.data.images.new(name, size, size, alpha=values[3] < 255, float_buffer=form in {"HDR", "OPEN_EXR"})
    image.pixels[:] = [x / 255 for x in values] * (size * size)
    image.filepath_raw, image.file_format = path, form
    image.save()
    bpy.data.images.remove(image)
    return bpy.data.images.load(path, check_existing=False)


@test
def files_that_the_renderer_reads_are_copied():
    """Byte for byte, under a name that fits what is in them; no picture is looked at in Python."""
    for name, form in (("a.jpg", "JPEG"), ("b.jpeg", "JPEG"), ("c.hdr", "HDR"), ("d.exr", "OPEN_EXR"), ("e.tga", "TARGA"),
                       ("f.tga", "TARGA_RAW"), ("g.png", "PNG"), ("wrong.png", "JPEG")):
        new_scene()
        image = written(name, form)
        with open(image.filepath_raw, "rb") as file:
            data = file.read()
        elsewhere = tempfile.mkdtemp(prefix="export-pictures-")
        image.filepath_raw = os.path.join(elsewhere, name)
        with open(image.filepath_raw, "wb") as file:
            file.write(data)
        _, texture = shown(image)
        equal(texture["file"], "Textures/" + ("wrong.jpg" if name == "wrong.png" else name))
        equal(texture.get("space", "srgb"), "linear" if form in {"HDR", "OPEN_EXR"} else "srgb")
        with open(os.path.join(FOLDER, texture["file"]), "rb") as file:
            assert file.read() == data, name
        shutil.rmtree(elsewhere)


@test
def files_that_the_renderer_does_not_read_are_written_by_blender():
    for name, form in (("a.bmp", "BMP"), ("b.tif", "TIFF"), ("c.webp", "WEBP"), ("d.jp2", "JPEG2000")):
        new_scene()
        try:
            image = written(name, form)
        except (TypeError, RuntimeError):
            continue  # this Blender has no such format
        _, texture = shown(image)
        equal(texture["file"], "Textures/%s.png" % name[0])
        kept = bpy.data.images.load(os.path.join(FOLDER, texture["file"]))
        near(list(kept.pixels)[:3], [x / 255 for x in (100, 20, 30)], 0.1 if form in {"WEBP", "JPEG2000"} else 1e-5)
        equal([image.filepath_raw.endswith(name), image.is_dirty], [True, False])


@test
def packed_and_painted_pictures():
    new_scene()
    image = written("packed.jpg", "JPEG")
    with open(image.filepath_raw, "rb") as file:
        data = file.read()
    image.pack()
    image.filepath_raw = "//nowhere/packed.jpg"
    _, texture = shown(image)
    with open(os.path.join(FOLDER, texture["file"]), "rb") as file:
        equal([texture["file"], file.read()], ["Textures/packed.jpg", data])
    new_scene()
    image = written("painted.jpg", "JPEG")
    image.pixels[0:4] = [1, 1, 1, 1]
    _, texture = shown(image)
    assert texture["file"].endswith(".png"), texture["file"]
    equal(list(read_png_rows(texture["file"])[0][0]), [255, 255, 255])
    equal([image.is_dirty, os.path.basename(image.filepath_raw)], [True, "painted.jpg"])


def read_png_rows(file):
    """Pixels from the bottom as Blender reads them: rows of codes."""
    image = bpy.data.images.load(os.path.join(FOLDER, file), check_existing=False)
    width, height = image.size
    values = list(image.pixels)
    rows = [[tuple(round(x * 255) for x in values[4 * (y * width + x):][:3]) for x in range(width)] for y in range(height)]
    bpy.data.images.remove(image)
    return rows


@test
def missing_pictures_are_magenta():
    """Also where a picture with the same stem lies beside the scene or among those of the product."""
    for name in ("wood.jpg", "stone.png", "letters.tga", "leaf.png", "studs.exr"):
        new_scene()
        image = picture("q.png")
        os.makedirs(os.path.join(FOLDER, "Textures"), exist_ok=True)
        for other in (name, os.path.splitext(name)[0] + ".ppm"):
            shutil.copy(os.path.join(FOLDER, "q.png"), os.path.join(FOLDER, "Textures", other))
        image.filepath = "//tex/" + name
        material, texture = shown(image, [22])
        equal([material["diffuse"], texture], [[1, 0, 1], None])
    scene = new_scene()
    scene.world = bpy.data.worlds.new("World")
    nodes, image = Nodes(scene.world), picture("q.png")
    image.filepath = "//hdri/sky.hdr"
    nodes.end(nodes.node("Background", Color=nodes.node("TexEnvironment", {"image": image})), "ShaderNodeOutputWorld")
    equal(export([22]).one("world")["background"], [1, 0, 1])


@test
def broken_pictures_are_magenta():
    for name in ("broken.png", "broken.jpg", "broken.exr", "broken.ppm"):
        new_scene()
        image = picture("q.png")
        with open(os.path.join(FOLDER, "q.png"), "rb") as file:
            start = file.read()[:50]
        with open(os.path.join(FOLDER, name), "wb") as file:
            file.write({"broken.png": start, "broken.ppm": b"P6\n9 9\n255\n123"}.get(name, b"this is no picture"))
        image.filepath = os.path.join(FOLDER, name)
        material, texture = shown(image, [23])
        equal([material["diffuse"], texture], [[1, 0, 1], None])
    new_scene()  # Blender shows the part of a JPEG that is there; the renderer would refuse the file
    image = written("cut.jpg", "JPEG", size=256)
    with open(image.filepath_raw, "r+b") as file:
        file.truncate(os.path.getsize(image.filepath_raw) * 2 // 3)
    image.reload()
    _, texture = shown(image)
    equal(texture["file"], "Textures/cut.png")


@test
def alpha_modes_give_colours_as_cycles_does():
    """One row: opaque, half covered, not covered. Colours that are used without their alpha are multiplied by
    it as codes; packed and data colours are not, and no alpha is left beside them."""
    codes = [200, 100, 40, 255, 200, 100, 40, 128, 200, 100, 40, 0]
    times, plain = [(200, 100, 40), (100, 50, 20), (0, 0, 0)], [(200, 100, 40)] * 3

    def look(mode, link_alpha=False, space=None, pack=False):
        new_scene()
        image = picture("three.png", 4, 3, 1, codes)
        image.alpha_mode = mode
        if pack:
            image.pack()
        material, texture = shown(image, link_alpha=link_alpha, space=space)
        return texture["file"], read_png_rows(texture["file"])[0], material

    for mode, space, wanted in (("STRAIGHT", None, times), ("PREMUL", None, times), ("CHANNEL_PACKED", None, plain),
                                ("NONE", None, plain), ("STRAIGHT", "Non-Color", plain)):
        file, pixels, _ = look(mode, space=space)
        equal((mode, pixels), (mode, wanted))
        equal(read_png(os.path.join(FOLDER, file))[2], 3)
    file, _, material = look("STRAIGHT", link_alpha=True)
    equal(file, "three.png")
    assert material["opacity_texture"]
    equal(look("NONE", link_alpha=True)[2].get("opacity_texture"), None)
    file, pixels, _ = look("PREMUL", pack=True)  # of what is packed Cycles believes it: 200 / 128 is white
    equal(pixels, [(200, 100, 40), (128, 100, 40), (0, 0, 0)])
    new_scene()  # alpha that covers everything needs no other file
    equal(shown(picture("covered.png", 4))[1]["file"], "covered.png")


@test
def inverted_colours_are_inverted_in_linear_light():
    def build(n, node):
        image = n.node("TexImage", {"image": picture("invert.png", 3, 1, 1, [0, 128, 255])})
        return n.node("BsdfDiffuse", Color=node(n, image))

    block, text = material_text(lambda n: build(n, lambda n, i: n.node("Invert", Color=i)))
    file = text.one("texture", block["diffuse_texture"])["file"]
    half = ((128 / 255 + 0.055) / 1.055) ** 2.4
    equal(read_png_rows(file)[0][0], (255, round(255 * (1.055 * (1 - half) ** (1 / 2.4) - 0.055)), 0))


@test
def colours_become_numbers_by_their_luminance():
    """RGB to BW and Math on a picture with colours; grey ones stay as they are."""
    srgb = lambda x: 12.92 * x if x <= 0.0031308 else 1.055 * x ** (1 / 2.4) - 0.055
    y = sum(w * ((x / 255 + 0.055) / 1.055) ** 2.4 for w, x in zip((0.2126, 0.7152, 0.0722), (200, 100, 40)))

    def pixel(codes, node):
        image = lambda n: n.node("TexImage", {"image": picture("grey.png", 3, 1, 1, codes)})
        block, text = material_text(lambda n: n.node("BsdfDiffuse", Color=node(n, image(n))))
        return read_png_rows(text.one("texture", block["diffuse_texture"])["file"])[0][0], block["diffuse"]

    to_grey = lambda n, i: n.node("RGBToBW", Color=i)
    half = lambda n, i: n.node("Math", {"operation": "MULTIPLY"}, Value=i, Value_001=0.5)
    rest = lambda n, i: n.node("Math", {"operation": "SUBTRACT"}, Value=1.0, Value_001=i)
    equal(pixel([200, 100, 40], to_grey), ((round(255 * srgb(y)),) * 3, [1, 1, 1]))
    equal(pixel([200, 100, 40], half), ((round(255 * srgb(y)),) * 3, [0.5, 0.5, 0.5]))
    equal(pixel([200, 100, 40], rest), ((round(255 * srgb(1 - y)),) * 3, [1, 1, 1]))
    equal(pixel([90, 90, 90], half), ((90, 90, 90), [0.5, 0.5, 0.5]))
    sum_of = lambda n: n.node("BsdfDiffuse", Color=n.node("Math", {"operation": "ADD"}, Value=n.node(
        "TexImage", {"image": picture()}), Value_001=0.5))
    material_text(sum_of, [12])
