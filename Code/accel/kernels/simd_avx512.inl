// 16 lanes in one register of AVX-512. Included inside the namespace and region of its kernel, like
// its siblings simd_avx2.inl and simd_sse.inl, which define the same names.
constexpr int W = 16;

struct Mask {
    __mmask16 v;
};
struct Floats {
    __m512 v;
    Floats() = default;
    Floats(__m512 a) : v(a) {}
    Floats(float a) : v(_mm512_set1_ps(a)) {}
    static Floats load(const void* p) { return _mm512_load_ps(p); }
    static Floats unaligned(const float* p) { return _mm512_loadu_ps(p); }
    void store(float* p) const { _mm512_store_ps(p, v); }
};
struct Ints {
    __m512i v;
    Ints(__m512i a) : v(a) {}
    Ints(std::uint32_t a) : v(_mm512_set1_epi32(static_cast<int>(a))) {}
    static Ints load(const std::uint32_t* p) { return _mm512_load_si512(p); }
    static Ints unaligned(const std::uint32_t* p) { return _mm512_loadu_si512(p); }
    static Ints from(std::uint32_t first) { // first, first + 1, ...
        const __m512i lane =
            _mm512_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15);
        return _mm512_add_epi32(_mm512_set1_epi32(static_cast<int>(first)), lane);
    }
    static Ints bytes(const std::uint8_t* p) {
        return _mm512_cvtepu8_epi32(_mm_load_si128(reinterpret_cast<const __m128i*>(p)));
    }
    void store(std::uint32_t* p) const { _mm512_store_si512(p, v); }
};
// As many doubles as there are floats, in two registers.
struct Doubles {
    __m512d lo, hi;
    Doubles(__m512d a, __m512d b) : lo(a), hi(b) {}
    Doubles(double a) : lo(_mm512_set1_pd(a)), hi(lo) {}
    explicit Doubles(Floats a)
        : lo(_mm512_cvtps_pd(_mm512_castps512_ps256(a.v))),
          hi(_mm512_cvtps_pd(_mm512_extractf32x8_ps(a.v, 1))) {}
    static Doubles load(const double* p) { return {_mm512_load_pd(p), _mm512_load_pd(p + 8)}; }
    void store(double* p) const { _mm512_store_pd(p, lo), _mm512_store_pd(p + 8, hi); }
    Floats toFloats() const {
        return _mm512_insertf32x8(_mm512_castps256_ps512(_mm512_cvtpd_ps(lo)), _mm512_cvtpd_ps(hi),
                                  1);
    }
};

