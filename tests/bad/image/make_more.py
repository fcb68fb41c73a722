#!/usr/bin/env python3
"""Writes the broken JPEG, Radiance HDR, TGA and OpenEXR pictures beside it, each with NAME.expect:
words of the message. make.py does it for the others; run it in its folder, it needs only Python.
There is a file for each message of the readers (tests/unit/test_image.cpp looks for the rest)."""
import struct
import zlib

# JPEG: a segment has a marker, the length and the rest.


def segment(marker, body):
    return bytes([0xFF, marker]) + struct.pack('>H', len(body) + 2) + body


START, END = b'\xff\xd8', b'\xff\xd9'


def steps(number=0, first=1):
    return segment(0xDB, bytes([number, first]) + bytes([1]) * 63)


def frame(kind=0xC0, bits=8, height=8, width=8, parts=((1, 0x11, 0),)):
    return segment(kind, struct.pack('>BHHB', bits, height, width, len(parts)) +
                   b''.join(bytes(part) for part in parts))


def codes(use, number, lengths, symbols):
    """A Huffman table; lengths[i] codes have i + 1 bits."""
    return segment(0xC4, bytes([use << 4 | number]) + bytes(lengths) + bytes(16 - len(lengths)) +
                   bytes(symbols))


def scan(parts=((1, 0),), bands=(0, 63, 0), data=b''):
    return segment(0xDA, bytes([len(parts)]) + b''.join(bytes(p) for p in parts) +
                   bytes(bands)) + data


# Code 0 is a difference of 0 bits, 10 one of 1 bit; 110 has a symbol that no block may have.
DC = codes(0, 0, (1, 1, 1), (0, 1, 16))
# Code 0 ends a block, 10 is one bit after 15 zeros; 110 is 16 zeros, 1110 a coefficient of 2 bits.
AC = codes(1, 0, (1, 1, 1, 1), (0, 0xF1, 0xF0, 0x02))
ZERO = b'\x3f'  # a block of zeros: 0, 0, ones to the end
GREY, GREY2 = START + steps() + frame() + DC + AC, START + steps() + frame(0xC2) + DC + AC
COLOUR = ((1, 0x11, 0), (2, 0x11, 0), (3, 0x11, 0))
FIRST = scan(bands=(0, 0, 0), data=ZERO)  # of a progressive picture

