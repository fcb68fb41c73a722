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
import subprocess
import sys
from xml.sax.saxutils import escape

try:
    from PIL import Image as Picture
    from reportlab import rl_config
    from reportlab.lib.colors import HexColor
    from reportlab.lib.pagesizes import A4
    from reportlab.lib.styles import ParagraphStyle
    from reportlab.lib.units import mm
    from reportlab.platypus import (Image, KeepTogether, PageBreak, Paragraph, Preformatted,
                                    SimpleDocTemplate, Spacer, Table, TableStyle)
except ImportError as error:
    sys.exit(f"make_report.py: {error}\nInstall what it needs: pip install reportlab pillow")

rl_config.invariant = 1  # no dates, no random ids
rl_config.useA85 = 0     # streams as bytes, not as text: a fifth smaller

TOP = os.path.abspath(os.path.join(os.path.dirname(os.path.abspath(__file__)), ".."))
MARGIN = 20 * mm
WIDTH = A4[0] - 2 * MARGIN
COLUMNS = 3
GAP = 5 * mm
CELL = (WIDTH - (COLUMNS - 1) * GAP) / COLUMNS
WIDE = 4  # a picture with more features than this gets a row of its own
FRONT = "showcase"  # the picture of page 1

INK, GREY, RULE, PALE = (HexColor(c) for c in ("#1d2328", "#68727a", "#c9d0d5", "#f1f4f5"))
ACCENT = HexColor("#14706f")

BODY = ParagraphStyle("body", fontName="Helvetica", fontSize=9.5, leading=13.8, textColor=INK)
LEAD = ParagraphStyle("lead", BODY, fontSize=11, leading=16.5)
TITLE = ParagraphStyle("title", BODY, fontName="Helvetica-Bold", fontSize=30, leading=36)
H1 = ParagraphStyle("h1", BODY, fontName="Helvetica-Bold", fontSize=16, leading=20, spaceAfter=3 * mm)
H2 = ParagraphStyle("h2", BODY, fontName="Helvetica-Bold", fontSize=10.5, leading=14,
                    textColor=ACCENT, spaceBefore=2.8 * mm, spaceAfter=0.8 * mm)
BULLET = ParagraphStyle("bullet", BODY, leftIndent=4 * mm, bulletIndent=0.5 * mm, spaceAfter=1 * mm)
CAPTION = ParagraphStyle("caption", BODY, fontSize=8.2, leading=10.4, leftIndent=2.6 * mm,
                         bulletIndent=0, bulletFontSize=8.2, spaceAfter=0.7 * mm)
NOTE = ParagraphStyle("note", CAPTION, leftIndent=0)
LABEL = ParagraphStyle("label", BODY, fontName="Courier", fontSize=7.2, leading=9.5, textColor=GREY)
CODE = ParagraphStyle("code", BODY, fontName="Courier", fontSize=9, leading=14)
HEAD = ParagraphStyle("head", BODY, fontName="Helvetica-Bold", fontSize=8.2, leading=10.5)
HEAD_RIGHT = ParagraphStyle("headRight", HEAD, alignment=2)
CELL_TEXT = ParagraphStyle("cellText", BODY, fontSize=8.5, leading=11)


class Failure(Exception):
    pass


def read(path):
    try:
        with open(os.path.join(TOP, path), encoding="utf-8") as file:
            return file.read()
    except OSError as error:
        raise Failure(f"can't read {path}: {error.strerror}") from None


def markup(text):
    """Plain or README text as the markup of a paragraph: `code` in Courier, links as their text."""
    text = escape(re.sub(r"\[([^]]*)\]\([^)]*\)", r"\1", text))
    return re.sub(r"`([^`]*)`", r'<font face="Courier">\1</font>', text)


def picture(path, width, height, pixels):
    """The picture as a JPEG of at most `pixels` across, fitted into width x height."""
    try:
        with Picture.open(os.path.join(TOP, path)) as opened:
            image = opened.convert("RGB")
    except OSError:
        raise Failure(f"can't read the picture {path}; `make demo gallery` renders it") from None
    if image.width > pixels:
        image = image.resize((pixels, round(image.height * pixels / image.width)), Picture.LANCZOS)
    data = io.BytesIO()
    image.save(data, "JPEG", quality=88, subsampling=0, optimize=True)
    data.seek(0)
    factor = min(width / image.width, height / image.height)
    return Image(data, image.width * factor, image.height * factor)


# ---- what the repository says ----

def readme():
    """First paragraph and first block of code of README.md."""
    text = read("README.md")
    match = re.match(r"# (\S.*)\n\n((?:.+\n)+)\n```\n((?:.+\n)+?)```\n", text)
    if not match:
        raise Failure("README.md does not begin with a title, a paragraph and the commands")
    return match.group(1), " ".join(match.group(2).split()), match.group(3).rstrip("\n")


def features():
    """[(picture without extension, its path, [feature, ...])] in order, and the partial list."""
    listed, _, partial = read("FeatureList.txt").partition("\n#Partial\n")
    groups = {}
    for line in listed.splitlines():
        if not line.strip() or line.startswith("#"):
            continue
        fields = [field.strip() for field in line.split("|")]
        if len(fields) != 4:
            raise Failure(f"FeatureList.txt: not four fields: {line}")
        stem = os.path.splitext(os.path.basename(fields[2]))[0]
        groups.setdefault(stem, []).append(fields[0])
    notes = [line.lstrip("# ").strip() for line in partial.splitlines() if line.startswith("#")]
    return [(stem, f"Output/{stem}.ppm", names) for stem, names in groups.items()], notes[1:]