inline Floats operator+(Floats a, Floats b) { return _mm512_add_ps(a.v, b.v); }
inline Floats operator-(Floats a, Floats b) { return _mm512_sub_ps(a.v, b.v); }
inline Floats operator*(Floats a, Floats b) { return _mm512_mul_ps(a.v, b.v); }
inline Floats operator/(Floats a, Floats b) { return _mm512_div_ps(a.v, b.v); }
inline Doubles operator+(Doubles a, Doubles b) {
    return {_mm512_add_pd(a.lo, b.lo), _mm512_add_pd(a.hi, b.hi)};
}
inline Doubles operator-(Doubles a, Doubles b) {
    return {_mm512_sub_pd(a.lo, b.lo), _mm512_sub_pd(a.hi, b.hi)};
}
inline Doubles operator*(Doubles a, Doubles b) {
    return {_mm512_mul_pd(a.lo, b.lo), _mm512_mul_pd(a.hi, b.hi)};
}
inline Doubles operator/(Doubles a, Doubles b) {
    return {_mm512_div_pd(a.lo, b.lo), _mm512_div_pd(a.hi, b.hi)};
}
inline Floats sqrt(Floats a) { return _mm512_sqrt_ps(a.v); }
inline Doubles sqrt(const Doubles& a) { return {_mm512_sqrt_pd(a.lo), _mm512_sqrt_pd(a.hi)}; }
inline Doubles abs(const Doubles& a) { return {_mm512_abs_pd(a.lo), _mm512_abs_pd(a.hi)}; }
inline Doubles min(const Doubles& a, const Doubles& b) {
    return {_mm512_min_pd(a.lo, b.lo), _mm512_min_pd(a.hi, b.hi)};
}
inline Doubles max(const Doubles& a, const Doubles& b) {
    return {_mm512_max_pd(a.lo, b.lo), _mm512_max_pd(a.hi, b.hi)};
}
inline Doubles withSign(const Doubles& a, const Doubles& of) {
    const __m512d sign = _mm512_set1_pd(-0.0);
    const auto half = [&](__m512d x, __m512d y) {
        return _mm512_or_pd(_mm512_andnot_pd(sign, x), _mm512_and_pd(sign, y));
    };
    return {half(a.lo, of.lo), half(a.hi, of.hi)};
}
inline Floats fma(Floats a, Floats b, Floats c) { return _mm512_fmadd_ps(a.v, b.v, c.v); }
inline Floats fnma(Floats a, Floats b, Floats c) {
    return _mm512_fnmadd_ps(a.v, b.v, c.v);
} // c - a b
inline Floats fms(Floats a, Floats b, Floats c) {
    return _mm512_fmsub_ps(a.v, b.v, c.v);
} // a b - c
// The second operand wins when one is NaN, as in base/math.h.
inline Floats min(Floats a, Floats b) { return _mm512_min_ps(a.v, b.v); }
inline Floats max(Floats a, Floats b) { return _mm512_max_ps(a.v, b.v); }
// min(a, b) where the mask is set, a elsewhere.
inline Floats minWhere(Mask m, Floats a, Floats b) {
    return _mm512_mask_min_ps(a.v, m.v, a.v, b.v);
}
inline Floats abs(Floats a) { return _mm512_abs_ps(a.v); }
inline Floats maxAbs(Floats a, Floats b) { return _mm512_range_ps(a.v, b.v, 0b1011); }
inline Floats flipSign(Floats a, Floats by) {
    return _mm512_xor_ps(a.v, _mm512_and_ps(by.v, _mm512_set1_ps(-0.0f)));
}
inline Floats withSign(Floats a, Floats of) { return flipSign(abs(a), of); }
inline Floats floor(Floats a) { return _mm512_floor_ps(a.v); }
// The next float; of those that are not negative.
inline Floats nextFloat(Floats a) {
    return _mm512_castsi512_ps(_mm512_add_epi32(_mm512_castps_si512(a.v), _mm512_set1_epi32(1)));
}
inline Floats roughInverse(Floats a) { return _mm512_rcp14_ps(a.v); } // 2^-14

inline Mask operator<(Floats a, Floats b) { return {_mm512_cmp_ps_mask(a.v, b.v, _CMP_LT_OQ)}; }
inline Mask operator<=(Floats a, Floats b) { return {_mm512_cmp_ps_mask(a.v, b.v, _CMP_LE_OQ)}; }
inline Mask operator>(Floats a, Floats b) { return b < a; }
inline Mask operator>=(Floats a, Floats b) { return b <= a; }
inline Mask operator==(Floats a, Floats b) { return {_mm512_cmp_ps_mask(a.v, b.v, _CMP_EQ_OQ)}; }
// True for NaN.
inline Mask notGreater(Floats a, Floats b) { return {_mm512_cmp_ps_mask(a.v, b.v, _CMP_NGT_UQ)}; }
inline Ints operator&(Ints a, Ints b) { return _mm512_and_si512(a.v, b.v); }
inline Ints operator+(Ints a, Ints b) { return _mm512_add_epi32(a.v, b.v); }
inline Mask operator<(Ints a, Ints b) { return {_mm512_cmplt_epu32_mask(a.v, b.v)}; }
inline Mask operator==(Ints a, Ints b) { return {_mm512_cmpeq_epi32_mask(a.v, b.v)}; }
inline Mask operator&(Mask a, Mask b) { return {static_cast<__mmask16>(a.v & b.v)}; }
inline Mask operator|(Mask a, Mask b) { return {static_cast<__mmask16>(a.v | b.v)}; }
inline unsigned bits(Mask m) {
    unsigned lanes = m.v;
#if !defined(__clang__)
    // g++ 12 may spill the 16 bits of a mask and load 32: they are made 32 in a register.
    asm("" : "+r"(lanes));
#endif
    return lanes;
}
inline Mask maskOf(unsigned laneBits) { return {static_cast<__mmask16>(laneBits)}; }
inline Floats select(Mask m, Floats a, Floats b) { return _mm512_mask_blend_ps(m.v, b.v, a.v); }
inline Ints select(Mask m, Ints a, Ints b) { return _mm512_mask_blend_epi32(m.v, b.v, a.v); }
inline Floats permute(Floats a, Ints lanes) { return _mm512_permutexvar_ps(lanes.v, a.v); }
inline Ints permute(Ints a, Ints lanes) { return _mm512_permutexvar_epi32(lanes.v, a.v); }

