#!/usr/bin/env python3
"""Writes the broken pictures beside it, each with NAME.expect: words of the message.
tests/unit/test_image.cpp reads them all. Needs nothing but Python; run it in its folder."""
import struct
import zlib


def chunk(kind, data, crc=None):
    crc = zlib.crc32(kind + data) if crc is None else crc
    return struct.pack('>I', len(data)) + kind + data + struct.pack('>I', crc)


SIGNATURE = b'\x89PNG\r\n\x1a\n'
END = chunk(b'IEND', b'')


def header(width=2, height=2, depth=8, kind=2, compression=0, filtering=0, interlace=0):
    return SIGNATURE + chunk(b'IHDR', struct.pack('>IIBBBBB', width, height, depth, kind,
                                                  compression, filtering, interlace))


ROWS = b'\0\1\2\3\4\5\6' * 2
DATA = zlib.compress(ROWS)
PIXELS = chunk(b'IDAT', DATA)


def raw(body, rows=ROWS):
    """A zlib stream whose deflate part is `body`."""
    return header() + chunk(b'IDAT', b'\x78\x9c' + body + struct.pack('>I', zlib.adler32(rows))) + END


def bits(*fields):
    """Fields (value, count) from the lowest bit on; Huffman codes as text, first bit first."""
    out, at = 0, 0
    for field in fields:
        if isinstance(field, str):
            for bit in field:
                out |= int(bit) << at
                at += 1
        else:
            out |= field[0] << at
            at += field[1]
    return out.to_bytes((at + 7) // 8 + 4, 'little')


def dynamic(literals, distances, lengths, *rest):
    """A dynamic block header: counts, then the lengths of the code-length code in file order."""
    return bits((1, 1), (2, 2), (literals - 257, 5), (distances - 1, 5), (len(lengths) - 4, 4),
                *[(n, 3) for n in lengths], *rest)


CASES = {
    # PPM and PGM
    'ppm_magic_only.ppm': (b'P6', ":1:3: error: the file ends where the width should be"),
    'ppm_no_height.ppm': (b'P6\n3 ', ":2:3: error: the file ends where the height should be"),
    'ppm_word_for_width.ppm': (b'P6\nwide 2\n255\n',
                               ":2:1: error: the width is 'wide'; it must be a whole number"),
    'ppm_negative.ppm': (b'P6\n-2 2\n255\n' + bytes(12), ":2:1: error: the width is '-2'"),
    'ppm_zero_width.ppm': (b'P6\n0 2\n255\n', "the size 0x2 is not possible; both sides must be 1"),
    'ppm_too_wide.ppm': (b'P6\n65536 1\n255\n' + bytes(9), "the size 65536x1 is not possible"),
    'ppm_billion.ppm': (b'P6\n32000 32000\n255\n' + bytes(9), "the size 32000x32000 is too large"),
    'ppm_promises.ppm': (b'P6\n16000 16000\n255\n' + bytes(9),
                         "the header promises 768000000 bytes of pixels, 9 follow it"),
    'ppm_overflow.ppm': (b'P6\n99999999999999999999 2\n255\n', ":2:1: error: the width is '99999999"),
    'ppm_fraction.ppm': (b'P6\n2.5 2\n255\n', ":2:1: error: the width is '2.5'"),
    'ppm_maxval_0.ppm': (b'P6\n# comment\n2 2\n0\n' + bytes(12),
                         ":4:1: error: the maxval is 0; it must be 1 to 65535"),
    'ppm_maxval_65536.ppm': (b'P6\n2 2 65536\n' + bytes(24), ":2:5: error: the maxval is 65536"),
    'ppm_truncated.ppm': (b'P6\n2 2\n255\n' + bytes(11),
                          "the header promises 12 bytes of pixels, 11 follow it"),
    'ppm_truncated_16.ppm': (b'P6\n2 2\n65535\n' + bytes(23),
                             "the header promises 24 bytes of pixels, 23 follow it"),
    'ppm_no_data.ppm': (b'P6\n2 2\n255', "the header promises 12 bytes of pixels, 0 follow it"),
    'ppm_above_maxval.ppm': (b'P6\n1 1\n100\n\x64\x65\x00',
                             "the sample 101 is larger than the maxval 100"),
    'ppm_text_above_maxval.ppm': (b'P3\n2 1\n255\n0 0 0\n0 256 0\n',
                                  ":5:3: error: the sample '256' is not a whole number from 0 to 255"),
    'ppm_text_word.ppm': (b'P3\n2 1\n255\n0 0 0\n0 red 0\n', ":5:3: error: the sample 'red'"),
    'ppm_text_garbage.ppm': (b'P3\n2 1\n255\n0 0 0\n0 \x01\xff\x02 0 \n', ":5:3: error: the sample '???'"),
    'ppm_text_negative.ppm': (b'P3\n2 1\n255\n0 0 -1 0 0 0\n', ":4:5: error: the sample '-1'"),
    'ppm_text_short.ppm': (b'P3\n2 1\n255\n100 100 100 20 20\n',
                           ":5:1: error: the file ends too early; more samples must follow"),
    'ppm_text_promises.ppm': (b'P3\n9000 9000\n255\n0 0 0\n',
                              "the header promises 243000000 samples, only 7 bytes follow it"),
    'ppm_text_long.ppm': (b'P3\n1 1\n255\n0 0 0 7\n', ":4:7: error: more samples than 1x1x3"),
    'ppm_comment_to_end.ppm': (b'P3\n# 2 2 255', ":2:10: error: the file ends where the width"),
    'pgm_truncated.pgm': (b'P5\n2 2\n255\nabc', "the header promises 4 bytes of pixels, 3 follow it"),
    'pbm.ppm': (b'P4\n8 1\n\xaa', "this is a bitmap (PBM); what can be read: PPM, PNG, PFM"),
    # PFM
    'pfm_truncated.pfm': (b'PF\n1 1\n-1.0\n' + bytes(11), "promises 12 bytes of pixels, 11 follow it"),
    'pfm_scale_0.pfm': (b'PF\n1 1\n0\n' + bytes(12), ":3:1: error: the scale is '0'; it must be"),
    'pfm_scale_word.pfm': (b'PF\n1 1\nlittle\n' + bytes(12), ":3:1: error: the scale is 'little'"),
    'pfm_scale_nan.pfm': (b'PF\n1 1\nnan\n' + bytes(12), ":3:1: error: the scale is 'nan'"),
    'pfm_nan.pfm': (b'PF\n2 1\n-1\n' + struct.pack('<6f', 0, 0, 0, 0, float('nan'), 0),
                    "the pixel 1,0 is not a finite number"),
    'pfm_infinite.pfm': (b'Pf\n1 2\n-1\n' + struct.pack('<2f', float('inf'), 0),
                         "the pixel 0,1 is not a finite number"),
    'pfm_zero.pfm': (b'PF\n0 0\n-1\n', "the size 0x0 is not possible"),
    'pfm_promises.pfm': (b'PF\n16384 16384\n-1\n', "promises 3221225472 bytes of pixels, 0 follow it"),
    # PNG: chunks
    'png_signature.png': (b'\x89PNG\n\x1a\n' + bytes(40), "the PNG signature is damaged"),
    'png_signature_only.png': (SIGNATURE, "the file ends before the IEND chunk"),
    'png_short_chunk.png': (SIGNATURE + b'\0\0\0\x0dIHDR', "ends in the middle of a chunk"),
    'png_long_chunk.png': (header() + b'\x7f\xff\xff\xffIDAT' + bytes(20),
                           "the file ends in the middle of the IDAT chunk"),
    'png_no_chunk.png': (header() + bytes(40), "no chunk starts at byte 33"),
    'png_no_header.png': (SIGNATURE + PIXELS + END, "the first chunk is not IHDR"),
    'png_two_headers.png': (header() + header()[8:] + PIXELS + END, "there are two IHDR chunks"),
    'png_header_length.png': (SIGNATURE + chunk(b'IHDR', bytes(12)), "the IHDR chunk has 12 bytes; 13"),
    'png_header_crc.png': (header()[:-1] + b'?' + PIXELS + END,
                           "the checksum (CRC) of the IHDR chunk does not fit"),
    'png_data_crc.png': (header() + chunk(b'IDAT', DATA, 1) + END,
                         "the checksum (CRC) of the IDAT chunk does not fit"),
    'png_no_end.png': (header() + PIXELS, "the file ends before the IEND chunk"),
    'png_no_pixels.png': (header() + END, "there is no IDAT chunk"),
    'png_critical.png': (header() + chunk(b'NEWS', b'?') + PIXELS + END,
                         "the chunk NEWS is necessary for the picture, but unknown"),
    'png_split_pixels.png': (header() + chunk(b'IDAT', DATA[:5]) + chunk(b'tEXt', b'a\0b') +
                             chunk(b'IDAT', DATA[5:]) + END, "the IDAT chunks do not follow each other"),
    # PNG: header
    'png_zero.png': (header(0, 2) + PIXELS + END, "the size 0x2 is not possible"),
    'png_too_wide.png': (header(0xFFFFFFFF, 2) + PIXELS + END, "the size 4294967295x2 is not possible"),
    'png_billion.png': (header(32000, 32000) + PIXELS + END, "the size 32000x32000 is too large"),
    'png_promises.png': (header(16000, 16000) + PIXELS + END,
                         "the file is too short for 16000x16000 pixels"),
    'png_depth_3.png': (header(depth=3) + PIXELS + END, "the bit depth is 3; with colour type 2"),
    'png_depth_4_rgb.png': (header(depth=4) + PIXELS + END, "it must be one of 8, 16"),
    'png_depth_16_palette.png': (header(depth=16, kind=3) + PIXELS + END, "must be one of 1, 2, 4, 8"),
    'png_depth_0.png': (header(depth=0, kind=0) + PIXELS + END, "the bit depth is 0"),
    'png_colour_type.png': (header(kind=5) + PIXELS + END, "the colour type is 5; it must be 0, 2, 3"),
    'png_compression.png': (header(compression=1) + PIXELS + END, "the compression method is 1"),
    'png_filtering.png': (header(filtering=9) + PIXELS + END, "the filter method is 9"),
    'png_interlace.png': (header(interlace=2) + PIXELS + END, "the interlace method is 2"),
    # PNG: palette and transparency
    'png_no_palette.png': (header(kind=3) + PIXELS + END, "the PLTE chunk is missing"),
    'png_palette_length.png': (header(kind=3) + chunk(b'PLTE', b'1234') + PIXELS + END,
                               "the PLTE chunk has 4 bytes; 3 for each"),
    'png_two_palettes.png': (header(kind=3) + chunk(b'PLTE', b'123') * 2 + PIXELS + END,
                             "there are two PLTE chunks"),
    'png_late_palette.png': (header(kind=3) + PIXELS + chunk(b'PLTE', b'123') + END,
                             "the PLTE chunk comes after the pixels"),
    'png_palette_index.png': (header(kind=3) + chunk(b'PLTE', b'123456') +
                              chunk(b'IDAT', zlib.compress(b'\0\0\1\0\1\2')) + END,
                              "a pixel has colour 2, but the palette has only 2"),
    'png_trns_early.png': (header(kind=3) + chunk(b'tRNS', b'1') + PIXELS + END,
                           "the tRNS chunk comes before the PLTE chunk"),
    'png_trns_late.png': (header() + PIXELS + chunk(b'tRNS', bytes(6)) + END,
                          "the tRNS chunk comes after the pixels"),
    'png_trns_long.png': (header(kind=3) + chunk(b'PLTE', b'123') + chunk(b'tRNS', b'12') + PIXELS + END,
                          "the tRNS chunk has more entries than the palette"),
    'png_trns_length.png': (header() + chunk(b'tRNS', b'12') + PIXELS + END,
                            "the tRNS chunk has 2 bytes; 6"),
    'png_trns_alpha.png': (header(kind=6) + chunk(b'tRNS', b'12') + PIXELS + END,
                           "the pixels have alpha already"),
    # PNG: rows and the zlib stream
    'png_filter.png': (header() + chunk(b'IDAT', zlib.compress(ROWS[:7] + b'\5' + ROWS[8:])) + END,
                       "row 1 has the filter 5; it must be 0 to 4"),
    'png_too_few.png': (header() + chunk(b'IDAT', zlib.compress(ROWS[:-1])) + END,
                        "it unpacks to 13 bytes instead of 14"),
    'png_too_many.png': (header() + chunk(b'IDAT', zlib.compress(ROWS + b'?')) + END,
                         "it unpacks to more than 14 bytes"),
    'png_adler.png': (header() + chunk(b'IDAT', DATA[:-1] + b'?') + END,
                      "its checksum (Adler-32) does not fit"),
    'png_stream_short.png': (header() + chunk(b'IDAT', DATA[:-6]) + END,
                             "the file ends in the middle of it"),
    'png_stream_tiny.png': (header() + chunk(b'IDAT', DATA[:3]) + END,
                            "the file ends in the middle of it"),
    'zlib_header.png': (header() + chunk(b'IDAT', b'\x78\x9d' + DATA[2:]) + END,
                        "it does not start as a zlib stream"),
    'zlib_method.png': (header() + chunk(b'IDAT', b'\x77\x05' + DATA[2:]) + END,
                        "it does not start as a zlib stream"),
    'zlib_dictionary.png': (header() + chunk(b'IDAT', b'\x78\xbb' + DATA[2:]) + END,
                            "it wants a preset dictionary"),
    'zlib_block_kind.png': (raw(b'\x07'), "a block of unknown kind"),
    'zlib_stored_length.png': (raw(b'\x01\x0e\x00\xf0\xff' + ROWS), "a stored block contradicts its length"),
    'zlib_stored_short.png': (raw(b'\x01\xff\x00\x00\xff'), "the file ends in the middle of it"),
    'zlib_stored_long.png': (raw(b'\x01\x0f\x00\xf0\xff' + ROWS + b'?'), "it unpacks to more than 14 bytes"),
    # Fixed codes: literal 1 is 00110001, length 3 is 0000001, distance 1 is 00000, 2 is 00001.
    'zlib_distance.png': (raw(bits((1, 1), (1, 2), '00110001', '0000001', '00001')),
                          "a distance that reaches before the start"),
    'zlib_distance_first.png': (raw(bits((1, 1), (1, 2), '0000001', '00000')),
                                "a distance that reaches before the start"),
    'zlib_distance_code.png': (raw(bits((1, 1), (1, 2), '00110001', '0000001', '11110')),
                               "an unknown distance"),
    'zlib_length_code.png': (raw(bits((1, 1), (1, 2), '00110001', '11000110')),
                             "an unknown match length"),
    'zlib_too_many_codes.png': (raw(dynamic(288, 30, [1] * 4)), "more codes than there are"),
    'zlib_oversubscribed_lengths.png': (raw(dynamic(257, 1, [1, 1, 1, 0])),
                                        "the code-length code has too many codes"),
    'zlib_incomplete_lengths.png': (raw(dynamic(257, 1, [2, 2, 2, 0])),
                                    "the code-length code leaves codes unused"),
    # Code-length code: 16 -> 0, 0 -> 1 (one bit each): the first length is a repetition.
    'zlib_repeat_nothing.png': (raw(dynamic(257, 1, [1, 0, 0, 1], '1')),
                                "a repeated code length without a first"),
    # 18 -> 1 (138 zeros), 0 -> 0: three times 138 are more than 258.
    'zlib_repeat_too_many.png': (raw(dynamic(257, 1, [0, 0, 1, 1], '1', (127, 7), '1', (127, 7))),
                                 "more code lengths than promised"),
    # 18 -> 1, 0 -> 0: all 258 lengths zero, so the block cannot end.
    'zlib_no_block_end.png': (raw(dynamic(257, 1, [0, 0, 1, 1], '1', (127, 7), '1', (109, 7))),
                              "a block without an end"),
    # 1 (the 18th in file order) -> 0, 18 -> 1: three literals of length 1.
    'zlib_oversubscribed.png': (raw(dynamic(257, 1, [0, 0, 1] + [0] * 14 + [1], '000', '1', (127, 7),
                                            '1', (104, 7), '0', '0')),
                                "the literal code has too many codes"),
    # 2 (the 16th) -> 0, 18 -> 1: literals 0 and 256 with two bits each use half of the codes.
    'zlib_incomplete.png': (raw(dynamic(257, 1, [0, 0, 1] + [0] * 12 + [1], '0', '1', (127, 7), '1',
                                        (106, 7), '0', '0')),
                            "the literal code leaves codes unused"),
    # Other files
    'empty.png': (b'', "the file is empty; what can be read: PPM, PNG, PFM"),
    'garbage.png': (bytes(range(7, 200)), "the file is no picture of a known kind"),
    'jpeg.png': (b'\xff\xd8\xff\xe0\0\x10JFIF', "the file ends in the middle of a segment"),
    'exr.exr': (b'\x76\x2f\x31\x01\2\0\0\0', "the file ends in the middle of the header"),
}

for name, (data, words) in CASES.items():
    open(name, 'wb').write(data)
    open(name.rsplit('.', 1)[0] + '.expect', 'w').write(words + '\n')
