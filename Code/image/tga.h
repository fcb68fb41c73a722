// The reader of Truevision TGA pictures (Truevision TGA File Format Specification, version 2.0).
// Private to image/.
#pragma once

#include "image/formats.h"

#include <string>

// Returns whether the file may be a TGA picture. Only version 2.0 has a signature, at the end of
// the file; without it all bytes of the header must be possible. So other files look like one, too:
// to be called when no format with a signature fits.
bool looksLikeTga(Bytes file);

// Computes the picture of a TGA file: types 1, 2 and 3 (colour-mapped, true-colour, grey) and 9, 10
// and 11 (the same run-length encoded), from any corner. Mapped and true colours have 15, 16, 24 or
// 32 bits, grey has 8, or 16 with alpha; 5 bits become value * 255 / 31, rounded down. There are
// 1 or 3 channels, and one more where the descriptor says that the bits beyond the colour are alpha
// (8 of 32 bits, 1 of 16, 8 of 16 beside grey); else these bits are left out. Fails
// (ErrorKind::Input) with `name` when the file is broken or too short, or of another type.
StoredImage decodeTga(Bytes file, const std::string& name);
