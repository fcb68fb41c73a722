// Reads JPEG pictures (ITU-T T.81, JFIF in T.871).
// Private to image/.
#pragma once

#include "image/formats.h"

// Decodes a baseline, extended or progressive picture with 8 bits per sample and Huffman codes
// (SOF0, SOF1, SOF2). One component gives grey (1 channel), three give RGB (3 channels), 8 bits
// each, the rows from the top. Three components are YCbCr unless an Adobe segment or the
// identifiers 'R', 'G', 'B' say that they are RGB already, and no JFIF segment says otherwise.
// Chroma of half the size is interpolated linearly, of any other size repeated. A progressive
// picture may end before all bits of its coefficients have come: those are 0. EXIF segments are
// skipped, and with them the orientation.
//
// Fails (ErrorKind::Input) with "name: error: what; what would be right" for a damaged file, one
// whose last scan is cut off, and for CMYK, YCCK, 12 bits, lossless, hierarchical and arithmetic
// coding. Memory is at most some 8 KB for each byte of the file.
StoredImage decodeJpeg(Bytes file, const std::string& name);