JPEG = {
    'start': (START + b'\xff', "the file ends before the picture does (the marker EOI); it is cut off"),
    'end_only': (START + END, "the file ends before the frame header; it is cut off"),
    'segment_cut': (START + b'\xff\xdb\0\x43\0', "the file ends in the middle of a segment"),
    'segment_length': (START + b'\xff\xdb\0\1', "the segment at byte 4 has the length 1; at least 2"),
    'two_starts': (START + segment(0xD8, b''), "a second picture starts within the first one"),
    'two_frames': (START + frame() * 2, "there are two frame headers; there must be one"),
    'lossless': (START + frame(0xC3), "the picture is lossless; it must be baseline"),
    'hierarchical': (START + frame(0xC5), "the picture is hierarchical; it must be"),
    'arithmetic': (START + frame(0xC9), "the picture is arithmetic-coded; it must be"),
    'lossless_arithmetic': (START + frame(0xCB), "the picture is lossless and arithmetic-coded"),
    'hierarchical_arithmetic': (START + frame(0xCF), "is hierarchical and arithmetic-coded"),
    'reserved': (START + frame(0xC8), "the picture is of a reserved kind (JPG)"),
    'restart_length': (START + segment(0xDD, b'\1'), "the restart interval has 1 bytes; 2"),
    'scan_first': (START + scan(), "a scan comes before the frame header; it must come after it"),
    'scan_length': (GREY + segment(0xDA, b'\1\1\0'), "a scan header has 3 bytes for 1 components"),
    'many_scans': (GREY2 + FIRST + b''.join(
        scan(bands=(k, k, 0x10 * h + low), data=b'\x7f') for k in range(1, 60)
        for h, low in ((0, 3), (3, 2), (2, 1), (1, 0))),
        "the picture has more than 200 scans; at most so many are read"),
    'band': (GREY2 + scan(bands=(0, 5, 0)), "has the coefficients 0 to 5; it must have 0 alone"),
    'bits': (GREY2 + scan(bands=(0, 0, 14)), "a scan comes from the bit 0 to 14; from 0 to at most"),
    'scan_component': (GREY + scan(((7, 0),)), "a scan has the component 7, which is not in the frame"),
    'scan_twice': (START + steps() + frame(parts=COLOUR) + DC + AC + scan(((1, 0), (1, 0))),
                   "a scan has the component 1 twice; once"),
    'no_codes': (START + steps() + frame() + DC + scan(),
                 "a scan has the Huffman tables 0 (DC) and 0 (AC), which are not in the file"),
    'no_steps': (START + frame() + DC + AC + scan(),
                 "the component 1 has the quantisation table 0, which is not in the file before it"),
    'two_scans': (START + steps() + frame(parts=COLOUR) + DC + AC + scan(data=ZERO) * 2,
                  "the component 1 has two scans; one"),
    'ac_first': (GREY2 + scan(bands=(1, 5, 0), data=ZERO),
                 "the first scan of the component 1 has not the coefficient 0; it must"),
    'bits_again': (GREY2 + FIRST * 2, "a scan repeats or leaves out bits of the coefficient 0"),
    'components_left': (START + steps() + frame(parts=COLOUR) + DC + AC + scan(data=ZERO) + END,
                        "the file ends before all components have had a scan; it is cut off"),
    # Frame header
    'frame_short': (START + segment(0xC0, bytes(5)), "the frame header has 5 bytes; at least 6"),
    'precision': (START + frame(bits=12), "the picture has 12 bits per sample; it must have 8"),
    'cmyk': (START + frame(parts=COLOUR + ((4, 0x11, 0),)),
             "the picture has four components (CMYK or YCCK); it must be grey"),
    'two_components': (START + frame(parts=COLOUR[:2]), "the picture has 2 components; it must have"),
    'frame_length': (START + segment(0xC0, struct.pack('>BHHB', 8, 8, 8, 3) + bytes(3)),
                     "the frame header has 9 bytes for 3 components; 15"),
    'sampling': (START + frame(parts=((1, 0x51, 0),)), "the sampling factors 5x1; each must be 1 to 4"),
    'steps_number': (START + frame(parts=((1, 0x11, 4),)), "has the quantisation table 4; 0 to 3"),
    'short': (START + frame(height=4000, width=4000), "the file is too short for 4000x4000 pixels"),
    'no_height': (START + frame(height=0), "the height comes later (a DNL marker); it must say"),
    'no_width': (START + frame(width=0), "the size 0x8 is not possible; both sides must be 1"),
    'billion': (START + frame(height=32000, width=32000), "the size 32000x32000 is too large"),
    'same_component': (START + frame(parts=COLOUR[:2] + ((1, 0x11, 0),)),
                       "two components have the identifier 1; each needs its own"),
    # Tables
    'table_number': (START + segment(0xDB, b'\4' + bytes(64)), "a quantisation table has the number 4"),
    'table_short': (START + segment(0xDB, bytes(40)), "the quantisation table 0 has 39 bytes; 64"),
    'step_0': (START + steps(first=0), "a step of the quantisation table 0 is 0; it must be at least 1"),
    'codes_class': (START + codes(2, 0, (1,), (0,)), "a Huffman table has the number 0 and the class 2"),
    'codes_cut': (START + segment(0xC4, bytes(9)), "the Huffman table 0 has 9 bytes; at least 17"),
    'codes_count': (START + codes(0, 0, (0, 3), (0,)), "the Huffman table 0 has 3 codes, but 1 bytes"),
    'codes_too_many': (START + codes(0, 0, (3,), (0, 1, 2)), "has more short codes than there can be"),
    # Scans
    'restart': (START + steps() + frame(width=16) + DC + AC + segment(0xDD, b'\0\1') +
                scan(data=ZERO + b'\xff\xd1' + ZERO + END), "the restart marker 0 is missing before byte"),
    'no_code': (GREY + scan(data=b'\xfe\xfe\xfe\xfe'), "there is no Huffman code for the bits before"),
    'scan_cut': (GREY + scan(), "the data of a scan end too early, at byte"),
    'dc_size': (GREY + scan(data=b'\xc0\0\0\0'), "a DC coefficient has 16 bits; at most 15"),
    # A difference of 1 with the lowest bit 13 is 8192; the fourth one is too much.
    'coefficient': (START + steps() + frame(0xC2, width=32) + DC + AC +
                    scan(bands=(0, 0, 13), data=b'\xb6\xd8'), "a coefficient is 32768; at most 32767"),
    'index': (GREY + scan(data=b'\x5b\x6f'), "a block has a coefficient with the number"),
    'new_bits': (GREY2 + FIRST + scan(bands=(1, 5, 1), data=b'\x7f') +
                 scan(bands=(1, 5, 0x10), data=b'\xe0\0'), "a new coefficient has 2 bits; it must have 1"),
}

