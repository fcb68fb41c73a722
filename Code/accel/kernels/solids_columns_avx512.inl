// Columns of W rows: numbers of things that lie anywhere, and bits. Included like solids.inl, in
// front of it, as its siblings solids_columns_avx2.inl and solids_columns_sse.inl are.
constexpr bool kPairsPay = true; // see solids_pairs.inl

// Four numbers that follow each other at row[i], in lane i of four registers.
inline void loadRows(const float* const (&row)[W], Floats (&column)[4]) {
    const auto rowsFrom = [&](int first) -> __m512 { // row 4 i + first in quarter i
        __m512 rows = _mm512_castps128_ps512(_mm_loadu_ps(row[first]));
        rows = _mm512_insertf32x4(rows, _mm_loadu_ps(row[4 + first]), 1);
        rows = _mm512_insertf32x4(rows, _mm_loadu_ps(row[8 + first]), 2);
        return _mm512_insertf32x4(rows, _mm_loadu_ps(row[12 + first]), 3);
    };
    const __m512 a = rowsFrom(0), b = rowsFrom(1), c = rowsFrom(2), d = rowsFrom(3);
    const auto low = [&](__m512 x, __m512 y) -> __m512d {
        return _mm512_castps_pd(_mm512_unpacklo_ps(x, y));
    };
    const auto high = [&](__m512 x, __m512 y) -> __m512d {
        return _mm512_castps_pd(_mm512_unpackhi_ps(x, y));
    };
    column[0] = _mm512_castpd_ps(_mm512_unpacklo_pd(low(a, b), low(c, d)));
    column[1] = _mm512_castpd_ps(_mm512_unpackhi_pd(low(a, b), low(c, d)));
    column[2] = _mm512_castpd_ps(_mm512_unpacklo_pd(high(a, b), high(c, d)));
    column[3] = _mm512_castpd_ps(_mm512_unpackhi_pd(high(a, b), high(c, d)));
}

// Children whose kind has this bit.
template <int Bit> inline unsigned kindBits(const WideNode<W>& node) {
    return bits({_mm512_test_epi32_mask(Ints::load(node.child).v, _mm512_set1_epi32(1 << Bit))});
}

// The same of doubles, in memory.
inline void storeRows(const double* const (&row)[W], double (*column)[W]) {
    for (int half = 0; half < 2; ++half) {
        const auto rowsFrom = [&](int first) -> __m512d { // and the one after the next
            const double* const* const at = row + 8 * half + first;
            return _mm512_insertf64x4(_mm512_castpd256_pd512(_mm256_loadu_pd(at[0])),
                                      _mm256_loadu_pd(at[2]), 1);
        };
        const __m512d a = rowsFrom(0), b = rowsFrom(1), c = rowsFrom(4), d = rowsFrom(5);
        const __m512d even[2] = {_mm512_unpacklo_pd(a, b), _mm512_unpacklo_pd(c, d)},
                      odd[2] = {_mm512_unpackhi_pd(a, b), _mm512_unpackhi_pd(c, d)};
        const __m512d columns[4] = {_mm512_shuffle_f64x2(even[0], even[1], 0x88),
                                    _mm512_shuffle_f64x2(odd[0], odd[1], 0x88),
                                    _mm512_shuffle_f64x2(even[0], even[1], 0xdd),
                                    _mm512_shuffle_f64x2(odd[0], odd[1], 0xdd)};
        for (int i = 0; i < 4; ++i) _mm512_store_pd(column[i] + 8 * half, columns[i]);
    }
}

// Bits of W rows of W, asked for by columns.
class LaneColumns {
public:
    LaneColumns() : columns_(_mm512_setzero_si512()) {}
    void set(int row, Mask columns) {
        columns_ = _mm512_mask_or_epi32(columns_, columns.v, columns_,
                                        _mm512_set1_epi32(kBit[static_cast<std::size_t>(row)]));
    }
    void store(std::uint32_t* to) const { _mm512_store_si512(to, columns_); }

private:
    // In memory, from where one costs no more than the `or` itself.
    alignas(64) static constexpr auto kBit = [] {
        std::array<int, W> bit{};
        for (std::size_t i = 0; i < W; ++i) bit[i] = 1 << i;
        return bit;
    }();
    __m512i columns_;
};
