// What look-ups on the map of a lamp need beside simd_sse.inl: see lamp_map_gather_avx512.inl.
inline Ints operator+(Ints a, Ints b) {
    return {_mm_add_epi32(a.lo, b.lo), _mm_add_epi32(a.hi, b.hi)};
}
inline Ints shiftedUp(Ints a, int by) {
    const __m128i count = _mm_cvtsi32_si128(by);
    return {_mm_sll_epi32(a.lo, count), _mm_sll_epi32(a.hi, count)};
}
inline Ints shiftedDown(Ints a, int by) {
    const __m128i count = _mm_cvtsi32_si128(by);
    return {_mm_srl_epi32(a.lo, count), _mm_srl_epi32(a.hi, count)};
}
inline Ints truncated(Floats a) { return {_mm_cvttps_epi32(a.lo), _mm_cvttps_epi32(a.hi)}; }
inline Ints intsAt(const std::uint32_t* from, Ints offset) {
    alignas(16) std::uint32_t out[W];
    offset.store(out);
    for (std::uint32_t& x : out)
        std::memcpy(&x, reinterpret_cast<const std::byte*>(from) + x, sizeof x);
    return Ints::load(out);
}
