#!/usr/bin/env python3
"""Writes the OpenEXR files beside it with the OpenEXR library (pip install OpenEXR numpy; made with
3.5.3): every compression, type, order of lines and choice of layers that is read. The pixels follow
value() below, which tests/unit/exr_kit.h repeats. Files with levels are written by hand, as the
Python package writes no levels; the library reads level 0 of them back. Run it in its folder."""
import struct

import numpy as np
import OpenEXR

WIDTH, HEIGHT = 33, 35
COMPRESSIONS = {'none': 0, 'rle': 1, 'zips': 2, 'zip': 3, 'piz': 4}
TYPES = {'half': np.float16, 'float': np.float32}


def value(x, y, c):
    return (x * 3 + y * 5 + c * 40 + (x * y % 7 == 0) * 9) / 16


def plane(c, dtype=np.float16, width=WIDTH, height=HEIGHT):
    y, x = np.mgrid[0:height, 0:width]
    return value(x, y, c).astype(dtype)


def planes(names, dtype=np.float16, width=WIDTH, height=HEIGHT, first=0):
    return {n: plane(first + c, dtype, width, height) for c, n in enumerate(names)}


def part(channels, name='picture', compression='zip', order=0, tiles=None, corner=(0, 0)):
    height, width = next(iter(channels.values())).shape
    header = {'compression': OpenEXR.Compression(COMPRESSIONS[compression]),
              'type': OpenEXR.tiledimage if tiles else OpenEXR.scanlineimage,
              'lineOrder': OpenEXR.LineOrder(order),
              'dataWindow': (np.array(corner, np.int32),
                             np.array([corner[0] + width - 1, corner[1] + height - 1], np.int32)),
              'displayWindow': (np.array([0, 0], np.int32), np.array([7, 7], np.int32))}
    if tiles:
        header['tiles'] = OpenEXR.TileDescription()
        header['tiles'].xSize, header['tiles'].ySize = tiles
    return OpenEXR.Part(header, {n: OpenEXR.Channel(v) for n, v in channels.items()}, name)


def write(name, *parts):
    OpenEXR.File(list(parts)).write(name + '.exr')


def attribute(name, kind, data):
    return name.encode() + b'\0' + kind.encode() + b'\0' + struct.pack('<i', len(data)) + data


