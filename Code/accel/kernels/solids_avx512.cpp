// solids.inl for the registers of avx512.cpp.
#include "accel/kernels/solids.h"

#if defined(__x86_64__)
#include "accel/kernels/region_includes.h"

AVX512_REGION_BEGIN
namespace kernels::avx512 {
#include "accel/kernels/simd_avx512.inl"

// Bits of W rows, asked for by columns.
class LaneMatrix {
public:
    LaneMatrix() : rows_(_mm256_setzero_si256()) {}
    void set(int row, unsigned columns) {
        rows_ = _mm256_mask_set1_epi16(rows_, static_cast<__mmask16>(1u << row),
                                       static_cast<short>(columns));
    }
    unsigned column(int i) const {
        return bits({_mm256_movepi16_mask(_mm256_sll_epi16(rows_, _mm_cvtsi32_si128(15 - i)))});
    }

private:
    __m256i rows_;
};

#include "accel/kernels/ray_lanes.inl"

#include "accel/kernels/solids_rows_avx512.inl"

#include "accel/kernels/solids.inl"
} // namespace kernels::avx512
KERNEL_REGION_END
#endif
