#!/usr/bin/env python3
"""Writes the Radiance HDR files beside it: one picture, whose pixels follow pixel() below, as several
programs write it, in all eight orders of the pixels and with each code of the scanlines. The test
tests/unit/test_hdr.cpp repeats pixel(). Needs `pip install numpy opencv-python-headless OpenImageIO
pyradiance`; run it in its folder."""
import os
import subprocess

import cv2
import numpy
import OpenImageIO
import pyradiance

WIDTH, HEIGHT = 21, 13
TOOLS = os.path.join(os.path.dirname(pyradiance.__file__), 'bin')


def pixel(x, y):
    mantissas = [(x // 3 * 37 + y * 11 + c * 83) % 256 for c in range(3)]
    mantissas[y % 3] |= 128  # the highest bit of the largest one is always set
    return (*mantissas, 120 + (x // 5 + y) % 17)


def value(x, y):
    *mantissas, exponent = pixel(x, y)
    return [m * 2.0 ** (exponent - 136) for m in mantissas]


def header(*lines):
    return '\n'.join(['#?RADIANCE', *lines, '', f'-Y {HEIGHT} +X {WIDTH}', '']).encode()


def old_code(row):
    """Runs of whole pixels: 1, 1, 1 and how many more of the pixel before."""
    out = b''
    for i, value in enumerate(row):
        if i == 0 or value != row[i - 1]:
            length = next((k for k in range(i, len(row)) if row[k] != value), len(row)) - i
            out += bytes(value) + (bytes((1, 1, 1, length - 1)) if length > 1 else b'')
    return out


def radiance(output, *command):
    with open(output + '.hdr', 'wb') as file:
        subprocess.run(command, stdout=file, check=True, env={'PATH': TOOLS})


rows = [[pixel(x, y) for x in range(WIDTH)] for y in range(HEIGHT)]
with open('old_code.hdr', 'wb') as file:
    file.write(header('SOFTWARE=make.py') + b''.join(old_code(row) for row in rows))

picture = numpy.float32([[value(x, y) for x in range(WIDTH)] for y in range(HEIGHT)])
cv2.imwrite('opencv_flat.hdr', picture[..., ::-1], [cv2.IMWRITE_HDR_COMPRESSION, 0])
cv2.imwrite('opencv_rle.hdr', picture[..., ::-1], [cv2.IMWRITE_HDR_COMPRESSION, 1])
output = OpenImageIO.ImageOutput.create('oiio_rle.hdr')
output.open('oiio_rle.hdr', OpenImageIO.ImageSpec(WIDTH, HEIGHT, 3, OpenImageIO.FLOAT))
output.write_image(picture)
output.close()

# These programs turn the pixels and say so in the header: the picture remains the same. The names
# say where pixels go in a scanline, and where scanlines go.
radiance('right_down', 'ra_rgbe', 'opencv_flat.hdr')
radiance('exposure', 'ra_rgbe', '-e', '+2', 'opencv_flat.hdr')
radiance('left_down', 'pflip', '-h', 'right_down.hdr')
radiance('right_up', 'pflip', '-v', 'right_down.hdr')
radiance('left_up', 'pflip', '-h', '-v', 'right_down.hdr')
radiance('up_right', 'protate', 'right_down.hdr')
radiance('down_left', 'protate', '-r', 'right_down.hdr')
radiance('down_right', 'protate', 'right_up.hdr')
radiance('up_left', 'protate', '-r', 'right_up.hdr')
