"""Cameras and what else a picture is: its size, samples, filter and exposure."""

import math

import bpy
from mathutils import Vector

from kit import VERSION, add, add_camera, export, new_scene, test
from scene_text import equal, near


def check_camera(scene, text, name="Camera"):
    """Rays through the corners of the picture, by the format's formulas, against view_frame()."""
    settings, block = text.one("settings"), text.one("camera", name)
    width, height = settings["resolution"]
    ax, ay = settings.get("pixel_aspect", [1, 1])
    xr, yr = width * ax, height * ay
    sensor, fit = block["sensor"], block["sensor_fit"]
    horizontal = xr > yr if fit == "auto" else fit == "horizontal"
    size = sensor[1] if fit == "vertical" else sensor[0]
    fitted = xr if horizontal else yr
    shift = block.get("shift", [0, 0])
    rows = block.keys()[0]
    r0, r1, r2, eye = ([row[i] for row in rows] for i in range(4))
    camera = scene.camera
    place = camera.matrix_world.normalized()
    for (px, py), corner in zip(((width, height), (width, 0), (0, 0), (0, height)), camera.data.view_frame(scene=scene)):
        u = (px / width - 0.5) * xr / fitted + shift[0]
        v = (py / height - 0.5) * yr / fitted + shift[1]
        if block["type"] == "orthographic":
            k = block["ortho_scale"]
            got = [e + u * k * a + v * k * b for e, a, b in zip(eye, r0, r1)]
            wanted = place @ Vector((corner.x, corner.y, 0))
        else:
            k = size / block["lens"]
            got = Vector([u * k * a + v * k * b - c for a, b, c in zip(r0, r1, r2)]).normalized()
            wanted = (place.to_3x3() @ corner).normalized()
        near(list(got), list(wanted), 2e-5)


@test
def camera_rays_for_all_fits_and_aspects():
    scene = new_scene()
    camera = scene.camera
    camera.data.lens, camera.data.sensor_width, camera.data.sensor_height = 35, 30, 21
    for fit in ("AUTO", "HORIZONTAL", "VERTICAL"):
        for size in ((160, 90), (90, 160), (100, 100)):
            for aspect in ((1, 1), (1.5, 1), (1, 2)):
                for kind in ("PERSP", "ORTHO"):
                    camera.data.sensor_fit, camera.data.type = fit, kind
                    camera.data.shift_x, camera.data.shift_y = 0.1, -0.2
                    scene.render.resolution_x, scene.render.resolution_y = size
                    scene.render.pixel_aspect_x, scene.render.pixel_aspect_y = aspect
                    check_camera(scene, export())


@test
def camera_scale_parent_and_constraint():
    scene = new_scene()
    target = add("Target", None, (1, 2, 0))
    parent = add("Parent", None, (0, 0, 1), (0, 0, 0.4), (2, 3, 2))
    scene.camera.parent = parent
    constraint = scene.camera.constraints.new("TRACK_TO")
    constraint.target, constraint.track_axis, constraint.up_axis = target, "TRACK_NEGATIVE_Z", "UP_Y"
    bpy.context.view_layer.update()
    text = export()
    check_camera(scene, text)
    rows = text.one("camera").keys()[0]
    near([math.hypot(*(row[i] for row in rows)) for i in range(3)], [1, 1, 1])


@test
def depth_of_field():
    scene = new_scene()
    data = scene.camera.data
    data.lens, data.clip_start = 80, 0.25
    dof = data.dof
    dof.use_dof, dof.aperture_fstop, dof.focus_distance = True, 2.8, 7
    dof.aperture_blades, dof.aperture_rotation, dof.aperture_ratio = 6, 0.5, 2
    block = export().one("camera")
    near(block["aperture_radius"], 0.08 / 5.6)
    near([block["focus_distance"], block["aperture_blades"], block["aperture_ratio"], block["clip_start"]], [7, 6, 2, 0.25])
    near(block["aperture_rotation"], math.degrees(0.5))
    dof.focus_object = add("Focus", None, (1, 4, 0.5))
    bpy.context.view_layer.update()
    axis = scene.camera.matrix_world.col[2].to_3d()
    wanted = abs(axis.dot(scene.camera.matrix_world.translation - Vector((1, 4, 0.5))))
    near(export().one("camera")["focus_distance"], wanted)
    data.type = "ORTHO"
    near(export().one("camera")["aperture_radius"], 1 / 5.6)
    dof.use_dof = False
    equal(export().one("camera").get("aperture_radius"), None)


@test
def other_cameras_follow_the_active_one():
    scene = new_scene()
    add_camera("Another", (3, 0, 0))
    scene.camera = bpy.data.objects["Camera"]
    equal([b.name for b in export().all("camera")], ["Camera", "Another"])
    equal([b.name for b in export(arguments=["--camera", "Another"]).all("camera")], ["Another", "Camera"])
    equal(scene.camera.name, "Camera")


@test
def panorama_warns():
    new_scene().camera.data.type = "PANO"
    equal(export([7]).one("camera")["type"], "perspective")


@test
def resolution_border_and_samples():
    scene = new_scene()
    render = scene.render
    render.resolution_x, render.resolution_y, render.resolution_percentage = 1921, 1001, 50
    render.use_border = render.use_crop_to_border = True
    render.border_min_x, render.border_max_x, render.border_min_y, render.border_max_y = 0.1, 0.7, 0.25, 0.6
    block = export().one("settings")
    equal(block["resolution"], [960, 500])
    equal(block["crop"], [96, 200, 672, 375])
    equal(block["samples"], 16)
    scene.cycles.samples, scene.cycles.max_bounces, scene.cycles.seed = 4096, 5, 7
    block = export().one("settings")
    equal([block["samples"], block["max_depth"], block["seed"]], [64, 5, 7])
    scene.cycles.samples = 1
    equal(export().one("settings")["jitter"], False)


