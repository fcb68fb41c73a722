"""Makes the Blender scenes of this project and their textures. Needs nothing but Blender 3.4 or later.

    blender -b --factory-startup --python-exit-code 3 -P Blend/MakeScenes.py                 everything
    blender -b --factory-startup --python-exit-code 3 -P Blend/MakeScenes.py -- glass dof    these scenes only

Writes Blend/NAME.blend for each row of SCENES and Textures/NAME for each row of TEXTURES.
Blend/ExportAll.sh runs this and exports every scene to ASCII/NAME.txt.

A new scene: a function that builds it, in one of the files scenes_*.py of the folder make, and a row in SCENES.

The folder make, each file from those above it:
    drawing.py, textures.py, picture_files.py    what the textures show, and how they are written
    materials.py                                 node trees
    shapes.py                                    grids of points to meshes
    staging.py                                   lights, cameras, the world, movement
    sets.py                                      what several scenes have in common
    scene_showcase.py, scenes_*.py               a function for each scene
"""

import os
import sys
from dataclasses import dataclass

import bpy

sys.dont_write_bytecode = True
sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))  # Blender leaves it out

from make import scenes_cameras, scenes_lights, scenes_surfaces
from make.picture_files import BLEND_FOLDER, TEXTURE_FOLDER, write_texture
from make.scene_showcase import showcase
from make.textures import TEXTURES


@dataclass
class Row:
    build: object
    width: int = 640
    height: int = 360
    samples: int = 64
    bounces: int = 6


SCENES = {
    "showcase": Row(showcase, 960, 540),
    "camera_perspective": Row(scenes_cameras.camera_perspective),
    "camera_fit": Row(scenes_cameras.camera_fit, 300, 420),
    "camera_ortho": Row(scenes_cameras.camera_ortho),
    "camera_shift": Row(scenes_cameras.camera_shift),
    "lights_point": Row(scenes_lights.lights_point),
    "lights_spot": Row(scenes_lights.lights_spot),
    "lights_sun": Row(scenes_lights.lights_sun),
    "lights_area": Row(scenes_lights.lights_area),
    "soft_shadows": Row(scenes_lights.soft_shadows),
    "shapes": Row(scenes_surfaces.shapes),
    "instances": Row(scenes_surfaces.instances),
    "mirror": Row(scenes_surfaces.mirror, bounces=16),
    "glass": Row(scenes_surfaces.glass_scene, bounces=12),
    "glossy": Row(scenes_surfaces.glossy_scene),
    "blinn": Row(scenes_surfaces.blinn),
    "textures": Row(scenes_surfaces.textures),
    "bump_normal": Row(scenes_surfaces.bump_normal),
    "dof": Row(scenes_cameras.dof),
    "motion_blur": Row(scenes_cameras.motion_blur),
    "world_environment": Row(scenes_lights.world_environment),
    "transparent": Row(scenes_surfaces.transparent_scene),
    "antialiasing": Row(scenes_cameras.antialiasing),
}


def new_file(row):
    """An empty scene with our settings."""
    bpy.ops.wm.read_factory_settings(use_empty=True)
    preferences = bpy.context.preferences
    preferences.filepaths.save_version = 0  # no .blend1
    preferences.edit.keyframe_new_interpolation_type = "LINEAR"
    scene = bpy.context.scene
    scene.render.engine = "CYCLES"
    scene.render.filepath = "//"
    scene.render.resolution_x, scene.render.resolution_y = row.width, row.height
    scene.render.resolution_percentage = 100
    cycles = scene.cycles
    cycles.samples = row.samples
    cycles.max_bounces = cycles.glossy_bounces = cycles.transmission_bounces = row.bounces
    cycles.use_denoising = cycles.use_adaptive_sampling = False
    cycles.caustics_reflective = cycles.caustics_refractive = False  # 64 samples are too few for them
    scene.view_settings.view_transform = "Standard"
    scene.render.dither_intensity = 0


def save_file(name):
    bpy.ops.wm.save_as_mainfile(
        filepath=os.path.join(BLEND_FOLDER, name + ".blend"), compress=True, relative_remap=False)


def main():
    wanted = sys.argv[sys.argv.index("--") + 1:] if "--" in sys.argv else []
    for name in wanted:
        if name not in SCENES:
            sys.exit("MakeScenes.py: error: no scene '%s'; known: %s" % (name, ", ".join(SCENES)))
    os.makedirs(TEXTURE_FOLDER, exist_ok=True)
    for name, picture in TEXTURES.items():
        if not wanted or not os.path.exists(os.path.join(TEXTURE_FOLDER, name)):
            write_texture(name, picture)
    for name in wanted or SCENES:
        new_file(SCENES[name])
        SCENES[name].build()
        save_file(name)


main()
