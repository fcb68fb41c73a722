// Byte lanes for the registers of AVX-512.
#include "image/byte_lanes.h"

#if defined(__x86_64__)
#include "base/target.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <immintrin.h>

AVX512_REGION_BEGIN
namespace byte_lanes::avx512 {
namespace {

constexpr std::size_t kVector = 64;

} // namespace

bool nonzeroPlaces(std::span<const std::uint8_t> bytes, std::size_t most,
                   RawVector<std::uint32_t>& places) {
    constexpr unsigned kLanes = 16; // of places
    const __m512i inOrder = _mm512_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15);
    places.resize(most + 64 + kLanes);
    std::size_t count = 0, at = 0;
    for (; at + 64 <= bytes.size() && count <= most; at += 64) {
        const __m512i here = _mm512_loadu_si512(&bytes[at]);
        const std::uint64_t mask = _mm512_test_epi8_mask(here, here);
        if (mask == 0) continue;
        for (unsigned first = 0; first < 64; first += kLanes) {
            const auto some = static_cast<__mmask16>(mask >> first);
            const __m512i from = _mm512_set1_epi32(static_cast<int>(at + first));
            const __m512i found =
                _mm512_maskz_compress_epi32(some, _mm512_add_epi32(inOrder, from));
            _mm512_storeu_si512(&places[count], found); // what is too much is overwritten
            count += static_cast<std::size_t>(_mm_popcnt_u32(some));
        }
    }
    for (; at < bytes.size() && count <= most; ++at)
        if (bytes[at] != 0) places[count++] = static_cast<std::uint32_t>(at);
    places.resize(count);
    return count <= most;
}

#include "image/png_filter.inl"

} // namespace byte_lanes::avx512
KERNEL_REGION_END
#endif
