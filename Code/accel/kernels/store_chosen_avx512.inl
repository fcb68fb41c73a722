// The chosen lanes, one after the other, in the sixteen places from `to` on; what follows them is
// overwritten too. Its siblings define the same names.
inline void storeChosenFloats(unsigned chosen, Floats a, float* to) {
    _mm512_storeu_ps(to, _mm512_maskz_compress_ps(static_cast<__mmask16>(chosen), a.v));
}
// Of vectors. Register r starts with element 16 r, which is in lane 16 r / 3.
inline void storeChosenVectors(unsigned chosen, Floats x, Floats y, Floats z, float* to) {
    alignas(64) static constexpr auto kLane = [] {
        std::array<std::array<std::uint32_t, W>, 3> lanes{};
        for (std::uint32_t i = 0; i < 3 * W; ++i) lanes[i / W][i % W] = i / 3;
        return lanes;
    }();
    constexpr __mmask16 kEveryThird[3] = {0x9249, 0x2492, 0x4924}; // from lane i
    const auto packed = [&](Floats a) {
        return _mm512_maskz_compress_ps(static_cast<__mmask16>(chosen), a.v);
    };
    const __m512 axis[3] = {packed(x), packed(y), packed(z)};
    for (std::size_t r = 0; r < 3; ++r) {
        const __m512i lane = _mm512_load_si512(kLane[r].data());
        // Element 16 r + i is of axis (r + i) % 3.
        __m512 elements = _mm512_permutexvar_ps(lane, axis[r]);
        for (std::size_t i = 1; i < 3; ++i)
            elements =
                _mm512_mask_permutexvar_ps(elements, kEveryThird[i], lane, axis[(r + i) % 3]);
        _mm512_storeu_ps(to + r * W, elements);
    }
}
// The lowest bits, in order, to where bits of `places` are.
inline unsigned spread(unsigned lowest, unsigned places) { return _pdep_u32(lowest, places); }
