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
    return _mm512_i32gather_epi32(offset.v, from, 1);
}
// Element i of a table for each i, which are below 2^31; 0 in lanes that are not chosen, whatever
// their i.
inline Ints elementsAt(const std::uint32_t* table, Ints i, unsigned chosen) {
    return _mm512_mask_i32gather_epi32(_mm512_setzero_si512(), static_cast<__mmask16>(chosen), i.v,
                                       table, 4);
}
// Element kStride * i of a table for each i.
template <int kStride> Doubles elementsAt(const double* table, Ints i) {
    const auto at = [&](__m256i row) {
        return _mm512_i32gather_pd(_mm256_mullo_epi32(row, _mm256_set1_epi32(kStride)), table, 8);
    };
    return {at(_mm512_castsi512_si256(i.v)), at(upperHalf(i))};
}
