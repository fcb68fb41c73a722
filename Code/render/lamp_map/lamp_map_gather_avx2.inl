// What look-ups on the map of a lamp need beside simd_avx2.inl: see lamp_map_gather_avx512.inl.
inline Ints operator+(Ints a, Ints b) { return _mm256_add_epi32(a.v, b.v); }
inline Ints shiftedUp(Ints a, int by) { return _mm256_sll_epi32(a.v, _mm_cvtsi32_si128(by)); }
inline Ints shiftedDown(Ints a, int by) { return _mm256_srl_epi32(a.v, _mm_cvtsi32_si128(by)); }
inline Ints truncated(Floats a) { return _mm256_cvttps_epi32(a.v); }
inline Ints intsAt(const std::uint32_t* from, Ints offset) {
    return _mm256_i32gather_epi32(static_cast<const int*>(static_cast<const void*>(from)), offset.v,
                                  1);
}
