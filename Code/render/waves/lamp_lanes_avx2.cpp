// Lamps in the registers of AVX2.
#include "render/waves/lamp_lanes.h"

#if defined(__x86_64__)
#include "accel/kernels/region_includes.h"
#include "base/math.h"
#include "light/light.h"
#include "render/occluders.h"
#include "sample/warp.h"

AVX2_REGION_BEGIN
namespace kernels::avx2 {
#include "accel/kernels/simd_avx2.inl"

constexpr std::size_t kSobolLanes = 8;
template <class Bits> inline Bits pickBytes(Bits from, Bits at) {
    return reinterpret_cast<Bits>(
        _mm256_shuffle_epi8(reinterpret_cast<__m256i>(from), reinterpret_cast<__m256i>(at)));
}
#include "render/waves/lit_lanes.inl"

#include "render/waves/disk_lanes.inl"
#include "render/waves/hidden_lanes.inl"
#include "render/waves/lamp_lanes.inl"
#include "render/waves/soft_lamp_lanes.inl"
} // namespace kernels::avx2
KERNEL_REGION_END
#endif
