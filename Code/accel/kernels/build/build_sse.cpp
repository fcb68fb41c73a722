// Boxes in two registers of four lanes: SSE4.2 as of 2008.
#include "accel/kernels/build/instances.h"
#include "accel/kernels/build/visit_order.h"

#if defined(__x86_64__)
#include "base/target.h"

#include <algorithm>
#include <bit>
#include <cstring>
#include <immintrin.h>
#include <limits>

SSE_REGION_BEGIN
namespace kernels::build::sse {
#include "accel/kernels/build/box_sse.inl"

#include "accel/kernels/build/bins.inl"

#include "accel/kernels/build/divide.inl"

#include "accel/kernels/build/leaf.inl"

#include "accel/kernels/build/subtree.inl"

} // namespace kernels::build::sse
KERNEL_REGION_END
#endif
