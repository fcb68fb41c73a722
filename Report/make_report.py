#!/usr/bin/env python3
"""Writes Report/report.pdf: what the program is, its features with pictures, its times.

    python3 Report/make_report.py [--raytracer FILE] [--bench FILE] [-o FILE]

--bench FILE takes the saved output of tests/bench/bench.sh instead of running it. The same input
gives the same bytes (with the same versions of reportlab and pillow).
"""
import argparse
import io
import os
import re
import sys
from xml.sax.saxutils import escape

from page import (A4, ACCENT, BODY, BULLET, CAPTION, CELL, CODE, COLUMNS, FLUSH, FRONT, Failure, GAP, GREY, H1, H2,
                  Image, KeepTogether, LABEL, LEAD, MARGIN, NOTE, PALE, PageBreak, Paragraph, Picture, Preformatted,
                  SimpleDocTemplate, Spacer, TITLE, TOP, Table, WIDE, WIDTH, figures, markup, mm, picture, read,
                  rule)
from error_pages import errorPages
from sources import bench, features, newest, readme, tsv


def front():
    title, about, commands = readme()
    code = Table([[Preformatted(commands, CODE)]], colWidths=[WIDTH],
                 style=[("BACKGROUND", (0, 0), (-1, -1), PALE),
                        ("LINEBEFORE", (0, 0), (0, -1), 2, ACCENT),
                        ("LEFTPADDING", (0, 0), (-1, -1), 4 * mm),
                        ("TOPPADDING", (0, 0), (-1, -1), 3 * mm),
                        ("BOTTOMPADDING", (0, 0), (-1, -1), 3.6 * mm)])
    return [Spacer(1, 14 * mm), Paragraph(markup(title), TITLE), Spacer(1, 5 * mm),
            picture(f"Output/{FRONT}.png", WIDTH, WIDTH, 960), Spacer(1, 2 * mm),
            Paragraph(f"ASCII/{FRONT}.txt, as make demo renders it", LABEL), Spacer(1, 8 * mm),
            Paragraph(markup(about), LEAD), Spacer(1, 7 * mm), code, PageBreak()]


def captions(names):
    return [Paragraph(markup(name), CAPTION, bulletText="\u2022") for name in names]


def card(stem, path, names):
    """A picture over the names of its features. The box is 16:9 whatever the picture's shape."""
    height = CELL * 9 / 16
    box = Table([[picture(path, CELL, height, 320)]], colWidths=[CELL], rowHeights=[height],
                style=[("ALIGN", (0, 0), (-1, -1), "CENTER"), ("VALIGN", (0, 0), (-1, -1), "MIDDLE"),
                       ("BACKGROUND", (0, 0), (-1, -1), PALE), *FLUSH])
    return [box, Spacer(1, 1 * mm), Paragraph(stem, LABEL), Spacer(1, 0.4 * mm), *captions(names)]


def wideRow(stem, names, left):
    """What shows many features: `left`, and their names in two columns."""
    half = (len(names) + 1) // 2
    return Table([[left, "", captions(names[:half]), "", captions(names[half:])]],
                 colWidths=[CELL, GAP, CELL, GAP, CELL],
                 style=[("VALIGN", (0, 0), (-1, -1), "TOP"), *FLUSH])


def gallery(groups):
    story = [Paragraph("Features", H1),
             Paragraph(f"{sum(len(names) for _, _, names in groups)} features, each under a picture that shows or "
                       "uses it. The grey name is that of the picture in "
                       f"{markup('`Output/`')}; {markup('`FeatureList.txt`')} names the scene and the test "
                       "behind each feature.", BODY), Spacer(1, 5 * mm)]
    narrow = [group for group in groups if len(group[2]) <= WIDE and group[0] != FRONT]
    for start in range(0, len(narrow), COLUMNS):
        cells = [card(*group) for group in narrow[start:start + COLUMNS]]
        cells += [""] * (COLUMNS - len(cells))
        row = [cells[0]] + [cell for other in cells[1:] for cell in ("", other)]
        widths = [CELL] + [GAP, CELL] * (COLUMNS - 1)
        story += [Table([row], colWidths=widths, style=[("VALIGN", (0, 0), (-1, -1), "TOP"), *FLUSH]),
                  Spacer(1, 4.2 * mm)]
    for stem, path, names in groups:
        if stem == FRONT:
            left = [Paragraph(stem, LABEL), Spacer(1, 0.4 * mm),
                    Paragraph("The picture of page 1; also what has no look of its own.", NOTE)]
        elif len(names) > WIDE:
            left = card(stem, path, [])
        else:
            continue
        story.append(KeepTogether([rule(), Spacer(1, 3 * mm), wideRow(stem, names, left),
                                   Spacer(1, 4 * mm)]))
    return story + [Spacer(1, 8 * mm)]