// Bits of the lanes where it holds.
inline unsigned less(const Doubles& a, const Doubles& b) {
    return bits({_mm512_cmp_pd_mask(a.lo, b.lo, _CMP_LT_OQ)}) |
           bits({_mm512_cmp_pd_mask(a.hi, b.hi, _CMP_LT_OQ)}) << 8;
}
inline unsigned atMost(const Doubles& a, const Doubles& b) {
    return bits({_mm512_cmp_pd_mask(a.lo, b.lo, _CMP_LE_OQ)}) |
           bits({_mm512_cmp_pd_mask(a.hi, b.hi, _CMP_LE_OQ)}) << 8;
}
inline Mask operator<(const Doubles& a, const Doubles& b) { return maskOf(less(a, b)); }
inline Doubles select(Mask m, const Doubles& a, const Doubles& b) {
    return {_mm512_mask_blend_pd(static_cast<__mmask8>(bits(m)), b.lo, a.lo),
            _mm512_mask_blend_pd(static_cast<__mmask8>(bits(m) >> 8), b.hi, a.hi)};
}

inline float smallest(Floats a) { return _mm512_reduce_min_ps(a.v); }
inline float largest(Floats a) { return _mm512_reduce_max_ps(a.v); }

// Lane i is the smallest or largest number of row i.
template <bool Largest> inline Floats foldRows(const float (*rows)[W]) {
    const auto fold = [&](__m512 a, __m512 b) {
        return Largest ? _mm512_max_ps(a, b) : _mm512_min_ps(a, b);
    };
    __m512 two[8], four[4];
    for (int i = 0; i < 8; ++i) { // two rows to a register, and so on
        const __m512 a = _mm512_load_ps(rows[i]), b = _mm512_load_ps(rows[i + 8]);
        two[i] = fold(_mm512_shuffle_f32x4(a, b, 0x44), _mm512_shuffle_f32x4(a, b, 0xee));
    }
    for (int i = 0; i < 4; ++i)
        four[i] = fold(_mm512_shuffle_f32x4(two[i], two[i + 4], 0x88),
                       _mm512_shuffle_f32x4(two[i], two[i + 4], 0xdd));
    const auto eight = [&](__m512 a, __m512 b) {
        return fold(_mm512_unpacklo_ps(a, b), _mm512_unpackhi_ps(a, b));
    };
    const __m512 a = eight(four[0], four[1]), b = eight(four[2], four[3]);
    const __m512 all = fold(_mm512_shuffle_ps(a, b, 0x44), _mm512_shuffle_ps(a, b, 0xee));
    return _mm512_shuffle_f32x4(all, all, _MM_SHUFFLE(3, 1, 2, 0));
}
inline Floats smallestOfRows(const float (*rows)[W]) { return foldRows<false>(rows); }
inline Floats largestOfRows(const float (*rows)[W]) { return foldRows<true>(rows); }

