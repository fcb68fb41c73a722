// Pairs of floats that lie anywhere, four at a time. Included by simd_*.inl.

struct FourPairs {
    __m128 first, second;

    // at(i): where pair i lies, for i from `from` on.
    template <class Fn> FourPairs(const Fn& at, std::size_t from) {
        const auto two = [&](std::size_t i) {
            const __m128 low = _mm_loadl_pi(_mm_setzero_ps(), pair(at(i)));
            return _mm_loadh_pi(low, pair(at(i + 1)));
        };
        const __m128 a = two(from), b = two(from + 2);
        first = _mm_shuffle_ps(a, b, _MM_SHUFFLE(2, 0, 2, 0));
        second = _mm_shuffle_ps(a, b, _MM_SHUFFLE(3, 1, 3, 1));
    }

private:
    static const __m64* pair(const float* at) { return reinterpret_cast<const __m64*>(at); }
};
