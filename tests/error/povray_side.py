"""A scene as POV-Ray 3.7's text, and its pictures. What POV-Ray cannot say ends in a Cannot that says why.
Its floors, which are biases at any number of samples: the shadow of an area light and its light are averaged apart and multiplied;
a lens has one fixed set of points, and sub-pixels in 4 x 4 places; antialiasing knows few jitters. Its random numbers have no
seed: pictures of other seeds are other columns and rows of a larger picture whose camera is shifted as much."""
import math, os, re, subprocess, time
import numpy as np
from scene import aim, ground, square

SCALE = 0.25  # of all light, so that a picture of 16 bits, whose white is 1, holds four times as much
STEP = 1 / (65535 * SCALE)  # of values in a picture
FADE = 1e-3  # distance at which lamps give all that `color` says; from there they fall with the square
PLACES = 24  # columns and rows by which seeds are shifted


class Cannot(Exception):
    """Why a renderer cannot show a scene."""


def vector(values):
    return "<" + ",".join("%.9g" % v for v in np.ravel(values)) + ">"


def placed(place):
    """The lines of POV-Ray's matrix are the images of x, y, z and of the origin."""
    return "matrix %s" % vector(place[:3].T)


def check(scene):
    if scene.sky is not None: raise Cannot("no light from a picture of the sky")
    if any(scene.background): raise Cannot("no light from the background")
    if any(s.motion for s in scene.shapes): raise Cannot("nothing moves")
    if scene.diffuse_depth != 0 and scene.depth > 0: raise Cannot("no unbiased indirect light")
    for m in scene.materials.values():
        if m.kind not in ("diffuse", "mirror") or m.texture or any(m.emission) or m.opacity < 1: raise Cannot("no %s the same as ours" % m.kind)


def texture(m):
    if m.kind == "mirror": return "pigment { rgb 0 } finish { ambient 0 diffuse 0 reflection { rgb %s } }" % vector(m.color)
    return "pigment { rgb %s } finish { ambient 0 diffuse 1 }" % vector(m.color)


def solid(scene, shape):
    """A shape up to its place."""
    if shape.kind == "sphere": return "sphere { 0, 1"
    if shape.kind == "cube": return "box { -1, 1"
    if shape.kind == "ground": return "plane { z, 0"
    mesh = {"rectangle": square}.get(shape.kind, lambda: scene.meshes[shape.mesh])()
    rows = []
    for word, values in ("vertex_vectors", mesh.points), ("normal_vectors", mesh.normals), ("face_indices", mesh.faces):
        if values is not None: rows.append("%s { %d, %s }" % (word, len(values), ", ".join(map(vector, values))))
    return "mesh2 {\n" + "\n".join(rows) + "\n"


def lamp_text(lamp, side):
    """Of radiant intensity I, the light on a white surface is I / pi / d^2; POV-Ray's is color * 2 / (1 + (d / FADE)^2)."""
    at, down, color = lamp.place[:3, 3], -lamp.place[:3, 2], np.asarray(lamp.light, float) * SCALE / math.pi
    faded = "fade_distance %g fade_power 2" % FADE
    if lamp.kind == "point" and not lamp.radius: return "light_source { %s rgb %s %s }" % (vector(at), vector(color / (2 * FADE ** 2)), faded)
    if lamp.kind == "sun" and not lamp.angle:
        return "light_source { %s rgb %s parallel point_at 0 }" % (vector(down * -1e5), vector(color))
    if lamp.kind != "rectangle": raise Cannot("no lamp the same as our %s" % lamp.kind)
    axes = [2 * lamp.place[:3, i] for i in range(2)]
    area = np.linalg.norm(np.cross(*axes))
    axes = [a * (side - 1) / side for a in axes]  # jitter takes the outer samples half a cell further
    return ("light_source { %s rgb %s spotlight radius 90 falloff 90 tightness 1 point_at %s %s area_light %s, %s, %d, %d jitter area_illumination on }" % (
        vector(at), vector(color * area / (2 * FADE ** 2)), vector(at + down), faded, vector(axes[0]), vector(axes[1]), side, side))