def milliseconds(seconds):
    value = seconds * 1000
    return f"{value:.2f}" if value < 10 else f"{value:.1f}" if value < 100 else f"{value:,.0f}"


def times(rows):
    script = read("tests/bench/bench.sh")
    what = {}
    for name, scene, options in re.findall(r"^row (\S+) (\S+) ?(.*)$", script, re.MULTILINE):
        what[name] = ("the ball" if scene.startswith('"') else scene, options)
    table = []
    for name, parse, build, render, write, rays, peak in rows:
        scene, options = what.get(name, ("", ""))
        table.append([name, f'{markup(scene)} <font face="Courier" size="7.5">{escape(options)}</font>',
                      *map(milliseconds, (parse, build, render, write)), f"{rays / 1e6:.2f}", f"{peak / 1e6:.1f}"])
    heading = ["what", "scene and options", "read<br/>ms", "build<br/>ms", "render<br/>ms", "write<br/>ms",
               "million rays<br/>a second", "peak memory<br/>MB"]
    widths = [22 * mm, 59 * mm, 12 * mm, 13 * mm, 14 * mm, 13 * mm, 20 * mm]
    triangles = re.search(r"a wavy ball of ([\d,]+) triangles", script)
    ball = f" The ball is a wavy mesh of {triangles.group(1)} triangles that the script makes." if triangles else ""
    return [Paragraph("Times", H1),
            Paragraph("Medians of five runs on one thread of the machine that made them, by "
                      f"{markup('`tests/bench/bench.sh`')}.{ball} Absolute times say little on a shared machine; compare two "
                      "builds in one interleaved run.", BODY), Spacer(1, 3 * mm),
            figures(heading, table, widths, 2), Spacer(1, 8 * mm)]


def rays():
    """Rates per kernel, and beside Embree's."""
    rates = newest(tsv("tests/bench/results.tsv"))
    names = ["primary_mrays_s", "primary_uv_mrays_s", "shadow_mrays_s", "bounce_mrays_s", "bounceany_mrays_s", "build_ms",
             "bytes_per_triangle"]
    story = [Paragraph("Rays", H1),
             Paragraph("Million rays a second through a mesh of 69,432 triangles (ball) and one of 1,110,912 (balls), "
                       f"{'one thread' if rates[0]['threads'] == '1' else rates[0]['threads'] + ' threads'} of an "
                       f"{escape(rates[0]['cpu'])}: camera rays, the same with u and v, shadow rays from a point light, and "
                       "diffuse bounces, nearest and any hit. All kernels find the same hits to the last bit. "
                       f"{markup('`make bench`')} adds rows to {markup('`tests/bench/results.tsv`')}.", BODY),
             Spacer(1, 3 * mm),
             figures(["mesh, kernel", "primary", "with u, v", "shadow", "bounce", "any bounce", "build<br/>ms",
                      "bytes per<br/>triangle"],
                     [[f"{os.path.splitext(row['mesh'])[0]}, {row['kernel']}"] + [f"{float(row[n]):.1f}" for n in names]
                      for row in rates],
                     [37 * mm] + [19 * mm] * 6), Spacer(1, 5 * mm)]
    peers = newest(tsv("tests/bench/peers.tsv"))
    survey = [row for row in peers if row["mesh"].endswith((", outside", ", inside"))]
    peers = [row for row in peers if row not in survey]
    story += [Paragraph(f"The same rays through {escape(peers[0]['peer'])} in alternating rounds, best of its modes (single "
                        "rays, packets of 8 and 16, streams): how many times as fast raytracer is, and the least and most "
                        f"of the rounds ({markup('`make bench-peers`')}).", BODY), Spacer(1, 3 * mm),
              figures(["mesh, kernel", "rays", "raytracer", "Embree", "its mode", "ratio", "in the rounds"],
                      [[f"{os.path.splitext(row['mesh'])[0]}, {row['kernel']}", row["what"], row["ours"], row["theirs"],
                        row["mode"], row["ratio"], f"{row['least']} to {row['most']}"] for row in peers],
                      [32 * mm, 36 * mm, 20 * mm, 18 * mm, 22 * mm, 16 * mm], 2), Spacer(1, 5 * mm)]
    ratios = {}
    for row in survey:
        ratios.setdefault(row["mesh"].replace(".obj", ""), {})[row["what"].split(",")[0]] = row["ratio"]
    kinds = ["primary", "shadow", "bounce", "bounceany"]
    if ratios:
        story += [Paragraph("The ratios alone, of one round each, on meshes of other kinds and from two views "
                            "(tests/bench/meshes.py makes them). One round is a rough figure: where all rays take 2 ms, some "
                            "are off by a third.", BODY), Spacer(1, 3 * mm),
                  figures(["mesh, view", *kinds], [[mesh, *(found[kind] for kind in kinds)] for mesh, found in ratios.items()],
                          [44 * mm] + [24 * mm] * 4), Spacer(1, 8 * mm)]
    return story