def write_levels(name, mode, width=13, height=9, tile=4):
    """A file of tiles with levels, not compressed: 1 MIPMAP, 2 RIPMAP, sizes rounded down."""
    channels = b''.join(n.encode() + b'\0' + struct.pack('<4i', 1, 0, 1, 1) for n in 'BGR') + b'\0'
    window = struct.pack('<4i', 0, 0, width - 1, height - 1)
    header = b''.join((
        attribute('channels', 'chlist', channels), attribute('compression', 'compression', b'\0'),
        attribute('dataWindow', 'box2i', window), attribute('displayWindow', 'box2i', window),
        attribute('lineOrder', 'lineOrder', b'\0'),
        attribute('pixelAspectRatio', 'float', struct.pack('<f', 1)),
        attribute('screenWindowCenter', 'v2f', struct.pack('<2f', 0, 0)),
        attribute('screenWindowWidth', 'float', struct.pack('<f', 1)),
        attribute('tiles', 'tiledesc', struct.pack('<2iB', tile, tile, mode)), b'\0'))
    if mode == 1:
        count = max(width, height).bit_length()
        levels = [(i, i) for i in range(count)]
    else:
        levels = [(i, j) for j in range(height.bit_length()) for i in range(width.bit_length())]
    chunks = []
    for i, j in levels:
        w, h = max(1, width >> i), max(1, height >> j)
        pixels = planes('RGB', np.float16, w, h, 10 * (i + j))
        for y in range(0, h, tile):
            for x in range(0, w, tile):
                data = b''.join(pixels[n][row, x:x + tile].tobytes()
                                for row in range(y, min(h, y + tile)) for n in 'BGR')
                chunks.append(struct.pack('<5i', x // tile, y // tile, i, j, len(data)) + data)
    start = struct.pack('<2I', 20000630, 2 | 0x200) + header
    offsets, at = b'', len(start) + 8 * len(chunks)
    for chunk in chunks:
        offsets += struct.pack('<Q', at)
        at += len(chunk)
    with open(name + '.exr', 'wb') as file:
        file.write(start + offsets + b''.join(chunks))
    back = OpenEXR.File(name + '.exr', separate_channels=True).channels()
    for n, pixels in planes('RGB', np.float16, width, height).items():
        assert (back[n].pixels == pixels).all(), name


for compression in COMPRESSIONS:
    for kind, dtype in TYPES.items():
        # FLOATs have twice the bytes: fewer of them, so that the files stay small.
        size = (WIDTH, HEIGHT) if kind == 'half' else (21, 19)
        # Small tiles would not become smaller by PIZ.
        for tiles in (None, (31, 33) if compression == 'piz' else (8, 16)):
            write(f'{compression}_{kind}_{"tiles" if tiles else "lines"}',
                  part(planes('RGB', dtype, *size), compression=compression, tiles=tiles))
write('rle_small', part({**planes('RGB', np.float16, 13, 9), 'Z': np.zeros((9, 13), np.float32)},
                        compression='rle'))
for w, h in ((1, 1), (1, 5), (3, 1), (2, 17)):
    write(f'size_{w}x{h}', part(planes('RGBA', np.float32, w, h), corner=(-7, 4)))
for order, name in enumerate(('increasing', 'decreasing', 'random')):
    if order < 2:
        write(f'order_{name}', part(planes('RGB'), order=order, corner=(-3, -100)))
    write(f'order_{name}_tiles', part(planes('RGB'), order=order, tiles=(16, 9), corner=(5, 6)))
write_levels('levels_mipmap', 1)
write_levels('levels_ripmap', 2)

small = dict(width=6, height=5)
write('channels_y', part(planes('Y', **small)))
write('channels_ya', part(planes('YA', **small)))
write('channels_rgba', part(planes('RGBA', **small)))
mixed = {'R': plane(0, np.float16, 6, 5), 'G': plane(1, np.float32, 6, 5),
         'B': plane(2, np.float16, 6, 5)}
for compression in ('zip', 'piz'):
    write(f'channels_mixed_{compression}',
          part({**mixed, 'Id': np.full((5, 6), 7, np.uint32), 'Z': plane(9, np.float32, 6, 5)},
               compression=compression))
# The picture is in values 0 to 2 or 0 to 3 in each of these.
write('layers_plain', part({**planes('RGBA', **small),
                            **planes(('a.R', 'a.G', 'a.B'), first=4, **small),
                            **planes('Y', first=9, **small)}))
write('layers_prefix', part({**planes([f'ViewLayer.Combined.{c}' for c in 'RGBA'], **small),
                             **planes([f'ViewLayer.Diffuse.{c}' for c in 'RGB'], first=4, **small),
                             **planes(['ViewLayer.Depth.Z', 'Y'], first=8, **small)}))
write('layers_order', part({**planes(['a.R', 'a.G', 'a.B'], **small),
                            **planes(['a-b.R', 'a-b.G', 'a-b.B'], first=4, **small),
                            **planes(['a.A.R', 'a.A.G', 'a.A.B'], first=8, **small),
                            **planes(['0.R', '0.G'], first=12, **small)}))
write('layers_long_name', part(planes([f'{"long" * 10}.{c}' for c in 'RGB'], **small)))
write('parts_colour', part(planes('Z', np.float32, first=9, **small), 'depth'),
      part(planes('Y', first=8, **small), 'grey'),
      part(planes('RGBA'), 'beauty', compression='piz', tiles=(16, 16)),
      part(planes('RGB', first=4, **small), 'second'))
write('parts_grey', part(planes('Z', np.float32, first=9, **small), 'depth'),
      part(planes('Y', **small), 'grey'))

# Each of 16384 numbers but zero once: the wavelet of PIZ works modulo 2^16.
ramp = np.arange(1, 16385, dtype=np.uint16).view(np.float16).reshape(32, 512)
write('piz_ramp', part({'Y': ramp}, compression='piz'))
special = np.array([[np.inf, -np.inf, np.nan], [-0.0, 65504, 2.0 ** -24]])
write('special_half', part({'Y': special.astype(np.float16)}))
special[1, 1:] = 3.4028234663852886e38, 1e-45
write('special_float', part({'Y': special.astype(np.float32)}))
