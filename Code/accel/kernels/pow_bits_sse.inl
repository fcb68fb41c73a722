// What powers need beside simd_sse.inl and table_gather_sse.inl: see pow_bits_avx512.inl.
inline Ints bitsOf(Floats a) { return {_mm_castps_si128(a.lo), _mm_castps_si128(a.hi)}; }
inline Floats fromBits(Ints a) { return {_mm_castsi128_ps(a.lo), _mm_castsi128_ps(a.hi)}; }
inline Ints plus(Ints a, std::uint32_t b) {
    return {_mm_add_epi32(a.lo, Ints(b).lo), _mm_add_epi32(a.hi, Ints(b).lo)};
}
inline Ints masked(Ints a, std::uint32_t b) {
    return {_mm_and_si128(a.lo, Ints(b).lo), _mm_and_si128(a.hi, Ints(b).lo)};
}
template <int kBits> Ints shiftedRight(Ints a) {
    return {_mm_srai_epi32(a.lo, kBits), _mm_srai_epi32(a.hi, kBits)};
}
inline Doubles powersOfTwo(Ints k) {
    const auto two = [&](__m128i exponent) {
        return _mm_castsi128_pd(_mm_slli_epi64(_mm_cvtepi32_epi64(exponent), 52));
    };
    const auto upper = [&](__m128i four) { return _mm_unpackhi_epi64(four, four); };
    const Ints biased = plus(k, 1023);
    return {two(biased.lo), two(upper(biased.lo)), two(biased.hi), two(upper(biased.hi))};
}
