#!/usr/bin/env python3
"""Writes the TGA files beside it: every type, size of pixels and of the entries of the colour map, and
origin, from Pillow where it can write them, else (_s) from the code below. The samples follow
sample(), which tests/unit/test_tga.cpp repeats. The names say the type, the bits of a pixel, the
attribute bits, the bits of an entry and the number of the first one, and the origin (1: right,
2: top). Needs `pip install numpy pillow`; run it in its folder. (Checked with OpenImageIO: the same
pixels.)"""
import struct

import numpy
from PIL import Image

WIDTH, HEIGHT = 19, 7
ENTRIES = 21


def sample(x, y, c):
    return (x // 4 * 29 + y * 53 + c * 97 + (x == 9) * y * c) % 256


def index(x, y):
    return (x // 3 + y * 5) % ENTRIES


def entry(i, c):
    return (i * 41 + c * 71) % 256


def stored(bits, red, green, blue, alpha):
    if bits > 16:
        return bytes((blue, green, red, alpha))[:bits // 8]
    return struct.pack('<H', (alpha >> 7 << 15 if bits == 16 else 0) | red >> 3 << 10
                       | green >> 3 << 5 | blue >> 3)


def packed(pixels):
    """Packets, the longest possible ones, which rows do not interrupt."""
    out, i = b'', 0
    while i < len(pixels):
        end = i + 1
        while end < len(pixels) and end - i < 128 and pixels[end] == pixels[i]:
            end += 1
        if end - i > 1:
            out += bytes((127 + end - i,)) + pixels[i]
        else:
            while end < len(pixels) and end - i < 128 and pixels[end] != pixels[end - 1]:
                end += 1
            out += bytes((end - i - 1,)) + b''.join(pixels[i:end])
        i = end
    return out


def name(kind, bits, attributes, map_bits, first, origin, maker):
    return f't{kind:02}_{bits:02}_a{attributes}_m{map_bits:02}_f{first:03}_o{origin}_{maker}.tga'


def write(kind, bits, attributes, origin, map_bits=0, first=0, ident=b'', end=b''):
    pixels, colours = [], b''
    for row in range(HEIGHT):
        for column in range(WIDTH):
            x = WIDTH - 1 - column if origin & 1 else column
            y = row if origin & 2 else HEIGHT - 1 - row
            if kind % 8 == 1:
                pixels.append(struct.pack('<H', first + index(x, y))[:bits // 8])
            elif kind % 8 == 3:
                pixels.append(bytes((sample(x, y, 0), sample(x, y, 3)))[:bits // 8])
            else:
                pixels.append(stored(bits, *(sample(x, y, c) for c in range(4))))
    if kind % 8 == 1:
        colours = b''.join(stored(map_bits, *(entry(i, c) for c in range(4))) for i in range(ENTRIES))
    header = struct.pack('<BBBHHBHHHHBB', len(ident), kind % 8 == 1, kind, first,
                         ENTRIES if map_bits else 0, map_bits, 3, 2, WIDTH, HEIGHT, bits,
                         attributes | origin << 4)
    with open(name(kind, bits, attributes, map_bits, first, origin, 's'), 'wb') as file:
        file.write(header + ident + colours + (packed(pixels) if kind > 8 else b''.join(pixels)) + end)


def save(mode, kind, bits, attributes, map_bits=0):
    if mode == 'P':
        picture = Image.fromarray(numpy.uint8([[index(x, y) for x in range(WIDTH)]
                                               for y in range(HEIGHT)]))
        picture.putpalette([entry(i, c) for i in range(ENTRIES) for c in range(3)])
    else:
        channels = {'L': (0,), 'LA': (0, 3), 'RGB': (0, 1, 2), 'RGBA': (0, 1, 2, 3)}[mode]
        values = numpy.uint8([[[sample(x, y, c) for c in channels] for x in range(WIDTH)]
                              for y in range(HEIGHT)])
        picture = Image.fromarray(values[..., 0] if mode == 'L' else values)
    for add, compression in ((0, None), (8, 'tga_rle')):
        for origin, orientation in ((0, -1), (2, 1)):
            picture.save(name(kind + add, bits, attributes, map_bits, 0, origin, 'pillow'),
                         compression=compression, orientation=orientation)


save('L', 3, 8, 0)
save('LA', 3, 16, 8)
save('RGB', 2, 24, 0)
save('RGBA', 2, 32, 8)
save('P', 1, 8, 0, 24)
FOOTER = bytes(8) + b'TRUEVISION-XFILE.\0'
for packing in (0, 8):
    write(3 + packing, 16, 0, 1)
    write(3 + packing, 8, 0, 3, ident=b'grey')
    for origin, bits, attributes in ((0, 15, 0), (1, 16, 0), (3, 16, 1), (1, 24, 0), (3, 24, 0),
                                     (2, 32, 0), (3, 32, 8)):
        write(2 + packing, bits, attributes, origin, ident=bytes(range(bits)), end=FOOTER)
    for origin, bits, attributes in ((2, 15, 0), (3, 16, 0), (0, 16, 1), (1, 24, 0), (3, 32, 0),
                                     (0, 32, 8)):
        write(1 + packing, 8, attributes, origin, bits, first=bits)
    write(1 + packing, 16, 0, 2, 24, first=700)
