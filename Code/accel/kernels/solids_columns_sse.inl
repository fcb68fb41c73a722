// See solids_columns_avx512.inl.
constexpr bool kPairsPay = false; // permutations take a store and many loads

inline void loadRows(const float* const (&row)[W], Floats (&column)[4]) {
    for (int half = 0; half < 2; ++half) {
        const auto rowAt = [&](int i) { return _mm_loadu_ps(row[4 * half + i]); };
        __m128 a = rowAt(0), b = rowAt(1), c = rowAt(2), d = rowAt(3);
        _MM_TRANSPOSE4_PS(a, b, c, d);
        const __m128 columns[4] = {a, b, c, d};
        for (int i = 0; i < 4; ++i) (half == 0 ? column[i].lo : column[i].hi) = columns[i];
    }
}

template <int Bit> inline unsigned kindBits(const WideNode<W>& node) {
    const Ints child = Ints::load(node.child);
    const auto top = [](__m128i four) {
        return static_cast<unsigned>(
            _mm_movemask_ps(_mm_castsi128_ps(_mm_slli_epi32(four, 31 - Bit))));
    };
    return top(child.lo) | top(child.hi) << 4;
}

inline void storeRows(const double* const (&row)[W], double (*column)[W]) {
    for (int pair = 0; pair < 4; ++pair)
        for (int half = 0; half < 2; ++half) {
            const __m128d a = _mm_loadu_pd(row[2 * pair] + 2 * half),
                          b = _mm_loadu_pd(row[2 * pair + 1] + 2 * half);
            _mm_store_pd(column[2 * half] + 2 * pair, _mm_unpacklo_pd(a, b));
            _mm_store_pd(column[2 * half + 1] + 2 * pair, _mm_unpackhi_pd(a, b));
        }
}

class LaneColumns {
public:
    LaneColumns() : lo_(_mm_setzero_si128()), hi_(lo_) {}
    void set(int row, Mask columns) {
        const __m128i bit = _mm_set1_epi32(static_cast<int>(1u << row));
        lo_ = _mm_or_si128(lo_, _mm_and_si128(_mm_castps_si128(columns.lo), bit));
        hi_ = _mm_or_si128(hi_, _mm_and_si128(_mm_castps_si128(columns.hi), bit));
    }
    void store(std::uint32_t* to) const { Ints(lo_, hi_).store(to); }

private:
    __m128i lo_, hi_;
};
