// What powers need beside simd_avx512.inl and table_gather_avx512.inl; its siblings define the
// same names.
inline Ints bitsOf(Floats a) { return _mm512_castps_si512(a.v); }
inline Floats fromBits(Ints a) { return _mm512_castsi512_ps(a.v); }
inline Ints plus(Ints a, std::uint32_t b) { return _mm512_add_epi32(a.v, Ints(b).v); }
inline Ints masked(Ints a, std::uint32_t b) { return _mm512_and_si512(a.v, Ints(b).v); }
template <int kBits> Ints shiftedRight(Ints a) { return _mm512_srai_epi32(a.v, kBits); }
// 2^k, for k from -1022 to 1023.
inline Doubles powersOfTwo(Ints k) {
    const auto half = [&](__m256i exponent) {
        return _mm512_castsi512_pd(_mm512_slli_epi64(_mm512_cvtepi32_epi64(exponent), 52));
    };
    const Ints biased = plus(k, 1023);
    return {half(_mm512_castsi512_si256(biased.v)), half(_mm512_extracti64x4_epi64(biased.v, 1))};
}