# Radiance HDR: lines of text, then scanlines.
HEAD = b'#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n'
PACKED8 = HEAD + b'-Y 1 +X 8\n\2\2\0\x08'

HDR = {
    'first_line': (b'#?RADIANCE', ":1:1: error: the file ends in its header; the first line must"),
    'no_empty_line': (b'#?RADIANCE\nA=1\n', ":3:1: error: the file ends in its header; an empty line"),
    'no_resolution': (HEAD, ":4:1: error: the file ends in its header; the resolution must follow"),
    'xyze': (b'#?RADIANCE\nFORMAT=32-bit_rle_xyze\n\n', ":2:1: error: the pixels are CIE colours"),
    'format': (b'#?RADIANCE\nFORMAT=jpeg\n\n', ":2:1: error: the format is 'jpeg'; it must be 32-bit"),
    'exposure_words': (b'#?RADIANCE\nEXPOSURE=1 2\n\n', "EXPOSURE is '1 2'; it must be 1 number"),
    'exposure_0': (b'#?RADIANCE\nEXPOSURE=0\n\n', "EXPOSURE is '0'; it must be more than 0"),
    'colorcorr': (b'#?RADIANCE\nCOLORCORR=1 2\n\n', "COLORCORR is '1 2'; it must be 3 numbers"),
    'exposures': (b'#?RADIANCE\n' + b'EXPOSURE=1e20\n' * 2 + b'\n',
                  ":3:1: error: all EXPOSURE lines together multiply by 1e+40; it must be 1e-30"),
    'resolution': (HEAD + b'-Y 2 -Y 2\n', ":4:1: error: the resolution is '-Y 2 -Y 2'; it must be like"),
    'zero': (HEAD + b'-Y 0 +X 2\n', "the size 2x0 is not possible; both sides must be 1"),
    'billion': (HEAD + b'-Y 32000 +X 32000\n', "the size 32000x32000 is too large"),
    'cut': (HEAD + b'-Y 2 +X 1\n\1\2\3\x80', "the scanline 2 is cut off: the file ends too early; 4"),
    'length': (HEAD + b'-Y 1 +X 8\n\2\2\0\x09', "the scanline 1 says that it has 9 pixels; 8"),
    'count_0': (PACKED8 + b'\0', "the scanline 1 has 0 pixels where 8 are left; it must be from 1"),
    'run_long': (PACKED8 + b'\x89\1', "the scanline 1 has 9 pixels where 8 are left"),
    'old_run_first': (HEAD + b'-Y 1 +X 2\n\1\1\1\1', "the scanline 1 begins with a run; there must be"),
    'old_run_long': (HEAD + b'-Y 1 +X 2\n\1\2\3\x80\1\1\1\x02',
                     "the scanline 1 has a run of 2 pixels; at most 1 are left"),
    'infinite': (b'#?RGBE\nEXPOSURE=1e-9\n\n-Y 1 +X 1\n\xff\xff\xff\xff', "the pixel 0,0 is 1.69"),
}


