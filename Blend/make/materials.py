"""Materials: node trees."""

import math
import os
from dataclasses import dataclass
from typing import Optional

import bpy

from make.picture_files import TEXTURE_FOLDER


@dataclass(frozen=True)
class Image:
    """An image texture as an input of a shader."""
    file: str
    scale: tuple = (1, 1)
    rotation: float = 0  # degrees
    offset: tuple = (0, 0)
    extension: str = "REPEAT"  # REPEAT EXTEND CLIP
    interpolation: str = "Linear"  # Linear Closest
    output: str = "Color"  # Color Alpha
    is_data: bool = False  # numbers, not colours


@dataclass(frozen=True)
class Bump:
    height: Image
    distance: float
    strength: float = 1.0


@dataclass(frozen=True)
class NormalMap:
    image: Image
    strength: float = 1.0


@dataclass(frozen=True)
class Shader:
    """A shader node and its inputs: numbers, colours, Image, Bump, NormalMap or another Shader."""
    node: str
    inputs: dict
    distribution: Optional[str] = None


def load_image(file, is_data):
    image = bpy.data.images.get(file)
    if image is None:
        image = bpy.data.images.load(os.path.join(TEXTURE_FOLDER, file))
        image.name, image.filepath = file, "//../Textures/" + file
    # Set even where it is the default: Blender cannot read all of these itself, and leaves it open.
    image.colorspace_settings.name = "Non-Color" if is_data or file.endswith(".pfm") else "sRGB"
    return image


def add_image_node(tree, image):
    node = tree.nodes.new("ShaderNodeTexImage")
    node.image = load_image(image.file, image.is_data)
    node.extension, node.interpolation = image.extension, image.interpolation
    if (image.scale, image.rotation, image.offset) != ((1, 1), 0, (0, 0)):
        mapping, source = tree.nodes.new("ShaderNodeMapping"), tree.nodes.new("ShaderNodeUVMap")
        mapping.inputs["Location"].default_value = image.offset + (0,)
        mapping.inputs["Rotation"].default_value = (0, 0, math.radians(image.rotation))
        mapping.inputs["Scale"].default_value = image.scale + (1,)
        tree.links.new(source.outputs["UV"], mapping.inputs["Vector"])
        tree.links.new(mapping.outputs["Vector"], node.inputs["Vector"])
    return node.outputs[image.output]


def add_bump_node(tree, bump):
    node = tree.nodes.new("ShaderNodeBump")
    node.inputs["Strength"].default_value, node.inputs["Distance"].default_value = bump.strength, bump.distance
    connect(tree, node.inputs["Height"], bump.height)
    return node.outputs["Normal"]


def add_normal_node(tree, normal):
    node = tree.nodes.new("ShaderNodeNormalMap")
    node.inputs["Strength"].default_value = normal.strength
    connect(tree, node.inputs["Color"], normal.image)
    return node.outputs["Normal"]


def add_shader_node(tree, shader):
    node = tree.nodes.new("ShaderNode" + shader.node)
    if shader.distribution:
        node.distribution = shader.distribution
    for name, value in shader.inputs.items():
        connect(tree, node.inputs[name], value)
    return node.outputs[0]


NODE_MAKERS = {Image: add_image_node, Bump: add_bump_node, NormalMap: add_normal_node, Shader: add_shader_node}


def connect(tree, socket, value):
    """Gives a socket a constant, or a link from what `value` describes."""
    make = NODE_MAKERS.get(type(value))
    if make:
        tree.links.new(make(tree, value), socket)
    elif isinstance(value, (int, float)):
        socket.default_value = value
    else:
        socket.default_value = tuple(value) + ((1,) if len(value) == 3 and socket.type == "RGBA" else ())


def material(name, shader):
    made = bpy.data.materials.new(name)
    made.use_nodes = True
    tree = made.node_tree
    tree.nodes.clear()
    output = tree.nodes.new("ShaderNodeOutputMaterial")
    connect(tree, output.inputs["Surface"], shader)
    return made


def diffuse(color, **inputs):
    return Shader("BsdfDiffuse", {"Color": color, **inputs})


def glossy(color, roughness=0.0, **inputs):
    # Ashikhmin-Shirley is the lobe that Cycles and we compute alike.
    kind = "ASHIKHMIN_SHIRLEY" if roughness > 0 else None
    return Shader("BsdfGlossy", {"Color": color, "Roughness": roughness, **inputs}, kind)


def glass(color, ior=1.5, roughness=0.0):
    return Shader("BsdfGlass", {"Color": color, "IOR": ior, "Roughness": roughness})


def emission(color, strength=1.0):
    return Shader("Emission", {"Color": color, "Strength": strength})


def transparent(color=(1, 1, 1)):
    return Shader("BsdfTransparent", {"Color": color})


def principled(color, roughness=0.0, metallic=0.0, **inputs):
    return Shader("BsdfPrincipled",
                  {"Base Color": color, "Roughness": roughness, "Metallic": metallic, **inputs})


def added(first, second):
    return Shader("AddShader", {0: first, 1: second})


def mixed(factor, first, second):
    return Shader("MixShader", {0: factor, 1: first, 2: second})


def roughness_of(exponent):
    """Blender's roughness with a Blinn-Phong exponent."""
    return (2 / (exponent + 2)) ** 0.25
