"""How the pages of the report look: styles, text, tables, pictures. Knows nothing about its content."""
import io
import os
import re
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


def rule():
    return Table([[""]], colWidths=[WIDTH], rowHeights=[1],
                 style=[("LINEABOVE", (0, 0), (-1, 0), 0.6, RULE)])


FLUSH = [(f"{side}PADDING", (0, 0), (-1, -1), 0) for side in ("LEFT", "RIGHT", "TOP", "BOTTOM")]


def figures(heading, rows, widths, texts=1):
    """A table of numbers: the first `texts` columns to the left, the others to the right. The last column
    takes what the others leave of the page when there is no width for it."""
    widths = list(widths) + ([WIDTH - sum(widths)] if len(widths) < len(heading) else [])
    table = [[Paragraph(cell, HEAD if i < texts else HEAD_RIGHT) for i, cell in enumerate(heading)]]
    table += [[Paragraph(cell, CELL_TEXT) if i < texts else cell for i, cell in enumerate(row)] for row in rows]
    style = TableStyle([("FONT", (0, 1), (-1, -1), "Helvetica", 8.5), ("TEXTCOLOR", (0, 0), (-1, -1), INK),
                        ("ALIGN", (texts, 0), (-1, -1), "RIGHT"), ("VALIGN", (0, 0), (-1, 0), "BOTTOM"),
                        ("VALIGN", (0, 1), (-1, -1), "MIDDLE"),
                        ("LINEBELOW", (0, 0), (-1, 0), 0.9, INK), ("LINEBELOW", (0, 1), (-1, -2), 0.4, RULE),
                        ("LINEBELOW", (0, -1), (-1, -1), 0.9, INK),
                        ("LEFTPADDING", (0, 0), (-1, -1), 1.2 * mm), ("RIGHTPADDING", (0, 0), (-1, -1), 1.2 * mm),
                        ("TOPPADDING", (0, 0), (-1, -1), 1.1 * mm), ("BOTTOMPADDING", (0, 0), (-1, -1), 1.5 * mm)])
    return Table(table, colWidths=widths, style=style, repeatRows=1)
