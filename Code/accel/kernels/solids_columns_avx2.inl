// See solids_columns_avx512.inl.
constexpr bool kPairsPay = true;

inline void loadRows(const float* const (&row)[W], Floats (&column)[4]) {
    const auto rowsFrom = [&](int first) -> __m256 { // row 4 i + first in half i
        return _mm256_insertf128_ps(_mm256_castps128_ps256(_mm_loadu_ps(row[first])),
                                    _mm_loadu_ps(row[4 + first]), 1);
    };
    const __m256 a = rowsFrom(0), b = rowsFrom(1), c = rowsFrom(2), d = rowsFrom(3);
    const auto low = [&](__m256 x, __m256 y) -> __m256d {
        return _mm256_castps_pd(_mm256_unpacklo_ps(x, y));
    };
    const auto high = [&](__m256 x, __m256 y) -> __m256d {
        return _mm256_castps_pd(_mm256_unpackhi_ps(x, y));
    };
    column[0] = _mm256_castpd_ps(_mm256_unpacklo_pd(low(a, b), low(c, d)));
    column[1] = _mm256_castpd_ps(_mm256_unpackhi_pd(low(a, b), low(c, d)));
    column[2] = _mm256_castpd_ps(_mm256_unpacklo_pd(high(a, b), high(c, d)));
    column[3] = _mm256_castpd_ps(_mm256_unpackhi_pd(high(a, b), high(c, d)));
}

template <int Bit> inline unsigned kindBits(const WideNode<W>& node) {
    const __m256i top = _mm256_slli_epi32(Ints::load(node.child).v, 31 - Bit);
    return static_cast<unsigned>(_mm256_movemask_ps(_mm256_castsi256_ps(top)));
}

inline void storeRows(const double* const (&row)[W], double (*column)[W]) {
    for (int half = 0; half < 2; ++half) {
        const auto at = [&](int i) -> __m256d { return _mm256_loadu_pd(row[4 * half + i]); };
        const __m256d a = at(0), b = at(1), c = at(2), d = at(3);
        const __m256d even[2] = {_mm256_unpacklo_pd(a, b), _mm256_unpacklo_pd(c, d)},
                      odd[2] = {_mm256_unpackhi_pd(a, b), _mm256_unpackhi_pd(c, d)};
        const __m256d columns[4] = {_mm256_permute2f128_pd(even[0], even[1], 0x20),
                                    _mm256_permute2f128_pd(odd[0], odd[1], 0x20),
                                    _mm256_permute2f128_pd(even[0], even[1], 0x31),
                                    _mm256_permute2f128_pd(odd[0], odd[1], 0x31)};
        for (int i = 0; i < 4; ++i) _mm256_store_pd(column[i] + 4 * half, columns[i]);
    }
}

class LaneColumns {
public:
    LaneColumns() : columns_(_mm256_setzero_si256()) {}
    void set(int row, Mask columns) {
        const __m256i bit = _mm256_set1_epi32(static_cast<int>(1u << row));
        columns_ = _mm256_or_si256(columns_, _mm256_and_si256(_mm256_castps_si256(columns.v), bit));
    }
    void store(std::uint32_t* to) const {
        _mm256_store_si256(reinterpret_cast<__m256i*>(to), columns_);
    }

private:
    __m256i columns_;
};
