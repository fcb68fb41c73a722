"""The script as users run it, from outside: exit codes, equal bytes, files."""

import glob
import os
import subprocess
import sys
import time

from places import RAYTRACER, SCRIPT, TOP
from scene_text import equal

WHOLE = []  # (name, function(launch, folder))


def whole(function):
    WHOLE.append((function.__name__, function))
    return function


def small_scene(folder):
    """Code that saves a scene with a camera, a lamp, a cube, and a second file without a camera."""
    return """
import bpy
bpy.ops.wm.read_factory_settings(use_empty=True)
scene = bpy.context.scene
scene.render.engine = "CYCLES"
scene.view_settings.view_transform = "Standard"
bpy.ops.mesh.primitive_monkey_add()
bpy.ops.mesh.primitive_cube_add(location=(3, 0, 0))
lamp = bpy.data.lights.new("Lamp", "POINT")
scene.collection.objects.link(bpy.data.objects.new("Lamp", lamp))
bpy.ops.wm.save_as_mainfile(filepath=r"%(f)s/nocamera.blend")
camera = bpy.data.objects.new("Camera", bpy.data.cameras.new("Camera"))
scene.collection.objects.link(camera)
scene.camera = camera
bpy.ops.wm.save_as_mainfile(filepath=r"%(f)s/good.blend")
scene.view_settings.gamma = 2
bpy.ops.wm.save_as_mainfile(filepath=r"%(f)s/warns.blend")
""" % {"f": folder}


class Launch:
    """Starts one Blender, or the Python of a bpy module."""

    def __init__(self, program):
        self.program = program
        self.is_python = "python" in os.path.basename(program)

    def script(self, path, arguments=(), blend=None):
        """The arguments that run a script."""
        if self.is_python:
            return [self.program, path, *([blend] if blend else []), *arguments]
        start = ["-b", blend] if blend else ["-b", "--factory-startup"]
        return [self.program, *start, "--python-exit-code", "3", "-P", path, "--", *arguments]

    def run(self, path, arguments=(), blend=None, timeout=600, environment=None):
        return subprocess.run(self.script(path, arguments, blend), capture_output=True, text=True, timeout=timeout,
                              env={**os.environ, "PYTHONDONTWRITEBYTECODE": "1",
                                   "RAYTRACER": RAYTRACER, **(environment or {})})


def expect(done, code, *parts):
    assert done.returncode == code, "exit code %d, wanted %d\n%s" % (done.returncode, code, done.stderr[-2000:])
    for part in parts:
        assert part in done.stderr + done.stdout, "'%s' is not in\n%s" % (part, done.stderr[-2000:])
    assert code == 3 or "Traceback" not in done.stderr, done.stderr[-2000:]


@whole
def exit_codes(launch, folder):
    out = os.path.join(folder, "out.txt")
    good, warns, none = (os.path.join(folder, n + ".blend") for n in ("good", "warns", "nocamera"))
    expect(launch.run(SCRIPT, ["-o", out], good), 0)
    expect(launch.run(SCRIPT, ["-o", out, "--strict"], good), 0)
    expect(launch.run(SCRIPT, ["-o", out], warns), 0, "W002", "1 warning: W002 x1")
    expect(launch.run(SCRIPT, ["-o", out, "--strict"], warns), 3, "W002")
    expect(launch.run(SCRIPT, ["-o", out], none), 2, "no active camera")
    expect(launch.run(SCRIPT, ["-o", out, "--camera", "Kamera"], good), 2, "known: Camera")
    expect(launch.run(SCRIPT, ["-o", out, "--frame", "x"], good), 2, "--frame")
    expect(launch.run(SCRIPT, ["-o", out, "--frame", "1:3"], good), 2, "####")
    expect(launch.run(SCRIPT, ["-o", out, "--nonsense"], good), 2)
    expect(launch.run(SCRIPT, ["--help"], good), 0, "W012", "--strict")
    expect(launch.run(SCRIPT, ["--list-warnings"], good), 0, "W012")
    expect(launch.run(SCRIPT, ["-o", os.path.join(folder, "good.blend", "x.txt")], good), 2)
    missing = launch.run(SCRIPT, ["-o", out], os.path.join(folder, "missing.blend"))
    assert missing.returncode != 0


