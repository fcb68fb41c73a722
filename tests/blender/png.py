"""Small PNG files: writing some, and reading those that Blend/Export.py writes. Eight bits, no filters."""

import struct
import zlib

from scene_text import equal


def write_png(path, pixels, width, height, channels=3):
    rows = b"".join(b"\0" + bytes(pixels[y * width * channels:(y + 1) * width * channels]) for y in range(height))
    chunk = lambda k, d: struct.pack(">I", len(d)) + k + d + struct.pack(">I", zlib.crc32(k + d))
    head = struct.pack(">IIBBBBB", width, height, 8, {1: 0, 3: 2, 4: 6}[channels], 0, 0, 0)
    with open(path, "wb") as file:
        file.write(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", head) + chunk(b"IDAT", zlib.compress(rows)) + chunk(b"IEND", b""))


def read_png(path):
    """(width, height, channels, rows from the top without filter bytes) of the script's own PNG."""
    with open(path, "rb") as file:
        data = file.read()
    width, height, depth, kind = struct.unpack(">IIBB", data[16:26])
    equal(depth, 8)
    i, packed = 8, b""
    while i < len(data):
        size, name = struct.unpack(">I4s", data[i:i + 8])
        packed += data[i + 8:i + 8 + size] if name == b"IDAT" else b""
        i += size + 12
    channels = {0: 1, 2: 3, 6: 4}[kind]
    raw, stride = zlib.decompress(packed), 1 + width * channels
    assert all(raw[y * stride] == 0 for y in range(height)), "filtered PNG"
    return width, height, channels, b"".join(raw[y * stride + 1:(y + 1) * stride] for y in range(height))