def growth():
    path = "tests/bench/growth.png"
    try:
        with Picture.open(os.path.join(TOP, path)) as opened:
            height = WIDTH * opened.height / opened.width
    except OSError:
        raise Failure(f"can't read {path}; `make bench-growth` draws it") from None
    render = [float(row["render_s"]) for row in tsv("tests/bench/growth.tsv") if row["what"] == "triangles"]
    return [KeepTogether([Paragraph("Growth", H1),
                          Paragraph("Time of one thread against what a scene has: triangles of one mesh, pixels, point "
                                    "lights, bounces between mirrors. From the smallest mesh to the largest rendering "
                                    f"takes {render[-1] / render[0]:.1f} times as long; reading and building grow in "
                                    f"proportion ({markup('`make bench-growth`')}, {markup('`tests/bench/growth.tsv`')}).",
                                    BODY), Spacer(1, 2 * mm),
                          Image(os.path.join(TOP, path), WIDTH, height), Spacer(1, 6 * mm)])]


def battery():
    """What tests/STRESS.md says, by subject, and all of it that has figures of other programs."""
    rows = [[cell.strip() for cell in line.strip("|\n").split("|")] for line in read("tests/STRESS.md").splitlines()
            if re.match(r"\| T\d", line) and line.count("|") == 8]
    if not rows:
        raise Failure("tests/STRESS.md has no table of tests")
    cases = sum(int(row[2].replace(",", "")) for row in rows)
    kept = sum(row[5] == "ok" for row in rows)
    short = [[f"{row[0]} {row[1]}", row[2], row[3], row[4]] for row in rows
             if row[6] or row[0] in ("T4a", "T5a", "T10", "T11a", "T12a", "T13a", "T18", "T19a", "T20c", "T21a")]
    others = [f"{row[0]}: {row[6]}" for row in rows if row[6]]
    missed = [f"{row[0]} {row[1]}: {row[3]}" for row in rows if row[5] != "ok"]
    story = [Paragraph("Does it hold?", H1),
             Paragraph(f"{markup('`raytracer verify`')} tests the numbers behind the pictures on any machine; "
                       f"{markup('`make stress`')} runs all of it and writes {markup('`tests/STRESS.md`')}: {len(rows)} tests "
                       f"with {cases / 1e6:.0f} million cases, of which {kept} keep their marks. The truth comes from outside of "
                       "the program: closed forms, wider arithmetic, brute force. Some of the rows:", BODY),
             Spacer(1, 3 * mm),
             figures(["test", "cases", "found", "mark"], [[markup(cell) if i == 0 else cell for i, cell in enumerate(row)]
                                                          for row in short],
                     [82 * mm, 24 * mm, 44 * mm]), Spacer(1, 4 * mm),
             Paragraph("Other programs with cases of the same kind: " + escape("; ".join(others)) + ".", BODY)]
    if missed:
        story += [Spacer(1, 2 * mm), Paragraph("Marks that are not kept yet:", BODY), Spacer(1, 1 * mm),
                  *(Paragraph(markup(text), BULLET, bulletText="\u2022") for text in missed)]
    return story + [Spacer(1, 8 * mm)]


