// The maps of lamps in the registers of AVX2.
#include "render/lamp_map/lamp_map.h"

#if defined(__x86_64__)
#include "accel/kernels/region_includes.h"
#include "accel/kernels/wide_tree.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>

AVX2_REGION_BEGIN
namespace kernels::avx2 {
#include "accel/kernels/simd_avx2.inl"

#include "accel/kernels/solids_columns_avx2.inl"

#include "accel/kernels/table_gather_avx2.inl"

#include "render/lamp_map/lamp_map_lanes.inl"
} // namespace kernels::avx2
KERNEL_REGION_END
#endif
