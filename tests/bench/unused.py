#!/usr/bin/env python3
"""What a feature costs that is compiled in and not used: its share of all instructions, by callgrind.

    python3 tests/bench/unused.py RAYTRACER [SCENE USED]

RAYTRACER has line numbers (make bench-unused builds it with -g1), so that an instruction counts for
all lines that it was inlined through, and the test whether a feature is wanted counts for the feature.
Every feature that a scene does not use must stay below 1 %; the exit code is 1 where one does not. With a
SCENE of yours, USED is the list of features that it uses: a,b,c or "".
"""
import argparse
import collections
import glob
import os
import re
import subprocess
import sys
import tempfile

import measured

MOST = 0.01
CODE = os.path.join(measured.TOP, "Code")
OPTIONS = ["--kernel", "avx2", "-t", "1", "-q", "-r", "64x36", "--spp", "64"]

# The code of a feature: files of Code/, or FILE: and what begins a statement, a block or a function there.
FEATURES = {
    "dof": ["camera/camera_in_lanes.h: if (optics.hasLens)", "render/camera_rays.cpp: if (drawsLens())",
            "render/camera_rays.h: bool drawsLens()"],
    "motion-blur": ["base/motion.*", "accel/kernels/solids_turning.h", "render/camera_rays.cpp: if (drawsTimes())",
                    "render/camera_rays.h: bool drawsTimes()", "camera/camera_in_lanes.h: if (camera.isMoving())",
                    "camera/camera_in_lanes.h: inline CameraAxes axesAt"],
    "textures": ["texture/texture.*", "texture/texels_in_lanes.h", "texture/filtered_in_lanes.h", "texture/footprint.h",
                 "texture/mip_levels.*", "texture/picture*", "integrate/cones_of_rays.h", "base/ray_cone.h",
                 "integrate/lobe_block.h: void paint(", "scene/texture_files.*"],
    "bump": ["integrate/shading.cpp: Vec3 bumped(", "integrate/shading.cpp: Vec3 carved(",
             "integrate/shading.cpp: Vec3 carvedUnder(", "integrate/shading.cpp: Vec3 mapped(",
             "integrate/shading.cpp: Vec3 shading::bentNormal(",
             "integrate/points.h: for (std::size_t i = 0; scene.anyMaterial().pictures"],
    "environment": ["texture/environment.*", "light/kinds/sky.h", "light/sky/*",
                    "integrate/wave.h: inline std::span<const Rgb> backgroundsOf("],
    "checkers": ["texture/box_checker.h", "integrate/checkers.*", "shape/checkered.*",
                 "integrate/lobed_wave.h: if (!context_.checkers.empty())"],
    "transparency": ["integrate/path.cpp: unsigned goStraight(", "integrate/path.cpp: if (scene_.hasSeeThrough())",
                     "integrate/whitted.cpp: void goStraight(", "integrate/lobed_wave.h: float opacityOf(",
                     "integrate/whitted.cpp: forEachBit(pointsWith(LobedMaterial::kSeeThrough",
                     "integrate/shading.cpp: Rgb straightTransmission(", "integrate/shading.cpp: void transmitted(",
                     "integrate/lobed_wave.h: if (scene_.hasSeeThrough())"],
    "emission": ["integrate/path.cpp: for (unsigned rest = pointsWith(LobedMaterial::kEmits",
                 "integrate/whitted.cpp: forEachBit(pointsWith(LobedMaterial::kEmits",
                 "integrate/lobed_wave.h: template <class LampPdf> void addEmission("],
    "lit-outside": ["integrate/lobed_wave.h: [&](std::size_t b) { return pointsWith(LobedMaterial::kLitOutside"],
    "refraction": ["scene/medium_tree.h", "material/boundary.h", "material/boundary_lobe.h", "material/lobes/refraction.h",
                   "material/lobes/dielectric.h", "integrate/wave.h: inline Boundary boundaryAt(",
                   "integrate/lobed_wave.h: void findBoundaries("],
    "rough-lobes": ["material/lobes/conductor.h", "material/lobes/coat.h", "material/lobes/sheen.h",
                    "material/lobes/oren_nayar.h", "material/lobes/translucent.h", "material/lobes/glossy_dielectric.h",
                    "material/lobes/schlick_mirror.h", "material/ggx.h", "material/energy*"],
    "highlights": ["material/lobes/ashikhmin.h", "material/lobes/blinn.h", "material/lobes/phong.h"],
    "filter-glossy": ["integrate/path.cpp: void filterGlossy(", "integrate/path.cpp: if (limits_.filterGlossy > 0)"],
    "anisotropy": ["integrate/lobed_wave.h: void turn(", "integrate/path_in_lanes.h: if (turned == 0)"],
    "area-lights": ["light/kinds/rectangle.h", "light/kinds/disk.h", "light/kinds/flat.h", "light/kinds/sphere.h",
                    "light/kinds/triangle.h", "light/flat_spread.cpp",
                    "integrate/lobed_wave.h: template <class LampPdf> void addMet("],
    "many-lights": ["light/tree/*"],
    "meshes": ["accel/triangle.h", "accel/kernels/beam*", "accel/kernels/bundle*", "accel/kernels/queue*",
               "accel/kernels/handful.h", "accel/kernels/chord.h", "accel/kernels/exact_hit.*", "accel/kernels/route.cpp",
               "accel/kernels/wide_*", "accel/kernels/build/*", "shape/mesh*", "scene/merge.*", "read/mesh/*"],
    "instances": ["scene/placed_meshes.*", "accel/kernels/placed*"],
    "first-hits": ["integrate/first_hit.cpp"],
    "error-goal": ["film/noise_map.*", "film/sample_plan.*", "film/adaptive_film.*", "film/error_measure.h",
                   "render/thin_places.*"],
    "denoise": ["denoise/*", "render/denoised.*"],
    "other-formats": ["image/exr*", "image/jpeg*", "image/hdr*", "image/tga*", "image/pfm*", "image/inflate*",
                      "read/json/*", "read/nff/*"],
}

