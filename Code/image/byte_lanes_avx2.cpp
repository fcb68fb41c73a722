// Byte lanes for the registers of AVX2.
#include "image/byte_lanes.h"

#if defined(__x86_64__)
#include "base/target.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <immintrin.h>

AVX2_REGION_BEGIN
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
bool isZero64(const std::uint8_t* from) {
    const __m256i any = _mm256_or_si256(load32(from), load32(from + 32));
    return _mm256_testz_si256(any, any) != 0;
}

} // namespace

#include "image/nonzero_places.inl"
#include "image/png_filter.inl"

} // namespace byte_lanes::avx2
KERNEL_REGION_END
#endif
