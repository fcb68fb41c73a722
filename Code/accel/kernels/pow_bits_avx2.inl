// What powers need beside simd_avx2.inl and table_gather_avx2.inl: see pow_bits_avx512.inl.
inline Ints bitsOf(Floats a) { return _mm256_castps_si256(a.v); }
inline Floats fromBits(Ints a) { return _mm256_castsi256_ps(a.v); }
inline Ints plus(Ints a, std::uint32_t b) { return _mm256_add_epi32(a.v, Ints(b).v); }
inline Ints masked(Ints a, std::uint32_t b) { return _mm256_and_si256(a.v, Ints(b).v); }
template <int kBits> Ints shiftedRight(Ints a) { return _mm256_srai_epi32(a.v, kBits); }
inline Doubles powersOfTwo(Ints k) {
    const auto half = [&](__m128i exponent) {
        return _mm256_castsi256_pd(_mm256_slli_epi64(_mm256_cvtepi32_epi64(exponent), 52));
    };
    const Ints biased = plus(k, 1023);
    return {half(_mm256_castsi256_si128(biased.v)), half(_mm256_extracti128_si256(biased.v, 1))};
}
