// What look-ups in tables need beside simd_avx2.inl: see table_gather_avx512.inl.
inline Doubles floor(const Doubles& a) { return {_mm256_floor_pd(a.lo), _mm256_floor_pd(a.hi)}; }
inline Ints wholeOf(const Doubles& a) {
    return _mm256_inserti128_si256(_mm256_castsi128_si256(_mm256_cvttpd_epi32(a.lo)),
                                   _mm256_cvttpd_epi32(a.hi), 1);
}
inline __m128i upperHalf(Ints a) { return _mm256_extracti128_si256(a.v, 1); }
inline Doubles doublesOf(Ints a) {
    return {_mm256_cvtepi32_pd(_mm256_castsi256_si128(a.v)), _mm256_cvtepi32_pd(upperHalf(a))};
}
inline Ints byteOf(Ints a, int i) {
    return _mm256_and_si256(_mm256_srl_epi32(a.v, _mm_cvtsi32_si128(8 * i)),
                            _mm256_set1_epi32(255));
}
inline Ints fourBytesAt(const std::uint8_t* from, Ints offset) {
    const NumbersInMemory at(offset);
    return loadWords([&](std::size_t i) { return from + at[i]; });
}
inline Ints elementsAt(const std::uint32_t* table, Ints i, unsigned chosen) {
    return _mm256_mask_i32gather_epi32(_mm256_setzero_si256(),
                                       static_cast<const int*>(static_cast<const void*>(table)),
                                       i.v, _mm256_castps_si256(maskOf(chosen).v), 4);
}
template <int kStride>
[[gnu::always_inline]] inline void pairsAt(const double* rows, Ints i, Doubles& first,
                                           Doubles& second) {
    const NumbersInMemory at(i);
    const TwoRows a(rows, at, 0, kStride), b(rows, at, 2, kStride), c(rows, at, 4, kStride),
        d(rows, at, 6, kStride);
    first = {_mm256_set_m128d(b.first, a.first), _mm256_set_m128d(d.first, c.first)};
    second = {_mm256_set_m128d(b.second, a.second), _mm256_set_m128d(d.second, c.second)};
}
