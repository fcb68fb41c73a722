"""Scenes for povray.py that say more than NFF can: thousands of mirrors on a chequered plane, glass in
front of a lens under a soft lamp, and a smooth mesh. Written in our native text and in POV-Ray's, so
that both show the same picture. Right-handed, z up; made by rule alone, but for a mesh that is named."""
import math, os
from collections import namedtuple
from spd_scenes import Sphere, add, cross, field, mul, sub, unit

# color * (ambient + diffuse * cos) + specular * cosH^shine under a lamp of 1, and a mirror or glass.
Look = namedtuple('Look', 'color ambient diffuse specular shine mirror glass', defaults=(0, 1, 0, False))
Box = namedtuple('Box', 'look lo hi')
Ground = namedtuple('Ground', 'even odd height')  # without end; unit squares if the looks differ
Mesh = namedtuple('Mesh', 'look points normals triangles')
Camera = namedtuple('Camera', 'eye at angle aperture focus', defaults=(0, 0))  # angle: from left to right
Lamp = namedtuple('Lamp', 'at radius', defaults=(0,))  # lights alike at every distance
View = namedtuple('View', 'width height camera lamp items samples lamp_samples', defaults=(1, 1))

SKY = (0.5, 0.7, 1)
DEPTH = 4             # bounces after the camera ray; POV-Ray counts that one, too
CUTOFF = 1 / 255      # rays of less weight are not traced: POV-Ray's own adc_bailout
GLASS = 1.5


def spheres(size=4):
    """10^size spheres of many sizes, all mirroring a fifth, on chequers."""
    ball = Look((1, 1, 1), 0.1, 0.7, 0.3, 50, 0.2)
    items = [Ground(ball._replace(color=(.9, .9, .9)), ball._replace(color=(.2, .2, .2)), 0)]
    for item in field(int(size)).items[1:]:
        items.append(Sphere(ball._replace(color=item.fill.color), item.centre, item.radius))
    return View(960, 540, Camera((0, -18, 6), (0, 8, 0), 60), Lamp((-30, -40, 50)), items)


def glass():
    """Two balls and a cube of glass, a mirror and coloured things under a soft lamp, through a lens."""
    def paint(*color): return Look(color, 0.1, 0.8)
    clear = Look((1, 1, 1), 0, 0, 0, 1, 1, True)
    items = [Ground(paint(.85, .85, .85), paint(.35, .35, .35), 0),
             Sphere(clear, (-1.1, -0.5, 1), 1), Sphere(clear, (1.3, -1, 0.8), 0.8), Box(clear, (-.9, -2.4, 0), (-.4, -1.9, .5)),
             Sphere(Look((.9, .9, .9), 0, 0.1, 0, 1, 0.8), (0.2, 1.8, 1.2), 1.2),
             Sphere(paint(.9, .2, .2), (-0.1, -2, 0.35), 0.35), Sphere(paint(.2, .8, .3), (2.6, 0.4, 0.5), 0.5),
             Box(paint(.2, .4, .9), (-3.4, 0.3, 0), (-2.4, 1.3, 1.6)), Box(paint(.9, .8, .2), (2.2, 1.6, 0), (3.4, 2.8, 2.2))]
    eye, at, sharp = (0, -7, 2.2), (0, 0, 0.9), (0, -0.5, 0.9)
    focus = sum(a * b for a, b in zip(sub(sharp, eye), unit(sub(at, eye))))
    return View(480, 270, Camera(eye, at, 50, 0.0625, focus), Lamp((-4, -5, 7), 1), items, 64, 16)


def mesh(path=None):
    """An OBJ file (y up) or a bumpy ball of 69k triangles, smooth, on a floor."""
    points, triangles = read_obj(path) if path else bumpy_ball(185)
    lo, hi = ([pick(p[k] for p in points) for k in range(3)] for pick in (min, max))
    size = math.sqrt(sum((b - a) ** 2 for a, b in zip(lo, hi)))
    centre = mul(add(lo, hi), 0.5)
    def beside(x, y, z): return add(centre, mul((x, y, z), size))
    items = [Ground(*[Look((.5, .5, .5), 0.1, 0.8)] * 2, lo[2]),
             Mesh(Look((.7, .6, .5), 0.1, 0.8), points, smooth_normals(points, triangles), triangles)]
    return View(960, 540, Camera(beside(1.05, -1.8, 0.6), centre, 40), Lamp(beside(0.45, -0.6, 1.4)), items)


