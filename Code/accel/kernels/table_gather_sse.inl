// What look-ups in tables need beside simd_sse.inl: see table_gather_avx512.inl.
inline Doubles floor(const Doubles& a) {
    return quarters([&](int i) { return _mm_floor_pd(a.v[i]); });
}
inline Ints wholeOf(const Doubles& a) {
    return {_mm_unpacklo_epi64(_mm_cvttpd_epi32(a.v[0]), _mm_cvttpd_epi32(a.v[1])),
            _mm_unpacklo_epi64(_mm_cvttpd_epi32(a.v[2]), _mm_cvttpd_epi32(a.v[3]))};
}
inline Doubles doublesOf(Ints a) {
    return {_mm_cvtepi32_pd(a.lo), _mm_cvtepi32_pd(_mm_unpackhi_epi64(a.lo, a.lo)),
            _mm_cvtepi32_pd(a.hi), _mm_cvtepi32_pd(_mm_unpackhi_epi64(a.hi, a.hi))};
}
inline Ints byteOf(Ints a, int i) {
    const __m128i shift = _mm_cvtsi32_si128(8 * i), byte = _mm_set1_epi32(255);
    return {_mm_and_si128(_mm_srl_epi32(a.lo, shift), byte),
            _mm_and_si128(_mm_srl_epi32(a.hi, shift), byte)};
}
inline Ints fourBytesAt(const std::uint8_t* from, Ints offset) {
    const NumbersInMemory at(offset);
    return loadWords([&](std::size_t i) { return from + at[i]; });
}
inline Ints elementsAt(const std::uint32_t* table, Ints i, unsigned chosen) {
    alignas(16) std::uint32_t at[W], out[W] = {};
    i.store(at);
    for (; chosen != 0; chosen &= chosen - 1) {
        const int lane = std::countr_zero(chosen);
        out[lane] = table[at[lane]];
    }
    return Ints::load(out);
}
template <int kStride>
[[gnu::always_inline]] inline void pairsAt(const double* rows, Ints i, Doubles& first,
                                           Doubles& second) {
    const NumbersInMemory at(i);
    const TwoRows a(rows, at, 0, kStride), b(rows, at, 2, kStride), c(rows, at, 4, kStride),
        d(rows, at, 6, kStride);
    first = {a.first, b.first, c.first, d.first};
    second = {a.second, b.second, c.second, d.second};
}
