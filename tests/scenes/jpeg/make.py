#!/usr/bin/env python3
"""Writes the JPEG files beside it with libjpeg-turbo (Pillow, and cjpeg from libjpeg-turbo-progs), and
what Pillow reads from them as .ppm or .pgm, which tests/unit/test_jpeg.cpp expects to the last bit.
fractional.jpg, which libjpeg does not read, and its pixels are made here. Run it in its folder."""
import io
import math
import struct
import subprocess
import tempfile

from PIL import Image

WIDTH, HEIGHT = 37, 21


def picture(width, height):
    image = Image.new('RGB', (width, height))
    for y in range(height):
        for x in range(width):
            noise = (x * 2654 + y * 10007 + x * y * 77) >> 3 & 31
            image.putpixel((x, y), (int(128 + 110 * math.sin(x / 4) * math.cos(y / 3)),
                                    (x // 7 + y // 5) % 2 * 200 + noise, x * 255 // max(width - 1, 1)))
    return image


def keep(name, data):
    with open(name + '.jpg', 'wb') as file:
        file.write(data)
    image = Image.open(io.BytesIO(data))
    image.save(name + ('.pgm' if image.mode == 'L' else '.ppm'))


def pillow(name, image, **options):
    data = io.BytesIO()
    image.save(data, 'JPEG', **options)
    keep(name, data.getvalue())


def cjpeg(image, *options):
    data = io.BytesIO()
    image.save(data, 'PPM')
    return subprocess.run(['cjpeg', *options], input=data.getvalue(), stdout=subprocess.PIPE,
                          check=True).stdout


def with_scans(image, script, *options):
    with tempfile.NamedTemporaryFile('w', suffix='.txt') as file:
        file.write(script)
        file.flush()
        return cjpeg(image, *options, '-scans', file.name)


def segment(marker, data):
    return bytes([0xFF, marker]) + struct.pack('>H', len(data) + 2) + data


def fractional():
    """RGB with the sampling factors 3x1, 2x1 and 1x3: every block has one value."""
    width, height = 40, 30
    factors = ((3, 1), (2, 1), (1, 3))
    columns, rows = -(-width // 24), -(-height // 24)
    values = [[[40 + 37 * c + (x * 23 + y * 51) % 130 for x in range(columns * h)]
               for y in range(rows * v)] for c, (h, v) in enumerate(factors)]
    bits, before = '', [0, 0, 0]
    for my in range(rows):
        for mx in range(columns):
            for c, (h, v) in enumerate(factors):
                for y in range(v):
                    for x in range(h):
                        value = values[c][my * v + y][mx * h + x] - 128
                        difference, before[c] = value - before[c], value
                        size = abs(difference).bit_length()
                        bits += format(size, '04b') # the code of a size is the size
                        if size:
                            bits += format(difference if difference > 0 else
                                           difference + (1 << size) - 1, '0%db' % size)
                        bits += '0' # the end of the block
    bits += '1' * (-len(bits) % 8)
    data = bytes(int(bits[i:i + 8], 2) for i in range(0, len(bits), 8)).replace(b'\xFF', b'\xFF\0')
    frame = struct.pack('>BHHB', 8, height, width, 3)
    scan = b'\3'
    for c, (h, v) in enumerate(factors):
        frame += bytes([b'RGB'[c], h << 4 | v, 0])
        scan += bytes([b'RGB'[c], 0])
    with open('fractional.jpg', 'wb') as file:
        file.write(b'\xFF\xD8' + segment(0xDB, b'\0' + b'\x08' * 64) + segment(0xC0, frame) +
                   segment(0xC4, bytes([0, 0, 0, 0, 12] + [0] * 12) + bytes(range(12))) +
                   segment(0xC4, bytes([0x10, 1] + [0] * 15) + b'\0') +
                   segment(0xDA, scan + bytes([0, 63, 0])) + data + b'\xFF\xD9')
    with open('fractional.ppm', 'wb') as file:
        file.write(b'P6\n%d %d\n255\n' % (width, height))
        for y in range(height):
            for x in range(width):
                file.write(bytes(values[c][y * v // 3 // 8][x * h // 3 // 8]
                                 for c, (h, v) in enumerate(factors)))


image = picture(WIDTH, HEIGHT)
for name, subsampling in (('444', 0), ('422', 1), ('420', 2)):
    for kind in ('baseline', 'progressive'):
        pillow(f'{name}_{kind}', image, quality=80, subsampling=subsampling,
               progressive=kind == 'progressive')
pillow('grey_baseline', image.convert('L'), quality=85)
pillow('grey_progressive', image.convert('L'), quality=85, progressive=True)
pillow('rgb', image, quality=85, keep_rgb=True)
pillow('optimised', image, quality=70, optimize=True)
pillow('restart', image, quality=70, restart_marker_blocks=2)
pillow('restart_progressive', image, quality=70, restart_marker_rows=1, progressive=True)
pillow('quality_1', image, quality=1)
pillow('quality_100', image, quality=100, subsampling=0)
for size in ((1, 1), (2, 2), (3, 1), (5, 4), (16, 16)):
    pillow('size_%dx%d' % size, picture(*size), quality=90, subsampling=2)
keep('411', cjpeg(image, '-sample', '4x1'))
keep('440', cjpeg(image, '-sample', '1x2'))
keep('mixed_sampling', cjpeg(image, '-sample', '2x2,1x2,2x1', '-progressive'))
keep('wide_steps', cjpeg(image, '-quality', '1')) # quantisation tables of 16 bits: SOF1
keep('three_scans', with_scans(image, '0;\n1;\n2;\n', '-restart', '1'))
keep('many_bits', with_scans(
    image, '0 1 2: 0-0, 0, 3;\n' + ''.join(f'{c}: 1-5, 0, 2;\n{c}: 6-63, 0, 1;\n{c}: 1-5, 2, 1;\n'
                                           for c in range(3)) +
    '0 1 2: 0-0, 3, 2;\n0 1 2: 0-0, 2, 1;\n0 1 2: 0-0, 1, 0;\n' +
    ''.join(f'{c}: 1-63, 1, 0;\n' for c in range(3)), '-quality', '90'))
fractional()
# Files that are refused.
for name, data in (('arithmetic', cjpeg(image, '-arithmetic')),):
    with open(name + '.jpg', 'wb') as file:
        file.write(data)
image.convert('CMYK').save('cmyk.jpg', quality=50)
