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

std::uint64_t nonzeroMask64(const std::uint8_t* from) {
    const __m512i bytes = _mm512_loadu_si512(from);
    return _mm512_test_epi8_mask(bytes, bytes);
}
bool isZero64(const std::uint8_t* from) { return nonzeroMask64(from) == 0; }
std::size_t nonzeroPlaces64(const std::uint8_t* from, std::size_t at, std::uint32_t* out) {
    constexpr unsigned kLanes = 16; // of places
    static_assert(kLanes <= kTooManyPlaces);
    const __m512i inOrder = _mm512_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15);
    const std::uint64_t mask = nonzeroMask64(from);
    std::size_t count = 0;
    for (unsigned first = 0; first < 64; first += kLanes) {
        const auto some = static_cast<__mmask16>(mask >> first);
        const __m512i begin = _mm512_set1_epi32(static_cast<int>(at + first));
        const __m512i found = _mm512_maskz_compress_epi32(some, _mm512_add_epi32(inOrder, begin));
        _mm512_storeu_si512(out + count, found);
        count += static_cast<std::size_t>(_mm_popcnt_u32(some));
    }
    return count;
}

} // namespace

#include "image/nonzero_places.inl"
#include "image/png_filter.inl"

} // namespace byte_lanes::avx512
KERNEL_REGION_END
#endif