def shift_of(seed):
    return [seed * 5 % PLACES, seed * 7 // 3 % PLACES]


def text(scene, samples, shift):
    """A picture of more columns and rows than wanted, so that `shift` moves what is wanted within it."""
    side, light_side = math.isqrt(samples), 2
    place, size = aim(scene.eye, scene.target), scene.size + PLACES
    right, up, forward = place[:3, 0], place[:3, 1], -place[:3, 2]
    pixel = 2 * math.tan(math.radians(scene.fov) / 2) / scene.size
    off = [pixel * (PLACES / 2 - s) for s in shift]  # of the middle of the picture from that of what is wanted
    direction = forward + right * off[0] - up * off[1]
    yield "#version 3.7;\nglobal_settings { assumed_gamma 1 max_trace_level %d adc_bailout 0 }\nbackground { rgb 0 }" % (scene.depth + 1)
    yield "camera { perspective location %s direction %s right %s up %s" % tuple(map(vector, (scene.eye, direction, right * pixel * size, up * pixel * size)))
    if scene.aperture: yield "aperture %.9g focal_point %s blur_samples %d confidence 0.999 variance 0" % (
        4 * scene.aperture, vector(np.asarray(scene.eye) + scene.focus * direction), max(samples, 2))
    yield "}"
    for lamp in scene.lamps: yield lamp_text(lamp, light_side)
    for shape in scene.shapes:
        look = texture(scene.materials[shape.material])
        if shape.other:
            a, b = (scene.materials[n] for n in (shape.material, shape.other))
            # Half a square up, the plane does not lie between two squares.
            look = "pigment { checker rgb %s, rgb %s translate 0.5*z } finish { ambient 0 diffuse 1 }" % (vector(a.color), vector(b.color))
        yield "%s %s %s }" % (solid(scene, shape), look, placed(shape.place))


def write(scene, folder, samples, seed):
    """The path of the text, and POV-Ray's options for what is wanted of the picture."""
    check(scene)
    shift = shift_of(seed)
    path = os.path.join(folder, "povray.pov")
    with open(path, "w") as file: file.write("\n".join(text(scene, samples, shift)) + "\n")
    size = scene.size + PLACES
    options = ["+I" + path, "+O" + path[:-4] + ".ppm", "+W%d" % size, "+H%d" % size, "+FP16", "File_Gamma=1.0", "Antialias_Gamma=1.0", "-D", "-V",
               "+SC%d" % (shift[0] + 1), "+EC%d" % (shift[0] + scene.size), "+SR%d" % (shift[1] + 1), "+ER%d" % (shift[1] + scene.size)]
    side = math.isqrt(samples)
    if scene.aperture or side < 2: return path, options + ["-A"]
    return path, options + ["+A0.0", "+AM1", "+R%d" % side, "+J1.0"]


def ppm16(path):
    with open(path, "rb") as file: data = file.read()
    head = re.match(rb"P6\s+(?:#[^\n]*\n)*(\d+)\s+(\d+)\s+(\d+)\s", data)
    width, height, top = map(int, head.groups())
    return np.frombuffer(data, ">u2", offset=head.end()).reshape(height, width, 3) / (top * SCALE)


def render(povray, scene, folder, samples, seed, threads):
    """A picture, the seconds that POV-Ray says it traced, and those of the whole process."""
    path, options = write(scene, folder, samples, seed)
    start = time.perf_counter()
    done = subprocess.run([povray, *options, "+WT%d" % threads], stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
    whole, said = time.perf_counter() - start, done.stdout.decode("latin-1")
    if done.returncode: raise SystemExit("error: POV-Ray failed:\n" + said)
    seconds = re.search(r"Trace Time:.*?\(([0-9.]+) seconds\)", said)
    (column, row), picture = shift_of(seed), ppm16(path[:-4] + ".ppm")
    return picture[row:row + scene.size, column:column + scene.size], float(seconds.group(1)), whole
