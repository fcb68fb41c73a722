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

#include "render/waves/disk_lanes.inl"
