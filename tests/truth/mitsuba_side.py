"""A scene as Mitsuba's, and its pictures: mitsuba_side.py SCENE OUT.npy [--variant NAME]. Mitsuba: pip install mitsuba."""
import argparse, glob, os, sys
import numpy as np
import scenes
from scene import ground, turn


def write_ply(path, mesh):
    columns = [mesh.points] + ([mesh.normals] if mesh.normals is not None else [])
    names = ["x", "y", "z"] + (["nx", "ny", "nz"] if mesh.normals is not None else [])
    if mesh.uvs is not None:
        columns.append(mesh.uvs * (1, -1) + (0, 1))  # pictures of Mitsuba have v = 0 at their upper edge
        names += ["u", "v"]
    with open(path, "wb") as file:
        file.write(("ply\nformat binary_little_endian 1.0\nelement vertex %d\n" % len(mesh.points)).encode())
        file.write("".join("property float %s\n" % n for n in names).encode())
        file.write(b"element face %d\nproperty list uchar int vertex_indices\nend_header\n" % len(mesh.faces))
        file.write(np.concatenate(columns, 1).astype("<f4").tobytes())
        rows = np.zeros(len(mesh.faces), [("n", "u1"), ("at", "<i4", 3)])
        rows["n"], rows["at"] = 3, mesh.faces
        file.write(rows.tobytes())


def rgb(values):
    return {"type": "rgb", "value": [float(v) for v in values]}


