// OpenEXR files (OpenEXR File Layout, version 2; the OpenEXR library where the document is silent):
// linear pictures of 16- or 32-bit floating-point numbers.
#pragma once

#include "image/formats.h"

#include <span>
#include <string>
#include <vector>

// Decodes the data window of a file as Depth::Float with 1 (Y), 2 (Y, A), 3 (R, G, B) or 4 (R, G,
// B, A) channels; the display window is ignored. Reads parts of scan lines and of tiles (of those
// the full-resolution level) in any line order, channels of type HALF and FLOAT, and the
// compressions NONE, RLE, ZIPS, ZIP and PIZ.
// The colour is "R", "G", "B"; if a file has no such channels, "P.R", "P.G", "P.B" of the first
// prefix P in alphabetical order that has all three; if there is none either, "Y". The alpha is "A"
// of the same layer. Of several parts the first with R, G and B counts, else the first with Y.
// A StoredImage is finite: infinity becomes the largest float of its sign, and NaN becomes 0.
// Fails (ErrorKind::Input) when the file is damaged or incomplete, and when the picture is deep
// data, luminance-chroma, subsampled or compressed in another way.
StoredImage decodeExr(Bytes file, const std::string& name);

// Some channels of a picture that belong together.
struct ExrLayer {
    std::string name;                  // "" for the beauty, whose channels are "R", "G", "B"
    std::vector<std::string> channels; // "Z" of the layer "depth" is called "depth.Z" in the file
    std::span<const float> values;     // row by row from the top, channels interleaved per pixel
};

// Encodes the layers as one part of scan lines with ZIP compression. All channels are HALF or
// all FLOAT. A HALF is the nearest one, of two equally near the even one; what is too large,
// infinity too, becomes the largest finite HALF. FLOAT values are stored bit for bit.
// The bytes are the same for any number of threads (0: as many as the machine has). The compressed
// picture is held in memory until its size is known, because the table of offsets comes first.
// Fails (ErrorKind::Output) when the size is not possible, when there are no channels, when a
// channel's name is empty, longer than 255 bytes, holds a zero byte or occurs twice, and when a
// layer has not as many values as pixels times channels.
void encodeExr(std::span<const ExrLayer> layers, int width, int height, bool half, int threads,
               ByteSink use);
