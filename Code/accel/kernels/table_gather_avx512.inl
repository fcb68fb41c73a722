// What look-ups in tables need beside simd_avx512.inl; its siblings define the same names.
inline Doubles floor(const Doubles& a) {
    constexpr int kDown = _MM_FROUND_TO_NEG_INF | _MM_FROUND_NO_EXC;
    return {_mm512_roundscale_pd(a.lo, kDown), _mm512_roundscale_pd(a.hi, kDown)};
}
// Cut towards zero.
inline Ints wholeOf(const Doubles& a) {
    return _mm512_inserti64x4(_mm512_castsi256_si512(_mm512_cvttpd_epi32(a.lo)),
                              _mm512_cvttpd_epi32(a.hi), 1);
}
inline __m256i upperHalf(Ints a) { return _mm512_extracti64x4_epi64(a.v, 1); }
inline Doubles doublesOf(Ints a) {
    return {_mm512_cvtepi32_pd(_mm512_castsi512_si256(a.v)), _mm512_cvtepi32_pd(upperHalf(a))};
}
// Byte i, 0 to 3, of each.
inline Ints byteOf(Ints a, int i) {
    return _mm512_and_si512(_mm512_srl_epi32(a.v, _mm_cvtsi32_si128(8 * i)),
                            _mm512_set1_epi32(255));
}
// The four bytes at each offset.
inline Ints fourBytesAt(const std::uint8_t* from, Ints offset) {
    const NumbersInMemory at(offset);
    return loadWords([&](std::size_t i) { return from + at[i]; });
}
// Element i of a table for each i, which are below 2^31; 0 in lanes that are not chosen, whatever
// their i.
inline Ints elementsAt(const std::uint32_t* table, Ints i, unsigned chosen) {
    return _mm512_mask_i32gather_epi32(_mm512_setzero_si512(), static_cast<__mmask16>(chosen), i.v,
                                       table, 4);
}
inline __m512d joined(__m128d a, __m128d b, __m128d c, __m128d d) {
    const __m256d low = _mm256_set_m128d(b, a), high = _mm256_set_m128d(d, c);
    return _mm512_insertf64x4(_mm512_castpd256_pd512(low), high, 1);
}
// The first two elements of row i, for each i, of a table whose rows are kStride long.
template <int kStride>
[[gnu::always_inline]] inline void pairsAt(const double* rows, Ints i, Doubles& first,
                                           Doubles& second) {
    const NumbersInMemory at(i);
    const TwoRows a(rows, at, 0, kStride), b(rows, at, 2, kStride), c(rows, at, 4, kStride),
        d(rows, at, 6, kStride), e(rows, at, 8, kStride), f(rows, at, 10, kStride),
        g(rows, at, 12, kStride), h(rows, at, 14, kStride);
    first = {joined(a.first, b.first, c.first, d.first),
             joined(e.first, f.first, g.first, h.first)};
    second = {joined(a.second, b.second, c.second, d.second),
              joined(e.second, f.second, g.second, h.second)};
}
