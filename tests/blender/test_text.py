"""Names, numbers and the table of warnings."""

import os
import re
import types

import bpy

from kit import Export, FOLDER, export, new_scene, primitive, test
from places import SCRIPT, TOP
from scene_text import equal


@test
def names_and_numbers():
    new_scene()
    thing = primitive("cube")
    thing.name = 'A "quoted" \\ name, ü'
    primitive("cube", location=(1 / 3, 1e-7, 0)).name = "plain_name-1.0+"
    text = export()
    equal([b.name for b in text.all("cube")], ['A "quoted" \\ name, ü', "plain_name-1.0+"])
    assert 'cube "A \\"quoted\\" \\\\ name, ü" {' in text.text and "cube plain_name-1.0+ {" in text.text
    for x, wanted in ((0.0, "0"), (-0.0, "0"), (Export.single(0.1), "0.1"), (1.0, "1"), (0.1, "0.1"), (1e20, "1e+20"),
                      (1920.0, "1920"), (2 / 3, repr(2 / 3)), (Export.single(2 / 3), "0.6666667")):
        equal(Export.number(x), wanted)
    assert not any(part in text.text for part in (FOLDER, os.path.expanduser("~") + "/", TOP + "/"))


@test
def warnings_have_one_table():
    with open(SCRIPT, encoding="utf-8") as file:
        source = file.read()
    import re
    used = {int(n) for n in re.findall(r"\.warn\(\s*(\d+),", source)}
    equal(used, set(Export.WARNINGS))


@test
def files_that_open_with_errors_are_exported():
    """Blender raises what it reports as an error, a missing library too, though the file is open."""
    path = os.path.join(FOLDER, "opens.blend")
    new_scene()
    bpy.ops.wm.save_as_mainfile(filepath=path)
    bpy.ops.wm.read_factory_settings(use_empty=True)

    def opening(opens):
        def open_mainfile(filepath):
            if opens:
                bpy.ops.wm.open_mainfile(filepath=filepath)
            raise RuntimeError("Error: 1 library is missing")
        return types.SimpleNamespace(data=bpy.data, app=bpy.app, ops=types.SimpleNamespace(
            wm=types.SimpleNamespace(open_mainfile=open_mainfile)))

    report, options = Export.Report(False), types.SimpleNamespace(blend=path)
    try:
        for opens, wanted in ((False, "cannot be opened: Error: 1 library is missing"), (True, None)):
            Export.bpy, problem = opening(opens), None
            try:
                Export.open_file(options, True, report)
            except Export.ExportError as error:
                problem = str(error)
            assert (wanted is None and problem is None) or wanted in problem, problem
    finally:
        Export.bpy = bpy
    equal(list(report.seen.values()), [37])


@test
def floats_are_as_short_as_they_can_be():
    import array
    import random
    source = random.Random(7)
    values = array.array("f", [0.1, 1 / 3, 16777216.0, 1e-30, -2.5, 0.0] + [source.uniform(-9, 9) for _ in range(4000)])
    texts = Export.shortest_floats(values)
    for x, text in zip(values, texts):
        assert Export.single(float(text)) == x and (len(text) <= len("%.6g" % x) or Export.single(float("%.6g" % x)) != x), (x, text)
    equal(texts[:5], ["0.1", "0.33333334", "16777216", "1e-30", "-2.5"])
