// The maps of lamps in the registers of AVX-512.
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

AVX512_REGION_BEGIN
namespace kernels::avx512 {
#include "accel/kernels/simd_avx512.inl"

#include "accel/kernels/solids_columns_avx512.inl"

#include "accel/kernels/table_gather_avx512.inl"

#include "render/lamp_map/lamp_map_lanes.inl"
} // namespace kernels::avx512
KERNEL_REGION_END
#endif
