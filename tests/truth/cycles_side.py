"""A scene as Blender's, and its pictures by Cycles: cycles_side.py SCENE OUT.npy. Needs python with bpy 4.5
(pip install bpy==4.5.15, Python 3.11). Lights are given in watts, as Blender 4 has them."""
import math, os, sys, time
import bpy
import numpy as np
from mathutils import Matrix
import scenes
from scene import aim, ball, box, ground, move, square


def rgba(values):
    return (*map(float, values), 1.0)


class Tree:
    """Nodes of a material or a world."""

    def __init__(self, owner, output):
        owner.use_nodes = True
        self.nodes, self.links = owner.node_tree.nodes, owner.node_tree.links
        self.nodes.clear()
        self.output = self.nodes.new(output)

    def node(self, kind, settings=(), **inputs):
        node = self.nodes.new("ShaderNode" + kind)
        for key, value in dict(settings).items(): setattr(node, key, value)
        for key, value in inputs.items(): self.put(node.inputs[key.replace("_", " ")], value)
        return node

    def put(self, to, value):
        if isinstance(value, bpy.types.Node): self.links.new(value.outputs[0], to)
        elif isinstance(value, tuple) and len(value) == 3: to.default_value = rgba(value)
        else: to.default_value = value

    def end(self, node):
        self.links.new(node.outputs[0], self.output.inputs["Surface"])


