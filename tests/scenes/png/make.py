#!/usr/bin/env python3
"""Writes the PNG files beside it with Python's zlib: every colour type, depth and interlace method,
row filters in turn. The pixels follow sample() below, which tests/unit/test_png.cpp repeats.
Needs nothing but Python; run it in its folder. (Checked once with pypng and Pillow: same pixels.)"""
import struct
import zlib

WIDTH, HEIGHT = 13, 9
CHANNELS = {0: 1, 2: 3, 3: 1, 4: 2, 6: 4}
DEPTHS = {0: (1, 2, 4, 8, 16), 2: (8, 16), 3: (1, 2, 4, 8), 4: (8, 16), 6: (8, 16)}
ADAM7 = ((0, 0, 8, 8), (4, 0, 8, 8), (0, 4, 4, 8), (2, 0, 4, 4), (0, 2, 2, 4), (1, 0, 2, 2),
         (0, 1, 1, 2))


def sample(x, y, c, depth):
    return (x * 2654 + y * 10007 + c * 31337 + x * y * 77) >> 3 & (1 << depth) - 1


def palette(depth):
    return bytes(v for i in range(1 << depth) for v in (i * 5 & 255, 255 - i & 255, i * 77 & 255))


def chunk(kind, data):
    return struct.pack('>I', len(data)) + kind + data + struct.pack('>I', zlib.crc32(kind + data))


def packed_row(values, depth):
    bits = ''.join(format(v, '0%db' % depth) for v in values)
    bits += '0' * (-len(bits) % 8)
    return bytes(int(bits[i:i + 8], 2) for i in range(0, len(bits), 8))


def paeth(a, b, c):
    p = a + b - c
    return min((abs(p - a), 0, a), (abs(p - b), 1, b), (abs(p - c), 2, c))[2]


def filtered(row, above, kind, back):
    out = bytearray([kind])
    for i, value in enumerate(row):
        a, c = (row[i - back], above[i - back]) if i >= back else (0, 0)
        b = above[i]
        out.append(value - (0, a, b, (a + b) // 2, paeth(a, b, c))[kind] & 255)
    return bytes(out)


def rows(kind, depth, interlaced, width, height):
    channels = CHANNELS[kind]
    back = max(1, channels * depth // 8)
    out, count = b'', 0
    for x0, y0, dx, dy in ADAM7 if interlaced else ((0, 0, 1, 1),):
        columns = range(x0, width, dx)
        if not columns:
            continue
        above = bytes(len(packed_row([0] * len(columns) * channels, depth)))
        for y in range(y0, height, dy):
            row = packed_row([sample(x, y, c, depth) for x in columns for c in range(channels)],
                             depth)
            out += filtered(row, above, count % 5, back)
            above, count = row, count + 1
    return out


def png(kind, depth, interlaced, transparent=b'', width=WIDTH, height=HEIGHT):
    out = b'\x89PNG\r\n\x1a\n' + chunk(b'IHDR', struct.pack('>IIBBBBB', width, height, depth, kind,
                                                           0, 0, interlaced))
    out += chunk(b'tEXt', b'Comment\0ancillary chunks are skipped')
    if kind == 3:
        out += chunk(b'PLTE', palette(depth))
    if transparent:
        out += chunk(b'tRNS', transparent)
    packed = zlib.compress(rows(kind, depth, interlaced, width, height), 9)
    middle = len(packed) // 2
    return out + chunk(b'IDAT', packed[:middle]) + chunk(b'IDAT', packed[middle:]) + chunk(b'IEND', b'')


def main():
    for kind, depths in DEPTHS.items():
        for depth in depths:
            for interlaced in (0, 1):
                name = 'c%d_%02d_%s' % (kind, depth, 'ni'[interlaced])
                open(name + '.png', 'wb').write(png(kind, depth, interlaced))
                if kind in (0, 2):  # the pixel (2,1) and those like it are transparent
                    see_through = b''.join(struct.pack('>H', sample(2, 1, c, depth))
                                           for c in range(CHANNELS[kind]))
                elif kind == 3:  # the first entries, the others stay opaque
                    see_through = bytes(i * 40 & 255 for i in range(min(1 << depth, 3)))
                else:
                    continue
                open(name + '_t.png', 'wb').write(png(kind, depth, interlaced, see_through))
    for width, height in ((1, 1), (3, 1), (1, 5), (5, 4)):  # some passes are empty
        open('size_%dx%d_i.png' % (width, height), 'wb').write(
            png(2, 8, 1, width=width, height=height))


main()
