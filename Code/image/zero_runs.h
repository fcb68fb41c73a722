// Deflate for bytes of which many are zero, as those of a filtered picture: runs of zeros and
// single bytes, found without a search. Private to image/.
#pragma once

#include "image/bit_writer.h"

#include <cstddef>
#include <cstdint>
#include <span>

// More bytes than one in so many that aren't zero are packed faster another way.
inline constexpr std::size_t kBytesPerNonzero = 2;

// Writes all of the bytes as one block. False, and nothing is written, where more of them aren't
// zero, they are too many for one block, or some gap of zeros takes too many bits.
bool putZeroRuns(BitWriter& out, std::span<const std::uint8_t> bytes, bool last);