HEAD = """raytracer 1
camera c {{
    look_at 0 -6 2  0 0 0.6  0 0 1
}}
material red {{
    diffuse 0.7 0.2 0.1
}}
material mirror {{
    diffuse 0.1 0.1 0.1
    mirror 0.8 0.8 0.8
}}
plane floor {{
    scale 4 4 1
    material red
}}
sphere a {{
    translate -1.2 0 1
    material mirror
}}
sphere b {{
    translate 1.2 0 1
    material red
}}
light l {{
    {lamp}
    translate 2 -3 5
    color 60 60 60
}}
world {{
    background 0.2 0.3 0.5
}}
settings {{
    integrator {integrator}
}}
"""
TEXTS = {
    "whitted": HEAD.format(lamp="type point", integrator="whitted"),
    "path": HEAD.format(lamp="type rectangle", integrator="path"),
}
# What each scene uses.
SCENES = {
    "whitted": "",
    "path": "area-lights",
    "ASCII/textures.txt": "textures,meshes,area-lights,many-lights",
}


class Region:
    """Lines of one file: all, or from the line that begins as said to the end of what begins there."""

    def __init__(self, text):
        pattern, _, begin = text.partition(": ")
        self.files = glob.glob(os.path.join(CODE, pattern))
        if not self.files:
            sys.exit(f"unused.py: no file Code/{pattern}")
        self.lines = self.found(begin) if begin else None

    def found(self, begin):
        with open(self.files[0], encoding="utf-8") as file:
            text = file.read().splitlines()
        first = [i for i, line in enumerate(text) if line.lstrip().startswith(begin)]
        if len(first) != 1:
            sys.exit(f"unused.py: '{begin}' begins {len(first)} lines of {self.files[0]}, and should begin one")
        last = first[0]
        while not text[last].endswith(("{", ";", "}")):
            last += 1
        if text[last].endswith("{"):
            indent = re.match(" *", text[first[0]]).group()
            while not text[last].startswith(indent + "}"):
                last += 1
        return range(first[0] + 1, last + 2)

    def has(self, file, line):
        return file in self.files and (self.lines is None or line in self.lines)


