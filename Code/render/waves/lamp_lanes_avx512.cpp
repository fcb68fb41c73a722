// Lamps in the registers of AVX-512.
#include "render/waves/lamp_lanes.h"

#if defined(__x86_64__)
#include "accel/kernels/region_includes.h"
#include "base/math.h"
#include "light/light.h"
#include "render/occluders.h"
#include "sample/warp.h"

AVX512_REGION_BEGIN
namespace kernels::avx512 {
#include "accel/kernels/simd_avx512.inl"

constexpr std::size_t kSobolLanes = 16;
template <class Bits> inline Bits pickBytes(Bits from, Bits at) {
    return reinterpret_cast<Bits>(
        _mm512_shuffle_epi8(reinterpret_cast<__m512i>(from), reinterpret_cast<__m512i>(at)));
}
#include "render/waves/lit_lanes.inl"

#include "render/waves/disk_lanes.inl"
#include "render/waves/hidden_lanes.inl"
#include "render/waves/lamp_lanes.inl"
#include "render/waves/soft_lamp_lanes.inl"
} // namespace kernels::avx512
KERNEL_REGION_END
#endif
