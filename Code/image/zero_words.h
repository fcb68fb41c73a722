// Deflate for drafts: bytes in words of eight, of which those that are zero are matches with a zero
// before them. Codes are made for a sample. Takes a third less time than zero_runs.h and, where few
// bytes are zero, run_finder.h, and some percent more room. Private to image/.
#pragma once

#include "image/bit_writer.h"

#include <cstddef>
#include <cstdint>
#include <span>

// Of fewer bytes a sample tells little and spares no time.
inline constexpr std::size_t kLeastOfZeroWords = 32768;

// Writes all of the bytes as one block. False, and nothing is written, where they are fewer or take
// more room than they have, as the sample tells nothing about them.
bool putZeroWords(BitWriter& out, std::span<const std::uint8_t> bytes, bool last);