@whole
def what_the_renderer_refuses_is_an_error(launch, folder):
    good, out = os.path.join(folder, "good.blend"), os.path.join(folder, "checked.txt")
    program = os.path.join(folder, "refuses")
    with open(program, "w") as file:
        file.write("#!/bin/sh\necho \"$1 $2: error: it is not to my taste\" >&2\nexit 2\n")
    os.chmod(program, 0o755)
    environment = {"RAYTRACER": program}
    expect(launch.run(SCRIPT, ["-o", out], good, environment=environment), 2, "--check %s: error: it is not to my taste" % out)
    expect(launch.run(SCRIPT, ["-o", out, "--no-check"], good, environment=environment), 0)
    expect(launch.run(SCRIPT, ["-o", out], good, environment={"RAYTRACER": os.path.join(folder, "none")}), 0)


@whole
def a_fault_of_the_script_is_3(launch, folder):
    broken = os.path.join(folder, "broken.py")
    with open(SCRIPT, encoding="utf-8") as file:
        source = file.read()
    with open(broken, "w", encoding="utf-8") as file:
        file.write(source.replace("def put_world", "def put_world").replace(
            "    def collect_world(self):\n", "    def collect_world(self):\n        1 / 0\n"))
    out = os.path.join(folder, "broken.txt")
    expect(launch.run(broken, ["-o", out], os.path.join(folder, "good.blend")), 3, "ZeroDivisionError")
    assert not os.path.exists(out) and not glob.glob(out + "*")


@whole
def same_bytes_twice(launch, folder):
    texts = []
    for name in ("a", "b"):
        out = os.path.join(folder, "twice", name, "scene.txt")
        expect(launch.run(SCRIPT, ["-o", out], os.path.join(folder, "good.blend")), 0)
        with open(out, "rb") as file:
            texts.append(file.read())
    equal(texts[0], texts[1])


@whole
def frames_and_default_output(launch, folder):
    good = os.path.join(folder, "good.blend")
    expect(launch.run(SCRIPT, ["-o", os.path.join(folder, "f-####.txt"), "--frame", "8:10"], good), 0)
    equal(sorted(os.path.basename(p) for p in glob.glob(os.path.join(folder, "f-*"))), ["f-0008.txt", "f-0009.txt", "f-0010.txt"])
    expect(launch.run(SCRIPT, [], good), 0)
    assert os.path.exists(os.path.join(folder, "good.txt"))


@whole
def speed_of_large_meshes(launch, folder):
    """Half a million triangles in a few seconds and in less than 30 MB."""
    code = os.path.join(folder, "large.py")
    with open(code, "w") as file:
        file.write(small_scene(folder).split("bpy.ops.mesh")[0] + """
bpy.ops.mesh.primitive_grid_add(x_subdivisions=500, y_subdivisions=500)
for v in bpy.context.object.data.vertices: v.co.z = 0.1 * v.co.x * v.co.y
bpy.ops.object.shade_smooth()
camera = bpy.data.objects.new("Camera", bpy.data.cameras.new("Camera"))
scene.collection.objects.link(camera)
scene.camera = camera
bpy.ops.wm.save_as_mainfile(filepath=r"%s/large.blend")
import os, sys; sys.stdout.flush(); os._exit(0)
""" % folder)
    expect(launch.run(code), 0)
    start = time.time()
    large = os.path.join(folder, "large.txt")
    expect(launch.run(SCRIPT, ["-o", large], os.path.join(folder, "large.blend")), 0)
    seconds = time.time() - start
    assert os.path.getsize(large) < 30e6, os.path.getsize(large)
    print("      500k triangles: %.1f s" % seconds)
    assert seconds < 60, "%.1f s" % seconds


@whole
def scenes_of_this_project(launch, folder):
    if launch.is_python and "--all-scenes" not in sys.argv:
        return  # once is enough; other versions have other defaults, not other code
    scenes = sorted(glob.glob(os.path.join(TOP, "Blend", "*.blend")))
    problems = []
    for blend in scenes:
        name = os.path.splitext(os.path.basename(blend))[0]
        out = os.path.join(folder, "project", "ASCII", name + ".txt")
        done = launch.run(SCRIPT, ["-o", out], blend)  # writes no pictures into the project
        if done.returncode != 0 or " warning" in done.stderr:
            problems.append("%s: %d %s" % (name, done.returncode, done.stderr[-500:]))
    assert not problems, "\n".join(problems)
