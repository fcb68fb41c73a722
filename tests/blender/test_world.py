"""The world around the scene."""

import math

import bpy

from kit import Nodes, export, new_scene, picture, test
from scene_text import equal, near


def world_text(build, expected=()):
    scene = new_scene()
    scene.world = bpy.data.worlds.new("World")
    nodes = Nodes(scene.world)
    nodes.end(build(nodes), "ShaderNodeOutputWorld")
    text = export(expected)
    return text.one("world"), text


@test
def world_colour():
    block, _ = world_text(lambda n: n.node("Background", Color=(0.1, 0.2, 0.3), Strength=2.0))
    near(block["background"], [0.2, 0.4, 0.6])
    equal([block["environment_lights"], block.get("ambient")], [True, None])
    block, _ = world_text(lambda n: n.node("Background", Color=(0, 0, 0)))
    equal(block.get("environment_lights"), None)
    new_scene().world = None
    equal(export().one("world")["background"], [0, 0, 0])


@test
def world_environment():
    def build(n, kind="POINT", **settings):
        mapping = n.node("Mapping", {"vector_type": kind}, Vector=n.node("TexCoord").outputs["Generated"],
                         Rotation=(0, 0, math.radians(50)))
        image = n.node("TexEnvironment", {"image": picture("env.png", width=4, height=2), **settings}, Vector=mapping)
        return n.node("Background", Color=image, Strength=3.0)

    block, text = world_text(build)
    near(block["background"], [3, 3, 3])
    near(block["environment_rotation"], -50)  # measured with Cycles in 3.4, 4.5 and 5.0
    equal(text.one("texture", block["environment"])["file"], "env.png")
    equal([block["environment_lights"], block.get("ambient")], [True, None])
    near(world_text(lambda n: build(n, "TEXTURE"))[0]["environment_rotation"], 50)
    world_text(lambda n: build(n, projection="MIRROR_BALL"), [31])
    world_text(lambda n: n.node("Background", Color=n.node("TexSky")), [30])


@test
def worlds_that_some_rays_do_not_see_warn():
    scene = new_scene()
    scene.world = bpy.data.worlds.new("World")
    for kind in ("camera", "glossy"):
        setattr(scene.world.cycles_visibility, kind, False)
    equal(export([39]).one("world")["environment_lights"], True)
    for kind in ("camera", "glossy"):
        setattr(scene.world.cycles_visibility, kind, True)
    scene.world.cycles_visibility.diffuse = False
    equal(export().one("world").get("environment_lights"), None)

    def build(n, **values):
        mapping = n.node("Mapping", Vector=n.node("TexCoord").outputs["Generated"], **values)
        return n.node("Background", Color=n.node("TexEnvironment", {"image": picture("env.png", width=4, height=2)}, Vector=mapping))

    world_text(lambda n: build(n, Location=(0, 0, 0.5)), [31])
    world_text(lambda n: build(n, Scale=(1, 1, 2)), [31])