def bench(saved, raytracer):
    """Rows of tests/bench/bench.sh: [[name, number, ...]]."""
    if saved:
        try:
            with open(saved, encoding="utf-8") as file:
                text = file.read()
        except OSError as error:
            raise Failure(f"can't read {saved}: {error.strerror}") from None
    else:
        print("running tests/bench/bench.sh, about a minute", file=sys.stderr)
        run = subprocess.run(["sh", "tests/bench/bench.sh", raytracer, "1"], cwd=TOP, text=True,
                             stdout=subprocess.PIPE, check=False)
        if run.returncode != 0:
            raise Failure(f"tests/bench/bench.sh failed with exit code {run.returncode}")
        text = run.stdout
    columns = ["what", "parse_s", "build_s", "render_s", "write_s", "rays_per_s", "peak_bytes"]
    lines = [line.split("\t") for line in text.splitlines() if "\t" in line]
    if len(lines) < 2 or lines[0] != columns:
        raise Failure("the output of tests/bench/bench.sh has other columns than expected")
    rows = []
    for line in lines[1:]:
        try:
            numbers = [float(field) for field in line[1:]]
        except ValueError:
            numbers = []
        if len(numbers) != len(columns) - 1:
            raise Failure(f"tests/bench/bench.sh gave no figures for {line[0]}; does the program run?")
        rows.append([line[0], *numbers])
    return rows


# ---- pages ----

def rule():
    return Table([[""]], colWidths=[WIDTH], rowHeights=[1],
                 style=[("LINEABOVE", (0, 0), (-1, 0), 0.6, RULE)])


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


FLUSH = [(f"{side}PADDING", (0, 0), (-1, -1), 0) for side in ("LEFT", "RIGHT", "TOP", "BOTTOM")]


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
    return story + [PageBreak()]


def milliseconds(seconds):
    value = seconds * 1000
    return f"{value:.2f}" if value < 10 else f"{value:.1f}" if value < 100 else f"{value:,.0f}"


def times(rows):
    script = read("tests/bench/bench.sh")
    what = {}
    for name, scene, options in re.findall(r"^row (\S+) (\S+) ?(.*)$", script, re.MULTILINE):
        what[name] = ("the ball" if scene.startswith('"') else scene, options)
    table = [[Paragraph("what", HEAD), Paragraph("scene and options", HEAD)] +
             [Paragraph(text, HEAD_RIGHT) for text in
              ("read<br/>ms", "build<br/>ms", "render<br/>ms", "write<br/>ms", "million rays<br/>a second",
               "peak memory<br/>MB")]]
    for name, parse, build, render, write, rays, peak in rows:
        scene, options = what.get(name, ("", ""))
        table.append([name, Paragraph(f'{markup(scene)} <font face="Courier" size="7.5">{escape(options)}</font>',
                                      CELL_TEXT),
                      *map(milliseconds, (parse, build, render, write)), f"{rays / 1e6:.2f}",
                      f"{peak / 1e6:.1f}"])
    style = TableStyle([("FONT", (0, 1), (-1, -1), "Helvetica", 8.5), ("TEXTCOLOR", (0, 0), (-1, -1), INK),
                        ("ALIGN", (2, 0), (-1, -1), "RIGHT"), ("VALIGN", (0, 0), (-1, 0), "BOTTOM"),
                        ("VALIGN", (0, 1), (-1, -1), "MIDDLE"),
                        ("LINEBELOW", (0, 0), (-1, 0), 0.9, INK), ("LINEBELOW", (0, 1), (-1, -2), 0.4, RULE),
                        ("LINEBELOW", (0, -1), (-1, -1), 0.9, INK),
                        ("LEFTPADDING", (0, 0), (-1, -1), 1.2 * mm), ("RIGHTPADDING", (0, 0), (-1, -1), 1.2 * mm),
                        ("TOPPADDING", (0, 0), (-1, -1), 1.1 * mm), ("BOTTOMPADDING", (0, 0), (-1, -1), 1.5 * mm)])
    widths = [22 * mm, 59 * mm, 12 * mm, 13 * mm, 14 * mm, 13 * mm, 20 * mm]
    widths.append(WIDTH - sum(widths))
    triangles = re.search(r"a wavy ball of ([\d,]+) triangles", script)
    ball = f" The ball is a wavy mesh of {triangles.group(1)} triangles that the script makes." if triangles else ""
    return [Paragraph("Times", H1),
            Paragraph("Medians of five runs on one thread of the machine that made them, by "
                      f"{markup('`tests/bench/bench.sh`')}.{ball} Absolute times say little on a shared machine; compare two "
                      "builds in one interleaved run.", BODY), Spacer(1, 3 * mm),
            Table(table, colWidths=widths, style=style, repeatRows=1), Spacer(1, 8 * mm)]


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
    ("The scene, normalised once", "render/scene.h",
     "Everything is placed in double, moved by the centre of the scene and scaled by a power of two so that its "
     "extent lies in [1, 2), and only then becomes float. A scene far from the origin, or of any size, renders "
     "alike. After that the scene does not change."),
]


def exactness():
    story = [Paragraph("How exactness is reached", H1)]
    for title, file, text in EXACT:
        read("Code/" + file)
        story += [Paragraph(f'{title} <font face="Courier" size="8" color="#68727a">&nbsp;Code/{file}</font>', H2),
                  Paragraph(text, BODY)]
    return story + [Spacer(1, 8 * mm)]


def missing(notes):
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
        story += exactness() + missing(notes)
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
