// Deflate for bytes of which many are zero, as those of a filtered picture: runs of zeros and
// single bytes, found without a search. Private to image/.
#pragma once

#include "image/bit_writer.h"

#include <cstdint>
#include <span>

// Writes all of the bytes as one block. False, and nothing is written, where half of them aren't
// zero or there are too many for one block.
bool putZeroRuns(BitWriter& out, std::span<const std::uint8_t> bytes, bool last);
