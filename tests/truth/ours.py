"""A scene as our text, and its pictures by ./raytracer."""
import os, subprocess
import numpy as np
from scene import move


def numbers(values):
    return " ".join("%.9g" % v for v in np.ravel(values))


def pfm(path):
    """A PFM as floats [height, width, 3], row 0 at the top."""
    with open(path, "rb") as file:
        assert file.readline().strip() == b"PF"
        width, height = map(int, file.readline().split())
        kind = "<f4" if float(file.readline()) < 0 else ">f4"
        return np.frombuffer(file.read(), kind).reshape(height, width, 3)[::-1].astype(np.float64)


def write_pfm(path, picture):
    with open(path, "wb") as file:
        file.write(b"PF\n%d %d\n-1.0\n" % (picture.shape[1], picture.shape[0]))
        file.write(np.ascontiguousarray(picture[::-1], "<f4").tobytes())


def material_lines(name, m, both_sides):
    color = numbers(m.color)
    lobes = {
        "diffuse": "lobe diffuse weight %s%s" % (color, " times %s" % m.texture if m.texture else ""),
        "mirror": "lobe mirror weight %s" % color,
        "glass": "lobe dielectric ior %g" % m.ior,
        "glossy": "lobe conductor weight %s color 1 1 1 edge_tint 1 1 1 roughness %g" % (color, m.roughness),
        "rough_glass": "lobe dielectric ior %g roughness %g" % (m.ior, m.roughness),
        "refraction": "lobe refraction ior %g roughness %g" % (m.ior, m.roughness),
        "metal": "lobe conductor color %s edge_tint %s roughness %g anisotropy %g rotation %g" % (
            color, numbers(m.edge_tint), m.roughness, m.anisotropy, m.rotation),
        "plastic": "lobe glossy_dielectric ior %g roughness %g covers\n    lobe diffuse weight %s" % (m.ior, m.roughness, color),
        "oren_nayar": "lobe oren_nayar color %s roughness %g" % (color, m.roughness),
        "translucent": "lobe translucent weight %s" % color,
    }
    yield "material %s {" % name
    yield "    " + lobes[m.kind]
    if any(m.emission):
        yield "    emission %s" % numbers(m.emission)
        if not both_sides: yield "    emission_sides front"
    if m.opacity < 1: yield "    opacity %g" % m.opacity
    yield "}"


def lamp_lines(name, lamp, as_cycles):
    """Lamps with a size can be seen: as bodies, or for Cycles as light alone, which hides nothing."""
    yield "light %s {" % name
    yield "    type %s" % lamp.kind
    yield "    transform %s" % numbers(lamp.place[:3])
    yield "    color %s" % numbers(lamp.light)
    if as_cycles and (lamp.kind in ("sphere", "disk", "rectangle") or lamp.radius or lamp.angle * (lamp.kind == "sun")):
        yield "    seen_by all"
    elif lamp.kind in ("sphere", "disk", "rectangle"):
        yield "    visible true"
    if lamp.kind in ("disk", "rectangle"): yield "    size 2 2"
    if lamp.radius: yield "    radius %g" % lamp.radius
    if lamp.kind == "sun": yield "    angle %g" % lamp.angle
    if lamp.kind == "spot": yield "    cone_angle %g\n    blend %g" % (lamp.angle, lamp.blend)
    yield "}"


def mesh_lines(name, mesh):
    yield "mesh %s {" % name
    for key, rows in (("points", mesh.points), ("triangles", mesh.faces), ("normals", mesh.normals), ("uvs", mesh.uvs)):
        if rows is None: continue
        yield "    %s %d" % (key, len(rows))
        yield from (numbers(row) for row in rows)
    yield "}"


def text(scene):
    depth = scene.depth
    yield "raytracer 1\nsettings {\n    resolution %d %d\n    samples %d" % (scene.size, scene.size, scene.spp)
    yield "    integrator %s\n    filter box 1\n    cutoff 0" % scene.integrator
    for key in ("max_depth", "diffuse_depth", "glossy_depth", "transmission_depth", "transparent_depth"):
        yield "    %s %d" % (key, scene.diffuse_depth if key == "diffuse_depth" and scene.diffuse_depth is not None else depth)
    yield "}\ncamera eye {\n    look_at %s %s 0 0 1\n    fov %g\n    sensor 36 36" % (
        numbers(scene.eye), numbers(scene.target), scene.fov)
    if scene.aperture: yield "    aperture_radius %g\n    focus_distance %.9g" % (scene.aperture, scene.focus)
    yield "}"
    yield "world {\n    background %s" % numbers((1, 1, 1) if scene.sky is not None else scene.background)
    if scene.sky is not None: yield "    environment sky"
    yield "}"
    if scene.sky is not None: yield 'texture sky {\n    file "sky.pfm"\n    space linear\n}'
    for name in scene.pictures: yield 'texture %s {\n    file "%s.pfm"\n    space linear\n}' % (name, name)
    for name, m in scene.materials.items(): yield from material_lines(name, m, scene.peer == "cycles")
    for name, mesh in scene.meshes.items(): yield from mesh_lines(name, mesh)
    for i, lamp in enumerate(scene.lamps): yield from lamp_lines("lamp%d" % i, lamp, scene.peer == "cycles")
    for i, shape in enumerate(scene.shapes):
        kind = {"rectangle": "plane", "mesh": "instance", "ground": "infinite_plane"}.get(shape.kind, shape.kind)
        yield "%s thing%d {\n    transform %s" % (kind, i, numbers(shape.place[:3]))
        if shape.motion: yield "    key\n    transform %s" % numbers((move(*shape.motion) @ shape.place)[:3])
        if shape.other: yield "    materials %s %s" % (shape.other, shape.material)  # the first has the square of x and y from -1 and 0 on
        else: yield "    material %s" % shape.material
        if shape.mesh: yield "    mesh %s" % shape.mesh
        yield "}"


def write(scene, folder):
    os.makedirs(folder, exist_ok=True)
    if scene.sky is not None: write_pfm(os.path.join(folder, "sky.pfm"), scene.sky)
    for name, picture in scene.pictures.items(): write_pfm(os.path.join(folder, name + ".pfm"), picture)
    path = os.path.join(folder, scene.name + ".txt")
    with open(path, "w") as file: file.write("\n".join(text(scene)) + "\n")
    return path


def render(scene, folder, binary, threads, flags=()):
    """Pictures of as many seeds as the scene says, [seed, row, column, channel]."""
    path, out = write(scene, folder), os.path.join(folder, "ours.pfm")
    pictures = []
    for seed in range(1, scene.seeds + 1):
        subprocess.run([binary, path, out, "--quiet", "--seed", str(seed), "--threads", str(threads), *flags], check=True)
        pictures.append(pfm(out))
    return np.array(pictures)