# From the comments of the named files.
EXACT = [
    ("The same bits everywhere", "base/math.h",
     "Sine, power, logarithm and the other elementary functions are built from + \u2212 \u00d7 / sqrt and integer "
     "steps only. Those of the C library are banned from everything that reaches a picture, because the library "
     "picks other code by CPU and version. Their errors are measured against the true value: 0.55 units in the "
     "last place for exp and log, 0.85 for sine (below 2<super size='6'>47</super>), 1.5 for the arc functions, "
     "2 for tangent. Fused multiply-add is banned too; where a \u00d7 b \u2212 c \u00d7 d would cancel, the "
     "products are split exactly (Dekker 1971)."),
    ("One canonical, watertight hit", "accel/triangle.h",
     "The hit of a ray and a triangle has one definition, to the last bit, so that no tree and no order of "
     "traversal can change a picture. Rounding is monotone: the sign of an edge function in float is never wrong, "
     "it can only be zero, and zeros are decided in double, where the products of two floats are exact (after "
     "Woop, Benthin and Wald 2013). Both triangles of an edge see the same bits, so closed meshes do not leak. "
     "Of all triangles around an edge or corner that the ray meets, exactly one of those that face the same way "
     "says yes (Edelsbrunner and M\u00fccke 1990). Depth is that of the triangle\u2019s plane, clamped to the "
     "triangle\u2019s own range and to the entry of its own padded box: culling by boxes never removes the "
     "nearest hit."),
    ("Many rays at once, the same bits", "accel/kernels/kernels.h",
     "Rays travel in batches through trees of 8 or 16 children per node, with SSE4.2, AVX2 or AVX-512, whichever the "
     "processor has. Rays from one point, as those of the camera and of a point light, go as bundles that use the "
     "tree to decide which pixels a triangle can cover; the rest goes through queues of nodes and leaves. Both only "
     "choose candidates; the canonical hit decides, so every kernel gives the picture of the scalar code."),
    ("Three front ends, one description", "desc/scene_desc.h",
     "The native text, COMP 557 JSON in all its dialects, NFF, and meshes by themselves (OBJ with MTL, PLY) become one "
     "SceneDesc of plain data; the quirks of each format end in its reader. --convert writes any of them as native "
     "text that renders to the same bits. Readers are fuzzed under sanitizers, and say file, line, column, what is "
     "wrong and what would be right."),
    ("The scene, normalised once", "scene/scene.h",
     "Everything is placed in double, moved by the centre of the scene and scaled by a power of two so that its "
     "extent lies in [1, 2), and only then becomes float. A scene far from the origin, or of any size, renders "
     "alike. After that the scene does not change."),
]


def exactness():
    story = [Paragraph("How exactness is reached", H1)]
    for title, file, text in EXACT:
        read("Code/" + file)
        heading = f'{title} <font face="Courier" size="8" color="#68727a">&nbsp;Code/{file}</font>'
        story.append(KeepTogether([Paragraph(heading, H2), Paragraph(text, BODY)]))
    return story + [Spacer(1, 8 * mm)]


def missing(notes):
    if not notes:
        return []
    return [KeepTogether([Paragraph("Partial", H1),
                          Paragraph("Not among the features because something is missing:", BODY),
                          Spacer(1, 1.5 * mm),
                          *(Paragraph(markup(note), BULLET, bulletText="\u2022") for note in notes)])]


def footer(canvas, document):
    if document.page > 1:
        canvas.setFont("Helvetica", 8)
        canvas.setFillColor(GREY)
        canvas.drawString(MARGIN, 11 * mm, "raytracer")
        canvas.drawRightString(A4[0] - MARGIN, 11 * mm, str(document.page))


def main():
    parser = argparse.ArgumentParser(description="Writes the report as a PDF.")
    parser.add_argument("--raytracer", default=os.path.join(TOP, "raytracer"), help="the program to time")
    parser.add_argument("--bench", metavar="FILE", help="saved output of tests/bench/bench.sh; default: run it")
    parser.add_argument("-o", "--output", default=os.path.join(TOP, "Report", "report.pdf"))
    arguments = parser.parse_args()
    try:
        groups, notes = features()
        story = front() + gallery(groups)
        story += times(bench(arguments.bench, os.path.abspath(arguments.raytracer)))
        story += rays() + errorPages() + growth() + battery() + exactness() + missing(notes)
        data = io.BytesIO()
        SimpleDocTemplate(data, pagesize=A4, leftMargin=MARGIN - 6, rightMargin=MARGIN - 6, topMargin=16 * mm,
                          bottomMargin=17 * mm, title="raytracer", author="", subject="Report", invariant=1,
                          ).build(story, onFirstPage=footer, onLaterPages=footer)
        with open(arguments.output, "wb") as file:
            file.write(data.getvalue())
    except Failure as failure:
        sys.exit(f"make_report.py: {failure}")
    except OSError as error:
        sys.exit(f"make_report.py: can't write {arguments.output}: {error.strerror}")
    print(f"{os.path.relpath(arguments.output)}: {len(data.getvalue()) / 1000:.0f} kB")


if __name__ == "__main__":
    main()
