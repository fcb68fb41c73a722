// The table of byte lanes, and those of any machine: 16 bytes are one register on all of them.
#include "image/byte_lanes.h"

#include "base/cpu.h"
#include "image/little_endian.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>

namespace byte_lanes {
#if defined(__x86_64__)
namespace avx2 {
PngFilter filterRow(const PngRow&, const PngRow&, std::size_t, std::span<std::uint8_t>);
bool nonzeroPlaces(std::span<const std::uint8_t>, std::size_t, std::vector<std::uint32_t>&);
} // namespace avx2
#endif

namespace plain {
namespace {

constexpr std::size_t kVector = 16;

Nonzero nonzeroOf64(const std::uint8_t* from) {
    constexpr std::uint64_t kLow = 0x7F7F7F7F7F7F7F7F;
    Nonzero found;
    for (unsigned i = 0; i < 8; ++i) {
        const auto eight = loadLittle<std::uint64_t>(from + 8 * i);
        const std::uint64_t ones = ((((eight & kLow) + kLow) | eight) & ~kLow) >> 7;
        // The products gather the eight bits, and their sum, in the highest byte.
        found.mask |= ones * 0x0102040810204080 >> 56 << 8 * i;
        found.count += ones * 0x0101010101010101 >> 56;
    }
    return found;
}
bool isZero64(const std::uint8_t* from) {
    std::uint64_t any = 0;
    for (unsigned i = 0; i < 8; ++i) any |= loadLittle<std::uint64_t>(from + 8 * i);
    return any == 0;
}

bool always() { return true; }

} // namespace

#include "image/nonzero_places.inl"
#include "image/png_filter.inl"

} // namespace plain
} // namespace byte_lanes

std::span<const ByteLanes> allByteLanes() {
    using namespace byte_lanes;
    static constexpr ByteLanes kTable[] = {
#if defined(__x86_64__)
        {"avx2", hasAvx2, avx2::filterRow, avx2::nonzeroPlaces},
#endif
        {"plain", plain::always, plain::filterRow, plain::nonzeroPlaces},
    };
    return kTable;
}

const ByteLanes& byteLanes() {
    static const ByteLanes& widest =
        *std::find_if(allByteLanes().begin(), allByteLanes().end(),
                      [](const ByteLanes& lanes) { return lanes.supported(); });
    return widest;
}
