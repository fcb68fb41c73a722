// What disk_lanes.inl asks of AVX2.
constexpr std::size_t kSobolLanes = 8;

// In each 16 bytes: those of `from` that the lower half of the bytes of `at` name.
template <class Bits> inline Bits pickBytes(Bits from, Bits at) {
    return reinterpret_cast<Bits>(
        _mm256_shuffle_epi8(reinterpret_cast<__m256i>(from), reinterpret_cast<__m256i>(at)));
}

inline Doubles fma(const Doubles& a, const Doubles& b, const Doubles& c) {
    return {_mm256_fmadd_pd(a.lo, b.lo, c.lo), _mm256_fmadd_pd(a.hi, b.hi, c.hi)};
}
inline Doubles nearQuotient(const Doubles& a, const Doubles& b) { return a / b; }
// Lanes within 2^-40 of the middle between two floats: see sobol_avx512.inl.
inline unsigned nearMiddle(const Doubles& a) {
    const auto half = [](__m256d x) {
        const __m256i shifted =
            _mm256_add_epi64(_mm256_castpd_si256(x), _mm256_set1_epi64x((1 << 28) + (1 << 13)));
        const __m256i rest = _mm256_and_si256(shifted, _mm256_set1_epi64x((1 << 29) - (1 << 14)));
        return static_cast<unsigned>(_mm256_movemask_pd(
            _mm256_castsi256_pd(_mm256_cmpeq_epi64(rest, _mm256_setzero_si256()))));
    };
    return half(a.lo) | half(a.hi) << 4;
}

#include "render/waves/disk_lanes.inl"
