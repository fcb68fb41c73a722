#!/usr/bin/env python3
"""Tests of Blend/Export.py in every Blender that is named. Standard library only.

    tests/blender/test_export.py --blender blender --blender /path/to/python-with-bpy [--only PART] [--verbose]

Each Blender runs run_inside.py: there, scenes are built in memory, exported, and the numbers in the text are
compared with what Blender and the formulas say (test_*.py, a file per subject). Then whole runs of the script
are started from outside (test_whole_runs.py). When ./raytracer exists, it checks each text.
Without --blender the `blender` of the PATH is used. The last line is `N passed, N failed`.
"""

import argparse
import json
import os
import shutil
import sys
import tempfile
import traceback

from places import HERE
from test_whole_runs import WHOLE, Launch, expect, small_scene


def run_program(program, only):
    launch = Launch(program)
    arguments = ["--only", only] if only else []
    done = launch.run(os.path.join(HERE, "run_inside.py"), arguments, timeout=1800)
    line = next((l for l in done.stdout.splitlines() if l.startswith("RESULTS ")), None)
    if line is None:
        return program, [("start", "no results\n" + done.stdout[-1500:] + done.stderr[-1500:])]
    answer = json.loads(line[8:])
    results = [tuple(r) for r in answer["results"]]
    folder = tempfile.mkdtemp(prefix="export-whole-")
    chosen = [(n, f) for n, f in WHOLE if not only or only in n]
    try:
        if chosen:
            code = os.path.join(folder, "make.py")
            with open(code, "w") as file:
                file.write(small_scene(folder) + "import os, sys; sys.stdout.flush(); os._exit(0)\n")
            expect(launch.run(code), 0)
        for name, function in chosen:
            problem = None
            try:
                function(launch, folder)
            except AssertionError as error:
                problem = str(error) or traceback.format_exc()
            except Exception:
                problem = traceback.format_exc()
            results.append((name, problem))
    finally:
        shutil.rmtree(folder, ignore_errors=True)
    return "Blender " + answer["version"], results


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--blender", action="append", metavar="PROGRAM", help="Blender, or a Python that has bpy")
    parser.add_argument("--only", metavar="PART", help="tests whose name contains this")
    parser.add_argument("--all-scenes", action="store_true", help="Blend/*.blend in every version")
    parser.add_argument("--verbose", action="store_true", help="name every test")
    options = parser.parse_args()
    programs = options.blender or [p for p in [shutil.which("blender")] if p]
    if not programs:
        print("no Blender found; name one with --blender")
    passed = failed = 0
    for program in programs:
        version, results = run_program(program, options.only)
        print("%s: %d tests" % (version, len(results)))
        for name, problem in results:
            passed, failed = passed + (problem is None), failed + (problem is not None)
            if problem or options.verbose:
                print("  %s  %s%s" % ("FAIL" if problem else "ok  ", name, "\n" + problem if problem else ""))
    print("%d passed, %d failed" % (passed, failed))
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
