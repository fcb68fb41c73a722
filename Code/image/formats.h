// The readers and writers of the file formats, one source file each; image.cpp chooses.
// Private to image/.
#pragma once

#include "image/image.h"

#include <cstdint>
#include <span>
#include <string>
#include <vector>

using Bytes = std::span<const std::uint8_t>;

// All fail (ErrorKind::Input) with "name: error: what; what would be right", text parts with
// "name:line:col". The size in the header is checked against the bytes before memory is taken.
StoredImage decodePpm(Bytes file, const std::string& name);
StoredImage decodePfm(Bytes file, const std::string& name);
StoredImage decodePng(Bytes file, const std::string& name);

void encodePpm(const Image& image, Encoding encoding, int threads, const ByteSink& use);
void encodePfm(const Image& image, int threads, const ByteSink& use);
void encodePng(const Image& image, Encoding encoding, int threads, const ByteSink& use);

// Fails unless both sides are in 1..kMaxSide and the area is at most kMaxPixels.
void checkSize(long long width, long long height, const std::string& name);

// Pixels as 8-bit or 16-bit (high byte first) codes; `out` has 3 * bits / 8 bytes per pixel.
void encodePixels(std::span<const Rgb> pixels, Encoding encoding, std::span<std::uint8_t> out);
