// Boxes in one register of eight lanes: AVX2 as of 2013.
#include "accel/kernels/build/instances.h"
#include "accel/kernels/build/visit_order.h"

#if defined(__x86_64__)
#include "base/target.h"

#include <algorithm>
#include <bit>
#include <cstring>
#include <immintrin.h>
#include <limits>

AVX2_REGION_BEGIN
namespace kernels::build::avx2 {
#include "accel/kernels/build/box_avx2.inl"

#include "accel/kernels/build/bins.inl"

#include "accel/kernels/build/divide.inl"

#include "accel/kernels/build/leaf.inl"

#include "accel/kernels/build/subtree.inl"

} // namespace kernels::build::avx2
KERNEL_REGION_END
#endif