# TGA: 18 bytes of header, the colour map, the pixels.
def tga(kind=2, bits=24, width=1, height=1, map_type=0, map_first=0, map_length=0, map_bits=0,
        descriptor=0, body=bytes(3)):
    return struct.pack('<BBBHHBHHHHBB', 0, map_type, kind, map_first, map_length, map_bits, 0, 0,
                       width, height, bits, descriptor) + body


# It names the format at the end of files whose header says nothing.
FOOTER = struct.pack('<II', 0, 0) + b'TRUEVISION-XFILE.\0'

TGA = {
    'footer_only': (FOOTER[-18:], "the TGA type is 85; it must be 1, 2, 3, 9, 10 or 11"),
    'no_picture': (tga(0, body=FOOTER), "this is a TGA file without a picture (type 0); the type must"),
    'huffman': (tga(32, body=FOOTER), "Huffman, delta and run-length codes (type 32); what can be read"),
    'type': (tga(4, body=FOOTER), "the TGA type is 4; it must be 1, 2, 3, 9, 10 or 11"),
    'bits': (tga(2, 8, body=FOOTER), "pixels of TGA type 2 have 8 bits; it must be 15, 16, 24 or 32"),
    'map_type': (tga(map_type=2, body=FOOTER), "the colour map type is 2; it must be 0 or 1"),
    'no_map': (tga(1, 8, body=FOOTER), "the colour map has 0 entries of 0 bits; there must be entries"),
    'interleaved': (tga(descriptor=0x40, body=FOOTER), "the rows of this TGA picture are interleaved"),
    'zero': (tga(width=0, body=FOOTER), "the size 0x1 is not possible; both sides must be 1"),
    'billion': (tga(width=32000, height=32000), "the size 32000x32000 is too large"),
    'map_cut': (tga(1, 8, map_type=1, map_length=9, map_bits=24), "is too short for its colour map"),
    'cut': (tga(height=2), "is too short for its pixels: it has 21 bytes; 6 must follow byte 18"),
    'packed_cut': (tga(10, width=200), "is too short for its pixels: it has 21 bytes; 8 must follow"),
    'packet_cut': (tga(10, width=3, body=b'\2abcdef'), "is too short for a packet"),
    'packet_long': (tga(10, width=2, body=b'\x82abc'), "a packet has 3 pixels; at most 2 are left"),
    'map_index': (tga(1, 8, map_type=1, map_first=5, map_length=1, map_bits=24, body=b'abc\x06'),
                  "a pixel has colour 6, but the colour map has only 5 to 5; it must be one"),
}

# OpenEXR: attributes, the table of offsets, the blocks.
MAGIC = b'\x76\x2f\x31\x01'
NONE, RLE, ZIPS, ZIP, PIZ = range(5)


def attribute(name, kind, value):
    return name + b'\0' + kind + b'\0' + struct.pack('<I', len(value)) + value


def channels(*names, kind=1, sampling=1):
    return attribute(b'channels', b'chlist', b''.join(
        name + b'\0' + struct.pack('<IIII', kind, 0, sampling, sampling) for name in names) + b'\0')


def compression(code):
    return attribute(b'compression', b'compression', bytes([code]))


def window(x1, y1):
    return attribute(b'dataWindow', b'box2i', struct.pack('<iiii', 0, 0, x1, y1))


def exr(*attributes, flags=0, body=b''):
    return MAGIC + struct.pack('<I', 2 + flags) + b''.join(attributes) + b'\0' + body