class Writer:
    def __init__(self, scene, folder):
        self.scene, self.folder = scene, folder
        self.pictures = {}
        bpy.ops.wm.read_factory_settings(use_empty=True)
        self.settings()
        self.camera()
        self.world()
        self.materials = {name: self.material(name, m) for name, m in scene.materials.items()}
        self.data = {}
        for i, shape in enumerate(scene.shapes): self.shape("thing%d" % i, shape)
        for i, lamp in enumerate(scene.lamps): self.lamp("lamp%d" % i, lamp)

    def settings(self):
        """Nothing that bends or stops the estimate: no clamps, no adaptive counts, no thresholds, no blurred caustics."""
        out, render = bpy.context.scene, bpy.context.scene.render
        render.engine = "CYCLES"
        render.resolution_x = render.resolution_y = self.scene.size
        render.resolution_percentage = 100
        render.dither_intensity, render.filter_size = 0, 1
        render.use_motion_blur, render.motion_blur_shutter, render.motion_blur_position = any(s.motion for s in self.scene.shapes), 1, "START"
        render.threads_mode, render.threads = "FIXED", 2
        render.image_settings.file_format, render.image_settings.color_depth = "OPEN_EXR", "32"
        render.use_persistent_data = True
        cycles = out.cycles
        cycles.samples, cycles.use_adaptive_sampling, cycles.use_denoising = self.scene.peer_spp, False, False
        cycles.sample_clamp_direct = cycles.sample_clamp_indirect = cycles.blur_glossy = 0
        cycles.light_sampling_threshold = 0
        cycles.caustics_reflective = cycles.caustics_refractive = True
        cycles.pixel_filter_type = "BOX"
        cycles.use_fast_gi = cycles.use_guiding = False
        for name in ("max_bounces", "diffuse_bounces", "glossy_bounces", "transmission_bounces", "transparent_max_bounces"):
            setattr(cycles, name, self.scene.depth)
        if self.scene.diffuse_depth is not None: cycles.diffuse_bounces = self.scene.diffuse_depth

    def camera(self):
        data = bpy.data.cameras.new("eye")
        data.sensor_width = data.sensor_height = 36
        data.angle = math.radians(self.scene.fov)
        data.clip_start, data.clip_end = 1e-3, 1e6
        if self.scene.aperture:
            data.dof.use_dof, data.dof.focus_distance = True, self.scene.focus
            data.dof.aperture_fstop = data.lens * 1e-3 / (2 * self.scene.aperture)
        eye = bpy.data.objects.new("eye", data)
        eye.matrix_world = Matrix(aim(self.scene.eye, self.scene.target).tolist())
        bpy.context.scene.collection.objects.link(eye)
        bpy.context.scene.camera = eye

    def picture(self, name, values):
        """A picture by way of a file of floats, rows from the bottom in memory."""
        image = bpy.data.images.new(name, values.shape[1], values.shape[0], float_buffer=True, is_data=True)
        rows = np.ones((*values.shape[:2], 4), np.float32)
        rows[..., :3] = values[::-1]
        image.pixels.foreach_set(rows.ravel())
        image.filepath_raw, image.file_format = os.path.join(self.folder, name + ".exr"), "OPEN_EXR"
        image.save()
        image = bpy.data.images.load(image.filepath_raw, check_existing=False)
        image.colorspace_settings.name = "Non-Color"
        return image

    def world(self):
        world = bpy.data.worlds.new("world")
        bpy.context.scene.world = world
        tree = Tree(world, "ShaderNodeOutputWorld")
        if self.scene.sky is not None:
            color = tree.node("TexEnvironment", {"image": self.picture("sky", self.scene.sky)})
        else:
            color = tuple(map(float, self.scene.background))
        tree.end(tree.node("Background", Color=color, Strength=1.0))

    def material(self, name, m):
        out = bpy.data.materials.new(name)
        tree = Tree(out, "ShaderNodeOutputMaterial")
        shader = self.shader(tree, m)
        if any(m.emission):
            most = max(m.emission)
            shine = tree.node("Emission", Color=tuple(v / most for v in m.emission), Strength=most)
            if self.scene.peer != "cycles":
                front = tree.node("Math", {"operation": "MULTIPLY_ADD"})
                tree.links.new(tree.node("NewGeometry").outputs["Backfacing"], front.inputs[0])
                front.inputs[1].default_value, front.inputs[2].default_value = -most, most
                tree.put(shine.inputs["Strength"], front)
                out.cycles.emission_sampling = "FRONT"
            both = tree.node("AddShader")
            tree.links.new(shader.outputs[0], both.inputs[0])
            tree.links.new(shine.outputs[0], both.inputs[1])
            shader = both
        if m.opacity < 1:
            mix = tree.node("MixShader", Fac=m.opacity)
            tree.links.new(tree.node("BsdfTransparent").outputs[0], mix.inputs[1])
            tree.links.new(shader.outputs[0], mix.inputs[2])
            shader = mix
        tree.end(shader)
        return out

    def shader(self, tree, m):
        color = tuple(map(float, m.color))
        if m.texture:
            color = tree.node("TexImage", {"image": self.picture(m.texture, self.scene.pictures[m.texture] * np.asarray(m.color))})
        turned = {"Anisotropy": m.anisotropy, "Rotation": m.rotation}
        if m.kind == "diffuse": return tree.node("BsdfDiffuse", Color=color)
        if m.kind == "oren_nayar": return tree.node("BsdfDiffuse", Color=color, Roughness=m.roughness)
        if m.kind == "translucent": return tree.node("BsdfTranslucent", Color=color)
        if m.kind == "glossy": return tree.node("BsdfAnisotropic", {"distribution": "MULTI_GGX"}, Color=color, Roughness=m.roughness)
        if m.kind == "mirror": return tree.node("BsdfAnisotropic", Color=color, Roughness=0.0)
        if m.kind == "glass": return tree.node("BsdfGlass", Color=(1, 1, 1), IOR=m.ior, Roughness=0.0)
        if m.kind == "rough_glass":
            return tree.node("BsdfGlass", {"distribution": "MULTI_GGX"}, Color=(1, 1, 1), IOR=m.ior, Roughness=m.roughness)
        if m.kind == "refraction":
            return tree.node("BsdfRefraction", {"distribution": "GGX"}, Color=(1, 1, 1), IOR=m.ior, Roughness=m.roughness)
        if m.kind == "metal":
            if m.anisotropy: turned["Tangent"] = tree.node("Tangent", {"direction_type": "UV_MAP"})
            return tree.node("BsdfMetallic", {"distribution": "MULTI_GGX", "fresnel_type": "F82"}, Base_Color=color,
                             Edge_Tint=tuple(map(float, m.edge_tint)), Roughness=m.roughness, **turned)
        if m.kind == "plastic":
            return tree.node("BsdfPrincipled", {"distribution": "MULTI_GGX"}, Base_Color=color, Roughness=m.roughness, IOR=m.ior,
                             Metallic=0.0, Specular_IOR_Level=0.5)
        raise SystemExit("error: no shader for %s" % m.kind)

    def mesh(self, shape):
        key = (shape.kind, shape.mesh, shape.material, shape.other)
        if key in self.data: return self.data[key]
        source = {"rectangle": square, "cube": box, "sphere": lambda: ball(128, 256), "ground": ground}.get(
            shape.kind, lambda: self.scene.meshes[shape.mesh])()
        data = bpy.data.meshes.new("%s of %s" % (shape.mesh or shape.kind, shape.material))
        data.from_pydata(source.points.tolist(), [], source.faces.tolist())
        if source.uvs is not None:
            layer = data.uv_layers.new(name="uv")
            layer.data.foreach_set("uv", source.uvs[source.faces.ravel()].astype(np.float32).ravel())
        if source.normals is not None:
            data.polygons.foreach_set("use_smooth", [True] * len(source.faces))
            data.normals_split_custom_set_from_vertices(source.normals.tolist())
        data.materials.append(self.squares(shape) if shape.other else self.materials[shape.material])
        data.update()
        self.data[key] = data
        return data

    def squares(self, shape):
        """The material of a ground of two materials, by uv, which are halves of x and y."""
        a, b = (self.scene.materials[name] for name in (shape.material, shape.other))
        assert a.kind == b.kind == "diffuse", "one node says the colors of both"
        out = bpy.data.materials.new("squares")
        tree = Tree(out, "ShaderNodeOutputMaterial")
        check = tree.node("TexChecker", Scale=2.0, Color1=tuple(map(float, a.color)), Color2=tuple(map(float, b.color)))
        tree.links.new(tree.node("TexCoord").outputs["UV"], check.inputs["Vector"])
        tree.end(tree.node("BsdfDiffuse", Color=check))
        return out

    def shape(self, name, shape):
        thing = bpy.data.objects.new(name, self.mesh(shape))
        thing.matrix_world = Matrix(shape.place.tolist())
        if shape.motion: self.animate(thing, shape)
        # Shadow terminators are left as the geometry has them.
        thing.cycles.shadow_terminator_geometry_offset = 0
        thing.cycles.shadow_terminator_offset = 0
        bpy.context.scene.collection.objects.link(thing)

    def animate(self, thing, shape):
        """From frame 1, at which the shutter opens, to frame 2."""
        for frame, place in ((1, shape.place), (2, move(*shape.motion) @ shape.place)):
            thing.location = Matrix(place.tolist()).to_translation()
            thing.keyframe_insert("location", frame=frame)
        for curve in thing.animation_data.action.fcurves:
            curve.extrapolation = "LINEAR"
            for key in curve.keyframe_points: key.interpolation = "LINEAR"
        bpy.context.scene.frame_set(1)

    def lamp(self, name, lamp):
        kinds = {"point": "POINT", "spot": "SPOT", "sun": "SUN", "sphere": "POINT", "disk": "AREA", "rectangle": "AREA"}
        data = bpy.data.lights.new(name, kinds[lamp.kind])
        most = max(lamp.light)
        data.color = [v / most for v in lamp.light]
        if lamp.kind in ("point", "spot"):
            data.energy, data.shadow_soft_size, data.use_soft_falloff = most * 4 * math.pi, lamp.radius, True
        if lamp.kind == "spot": data.spot_size, data.spot_blend = math.radians(lamp.angle), lamp.blend
        if lamp.kind == "sun": data.energy, data.angle = most, math.radians(lamp.angle)
        if lamp.kind == "sphere":
            data.energy, data.shadow_soft_size, data.use_soft_falloff = most * 4 * (math.pi * lamp.radius) ** 2, lamp.radius, False
        if lamp.kind in ("disk", "rectangle"):
            x, y = (2 * np.linalg.norm(lamp.place[:3, i]) for i in range(2))
            data.shape, data.size, data.size_y = ("ELLIPSE" if lamp.kind == "disk" else "RECTANGLE"), x, y
            data.energy = most * math.pi * x * y * (math.pi / 4 if lamp.kind == "disk" else 1)
        thing = bpy.data.objects.new(name, data)
        thing.visible_camera = True
        place = lamp.place.copy()
        place[:3, :3] /= np.linalg.norm(place[:3, :3], axis=0)
        thing.matrix_world = Matrix(place.tolist())
        bpy.context.scene.collection.objects.link(thing)

    def render(self, seed):
        """A picture, and the seconds that Blender took for it."""
        out, path = bpy.context.scene, os.path.join(self.folder, "cycles.exr")
        out.cycles.seed, out.render.filepath = seed, path
        start = time.perf_counter()
        bpy.ops.render.render()
        seconds = time.perf_counter() - start
        bpy.data.images["Render Result"].save_render(path)
        image = bpy.data.images.load(path, check_existing=False)
        image.colorspace_settings.name = "Non-Color"
        values = np.empty(len(image.pixels), np.float32)
        image.pixels.foreach_get(values)
        bpy.data.images.remove(image)
        return values.reshape(self.scene.size, self.scene.size, 4)[::-1, :, :3].astype(np.float64), seconds


def main():
    name, out = sys.argv[1:3]
    scene = scenes.SCENES[name]()
    writer = Writer(scene, os.path.dirname(os.path.abspath(out)))
    np.save(out, np.array([writer.render(seed)[0] for seed in range(1, scene.seeds + 1)]))


if __name__ == "__main__":
    main()
