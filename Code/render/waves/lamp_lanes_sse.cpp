// Lamps in the registers of SSE4.2.
#include "render/waves/lamp_lanes.h"

#if defined(__x86_64__)
#include "accel/kernels/region_includes.h"
#include "base/math.h"
#include "light/light.h"
#include "render/occluders.h"
#include "sample/warp.h"

SSE_REGION_BEGIN
namespace kernels::sse {
#include "accel/kernels/simd_sse.inl"

constexpr std::size_t kSobolLanes = 4;
template <class Bits> inline Bits pickBytes(Bits from, Bits at) {
    return reinterpret_cast<Bits>(
        _mm_shuffle_epi8(reinterpret_cast<__m128i>(from), reinterpret_cast<__m128i>(at)));
}
#include "render/waves/lit_lanes.inl"

#include "render/waves/disk_lanes.inl"
#include "render/waves/hidden_lanes.inl"
#include "render/waves/lamp_lanes.inl"
#include "render/waves/soft_lamp_lanes.inl"
} // namespace kernels::sse
KERNEL_REGION_END
#endif