// x, y, z of W vectors that follow each other.
inline void loadVectors(const float* p, Floats& x, Floats& y, Floats& z) {
    const __m512 a = _mm512_loadu_ps(p), b = _mm512_loadu_ps(p + 16), c = _mm512_loadu_ps(p + 32);
    const auto pick = [&](__m512i fromAB, __m512i withC) {
        return _mm512_permutex2var_ps(_mm512_permutex2var_ps(a, fromAB, b), withC, c);
    };
    x = pick(_mm512_setr_epi32(0, 3, 6, 9, 12, 15, 18, 21, 24, 27, 30, 0, 0, 0, 0, 0),
             _mm512_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 17, 20, 23, 26, 29));
    y = pick(_mm512_setr_epi32(1, 4, 7, 10, 13, 16, 19, 22, 25, 28, 31, 0, 0, 0, 0, 0),
             _mm512_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 18, 21, 24, 27, 30));
    z = pick(_mm512_setr_epi32(2, 5, 8, 11, 14, 17, 20, 23, 26, 29, 0, 0, 0, 0, 0, 0),
             _mm512_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 16, 19, 22, 25, 28, 31));
}

#include "accel/kernels/gather_by_hand.inl"

inline Floats joined(__m128 a, __m128 b, __m128 c, __m128 d) {
    const __m256 low = _mm256_set_m128(b, a), high = _mm256_set_m128(d, c);
    return _mm512_insertf32x8(_mm512_castps256_ps512(low), high, 1);
}
// W times four bytes, of which number i lies at at(i).
template <class Fn> [[gnu::always_inline]] inline Ints loadWords(const Fn& at) {
    const __m256i low = _mm256_set_m128i(fourWords(at, 4), fourWords(at, 0));
    const __m256i high = _mm256_set_m128i(fourWords(at, 12), fourWords(at, 8));
    return _mm512_inserti64x4(_mm512_castsi256_si512(low), high, 1);
}
// W pairs, of which number i lies at at(i).
template <class Fn>
[[gnu::always_inline]] inline void loadPairs(const Fn& at, Floats& first, Floats& second) {
    const FourPairs a(at, 0), b(at, 4), c(at, 8), d(at, 12);
    first = joined(a.first, b.first, c.first, d.first);
    second = joined(a.second, b.second, c.second, d.second);
}
// W pairs (a, b) that follow each other.
inline void storePairs(Floats a, Ints b, float* to) {
    const __m512 other = _mm512_castsi512_ps(b.v);
    const __m512i low = _mm512_setr_epi32(0, 16, 1, 17, 2, 18, 3, 19, 4, 20, 5, 21, 6, 22, 7, 23);
    const __m512i high = _mm512_add_epi32(low, _mm512_set1_epi32(8));
    _mm512_storeu_ps(to, _mm512_permutex2var_ps(a.v, low, other));
    _mm512_storeu_ps(to + 16, _mm512_permutex2var_ps(a.v, high, other));
}

// W rows (a, b, c, d, e) that follow each other. Register r starts with element 16 r, which is in
// row 16 r / 5 and column r.
inline void storeRows(Floats a, Floats b, Floats c, Ints d, Ints e, float* to) {
    alignas(64) static constexpr auto kRow = [] {
        std::array<std::array<std::uint32_t, W>, 5> rows{};
        for (std::uint32_t i = 0; i < 5 * W; ++i) rows[i / W][i % W] = i / 5;
        return rows;
    }();
    constexpr __mmask16 kEveryFifth[5] = {0x8421, 0x0842, 0x1084, 0x2108, 0x4210}; // from lane i
    const __m512 column[5] = {a.v, b.v, c.v, _mm512_castsi512_ps(d.v), _mm512_castsi512_ps(e.v)};
    for (std::size_t r = 0; r < 5; ++r) {
        const __m512i row = _mm512_load_si512(kRow[r].data());
        __m512 elements = _mm512_permutexvar_ps(row, column[r]);
        for (std::size_t i = 1; i < 5; ++i)
            elements =
                _mm512_mask_permutexvar_ps(elements, kEveryFifth[i], row, column[(r + i) % 5]);
        _mm512_storeu_ps(to + r * W, elements);
    }
}

