"""Pictures of ./raytracer against those of Cycles."""

import os
import struct
import subprocess

import bpy
from mathutils import Vector

from kit import FOLDER, Nodes, add_camera, add_light, export, new_scene, primitive, test
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
        export()
        out = os.path.join(FOLDER, "scene.pfm")
        subprocess.run([RAYTRACER, os.path.join(FOLDER, "scene.txt"), out, "--quiet", "--max-depth", "0"], check=True)
        with open(out, "rb") as file:
            data = file.read()[-4 * len(wanted):]
        errors = sorted(abs(a - b) for a, b in zip(struct.unpack("<%df" % len(wanted), data), wanted))
        peak = max(wanted)
        # Rays that hit an edge may fall on either side.
        assert errors[int(0.99 * len(errors))] < 1e-4 * peak and sum(e > 0.01 * peak for e in errors) <= 12, \
            "%s: median %g, 99 %% %g, %d above 1 %%" % (
                kind, errors[len(errors) // 2], errors[int(0.99 * len(errors))], sum(e > 0.01 * peak for e in errors))