@test
def light_paths():
    scene = new_scene()
    block = export().one("settings")
    wanted = ("integrator", "diffuse_depth", "glossy_depth", "transmission_depth", "transparent_depth", "caustics")
    equal([block.get(k) for k in wanted], ["path"] + [None] * 5)  # as the renderer takes them anyway
    scene.render.engine = "BLENDER_EEVEE" if VERSION < (4, 2) or VERSION >= (5, 0) else "BLENDER_EEVEE_NEXT"
    equal(export().one("settings").get("integrator"), None)
    scene.render.engine = "CYCLES"
    equal(export(arguments=["--integrator", "whitted"]).one("settings").get("integrator"), None)
    cycles = scene.cycles
    near(block.get("clamp_indirect", 0), cycles.sample_clamp_indirect)
    near(block.get("filter_glossy", 0), cycles.blur_glossy)
    cycles.diffuse_bounces, cycles.glossy_bounces, cycles.transmission_bounces, cycles.transparent_max_bounces = 3, 2, 6, 7
    cycles.blur_glossy = 0
    cycles.sample_clamp_indirect, cycles.caustics_reflective, cycles.caustics_refractive = 2.5, False, False
    block = export().one("settings")
    equal([block.get(k) for k in wanted], ["path", 3, 2, 6, 7, False])
    equal([block["clamp_indirect"], block.get("filter_glossy")], [2.5, None])
    cycles.caustics_refractive = True
    equal(export().one("settings").get("caustics"), None)


@test
def filter_exposure_and_transfer():
    scene = new_scene()
    equal(export().one("settings")["filter"], ["blackman-harris", 1.5])
    scene.cycles.pixel_filter_type, scene.cycles.filter_width = "BOX", 0.01
    equal(export().one("settings")["filter"], ["box", 1])
    scene.cycles.pixel_filter_type, scene.cycles.filter_width = "GAUSSIAN", 2
    equal(export().one("settings")["filter"], ["gaussian", 2])
    scene.view_settings.exposure, scene.cycles.film_exposure = 0.5, 4
    near(export().one("settings")["exposure"], 2.5)
    equal(export().one("settings")["transfer"], "srgb")
    scene.view_settings.view_transform = "Raw"
    equal(export().one("settings")["transfer"], "linear")
    scene.view_settings.view_transform = "Filmic"
    equal(export([1]).one("settings")["transfer"], "srgb")
    scene.view_settings.view_transform, scene.view_settings.gamma = "Standard", 1.5
    export([2])


@test
def settings_are_restored():
    scene = new_scene()
    scene.render.use_compositing = True
    before = (scene.render.engine, scene.render.use_compositing, scene.frame_current, scene.render.filepath, scene.camera)
    export(arguments=["--frame", "7"])
    equal((scene.render.engine, scene.render.use_compositing, scene.frame_current, scene.render.filepath, scene.camera), before)


@test
def cameras_that_the_renderer_would_refuse():
    scene = new_scene()
    wanted = export().one("camera").keys()[0]
    scene.camera.scale = (0, 0, 0)
    near(export([36]).one("camera").keys()[0], wanted)
    scene.camera.scale = (1, 1, 1)
    scene.camera.data.type, scene.camera.data.ortho_scale = "ORTHO", 0
    assert export([35]).one("camera")["ortho_scale"] > 0
    scene.camera.data.type = "PERSP"
    scene.render.resolution_x, scene.render.resolution_y, scene.render.resolution_percentage = 16, 4, 1
    equal(export([3]).one("settings")["resolution"], [1, 1])  # Blender itself renders none that small


@test
def settings_without_a_counterpart_warn_once_each():
    def warns(change, number):
        scene = new_scene()
        change(scene)
        export([number])

    def set_border(scene):
        scene.render.use_border, scene.render.border_max_x = True, 0.5

    def set_compositor(scene):
        if VERSION >= (5, 0):
            scene.compositing_node_group = bpy.data.node_groups.new("C", "CompositorNodeTree")
            scene.compositing_node_group.nodes.new("CompositorNodeBlur")
        else:
            scene.use_nodes = True
            scene.node_tree.nodes.new("CompositorNodeBlur")

    warns(lambda s: setattr(s.render, "film_transparent", True), 40)
    warns(set_border, 44)
    warns(set_compositor, 45)
    warns(lambda s: setattr(s.view_layers[0], "use_sky", False), 38)
    warns(lambda s: setattr(s.view_layers[0], "use_solid", False), 38)
    if hasattr(bpy.types.ColorManagedViewSettings, "bl_rna") and "use_white_balance" in \
            bpy.types.ColorManagedViewSettings.bl_rna.properties:
        warns(lambda s: setattr(s.view_settings, "use_white_balance", True), 41)

    def zoom(scene):
        scene.render.use_motion_blur = True
        for frame, lens in ((0, 20), (2, 80)):
            scene.camera.data.lens = lens
            scene.camera.data.keyframe_insert("lens", frame=frame)
        scene.frame_set(1)

    warns(zoom, 42)

    def roll(scene):
        scene.render.use_motion_blur = True
        scene.cycles.rolling_shutter_type = "TOP"

    warns(roll, 43)