def block(data, code, width=4, height=1, name=b'Y', flags=0, numbers=(0,), size=None, extra=()):
    """A picture of one block; `numbers` are those before its size."""
    head = exr(channels(name), compression(code), window(width - 1, height - 1), *extra, flags=flags)
    return head + struct.pack('<Q', len(head) + 8) + struct.pack(
        f'<{len(numbers)}i', *numbers) + struct.pack('<I', len(data) if size is None else size) + data


def piz(body, length=None):
    """A set of numbers that has but zero, and then the code."""
    return struct.pack('<HHI', 1, 0, len(body) if length is None else length) + body


def table(first, last, lengths, code, bits):
    """A Huffman code of PIZ with lengths of 6 bits each."""
    value, count = 0, 0
    for length in lengths:
        value, count = value << 6 | length, count + 6
    value <<= -count % 8
    return struct.pack('<5I', first, last, 0, bits, 0) + value.to_bytes((count + 7) // 8, 'big') + code


def coded(body, **more):
    return block(piz(body), PIZ, width=64, height=1, **more)


GOOD = (channels(b'Y'), compression(NONE), window(3, 0))
TILES, DEEP, PARTS = 0x200, 0x800, 0x1000
EXR = {
    'magic_only': (MAGIC, "the file ends in the middle of the header (version); it is cut off"),
    'version': (MAGIC + struct.pack('<I', 3), "the version of OpenEXR is 3; only 2 is read"),
    'flags': (MAGIC + struct.pack('<I', 0x10002), "the version field has the unknown flags 65536"),
    'no_end': (exr(*GOOD)[:-1], "the file ends in the middle of the header; it is cut off"),
    'value_cut': (exr(*GOOD)[:-9], "the file ends in the middle of the header (dataWindow)"),
    'long_name': (exr(attribute(b'n' * 256, b'int', b'')),
                  "the name of an attribute at byte 8 does not end; at most 255 bytes and a zero"),
    'wrong_type': (exr(attribute(b'compression', b'int', b'\0')),
                   "the attribute compression is a int of 1 bytes; it must be a compression of 1"),
    'part_type': (exr(attribute(b'type', b'string', b'sound')), "a part has the type sound; it must be"),
    'channel_twice': (exr(channels(b'R', b'R')), "two channels are called R; each needs its own name"),
    'channels_cut': (exr(attribute(b'channels', b'chlist', b'R\0\1')), "the list of channels ends too"),
    'channel_type': (exr(channels(b'R', kind=3)), "the channel R has the type 3; it must be 0 (UINT)"),
    'no_colour': (exr(channels(b'Z')), "there is no colour; R, G and B or Y of type HALF or FLOAT"),
    'chroma': (exr(channels(b'BY', b'RY', b'Y')), "the picture is luminance-chroma (Y, RY, BY)"),
    'deep': (exr(channels(b'Y'), flags=DEEP), "the picture is deep data, which is not read; it must"),
    'subsampled': (exr(channels(b'Y', sampling=2), *GOOD[1:]), "the channel Y is subsampled"),
    'no_window': (exr(*GOOD[:2]), "the attribute dataWindow is missing; each part needs one"),
    'no_tiles': (exr(*GOOD, flags=TILES), "the attribute tiles is missing; a part of tiles needs it"),
    'tiles_0': (exr(*GOOD, attribute(b'tiles', b'tiledesc', bytes(9)), flags=TILES),
                "the tiles have 0x0 pixels; both sides must be at least 1"),
    'no_compression': (exr(GOOD[0], GOOD[2]), "the attribute compression is missing; each part needs"),
    'dwaa': (exr(GOOD[0], compression(8), GOOD[2]), "the compression DWAA is not read; what can be"),
    'code_99': (exr(GOOD[0], compression(99), GOOD[2]), "the compression number 99 is not read"),
    'zero': (exr(*GOOD[:2], window(-1, 0)), "the size 0x1 is not possible; both sides must be 1"),
    'billion': (exr(*GOOD[:2], window(31999, 31999)), "the size 32000x32000 is too large"),
    'no_offsets': (exr(*GOOD), "the file is too short for the offsets of 1 blocks; it is cut off"),
    'promises': (exr(*GOOD[:2], window(9999, 0), body=bytes(8)),
                 "the file is too short for 10000x1 pixels"),
    'no_count': (exr(channels(b'Z'), b'\0', *GOOD, b'\0', flags=PARTS),
                 "the attribute chunkCount of part 0 is missing; each part of several needs it"),
    'count': (exr(channels(b'Z'), attribute(b'chunkCount', b'int', b'\x99\0\0\0'), b'\0', *GOOD, b'\0',
                  flags=PARTS), "the file ends in the middle of the offsets; it is cut off"),
    'offset': (exr(*GOOD, body=struct.pack('<Q', 9999)), "its offset 9999 is not in the file"),
    'other_block': (block(bytes(8), NONE, numbers=(7,)), "is missing: another one is at its offset"),
    'block_cut': (block(bytes(7), NONE, size=8), "is missing: the file ends in the middle of it"),
    'block_empty': (block(b'', ZIPS, width=4000), "is missing: 0 bytes cannot hold 8000"),
    'block_large': (block(bytes(9), NONE), "a block has 9 bytes; its pixels need 8"),
    'zip_broken': (block(b'\x78\x9d' + bytes(20), ZIPS, width=50), "broken compressed data: it does not start as a zlib"),
    'zip_short': (block(zlib.compress(bytes(90)), ZIP, width=50),
                  "broken compressed data: it unpacks to 90 bytes instead of 100; the file is damaged"),
    'rle_cut': (block(b'\xfbab', RLE), "broken RLE data: it ends in the middle of a run; the file"),
    'rle_long': (block(b'\x07a\x07a', RLE), "broken RLE data: it unpacks to more than 8 bytes"),
    'rle_short': (block(b'\x03a', RLE), "broken RLE data: it unpacks to 4 bytes instead of 8"),
    'piz_header': (block(b'\0', PIZ), "broken PIZ data: it ends in the middle of its header"),
    'piz_set': (block(struct.pack('<HH', 0, 9000), PIZ), "broken PIZ data: its set of numbers is too"),
    'piz_numbers': (block(struct.pack('<HH', 0, 9), PIZ),
                    "broken PIZ data: it ends in the middle of its numbers"),
    'piz_no_codes': (block(struct.pack('<HH', 1, 0), PIZ), "broken PIZ data: it has no codes; the file"),
    'piz_codes': (block(piz(b'abc', 9), PIZ, width=64), "broken PIZ data: 3 bytes of codes instead of 9"),
    'piz_symbols': (coded(table(1, 0, (1, 1), b'', 0)), "its symbols are 1 to 0; at most 0 to 65536"),
    'piz_lengths': (coded(table(0, 1, (1, 2), b'', 0)), "the lengths of its codes are not possible"),
    'piz_more_lengths': (coded(table(0, 0, (59,), b'', 0)), "more lengths of codes than promised"),
    'piz_no_code': (coded(table(0, 1, (1, 0), b'\xff\xff', 16)), "a code that stands for nothing"),
    'piz_bits': (coded(table(0, 1, (1, 1), b'', 99)), "it ends in the middle of its codes"),
    'piz_code_cut': (coded(table(0, 1, (1, 1), b'\0', 8)), "it ends in the middle of a code"),
    'piz_run_first': (coded(table(0, 1, (1, 1), b'\xff\xff', 16)), "a run without a number before it"),
    'piz_run_long': (coded(table(0, 1, (1, 1), b'\x7f\xff', 16)), "more numbers than pixels; the file"),
}

for kind, extension, cases in (('jpeg', 'jpg', JPEG), ('hdr', 'hdr', HDR), ('tga', 'tga', TGA),
                               ('exr', 'exr', EXR)):
    for name, (data, words) in cases.items():
        open(f'{kind}_{name}.{extension}', 'wb').write(data)
        open(f'{kind}_{name}.expect', 'w').write(words + '\n')
