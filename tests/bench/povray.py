#!/usr/bin/env python3
"""Whole pictures against POV-Ray 3.7 (Debian: povray), one thread:
    povray.py RAYTRACER [SCENE[:SIZE]...] [--resolution WxH] [--runs N] [--keep FOLDER]
Writes every scene as NFF or, where that can't say it, as native text, and as POV-Ray's text, renders
both in turn and prints, tab-separated, the median seconds of the whole processes (start, reading, rendering, writing a PNG) on the clock and of the
processor (POV-Ray also waits for itself), their ratios, and how far the pictures differ (mean absolute difference of a channel, of 255). Needs only python3."""
import argparse, os, resource, shutil, subprocess, sys, tempfile, time
sys.dont_write_bytecode = True
from pov_scenes import VIEWS, numbers, vector, write_native, write_pov as write_view_pov
from spd_scenes import SCENES, Cone, Polygon, Sphere, cross, mul, sub, unit
import math

DEPTH = 4  # bounces after the camera ray; POV-Ray counts that one, too


def write_nff(scene, width, height, out):
    out.write('b %s\nv\nfrom %s\nat %s\nup %s\nangle %g\nhither 0.01\nresolution %d %d\n' % (
        numbers(scene.background), numbers(scene.eye), numbers(scene.at), numbers(scene.up), scene.angle, width, height))
    for light in scene.lights: out.write('l %s\n' % numbers(light))
    last = None
    for item in scene.items:
        if item.fill is not last:
            last = item.fill
            out.write('f %s %.9g %.9g %.9g 0 0\n' % (numbers(last.color), last.kd, last.ks, last.shine))
        if isinstance(item, Sphere):
            out.write('s %s %.9g\n' % (numbers(item.centre), item.radius))
        elif isinstance(item, Cone):
            out.write('c %s %.9g %s %.9g\n' % (numbers(item.base), item.base_radius, numbers(item.apex), item.apex_radius))
        else:
            out.write('p %d\n' % len(item.corners))
            for corner in item.corners: out.write(numbers(corner) + '\n')


def write_pov(scene, width, height, out):
    """The same picture: NFF's light per lamp is sqrt(n) / 2n, the ambient light as much, and its angle
    spans the centres of the first and the last row."""
    light = math.sqrt(len(scene.lights)) / (2 * len(scene.lights))
    forward = unit(sub(scene.at, scene.eye))
    right = unit(cross(forward, scene.up))
    up = cross(right, forward)
    tall = 2 * math.tan(math.radians(scene.angle) / 2) * height / (height - 1)
    out.write('#version 3.7;\nglobal_settings { assumed_gamma 1 max_trace_level %d adc_bailout 0 }\n'
              'background { rgb %s }\ncamera { perspective location %s direction %s right %s up %s }\n' % (
                  DEPTH + 1, vector(scene.background), vector(scene.eye), vector(forward),
                  vector(mul(right, tall * width / height)), vector(mul(up, tall))))
    for at in scene.lights: out.write('light_source { %s rgb %.9g }\n' % (vector(at), light))
    names = {}
    for item in scene.items:
        fill = item.fill
        if fill in names: continue
        names[fill] = 'T%d' % len(names)
        mirror = ' phong %.9g phong_size %.9g reflection %.9g' % (fill.ks, fill.shine, fill.ks) if fill.ks else ''
        out.write('#declare %s = texture { pigment { rgb %s } finish { ambient %.9g diffuse %.9g%s } }\n' % (
            names[fill], vector(fill.color), fill.kd * light, fill.kd, mirror))
    triangles = {}
    for item in scene.items:
        name = names[item.fill]
        if isinstance(item, Sphere):
            out.write('sphere { %s %.9g texture { %s } }\n' % (vector(item.centre), item.radius, name))
        elif isinstance(item, Cone):
            out.write('cone { %s %.9g %s %.9g open texture { %s } }\n' % (
                vector(item.base), item.base_radius, vector(item.apex), item.apex_radius, name))
        else:
            triangles.setdefault(name, []).extend((item.corners[0], item.corners[k], item.corners[k + 1])
                                                  for k in range(1, len(item.corners) - 1))
    for name, list_ in triangles.items():  # a mesh is POV-Ray's fastest way
        out.write('mesh {\n')
        out.writelines('triangle { %s %s %s }\n' % tuple(map(vector, t)) for t in list_)
        out.write('texture { %s } }\n' % name)


