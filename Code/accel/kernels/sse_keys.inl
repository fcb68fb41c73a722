// The part of simd_sse.inl for keys: numbers to sort that say of which lane they are, see keysOf()
// of simd_avx512.inl.

struct alignas(16) Keys {
    std::uint32_t v[W];
};
// Bytes for _mm_shuffle_epi8(): kPacked[m] brings the chosen ones of four numbers to the front,
// zeros follow; 16 of kSlid from 16 - 4 n on move numbers n places up, from 32 - 4 n on 4 - n
// places down.
alignas(16) inline constexpr auto kPacked = [] {
    std::array<std::array<std::uint8_t, 16>, 16> all{};
    for (unsigned chosen = 0; chosen < 16; ++chosen) {
        all[chosen].fill(0x80);
        std::size_t to = 0;
        for (unsigned byte = 0; byte < 16; ++byte)
            if ((chosen >> byte / 4 & 1) != 0) all[chosen][to++] = static_cast<std::uint8_t>(byte);
    }
    return all;
}();
inline constexpr auto kSlid = [] {
    std::array<std::uint8_t, 48> all{};
    all.fill(0x80);
    for (std::size_t byte = 0; byte < 16; ++byte) all[16 + byte] = static_cast<std::uint8_t>(byte);
    return all;
}();
inline __m128i packed(__m128i four, unsigned chosen) {
    return _mm_shuffle_epi8(
        four, _mm_load_si128(reinterpret_cast<const __m128i*>(kPacked[chosen].data())));
}
inline Keys keysOf(Mask lanes, Floats a) {
    const unsigned chosen = bits(lanes), inLow = chosen & 15;
    const auto keysOfFour = [](__m128 near, __m128i lane, unsigned m) {
        return packed(
            _mm_or_si128(_mm_andnot_si128(_mm_set1_epi32(15), _mm_castps_si128(near)), lane), m);
    };
    const __m128i low = keysOfFour(a.lo, _mm_setr_epi32(7, 6, 5, 4), inLow),
                  high = keysOfFour(a.hi, _mm_setr_epi32(3, 2, 1, 0), chosen >> 4);
    const auto slid = [&](int first) { // the high ones behind the low ones
        const std::uint8_t* const from =
            kSlid.data() + first - std::ptrdiff_t{4} * __builtin_popcount(inLow);
        return _mm_shuffle_epi8(high, _mm_loadu_si128(reinterpret_cast<const __m128i*>(from)));
    };
    Keys keys;
    _mm_store_si128(reinterpret_cast<__m128i*>(keys.v), _mm_or_si128(low, slid(16)));
    _mm_store_si128(reinterpret_cast<__m128i*>(keys.v + 4), slid(32));
    return keys;
}
inline __m128i firstFour(const Keys& keys) {
    return _mm_load_si128(reinterpret_cast<const __m128i*>(keys.v));
}
inline void storeKeys(const Keys& keys, std::uint32_t* to) {
    for (int i = 0; i < W; ++i) to[i] = keys.v[i];
}
inline __m128i pick(__m128i keys, const std::uint32_t* from) {
    const __m128i lane =
        _mm_xor_si128(_mm_and_si128(keys, _mm_set1_epi32(15)), _mm_set1_epi32(W - 1));
    // The bytes of that lane, 0 to 31: numbers with the highest bit pick zeros.
    const __m128i first = _mm_shuffle_epi8(
        _mm_slli_epi32(lane, 2), _mm_setr_epi8(0, 0, 0, 0, 4, 4, 4, 4, 8, 8, 8, 8, 12, 12, 12, 12));
    const __m128i byte = _mm_add_epi8(first, _mm_set1_epi32(0x03020100));
    const auto* const halves = reinterpret_cast<const __m128i*>(from);
    return _mm_or_si128(
        _mm_shuffle_epi8(_mm_loadu_si128(halves), _mm_add_epi8(byte, _mm_set1_epi8(0x70))),
        _mm_shuffle_epi8(_mm_loadu_si128(halves + 1), _mm_sub_epi8(byte, _mm_set1_epi8(16))));
}
inline std::uint32_t element(__m128i four, int i) {
    alignas(16) std::uint32_t all[4];
    _mm_store_si128(reinterpret_cast<__m128i*>(all), four);
    return all[i & 3];
}

// Keys in descending order.
inline Keys sortedKeys(Keys keys) {
    std::sort(keys.v, keys.v + W, [](std::uint32_t a, std::uint32_t b) { return a > b; });
    return keys;
}
inline Keys pickAll(const Keys& keys, const std::uint32_t* from) {
    Keys picked;
    for (int i = 0; i < W; ++i) picked.v[i] = from[(keys.v[i] & 15) ^ (W - 1)];
    return picked;
}
inline std::uint32_t element(const Keys& all, int i) { return all.v[i]; }
