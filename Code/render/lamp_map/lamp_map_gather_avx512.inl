// What look-ups on the map of a lamp need beside simd_avx512.inl; its siblings define the same.
inline Ints operator+(Ints a, Ints b) { return _mm512_add_epi32(a.v, b.v); }
inline Ints shiftedUp(Ints a, int by) { return _mm512_sll_epi32(a.v, _mm_cvtsi32_si128(by)); }
inline Ints shiftedDown(Ints a, int by) { return _mm512_srl_epi32(a.v, _mm_cvtsi32_si128(by)); }
inline Ints truncated(Floats a) { return _mm512_cvttps_epi32(a.v); }
// At offsets in bytes.
inline Ints intsAt(const std::uint32_t* from, Ints offset) {
    return _mm512_i32gather_epi32(offset.v, from, 1);
}
