// Children of a node onto a stack, the farthest first. Included by the file of each instruction set
// inside its namespace.

// Up to four, 97 to 99 of 100 steps, by a sorting network. entries: the depths' bits, the lowest
// four replaced. Returns the nearest.
inline WideRef pushSorted(unsigned hit, Floats entry, const WideRef* child, WideRef* refs,
                          std::uint32_t* entries) {
    const auto keys = keysOf(hit, entry);
    if (std::popcount(hit) > 4) [[unlikely]] {
        alignas(64) std::uint32_t sorted[W];
        storeKeys(keys, sorted);
        const int n = std::popcount(hit);
        for (int a = 1; a < n; ++a) {
            const std::uint32_t key = sorted[a];
            int place = a;
            for (; place > 0 && sorted[place - 1] < key; --place) sorted[place] = sorted[place - 1];
            sorted[place] = key;
        }
        for (int a = 0; a < n; ++a) entries[a] = sorted[a], refs[a] = child[sorted[a] & 15];
        return refs[n - 1];
    }
    __m128i k = firstFour(keys);
    const auto exchange = [](__m128i x, __m128i y, auto lower) {
        return _mm_castps_si128(_mm_blend_ps(_mm_castsi128_ps(_mm_max_epu32(x, y)),
                                             _mm_castsi128_ps(_mm_min_epu32(x, y)),
                                             decltype(lower)::value));
    };
    k = exchange(k, _mm_shuffle_epi32(k, _MM_SHUFFLE(1, 0, 3, 2)),
                 std::integral_constant<int, 12>());
    k = exchange(k, _mm_shuffle_epi32(k, _MM_SHUFFLE(2, 3, 0, 1)),
                 std::integral_constant<int, 10>());
    const __m128i middle = exchange(k, _mm_shuffle_epi32(k, _MM_SHUFFLE(3, 1, 2, 0)),
                                    std::integral_constant<int, 4>());
    k = _mm_blend_epi16(k, middle, 0x3c);
    _mm_storeu_si128(reinterpret_cast<__m128i*>(entries), k);
    const __m128i sorted = pick(k, child);
    _mm_storeu_si128(reinterpret_cast<__m128i*>(refs), sorted);
    return element(sorted, std::popcount(hit) - 1);
}