def instructions(raytracer, scene, folder):
    """{address: instructions} of rendering a scene, those of called functions at their own addresses."""
    out = os.path.join(folder, "callgrind.out")
    measured.output("valgrind", "--tool=callgrind", "-q", "--dump-instr=yes", f"--callgrind-out-file={out}", raytracer,
                    scene, os.path.join(folder, "picture.ppm"), *OPTIONS)
    costs = collections.Counter()
    address, isCall = 0, False
    with open(out, encoding="utf-8") as text:
        for row in text:
            if row.startswith("calls="):
                isCall = True  # the next row has what the call cost
            elif match := re.match(r"(0x[0-9a-f]+|[+-][0-9]+|\*) \S+(?: ([0-9]+))?$", row):
                place = match[1]
                if place != "*":
                    address = int(place, 0) + (address if place[0] in "+-" else 0)
                if not isCall:
                    costs[address] += int(match[2] or 0)
                isCall = False
    return costs


def places(raytracer, addresses):
    """{address: [(file, line)]}, the line of the instruction and those of all calls that it was inlined through."""
    found = collections.defaultdict(list)
    address = 0
    done = subprocess.run(["addr2line", "-a", "-i", "-e", raytracer], input="\n".join(map(hex, addresses)), text=True,
                          stdout=subprocess.PIPE, check=True)
    for row in done.stdout.splitlines():
        if row.startswith("0x"):
            address = int(row, 16)
            continue
        file, _, line = row.split(" ")[0].rpartition(":")
        found[address].append((os.path.normpath(file), int(line) if line.isdigit() else 0))
    return found


def check(name, costs, frames, used):
    """Prints a scene's table; returns whether all that it does not use is below the mark, and all that it uses is seen."""
    total = sum(costs.values())
    known = sum(cost for address, cost in costs.items() if any(file.startswith(CODE) for file, _ in frames[address]))
    if known < 0.5 * total:
        sys.exit("unused.py: the program has no line numbers; make bench-unused builds one that has")
    if unknown := set(used) - set(FEATURES):
        sys.exit(f"unused.py: no feature {', '.join(sorted(unknown))}; there are {', '.join(FEATURES)}")
    print(f"{name}: {total:,} instructions")
    isFine = True
    for feature, texts in FEATURES.items():
        regions = [Region(text) for text in texts]
        own = {frame for frame in set().union(*frames.values()) if any(region.has(*frame) for region in regions)}
        cost = sum(cost for address, cost in costs.items() if not own.isdisjoint(frames[address]))
        isWrong = cost == 0 if feature in used else cost > MOST * total
        isFine &= not isWrong
        mark = "FAIL" if isWrong else "used" if feature in used else ""
        print(f"  {feature:14} {cost:15,} {100 * cost / total:8.3f} %  {mark}".rstrip())
    return isFine


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n", maxsplit=1)[0])
    parser.add_argument("raytracer")
    parser.add_argument("scene", nargs="?")
    parser.add_argument("used", nargs="?", default="")
    arguments = parser.parse_args()
    isFine = True
    with tempfile.TemporaryDirectory() as folder:
        scenes = {arguments.scene: arguments.used} if arguments.scene else SCENES
        for scene, used in scenes.items():
            file = scene
            if scene in TEXTS:
                file = os.path.join(folder, f"{scene}.txt")
                with open(file, "w", encoding="ascii") as out:
                    out.write(TEXTS[scene])
            costs = instructions(arguments.raytracer, file, folder)
            frames = places(arguments.raytracer, costs)
            isFine &= check(scene, costs, frames, list(filter(None, used.split(","))))
    if not isFine:
        sys.exit("FAIL: a feature that is not used costs more than 1 %, or one that is used costs nothing")


if __name__ == "__main__":
    main()
