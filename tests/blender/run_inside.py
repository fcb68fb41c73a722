"""Runs in Blender, for test_export.py: the tests that build scenes in memory; one line RESULTS."""

import json
import os
import shutil
import sys
import traceback

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, HERE)

import bpy

from kit import FOLDER, TESTS

for name in ("cameras", "lights", "shapes", "meshes", "motion", "materials", "textures", "world", "agreement", "text"):
    __import__("test_" + name)


def places_of(error):
    """Where a check failed and what called it, without this file."""
    frames = [f for f in traceback.extract_tb(error.__traceback__) if os.path.dirname(f.filename) == HERE]
    return ", ".join("%s:%d" % (os.path.basename(f.filename), f.lineno) for f in frames[1:])


def run(only):
    results = []
    for name, function in TESTS:
        if only and only not in name:
            continue
        problem = None
        try:
            function()
        except AssertionError as error:
            problem = "%s: %s" % (places_of(error), error)
        except BaseException:
            problem = traceback.format_exc()
        results.append((name, problem))
    shutil.rmtree(FOLDER, ignore_errors=True)
    print("RESULTS " + json.dumps({"version": bpy.app.version_string, "results": results}))
    sys.stdout.flush()
    os._exit(0)


run(sys.argv[sys.argv.index("--only") + 1] if "--only" in sys.argv else None)