def read_obj(path):
    points, triangles = [], []
    with open(path) as text:
        for line in text:
            word, *rest = line.split() or ['']
            if word == 'v':
                x, y, z = map(float, rest[:3])
                points.append((x, -z, y))
            elif word == 'f':
                corners = [int(c.split('/')[0]) for c in rest]
                corners = [c - 1 if c > 0 else c + len(points) for c in corners]
                triangles += [(corners[0], corners[k], corners[k + 1]) for k in range(1, len(corners) - 1)]
    return points, triangles


def bumpy_ball(n):
    """A ball of n rings and n meridians with waves on it."""
    points = []
    for i in range(n + 1):
        for j in range(n):
            polar, around = math.pi * i / n, math.tau * j / n
            r = 1 + 0.08 * math.sin(9 * polar) * math.sin(8 * around) * math.sin(polar)
            points.append((r * math.sin(polar) * math.cos(around), r * math.sin(polar) * math.sin(around), r * math.cos(polar)))
    triangles = []
    for i in range(n):
        for j in range(n):
            a, b = i * n + j, i * n + (j + 1) % n
            if i > 0: triangles.append((a, a + n, b))
            if i < n - 1: triangles.append((b, a + n, b + n))
    return points, triangles


def smooth_normals(points, triangles):
    """Of the vertices, weighted by area."""
    sums = [(0, 0, 0)] * len(points)
    for t in triangles:
        a, b, c = (points[k] for k in t)
        n = cross(sub(b, a), sub(c, a))
        for k in t: sums[k] = add(sums[k], n)
    return [unit(n) if any(n) else (0, 0, 1) for n in sums]


def numbers(v): return ' '.join('%.9g' % x for x in v)
def vector(v): return '<' + ','.join('%.9g' % x for x in v) + '>'


def frame(camera):
    forward = unit(sub(camera.at, camera.eye))
    right = unit(cross(forward, (0, 0, 1)))
    return right, cross(right, forward), forward


def looks_of(view):
    """Names of the looks, in the order of their first use."""
    names = {}
    for item in view.items:
        for look in (item.even, item.odd) if isinstance(item, Ground) else (item[0],):
            names.setdefault(look, 'm%d' % len(names))
    return names


def write_native(view, path):
    """The scene as PATH.txt, meshes beside it. Diffuse light of a lamp is kd/pi * E, highlights ks * E:
    with E = pi both are as in POV-Ray, highlights divided by pi."""
    camera, lamp, names = view.camera, view.lamp, looks_of(view)
    with open(path + '.txt', 'w') as out:
        out.write('raytracer 1\nsettings {\nresolution %d %d\nsamples %d\nlight_samples %d\nmax_depth %d\ncutoff %.9g\nfilter box 1\n}\n'
                  'world {\nbackground %s\n}\n' % (view.width, view.height, view.samples, view.lamp_samples, DEPTH, CUTOFF, numbers(SKY)))
        out.write('camera c {\nlook_at %s  %s  0 0 1\nlens %.17g\n' % (
            numbers(camera.eye), numbers(camera.at), 18 / math.tan(math.radians(camera.angle) / 2)))
        if camera.aperture: out.write('aperture_radius %.9g\nfocus_distance %.9g\n' % (camera.aperture, camera.focus))
        out.write('}\nlight l {\ntranslate %s\ncolor %s\nattenuation 0 0 1\nradius %.9g\n}\n' % (
            numbers(lamp.at), numbers((math.pi,) * 3), lamp.radius))
        for look, name in names.items():
            out.write('material %s {\ndiffuse %s\n' % (name, numbers(mul(look.color, look.diffuse))))
            if look.ambient: out.write('emission %s\n' % numbers(mul(look.color, look.ambient)))
            if look.specular:
                out.write('specular %s\nexponent %.9g\n' % (numbers((look.specular / math.pi,) * 3), look.shine))
            if look.mirror: out.write('mirror %s\n' % numbers((look.mirror,) * 3))
            if look.glass: out.write('transmission 1 1 1\nior %.9g\nfresnel dielectric\n' % GLASS)
            out.write('}\n')
        for k, item in enumerate(view.items):
            if isinstance(item, Ground):
                out.write('infinite_plane o%d {\ntranslate 0 0 %.9g\nmaterials %s %s\n}\n' % (
                    k, item.height, names[item.even], names[item.odd]))
            elif isinstance(item, Sphere):
                out.write('sphere o%d {\ntranslate %s\nradius %.9g\nmaterial %s\n}\n' % (
                    k, numbers(item.centre), item.radius, names[item[0]]))
            elif isinstance(item, Box):
                out.write('cube o%d {\ntranslate %s\nscale %s\nmaterial %s\n}\n' % (
                    k, numbers(mul(add(item.lo, item.hi), 0.5)), numbers(mul(sub(item.hi, item.lo), 0.5)), names[item.look]))
            else:
                write_obj(item, '%s_%d.obj' % (path, k))
                out.write('mesh g%d {\nfile "%s_%d.obj"\n}\ninstance o%d {\nmesh g%d\nmaterial %s\n}\n' % (
                    k, os.path.basename(path), k, k, k, names[item.look]))