class Writer:
    def __init__(self, mi, scene, folder):
        self.mi, self.scene, self.folder = mi, scene, folder
        os.makedirs(folder, exist_ok=True)

    def matrix(self, place):
        return self.mi.ScalarTransform4f(np.asarray(place, float).tolist())

    def bitmap(self, picture):
        return self.mi.Bitmap(np.ascontiguousarray(picture, np.float32))

    def bsdf(self, m):
        if m.kind == "diffuse":
            color = rgb(m.color)
            if m.texture:
                picture = self.scene.pictures[m.texture] * np.asarray(m.color)
                color = {"type": "bitmap", "bitmap": self.bitmap(picture), "raw": True, "filter_type": "bilinear", "wrap_mode": "repeat"}
            inner = {"type": "diffuse", "reflectance": color}
        elif m.kind == "mirror":
            inner = {"type": "conductor", "material": "none", "specular_reflectance": rgb(m.color)}
        elif m.kind == "glossy":
            inner = {"type": "roughconductor", "material": "none", "specular_reflectance": rgb(m.color), "distribution": "ggx", "alpha": m.roughness ** 2}
        elif m.kind == "glass":
            return {"type": "dielectric", "int_ior": m.ior, "ext_ior": 1.0}
        else:
            raise SystemExit("error: Mitsuba has no model that is the same as %s" % m.kind)
        sided = {"type": "twosided", "bsdf": inner}
        return {"type": "mask", "opacity": m.opacity, "bsdf": sided} if m.opacity < 1 else sided

    def squares(self, shape):
        """The BSDF of a ground of two materials."""
        a, b = (self.scene.materials[name] for name in (shape.material, shape.other))
        assert a.kind == b.kind == "diffuse", "Mitsuba's checkerboard is a texture of one BSDF"
        color = {"type": "checkerboard", "color0": rgb(a.color), "color1": rgb(b.color)}
        return {"type": "twosided", "bsdf": {"type": "diffuse", "reflectance": color}}

    def shape(self, shape):
        if shape.motion: raise SystemExit("error: Mitsuba 3 has no shapes that move")
        out = {"type": {"mesh": "ply", "ground": "ply"}.get(shape.kind, shape.kind), "to_world": self.matrix(shape.place)}
        material = self.scene.materials[shape.material]
        out["bsdf"] = self.squares(shape) if shape.other else self.bsdf(material)
        if any(material.emission): out["emitter"] = {"type": "area", "radiance": rgb(material.emission)}
        if shape.kind == "mesh": out.update(self.mesh_file(shape.mesh, self.scene.meshes[shape.mesh]))
        if shape.kind == "ground": out.update(self.mesh_file("ground", ground()))
        return out

    def mesh_file(self, name, mesh):
        path = os.path.join(self.folder, name + ".ply")
        write_ply(path, mesh)
        return {"type": "ply", "filename": path, "face_normals": mesh.normals is None}

    def lamp(self, lamp):
        at = lamp.place[:3, 3].tolist()
        forward = self.matrix(lamp.place @ turn(180, 0, 1, 0))  # Mitsuba's lamps shine along +Z
        black = {"type": "diffuse", "reflectance": rgb((0, 0, 0))}
        area = {"type": "area", "radiance": rgb(lamp.light)}
        if lamp.kind == "point": return {"type": "point", "position": at, "intensity": rgb(lamp.light)}
        if lamp.kind == "spot":
            assert lamp.blend == 0, "Mitsuba fades spots in another way"
            half = lamp.angle / 2
            return {"type": "spot", "to_world": forward, "intensity": rgb(lamp.light), "cutoff_angle": half, "beam_width": half * 0.999999}
        if lamp.kind == "sun":
            assert lamp.angle == 0, "Mitsuba's sun is a direction"
            return {"type": "directional", "to_world": forward, "irradiance": rgb(lamp.light)}
        if lamp.kind == "sphere": return {"type": "sphere", "center": at, "radius": lamp.radius, "bsdf": black, "emitter": area}
        return {"type": lamp.kind, "to_world": forward, "bsdf": black, "emitter": area}

    def sky(self, sky):
        """Mitsuba has its first and last row of texels at the poles; ours lie half a texel off them. Twice the rows, with
        those between interpolated, make both the same function."""
        low, high = np.concatenate([sky[:1], sky]), np.concatenate([sky, sky[-1:]])
        rows = np.empty((2 * len(sky) + 1, *sky.shape[1:]))
        rows[0::2], rows[1::2] = (low + high) / 2, sky
        axes = np.array([[0, 0, 1, 0], [1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 0, 1]], float)
        return {"type": "envmap", "bitmap": self.bitmap(rows), "to_world": self.matrix(axes)}

    def scene_dict(self, sampler="independent"):
        scene, mi = self.scene, self.mi
        if scene.diffuse_depth is not None and scene.diffuse_depth < scene.depth:
            raise SystemExit("error: Mitsuba has no limit of diffuse bounces alone")
        lens = {"type": "thinlens", "aperture_radius": scene.aperture, "focus_distance": scene.focus} if scene.aperture else {"type": "perspective"}
        look = mi.ScalarTransform4f().look_at(origin=list(scene.eye), target=list(scene.target), up=[0, 0, 1])
        # Paths of Mitsuba count their edges, ours the bounces before the last one that meets a lamp.
        out = {"type": "scene", "integrator": {"type": "path", "max_depth": scene.depth + 2, "rr_depth": 1000},
               "sensor": {**lens, "to_world": look, "fov": scene.fov,
                          "film": {"type": "hdrfilm", "width": scene.size, "height": scene.size, "rfilter": {"type": "box"},
                                   "pixel_format": "rgb", "component_format": "float32"},
                          "sampler": {"type": sampler, "sample_count": scene.peer_spp}}}
        if scene.sky is not None: out["sky"] = self.sky(scene.sky)
        elif any(scene.background): out["sky"] = {"type": "constant", "radiance": rgb(scene.background)}
        for i, lamp in enumerate(scene.lamps): out["lamp%d" % i] = self.lamp(lamp)
        groups = {}
        for i, shape in enumerate(scene.shapes):
            if not (scene.shared and shape.kind == "mesh"):
                out["thing%d" % i] = self.shape(shape)
                continue
            key = "group_%s_%s" % (shape.mesh, shape.material)
            if key not in groups:
                groups[key] = True
                out[key] = {"type": "shapegroup", "inner": {**self.mesh_file(shape.mesh, scene.meshes[shape.mesh]), "bsdf": self.bsdf(scene.materials[shape.material])}}
            out["thing%d" % i] = {"type": "instance", "group": {"type": "ref", "id": key}, "to_world": self.matrix(shape.place)}
        return out


def start(variant):
    """Mitsuba itself, in this variant."""
    if "DRJIT_LIBLLVM_PATH" not in os.environ:
        found = sorted(glob.glob("/usr/lib/*/libLLVM*.so*"))
        if found: os.environ["DRJIT_LIBLLVM_PATH"] = found[-1]
    import mitsuba as mi
    mi.set_variant(variant)
    return mi


def main():
    options = argparse.ArgumentParser(description=__doc__)
    options.add_argument("scene")
    options.add_argument("out")
    options.add_argument("--variant", default="llvm_ad_rgb")
    args = options.parse_args()
    mi = start(args.variant)
    scene = scenes.SCENES[args.scene]()
    loaded = mi.load_dict(Writer(mi, scene, os.path.dirname(os.path.abspath(args.out))).scene_dict())
    np.save(args.out, np.array([np.array(mi.render(loaded, spp=scene.peer_spp, seed=seed), np.float64)[..., :3]
                                for seed in range(scene.seeds)]))


if __name__ == "__main__":
    main()
