"""Writes textures: PPM, PNG, PFM, TGA and Radiance HDR; JPEG and OpenEXR by Blender."""

import math
import os
import struct
import sys
import tempfile
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


def run_length(values, most, plain, run):
    """Packets of at most `most` values each: plain(values), and run(value, how often) from 3 equal ones on."""
    out, start, i = [], 0, 0

    def flush(end):
        for at in range(start, end, most):
            out.append(plain(values[at:min(at + most, end)]))

    while i < len(values):
        end = i + 1
        while end < len(values) and end - i < most and values[end] == values[i]:
            end += 1
        if end - i > 2:
            flush(i)
            out.append(run(values[i], end - i))
            start = end
        i = end
    flush(len(values))
    return b"".join(out)


def encode_tga(width, height, rows):
    """32 bits with alpha, run-length encoded, from the top."""
    header = struct.pack("<BBBHHBHHHHBB", 0, 0, 10, 0, 0, 0, 0, 0, width, height, 32, 0x28)
    lines = []
    for row in byte_rows(rows):
        pixels = [row[i + 2:i + 3] + row[i + 1:i + 2] + row[i:i + 1] + row[i + 3:i + 4] for i in range(0, len(row), 4)]
        lines.append(run_length(pixels, 128, lambda some: bytes([len(some) - 1]) + b"".join(some),
                                lambda pixel, count: bytes([count + 127]) + pixel))
    return header + b"".join(lines)


def rgbe(pixel):
    brightest = max(pixel)
    if brightest < 1e-32:
        return bytes(4)
    fraction, exponent = math.frexp(brightest)
    return bytes([int(x * fraction * 256 / brightest) for x in pixel] + [exponent + 128])


def encode_hdr(width, height, rows):
    lines = []
    for row in rows:
        pixels = [rgbe(pixel) for pixel in row]
        lines.append(struct.pack(">BBH", 2, 2, width))
        for channel in range(4):
            lines.append(run_length(bytes(p[channel] for p in pixels), 127, lambda some: bytes([len(some)]) + some,
                                    lambda value, count: bytes([128 + count, value])))
    return b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y %d +X %d\n" % (height, width) + b"".join(lines)


def by_blender(file_format, is_float, **settings):
    """An encoder: what Blender writes."""
    def encode(width, height, rows):
        import bpy

        image = bpy.data.images.new("picture", width, height, float_buffer=is_float)
        image.colorspace_settings.name = "Non-Color" if is_float else "sRGB"
        image.pixels = [x for row in reversed(rows) for pixel in row for x in (*pixel, 1.0)]
        scene = bpy.context.scene
        scene.view_settings.view_transform = "Standard"
        scene.render.image_settings.file_format = file_format
        for name, value in settings.items():
            setattr(scene.render.image_settings, name, value)
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "picture")
            image.save_render(path, scene=scene)
            with open(path, "rb") as file:
                data = file.read()
        bpy.data.images.remove(image)
        return data
    return encode


ENCODERS = {
    ".ppm": encode_ppm, ".png": encode_png, ".pfm": encode_pfm, ".tga": encode_tga, ".hdr": encode_hdr,
    ".jpg": by_blender("JPEG", False, color_mode="RGB", quality=88),
    ".exr": by_blender("OPEN_EXR", True, color_mode="RGB", color_depth="16", exr_codec="ZIP"),
}


def write_texture(name, picture):
    width, height = picture.width, picture.height
    rows = [[picture.draw((x + 0.5) / width, 1 - (y + 0.5) / height) for x in range(width)]
            for y in range(height)]
    with open(os.path.join(TEXTURE_FOLDER, name), "wb") as file:
        file.write(ENCODERS[os.path.splitext(name)[1]](width, height, rows))
