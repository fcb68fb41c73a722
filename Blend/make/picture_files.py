"""Writes textures as PPM, PNG and PFM."""

import os
import struct
import sys
import zlib
from array import array

BLEND_FOLDER = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
TEXTURE_FOLDER = os.path.join(BLEND_FOLDER, os.pardir, "Textures")


def byte_rows(rows):
    """Rows of pixels -> rows of bytes."""
    return [bytes(min(max(int(x * 255 + 0.5), 0), 255) for pixel in row for x in pixel) for row in rows]


def encode_ppm(width, height, rows):
    return b"P6\n%d %d\n255\n" % (width, height) + b"".join(byte_rows(rows))


def encode_png(width, height, rows):
    def chunk(kind, data):
        body = kind + data
        return struct.pack(">I", len(data)) + body + struct.pack(">I", zlib.crc32(body))

    color_type = {3: 2, 4: 6}[len(rows[0][0])]
    header = struct.pack(">IIBBBBB", width, height, 8, color_type, 0, 0, 0)
    lines = b"".join(b"\0" + row for row in byte_rows(rows))
    return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", zlib.compress(lines, 9))
            + chunk(b"IEND", b""))


def encode_pfm(width, height, rows):
    data = array("f", (x for row in reversed(rows) for pixel in row for x in pixel))
    if sys.byteorder != "little":
        data.byteswap()
    return b"PF\n%d %d\n-1.0\n" % (width, height) + data.tobytes()


ENCODERS = {".ppm": encode_ppm, ".png": encode_png, ".pfm": encode_pfm}


def write_texture(name, picture):
    width, height = picture.width, picture.height
    rows = [[picture.draw((x + 0.5) / width, 1 - (y + 0.5) / height) for x in range(width)]
            for y in range(height)]
    with open(os.path.join(TEXTURE_FOLDER, name), "wb") as file:
        file.write(ENCODERS[os.path.splitext(name)[1]](width, height, rows))