def write_obj(item, path):
    with open(path, 'w') as out:
        out.writelines('v %s\n' % numbers(p) for p in item.points)
        out.writelines('vn %s\n' % numbers(n) for n in item.normals)
        out.writelines('f %s\n' % ' '.join('%d//%d' % (c + 1, c + 1) for c in t) for t in item.triangles)


def write_pov(view, path):
    """The same as PATH.pov."""
    camera, lamp, names = view.camera, view.lamp, looks_of(view)
    right, up, forward = frame(camera)
    wide = 2 * math.tan(math.radians(camera.angle) / 2)
    with open(path + '.pov', 'w') as out:
        out.write('#version 3.7;\nglobal_settings { assumed_gamma 1 max_trace_level %d adc_bailout %.9g }\nbackground { rgb %s }\n'
                  'camera { perspective location %s direction %s right %s up %s\n' % (
                      DEPTH + 1, CUTOFF, vector(SKY), vector(camera.eye), vector(forward), vector(mul(right, wide)),
                      vector(mul(up, wide * view.height / view.width))))
        if camera.aperture:  # four radii of the lens; with no variance it takes all samples
            out.write('aperture %.9g focal_point %s blur_samples %d confidence 0.999 variance 0\n' % (
                4 * camera.aperture, vector(add(camera.eye, mul(forward, camera.focus))), view.samples))
        out.write('}\nlight_source { %s rgb 1' % vector(lamp.at))
        if lamp.radius:  # jitter takes the outer samples half a cell further
            side = math.isqrt(view.lamp_samples)
            across = 2 * lamp.radius * (side - 1) / side
            out.write(' area_light %s, %s, %d, %d jitter circular orient' % (
                vector((across, 0, 0)), vector((0, across, 0)), side, side))
        out.write(' }\n')
        for look, name in names.items():
            finish = 'ambient %.9g diffuse %.9g' % (look.ambient, look.diffuse)
            if look.specular: finish += ' specular %.9g roughness %.9g' % (look.specular, 1 / look.shine)
            if look.glass: finish += ' reflection { 0, 1 fresnel on } conserve_energy'
            elif look.mirror: finish += ' reflection %.9g' % look.mirror
            out.write('#declare P%s = pigment { rgb%s }\n#declare F%s = finish { %s }\n' % (
                name, 't <1,1,1,1>' if look.glass else ' ' + vector(look.color), name, finish))

        def put(solid, look):
            name = names[look]
            texture = 'pigment { P%s } finish { F%s }' % (name, name)
            if not look.glass: return out.write('%s %s }\n' % (solid, texture))
            # Lamps would shine through; here glass has a shadow as everything else.
            out.write('%s %s interior { ior %.9g } no_shadow }\n%s pigment { rgb 0 } no_image no_reflection }\n' % (
                solid, texture, GLASS, solid))

        for item in view.items:
            if isinstance(item, Ground):
                even, odd = names[item.even], names[item.odd]
                pigment = 'P%s' % even if even == odd else 'checker pigment { P%s }, pigment { P%s } translate %s' % (
                    even, odd, vector((0, 0, item.height - 0.5)))
                out.write('plane { <0,0,1>, %.9g pigment { %s } finish { F%s } }\n' % (item.height, pigment, even))
            elif isinstance(item, Sphere):
                put('sphere { %s, %.9g' % (vector(item.centre), item.radius), item[0])
            elif isinstance(item, Box):
                put('box { %s, %s' % (vector(item.lo), vector(item.hi)), item.look)
            else:
                name = names[item.look]
                out.write('mesh2 {\n')
                for word, list_ in ('vertex_vectors', item.points), ('normal_vectors', item.normals), ('face_indices', item.triangles):
                    out.write('%s { %d' % (word, len(list_)))
                    out.writelines(',' + vector(v) for v in list_)
                    out.write(' }\n')
                out.write('pigment { P%s } finish { F%s } }\n' % (name, name))


VIEWS = {make.__name__: make for make in (spheres, glass, mesh)}
