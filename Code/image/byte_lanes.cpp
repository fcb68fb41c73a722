// The table of byte lanes, and those of any machine: 16 bytes are one register on all of them.
#include "image/byte_lanes.h"

#include "base/cpu.h"
#include "image/little_endian.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <utility>

namespace byte_lanes {
#if defined(__x86_64__)
namespace avx2 {
PngFilter filterRow(std::span<const std::uint8_t>, std::span<const std::uint8_t>, std::size_t,
                    std::optional<PngFilter>, std::span<std::uint8_t>);
bool nonzeroPlaces(std::span<const std::uint8_t>, std::size_t, RawVector<std::uint32_t>&);
void putWords(BitWriter&, const WordList&, const WordCodes&);
std::size_t addToAdler(AdlerSums&, std::span<const std::uint8_t>);
std::size_t foldForCrc(std::uint32_t, std::span<const std::uint8_t>, CrcBytes&);
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
std::size_t nonzeroPlaces64(const std::uint8_t* from, std::size_t at, std::uint32_t* out) {
    return nonzeroPlacesOf(nonzeroOf64(from), at, out);
}
bool isZero64(const std::uint8_t* from) {
    std::uint64_t any = 0;
    for (unsigned i = 0; i < 8; ++i) any |= loadLittle<std::uint64_t>(from + 8 * i);
    return any == 0;
}

// Lane by lane, `bytes` are the sums of the bytes and `before` of what these were before each
// vector.
constexpr std::size_t kVectors = 23; // 255 * 23 * 22 / 2 < 2^16
constexpr std::size_t kBlock = kVector * kVectors;
void addBlock(AdlerSums& sums, const std::uint8_t* from) {
    using Pairs __attribute__((vector_size(kVector))) = std::uint16_t;
    constexpr int kFirst = std::endian::native == std::endian::little ? 0 : 8;
    Pairs firstBytes{}, secondBytes{}, firstBefore{}, secondBefore{}; // of each two bytes
    for (std::size_t i = 0; i < kVectors; ++i) {
        Pairs pairs;
        std::memcpy(&pairs, from + i * kVector, sizeof pairs);
        firstBefore += firstBytes;
        secondBefore += secondBytes;
        firstBytes += pairs >> kFirst & 0xFF;
        secondBytes += pairs >> (8 - kFirst) & 0xFF;
    }
    std::uint32_t sum = 0, before = 0, inVector = 0;
    for (std::size_t k = 0; k < kVector / 2; ++k) {
        const auto weight = static_cast<std::uint32_t>(kVector - 2 * k);
        sum += std::uint32_t{firstBytes[k]} + secondBytes[k];
        before += std::uint32_t{firstBefore[k]} + secondBefore[k];
        inVector += weight * firstBytes[k] + (weight - 1) * secondBytes[k];
    }
    sums.b += static_cast<std::uint32_t>(kBlock) * sums.a +
              static_cast<std::uint32_t>(kVector) * before + inVector;
    sums.a += sum;
}
std::size_t addToAdler(AdlerSums& sums, std::span<const std::uint8_t> bytes) {
    std::size_t at = 0;
    for (; at + kBlock <= bytes.size(); at += kBlock) addBlock(sums, &bytes[at]);
    return at;
}

// Tables are as fast as what could be done here.
std::size_t foldForCrc(std::uint32_t, std::span<const std::uint8_t>, CrcBytes&) { return 0; }

bool always() { return true; }

} // namespace

#include "image/nonzero_places.inl"
#include "image/png_filter.inl"
#include "image/put_words.inl"

} // namespace plain
} // namespace byte_lanes

#if defined(__x86_64__)
namespace {
bool hasAvx2Bytes() { return hasAvx2() && hasCarrylessProducts(); }
} // namespace
#endif

std::span<const ByteLanes> allByteLanes() {
    using namespace byte_lanes;
    static constexpr ByteLanes kTable[] = {
#if defined(__x86_64__)
        {"avx2", hasAvx2Bytes, avx2::filterRow, avx2::nonzeroPlaces,
         avx2::putWords, avx2::addToAdler, avx2::foldForCrc},
#endif
        {"plain", plain::always, plain::filterRow, plain::nonzeroPlaces,
         plain::putWords, plain::addToAdler, plain::foldForCrc},
    };
    return kTable;
}

const ByteLanes& byteLanes() {
    static const ByteLanes& widest =
        *std::find_if(allByteLanes().begin(), allByteLanes().end(),
                      [](const ByteLanes& lanes) { return lanes.supported(); });
    return widest;
}
