// What the two parts of the reader of Radiance HDR pictures share (G. Ward, "Real Pixels", Graphics
// Gems II; Radiance reference manual, "File Formats", pictures): the header and the scanlines.
// Private to image/.
#pragma once

#include "image/formats.h"

#include <array>
#include <cstddef>
#include <string>

// What the text in front of the scanlines says.
struct HdrHeader {
    int width = 0, height = 0;
    // The file has `lines` scanlines of `length` pixels: rows or columns, from any corner. Pixel j
    // of scanline i is number start + i * lineStep + j * pixelStep of the picture, whose pixels are
    // counted row after row from the top.
    std::size_t lines = 0, length = 0;
    std::ptrdiff_t start = 0, lineStep = 0, pixelStep = 0;
    // The product of all EXPOSURE and COLORCORR lines: what red, green and blue were multiplied by
    // before they were stored. Each is in 1e-30 .. 1e30.
    std::array<double, 3> exposure{1, 1, 1};
    std::size_t dataStart = 0; // where the first scanline begins in the file
};

// Reads the lines up to and with the one of the resolution. Fails (ErrorKind::Input) with
// "name:line:1" when a line is not as it must be, and when the pixels are XYZE.
HdrHeader readHdrHeader(Bytes file, const std::string& name);

// Computes the picture of a Radiance HDR file with RGBE pixels: three floats per pixel, each
// mantissa * 2^(exponent - 136), divided by what the header says the values were multiplied by; an
// exponent of 0 is black. Scanlines may be flat or packed by either of the two run-length codes.
// Fails (ErrorKind::Input) with `name` when the file is broken or too short, before it takes memory
// for the pixels, and when a value is too large for a float.
StoredImage decodeHdr(Bytes file, const std::string& name);
