"""Pictures of ./raytracer against those of Cycles."""

import os
import struct
import subprocess

import bpy
from mathutils import Vector

from kit import FOLDER, VERSION, Nodes, add_camera, add_light, export, new_scene, picture, primitive, test
from places import RAYTRACER


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


def our_pixels(count, *arguments):
    """The same of the current scene, exported and rendered here."""
    export()
    out = os.path.join(FOLDER, "scene.pfm")
    subprocess.run([RAYTRACER, os.path.join(FOLDER, "scene.txt"), out, "--quiet", *arguments], check=True)
    with open(out, "rb") as file:
        return struct.unpack("<%df" % count, file.read()[-4 * count:])


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
        got = our_pixels(len(wanted), "--integrator", "whitted", "--max-depth", "0")
        errors = sorted(abs(a - b) for a, b in zip(got, wanted))
        peak = max(wanted)
        # Rays that hit an edge may fall on either side.
        assert errors[int(0.99 * len(errors))] < 1e-4 * peak and sum(e > 0.01 * peak for e in errors) <= 12, \
            "%s: median %g, 99 %% %g, %d above 1 %%" % (
                kind, errors[len(errors) // 2], errors[int(0.99 * len(errors))], sum(e > 0.01 * peak for e in errors))


@test
def paths_agree_with_cycles():
    """Lobes, their pictures, the sky, shining meshes and lamps in mirrors: what a path tracer sees of a small
    room, by means of blocks of pixels, as both pictures have noise."""
    if not os.path.exists(RAYTRACER) or not hasattr(bpy.context.scene, "cycles"):
        return
    new = VERSION >= (4, 0)
    clear, level = ("Transmission_Weight", "Specular_IOR_Level") if new else ("Transmission", "Specular")
    image = lambda n: n.node("TexImage", {
        "image": picture("bands.png", 3, 4, 4, ([60] * 6 + [220] * 6) * 4), "interpolation": "Closest"})
    principled = lambda **inputs: lambda n: n.node(
        "BsdfPrincipled", **{k: v(n) if callable(v) else v for k, v in {"Roughness": 0.3, **inputs}.items()})
    glossy = lambda kind, roughness: lambda n: n.node("BsdfGlossy", {"distribution": kind}, Color=(0.9, 0.7, 0.4), Roughness=roughness)
    cases = {
        "plastic": principled(Base_Color=(0.7, 0.2, 0.1)),
        "metal with pictures": principled(Base_Color=(0.9, 0.7, 0.4), Metallic=image, Roughness=image),
        "glass with pictures": principled(Base_Color=(0.8, 0.9, 1), Roughness=0.1, **{clear: image, level: image}),
        "ggx": glossy("GGX", 0.3),
        "ashikhmin": glossy("ASHIKHMIN_SHIRLEY", 0.4),
        "mirror": glossy("GGX", 0.0),
        "rough glass": lambda n: n.node("BsdfGlass", {"distribution": "GGX"}, IOR=1.5, Roughness=0.3),
    }
    for name, build in cases.items():
        scene = new_scene(with_camera=False)
        cycles, render = scene.cycles, scene.render
        cycles.samples, cycles.blur_glossy, cycles.use_denoising, cycles.use_adaptive_sampling = 128, 0, False, False
        cycles.light_sampling_threshold, cycles.sample_clamp_indirect = 0, 0
        render.resolution_x, render.resolution_y = 64, 48
        scene.world = bpy.data.worlds.new("Sky")
        sky = picture("sky.png", 3, 4, 2, [90, 120, 200] * 4 + [40, 40, 60] * 4)
        n = Nodes(scene.world)
        n.end(n.node("Background", Color=n.node("TexEnvironment", {"image": sky, "interpolation": "Closest"})), "ShaderNodeOutputWorld")
        n = Nodes()
        primitive("plane", n.end(n.node("BsdfDiffuse", Color=(0.5, 0.5, 0.5))), size=20)
        n = Nodes()
        primitive("cube", n.end(n.node("Emission", Color=(1, 0.6, 0.3), Strength=4.0)), location=(-2.4, 0.5, 0.6), size=1.2)
        n = Nodes()
        primitive("uv_sphere", n.end(build(n)), smooth=True, segments=64, ring_count=32, location=(0, 0, 1))
        lamp = add_light("AREA", energy=400, shape="DISK", size=1.5)
        lamp.location, lamp.rotation_euler = (2, -3, 5), Vector((2, -3, 4)).to_track_quat("Z", "Y").to_euler()
        add_camera(location=(0, -7, 2.5), rotation=(1.36, 0, 0), lens=50)
        wanted = cycles_pixels(scene)
        got = our_pixels(len(wanted), "--spp", "256")
        blocks = [[0.0] * 144, [0.0] * 144]
        for block, values in zip(blocks, (got, wanted)):
            for i, x in enumerate(values):
                block[i // 3 % 64 // 8 + 8 * (i // 3 // 64 // 8) + 48 * (i % 3)] += x / 64
        # Before 4.0 the layer of plastic took nothing from what is below, and rough metal was darker by what is
        # reflected twice: up to 5 % of a highlight. What rough glass shows of the lamp has noise of 0.03.
        far = [(i, a, b) for i, (a, b) in enumerate(zip(*blocks)) if abs(a - b) > 0.05 + 0.05 * b]
        mean, off = sum(wanted) / len(wanted), (sum(got) - sum(wanted)) / len(wanted)
        assert not far and abs(off) < 0.015 * mean, "%s: off by %g of %g, blocks %s" % (name, off, mean, far)
