// Deflate for bytes that are nearly all zero, as those of a filtered picture with little in it:
// runs of zeros and single bytes, found without a search.
// Private to image/.
#pragma once

#include "image/bit_writer.h"

#include <cstdint>
#include <span>

// Writes all of the bytes as one block. False, and nothing is written, where too few of them are
// zero or the others come again so often that matches are worth their search.
bool putZeroRuns(BitWriter& out, std::span<const std::uint8_t> bytes, bool last);
