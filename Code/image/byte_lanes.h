// ByteLanes: what picture writing does with many bytes at a time, once for each width of registers.
// All give the same bytes.
// Private to image/.
#pragma once

#include "base/raw_vector.h"
#include "image/png.h"
#include "image/word_codes.h"

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

// Adler-32's sums without their modulus: a of the bytes, b of a after each byte.
struct AdlerSums {
    std::uint32_t a, b;
};

using CrcBytes = std::array<std::uint8_t, 16>;
// CRC-32's (ISO 3309), as shifts to the right want it: x^31 lowest, and x^32 left out.
inline constexpr std::uint32_t kCrcPolynomial = 0xEDB88320;

struct ByteLanes {
    const char* name;
    bool (*supported)(); // by this CPU

    // Writes the row to `out` with that filter or, without one, with the filter whose bytes, as
    // signed numbers without their signs, have the smallest sum (PNG specification, 12.7; of equal
    // sums the first filter). A row that is as the one above gets None or Up in any case. Returns
    // which. `above` is as long; zeros for the first row.
    PngFilter (*filterRow)(std::span<const std::uint8_t> row, std::span<const std::uint8_t> above,
                           std::size_t pixelBytes, std::optional<PngFilter> filter,
                           std::span<std::uint8_t> out);
    // Where the bytes that aren't zero stand, in order; false where there are more than `most`, of
    // which some are left out then.
    bool (*nonzeroPlaces)(std::span<const std::uint8_t> bytes, std::size_t most,
                          RawVector<std::uint32_t>& places);
    // Writes the words with their codes; there is room. (Nothing in it is done in lanes, but shifts
    // that leave the flags alone come with AVX2's CPUs and spare a fifth.)
    void (*putWords)(BitWriter& out, const WordList& words, const WordCodes& codes);
    // Adds bytes, so few that the sums stay below 2^32: from the front as many as make whole
    // blocks, which is what it returns; less than 512 are left.
    std::size_t (*addToAdler)(AdlerSums& sums, std::span<const std::uint8_t> bytes);
    // Folds the first of the bytes, as many as it returns, maybe none, into 16: these make of 0
    // what the others make of `crc`, a CRC-32 without the inversions at its start and end.
    std::size_t (*foldForCrc)(std::uint32_t crc, std::span<const std::uint8_t> bytes,
                              CrcBytes& folded);
};

// The widest first.
std::span<const ByteLanes> allByteLanes();
// The widest that this CPU has.
const ByteLanes& byteLanes();

// Which of 64 bytes aren't zero, the first one lowest, and how many.
struct Nonzero {
    std::uint64_t mask = 0;
    std::size_t count = 0;
};
// Writes their places, counted from `at` on, and up to kTooManyPlaces more of any value.
inline constexpr std::size_t kTooManyPlaces = 16;
inline std::size_t nonzeroPlacesOf(Nonzero nonzero, std::size_t at, std::uint32_t* out) {
    // In groups, whose number the processor guesses more often than that of the places.
    constexpr std::size_t kGroup = 4;
    for (std::size_t i = 0; i < nonzero.count; i += kGroup)
        for (std::size_t k = 0; k < kGroup; ++k, nonzero.mask &= nonzero.mask - 1)
            out[i + k] = static_cast<std::uint32_t>(
                at + static_cast<std::size_t>(std::countr_zero(nonzero.mask)));
    return nonzero.count;
}
