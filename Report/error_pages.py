"""Run time against error, from tests/error: the ratios of the middle level of all scenes, then each scene with its plot, its ratios and
what its section of tests/error/SCENES.md says."""
import os
import re

from page import (BODY, Failure, H1, H2, Image, KeepTogether, LABEL, Paragraph, Picture, Spacer, TOP, WIDTH, figures, markup, mm, read)
from sources import tsv

PEERS = {"mitsuba_llvm": "Mitsuba, LLVM", "mitsuba_scalar": "Mitsuba, scalar", "cycles": "Cycles", "povray": "POV-Ray"}


def sections():
    """What SCENES.md says: its introduction, and the paragraphs of each scene by its name."""
    head, *parts = re.split(r"^## (\w+)\n", read("tests/error/SCENES.md"), flags=re.MULTILINE)
    joined = lambda text: [" ".join(p.split()) for p in text.strip().split("\n\n")]
    return joined(head.partition("\n")[2]), {name: joined(text) for name, text in zip(parts[::2], parts[1::2])}


def plot(scene):
    path = f"tests/error/plots/{scene}.png"
    try:
        with Picture.open(os.path.join(TOP, path)) as opened:
            return Image(os.path.join(TOP, path), WIDTH, WIDTH * opened.height / opened.width)
    except OSError:
        raise Failure(f"can't read {path}; `make bench-error` draws it") from None


def ratio(row, times):
    """Cell: how many times faster ours is, and the range of it."""
    value, span = row[times + "times_faster"], row[times + "range_5_95"]
    return value if span in ("-", "") else f"{value} ({span})"


def table(rows):
    levels = sorted({row["display_rmse"] for row in rows if row["display_rmse"] != "-"}, key=float, reverse=True)
    cells = []
    for peer, name in PEERS.items():
        of = {row["display_rmse"]: row for row in rows if row["peer"] == peer}
        if not of: continue
        if "-" in of:
            cells.append([f"{name}: {markup(of['-']['note'])}"] + [""] * 6)
            continue
        cells.append([name] + [ratio(of[level], times) for times in ("render_", "") for level in levels])
    heading = ["ours is faster, times", *(f"rendering<br/>to {level}" for level in levels), *(f"process<br/>to {level}" for level in levels)]
    return figures(heading, cells, [WIDTH - 6 * 23 * mm] + [23 * mm] * 6)


def errorPages():
    introduction, said = sections()
    rows = tsv("tests/error/error.tsv")
    scenes = list(dict.fromkeys(row["scene"] for row in rows))
    if set(scenes) != set(said):
        raise Failure(f"tests/error/SCENES.md and error.tsv have different scenes: {', '.join(sorted(set(scenes) ^ set(said)))}")
    story = [Paragraph("Run time against error", H1), *(Paragraph(markup(text), BODY) for text in introduction), Spacer(1, 4 * mm)]
    for scene in said:
        of = [row for row in rows if row["scene"] == scene]
        story.append(KeepTogether([Paragraph(scene.replace("_", " "), H2), *(Paragraph(markup(text), BODY) for text in said[scene]),
                                   Spacer(1, 2 * mm), table(of), Spacer(1, 2 * mm), plot(scene),
                                   Paragraph(f"tests/error/plots/{scene}.png", LABEL), Spacer(1, 6 * mm)]))
    return story
