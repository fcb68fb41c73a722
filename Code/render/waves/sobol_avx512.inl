// What disk_lanes.inl asks of AVX-512.
constexpr std::size_t kSobolLanes = 16;

// In each 16 bytes: those of `from` that the lower half of the bytes of `at` name.
template <class Bits> inline Bits pickBytes(Bits from, Bits at) {
    return reinterpret_cast<Bits>(
        _mm512_shuffle_epi8(reinterpret_cast<__m512i>(from), reinterpret_cast<__m512i>(at)));
}

inline Doubles fma(const Doubles& a, const Doubles& b, const Doubles& c) {
    return {_mm512_fmadd_pd(a.lo, b.lo, c.lo), _mm512_fmadd_pd(a.hi, b.hi, c.hi)};
}
// a / b within 2^-41 of it: an inverse within 2^-14, whose error becomes its third power.
inline Doubles nearQuotient(const Doubles& a, const Doubles& b) {
    const auto half = [&](__m512d x, __m512d y) {
        const __m512d rough = _mm512_rcp14_pd(y);
        const __m512d off = _mm512_fnmadd_pd(y, rough, _mm512_set1_pd(1));
        return _mm512_mul_pd(x, _mm512_fmadd_pd(rough, _mm512_fmadd_pd(off, off, off), rough));
    };
    return {half(a.lo, b.lo), half(a.hi, b.hi)};
}
// Lanes within 2^-40 of the middle between two floats: 2^13 steps about the place where the 29 bits
// that a float has no room for are one and zeros.
inline unsigned nearMiddle(const Doubles& a) {
    const auto half = [](__m512d x) {
        const __m512i shifted =
            _mm512_add_epi64(_mm512_castpd_si512(x), _mm512_set1_epi64((1 << 28) + (1 << 13)));
        return static_cast<unsigned>(
            _mm512_testn_epi64_mask(shifted, _mm512_set1_epi64((1 << 29) - (1 << 14))));
    };
    return half(a.lo) | half(a.hi) << 8;
}

#include "render/waves/disk_lanes.inl"