// Writes the chosen lanes one after the other; what follows them is overwritten too.
inline void storeChosen(Mask chosen, const std::uint32_t* from, std::uint32_t* to) {
    _mm512_storeu_si512(to, _mm512_maskz_compress_epi32(chosen.v, _mm512_load_si512(from)));
}
inline void storeChosen(unsigned chosen, Ints from, std::uint32_t* to) {
    _mm512_storeu_si512(to, _mm512_maskz_compress_epi32(static_cast<__mmask16>(chosen), from.v));
}
inline void storeChosen(unsigned chosen, const std::uint32_t* from, std::uint32_t* to) {
    storeChosen(chosen, Ints::load(from), to);
}
// Bits of the chosen numbers (not negative), in the lowest four how many lanes come behind; zeros
// follow. They sort like the numbers, of equal ones the last first.
inline __m512i keysOf(Mask chosen, Floats a) {
    const __m512i lane = _mm512_setr_epi32(15, 14, 13, 12, 11, 10, 9, 8, 7, 6, 5, 4, 3, 2, 1, 0);
    const __m512i keys =
        _mm512_or_si512(_mm512_andnot_si512(_mm512_set1_epi32(15), _mm512_castps_si512(a.v)), lane);
    return _mm512_maskz_compress_epi32(chosen.v, keys);
}
inline __m128i firstFour(__m512i keys) { return _mm512_castsi512_si128(keys); }
inline void storeKeys(__m512i keys, std::uint32_t* to) { _mm512_storeu_si512(to, keys); }
inline __m128i pick(__m128i keys, const std::uint32_t* from) {
    const __m128i lanes = _mm_xor_si128(keys, _mm_set1_epi32(W - 1));
    return _mm512_castsi512_si128(
        _mm512_permutexvar_epi32(_mm512_castsi128_si512(lanes), _mm512_load_si512(from)));
}
// Element i, 0 to 3.
inline std::uint32_t element(__m128i four, int i) {
    return static_cast<std::uint32_t>(_mm_cvtsi128_si32(
        _mm_castps_si128(_mm_permutevar_ps(_mm_castsi128_ps(four), _mm_cvtsi32_si128(i)))));
}

// Keys in descending order: Batcher's bitonic sort (1968), step by step exchanged with the lane
// that is `apart`.
inline __m512i sortedKeys(__m512i k) {
    const auto exchange = [&](__m512i other, unsigned smaller) {
        k = _mm512_mask_min_epu32(_mm512_max_epu32(k, other), static_cast<__mmask16>(smaller), k,
                                  other);
    };
    const auto apart1 = [&] { return _mm512_shuffle_epi32(k, _MM_PERM_CDAB); };
    const auto apart2 = [&] { return _mm512_shuffle_epi32(k, _MM_PERM_BADC); };
    const auto apart4 = [&] { return _mm512_shuffle_i32x4(k, k, _MM_SHUFFLE(2, 3, 0, 1)); };
    const auto apart8 = [&] { return _mm512_shuffle_i32x4(k, k, _MM_SHUFFLE(1, 0, 3, 2)); };
    exchange(apart1(), 0x6666);
    exchange(apart2(), 0x3c3c), exchange(apart1(), 0x5a5a);
    exchange(apart4(), 0x0ff0), exchange(apart2(), 0x33cc), exchange(apart1(), 0x55aa);
    exchange(apart8(), 0xff00), exchange(apart4(), 0xf0f0), exchange(apart2(), 0xcccc);
    exchange(apart1(), 0xaaaa);
    return k;
}
inline __m512i pickAll(__m512i keys, const std::uint32_t* from) {
    const __m512i lanes = _mm512_xor_si512(keys, _mm512_set1_epi32(W - 1));
    return _mm512_permutexvar_epi32(lanes, _mm512_load_si512(from));
}
inline std::uint32_t element(__m512i all, int i) {
    return static_cast<std::uint32_t>(_mm_cvtsi128_si32(
        _mm512_castsi512_si128(_mm512_permutexvar_epi32(_mm512_set1_epi32(i), all))));
}
