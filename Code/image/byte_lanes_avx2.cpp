// Byte lanes for the registers of AVX2.
#include "image/byte_lanes.h"

#if defined(__x86_64__)
#include "base/target.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <immintrin.h>
#include <numeric>
#include <utility>

KERNEL_REGION_BEGIN("avx2,fma,bmi,bmi2,lzcnt,popcnt,pclmul")
namespace byte_lanes::avx2 {
namespace {

constexpr std::size_t kVector = 32;

__m256i load32(const std::uint8_t* from) {
    __m256i bytes;
    std::memcpy(&bytes, from, sizeof bytes);
    return bytes;
}
std::uint32_t zerosOf32(const std::uint8_t* from) {
    const __m256i areZero = _mm256_cmpeq_epi8(load32(from), _mm256_setzero_si256());
    return static_cast<std::uint32_t>(_mm256_movemask_epi8(areZero));
}
Nonzero nonzeroOf64(const std::uint8_t* from) {
    const std::uint64_t mask = ~(zerosOf32(from) | std::uint64_t{zerosOf32(from + 32)} << 32);
    return {mask, static_cast<std::size_t>(_mm_popcnt_u64(mask))};
}
std::size_t nonzeroPlaces64(const std::uint8_t* from, std::size_t at, std::uint32_t* out) {
    return nonzeroPlacesOf(nonzeroOf64(from), at, out);
}
bool isZero64(const std::uint8_t* from) {
    const __m256i any = _mm256_or_si256(load32(from), load32(from + 32));
    return _mm256_testz_si256(any, any) != 0;
}

std::uint32_t sumOfLanes(__m256i lanes) {
    std::array<std::uint32_t, 8> parts;
    std::memcpy(parts.data(), &lanes, sizeof lanes);
    return std::accumulate(parts.begin(), parts.end(), std::uint32_t{0});
}

__m128i load16(const std::uint8_t* from) {
    __m128i bytes;
    std::memcpy(&bytes, from, sizeof bytes);
    return bytes;
}
// x^n modulo CRC-32's polynomial, with the highest bit first and the rest behind it in 33.
constexpr std::uint64_t powerOfX(unsigned n) {
    std::uint32_t power = 1u << 31;
    for (; n > 0; --n) power = (power & 1) != 0 ? power >> 1 ^ kCrcPolynomial : power >> 1;
    return std::uint64_t{power} << 1;
}
// Multiplies by what so many bits behind the sixteen bytes do to them.
template <unsigned kBits> __m128i moved(__m128i bytes) {
    const __m128i powers = _mm_set_epi64x(static_cast<long long>(powerOfX(kBits - 32)),
                                          static_cast<long long>(powerOfX(kBits + 32)));
    return _mm_xor_si128(_mm_clmulepi64_si128(bytes, powers, 0x00),
                         _mm_clmulepi64_si128(bytes, powers, 0x11));
}

} // namespace

// Gopal and others, "Fast CRC Computation for Generic Polynomials Using PCLMULQDQ Instruction"
// (Intel 2009), up to the last sixteen bytes.
std::size_t foldForCrc(std::uint32_t crc, std::span<const std::uint8_t> bytes, CrcBytes& folded) {
    constexpr std::size_t kTurns = 4, kBlock = 16 * kTurns;
    if (bytes.size() < kBlock) return 0;
    __m128i sums[kTurns];
    for (std::size_t k = 0; k < kTurns; ++k) sums[k] = load16(&bytes[16 * k]);
    sums[0] = _mm_xor_si128(sums[0], _mm_cvtsi32_si128(static_cast<int>(crc)));
    std::size_t at = kBlock;
    for (; at + kBlock <= bytes.size(); at += kBlock)
        for (std::size_t k = 0; k < kTurns; ++k)
            sums[k] = _mm_xor_si128(moved<8 * kBlock>(sums[k]), load16(&bytes[at + 16 * k]));
    __m128i sum = sums[0];
    for (std::size_t k = 1; k < kTurns; ++k) sum = _mm_xor_si128(moved<128>(sum), sums[k]);
    std::memcpy(folded.data(), &sum, sizeof sum);
    return at;
}

std::size_t addToAdler(AdlerSums& sums, std::span<const std::uint8_t> bytes) {
    // What a byte adds to b until the end of its vector: it is in as many values of a.
    const __m256i weights =
        _mm256_setr_epi8(32, 31, 30, 29, 28, 27, 26, 25, 24, 23, 22, 21, 20, 19, 18, 17, 16, 15, 14,
                         13, 12, 11, 10, 9, 8, 7, 6, 5, 4, 3, 2, 1);
    const __m256i zero = _mm256_setzero_si256(), ones = _mm256_set1_epi16(1);
    __m256i sum = zero, before = zero, inVectors = zero; // `before`: of `sum` before each vector
    std::size_t at = 0;
    for (; at + kVector <= bytes.size(); at += kVector) {
        const __m256i here = load32(&bytes[at]);
        before = _mm256_add_epi32(before, sum);
        sum = _mm256_add_epi32(sum, _mm256_sad_epu8(here, zero));
        const __m256i pairs = _mm256_maddubs_epi16(here, weights); // at most 255 * 63 < 2^15
        inVectors = _mm256_add_epi32(inVectors, _mm256_madd_epi16(pairs, ones));
    }
    sums.b += static_cast<std::uint32_t>(at) * sums.a +
              static_cast<std::uint32_t>(kVector) * sumOfLanes(before) + sumOfLanes(inVectors);
    sums.a += sumOfLanes(sum);
    return at;
}

#include "image/nonzero_places.inl"
#include "image/png_filter.inl"
#include "image/put_words.inl"

} // namespace byte_lanes::avx2
KERNEL_REGION_END
#endif