def written(name, size, path, resolution):
    """The scene, the file of it that is ours, its samples per pixel, and how large its picture is."""
    pixels = resolution and tuple(map(int, resolution.split('x')))
    if name in VIEWS:
        view = VIEWS[name](size) if size else VIEWS[name]()
        if pixels: view = view._replace(width=pixels[0], height=pixels[1])
        write_native(view, path)
        write_view_pov(view, path)
        return view, path + '.txt', view.samples, (view.width, view.height)
    scene, pixels = SCENES[name](int(size)) if size else SCENES[name](), pixels or (512, 512)
    with open(path + '.nff', 'w') as out: write_nff(scene, *pixels, out)
    with open(path + '.pov', 'w') as out: write_pov(scene, *pixels, out)
    return scene, path + '.nff', 1, pixels


def seconds(command):
    """Of the whole process: on the clock, and of the processor, which a busy machine changes less."""
    start, before = time.perf_counter(), resource.getrusage(resource.RUSAGE_CHILDREN)
    done = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
    clock, after = time.perf_counter() - start, resource.getrusage(resource.RUSAGE_CHILDREN)
    if done.returncode: sys.exit('%s failed:\n%s' % (command[0], done.stdout.decode('latin-1')))
    return clock, after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def median(values): return sorted(values)[len(values) // 2]


def difference(raytracer, a, b):
    done = subprocess.run([raytracer, 'diff', a, b, '--metric', 'mae', '--tol', '1'], stdout=subprocess.PIPE)
    return done.stdout.decode().strip().replace('\n', ' ')


def main():
    args = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    args.add_argument('raytracer')
    args.add_argument('scenes', nargs='*', metavar='SCENE[:SIZE]',
                      help='of %s; mesh:FILE.obj shows that file' % ', '.join([*SCENES, *VIEWS]))
    args.add_argument('--resolution', metavar='WxH', help="512x512, or the scene's own")
    args.add_argument('--runs', type=int, default=5)
    args.add_argument('--keep', metavar='FOLDER', help='scenes and pictures stay there')
    args = args.parse_args()
    povray = shutil.which('povray')
    if not povray: sys.exit('povray.py: there is no povray here; Debian has it as the package povray')
    print('scene\titems\tours_s\tpovray_s\tratio\tours_cpu_s\tpovray_cpu_s\tcpu_ratio\tdifference', flush=True)
    with tempfile.TemporaryDirectory() as folder:
        folder = args.keep or folder
        os.makedirs(folder, exist_ok=True)
        for word in args.scenes or [*SCENES, *VIEWS]:
            name, _, size = word.partition(':')
            if name not in SCENES and name not in VIEWS:
                sys.exit('povray.py: no scene %s; known: %s' % (name, ', '.join([*SCENES, *VIEWS])))
            path = os.path.join(folder, name + os.path.basename(size))
            scene, file, samples, (width, height) = written(name, size, path, args.resolution)
            ours = [args.raytracer, file, path + '.png', '--threads', '1', '--quiet']
            if samples == 1: ours.append('--no-aa')
            theirs = [povray, '+I%s.pov' % path, '+O%s_pov.png' % path, '+W%d' % width, '+H%d' % height,
                      '-D', '-A', '+WT1', '+FN8', 'File_Gamma=srgb', '-GA']
            times = [seconds(ours) + seconds(theirs) for _ in range(args.runs)]
            columns = [median([t[k] for t in times]) for k in range(4)]
            ratios = [median([t[2 + k] / t[k] for t in times]) for k in range(2)]
            print('%s\t%d\t%.3f\t%.3f\t%.1f\t%.3f\t%.3f\t%.1f\t%s' % (
                word, len(scene.items), columns[0], columns[2], ratios[0], columns[1], columns[3], ratios[1],
                difference(args.raytracer, path + '.png', path + '_pov.png')), flush=True)


if __name__ == '__main__':
    main()
