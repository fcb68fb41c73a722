// 8 lanes in two registers of SSE4.2, so that the trees are those of AVX2.
#pragma once

#include "simd/region.h"

#include <cstddef>
#include <cstdint>
#include <immintrin.h>

LANES_BEGIN

inline constexpr int W = 8;

struct Mask {
    __m128 lo, hi;
};
struct Floats {
    __m128 lo, hi;
    Floats() = default;
    Floats(__m128 a, __m128 b) : lo(a), hi(b) {}
    Floats(float a) : lo(_mm_set1_ps(a)), hi(lo) {}
    static Floats load(const void* p) {
        const float* f = static_cast<const float*>(p);
        return {_mm_load_ps(f), _mm_load_ps(f + 4)};
    }
    static Floats unaligned(const float* p) { return {_mm_loadu_ps(p), _mm_loadu_ps(p + 4)}; }
    void store(float* p) const { _mm_store_ps(p, lo), _mm_store_ps(p + 4, hi); }
};
struct Ints {
    __m128i lo, hi;
    Ints(__m128i a, __m128i b) : lo(a), hi(b) {}
    Ints(std::uint32_t a) : lo(_mm_set1_epi32(static_cast<int>(a))), hi(lo) {}
    static Ints load(const std::uint32_t* p) {
        const auto* v = reinterpret_cast<const __m128i*>(p);
        return {_mm_load_si128(v), _mm_load_si128(v + 1)};
    }
    static Ints unaligned(const std::uint32_t* p) {
        const auto* v = reinterpret_cast<const __m128i*>(p);
        return {_mm_loadu_si128(v), _mm_loadu_si128(v + 1)};
    }
    static Ints from(std::uint32_t first) {
        const __m128i all = _mm_set1_epi32(static_cast<int>(first));
        return {_mm_add_epi32(all, _mm_setr_epi32(0, 1, 2, 3)),
                _mm_add_epi32(all, _mm_setr_epi32(4, 5, 6, 7))};
    }
    static Ints bytes(const std::uint8_t* p) {
        const __m128i all = _mm_loadl_epi64(reinterpret_cast<const __m128i*>(p));
        return {_mm_cvtepu8_epi32(all), _mm_cvtepu8_epi32(_mm_srli_si128(all, 4))};
    }
    void store(std::uint32_t* p) const {
        auto* v = reinterpret_cast<__m128i*>(p);
        _mm_store_si128(v, lo), _mm_store_si128(v + 1, hi);
    }
};
struct Doubles {
    __m128d v[4];
    Doubles(__m128d a, __m128d b, __m128d c, __m128d d) : v{a, b, c, d} {}
    Doubles(double a) : v{_mm_set1_pd(a), _mm_set1_pd(a), _mm_set1_pd(a), _mm_set1_pd(a)} {}
    explicit Doubles(Floats a)
        : v{_mm_cvtps_pd(a.lo), _mm_cvtps_pd(_mm_movehl_ps(a.lo, a.lo)), _mm_cvtps_pd(a.hi),
            _mm_cvtps_pd(_mm_movehl_ps(a.hi, a.hi))} {}
    static Doubles load(const double* p) {
        return {_mm_load_pd(p), _mm_load_pd(p + 2), _mm_load_pd(p + 4), _mm_load_pd(p + 6)};
    }
    void store(double* p) const {
        for (int i = 0; i < 4; ++i) _mm_store_pd(p + std::ptrdiff_t{2} * i, v[i]);
    }
    Floats toFloats() const {
        return {_mm_movelh_ps(_mm_cvtpd_ps(v[0]), _mm_cvtpd_ps(v[1])),
                _mm_movelh_ps(_mm_cvtpd_ps(v[2]), _mm_cvtpd_ps(v[3]))};
    }
};

inline Floats operator+(Floats a, Floats b) {
    return {_mm_add_ps(a.lo, b.lo), _mm_add_ps(a.hi, b.hi)};
}
inline Floats operator-(Floats a, Floats b) {
    return {_mm_sub_ps(a.lo, b.lo), _mm_sub_ps(a.hi, b.hi)};
}
inline Floats operator*(Floats a, Floats b) {
    return {_mm_mul_ps(a.lo, b.lo), _mm_mul_ps(a.hi, b.hi)};
}
inline Floats operator/(Floats a, Floats b) {
    return {_mm_div_ps(a.lo, b.lo), _mm_div_ps(a.hi, b.hi)};
}
inline Doubles operator+(const Doubles& a, const Doubles& b) {
    return {_mm_add_pd(a.v[0], b.v[0]), _mm_add_pd(a.v[1], b.v[1]), _mm_add_pd(a.v[2], b.v[2]),
            _mm_add_pd(a.v[3], b.v[3])};
}
inline Doubles operator-(const Doubles& a, const Doubles& b) {
    return {_mm_sub_pd(a.v[0], b.v[0]), _mm_sub_pd(a.v[1], b.v[1]), _mm_sub_pd(a.v[2], b.v[2]),
            _mm_sub_pd(a.v[3], b.v[3])};
}
inline Doubles operator*(const Doubles& a, const Doubles& b) {
    return {_mm_mul_pd(a.v[0], b.v[0]), _mm_mul_pd(a.v[1], b.v[1]), _mm_mul_pd(a.v[2], b.v[2]),
            _mm_mul_pd(a.v[3], b.v[3])};
}
inline Doubles operator/(const Doubles& a, const Doubles& b) {
    return {_mm_div_pd(a.v[0], b.v[0]), _mm_div_pd(a.v[1], b.v[1]), _mm_div_pd(a.v[2], b.v[2]),
            _mm_div_pd(a.v[3], b.v[3])};
}
inline Floats sqrt(Floats a) { return {_mm_sqrt_ps(a.lo), _mm_sqrt_ps(a.hi)}; }
// fn(i) for each of the four registers.
template <class Fn> inline Doubles quarters(Fn&& fn) { return {fn(0), fn(1), fn(2), fn(3)}; }
inline Doubles sqrt(const Doubles& a) {
    return quarters([&](int i) { return _mm_sqrt_pd(a.v[i]); });
}
inline Doubles abs(const Doubles& a) {
    return quarters([&](int i) { return _mm_andnot_pd(_mm_set1_pd(-0.0), a.v[i]); });
}
inline Doubles min(const Doubles& a, const Doubles& b) {
    return {_mm_min_pd(a.v[0], b.v[0]), _mm_min_pd(a.v[1], b.v[1]), _mm_min_pd(a.v[2], b.v[2]),
            _mm_min_pd(a.v[3], b.v[3])};
}
inline Doubles max(const Doubles& a, const Doubles& b) {
    return quarters([&](int i) { return _mm_max_pd(a.v[i], b.v[i]); });
}
inline Doubles withSign(const Doubles& a, const Doubles& of) {
    const __m128d sign = _mm_set1_pd(-0.0);
    const auto part = [&](__m128d x, __m128d y) {
        return _mm_or_pd(_mm_andnot_pd(sign, x), _mm_and_pd(sign, y));
    };
    return {part(a.v[0], of.v[0]), part(a.v[1], of.v[1]), part(a.v[2], of.v[2]),
            part(a.v[3], of.v[3])};
}
// Two roundings here: fma() is used only where the pads cover either way.
inline Floats fma(Floats a, Floats b, Floats c) { return a * b + c; }
inline Floats fnma(Floats a, Floats b, Floats c) { return c - a * b; } // c - a b
inline Floats fms(Floats a, Floats b, Floats c) { return a * b - c; }  // a b - c
inline Floats min(Floats a, Floats b) { return {_mm_min_ps(a.lo, b.lo), _mm_min_ps(a.hi, b.hi)}; }
inline Floats max(Floats a, Floats b) { return {_mm_max_ps(a.lo, b.lo), _mm_max_ps(a.hi, b.hi)}; }
inline Floats abs(Floats a) {
    const __m128 sign = _mm_set1_ps(-0.0f);
    return {_mm_andnot_ps(sign, a.lo), _mm_andnot_ps(sign, a.hi)};
}
inline Floats maxAbs(Floats a, Floats b) { return max(abs(a), abs(b)); }
inline Floats flipSign(Floats a, Floats by) {
    const __m128 sign = _mm_set1_ps(-0.0f);
    return {_mm_xor_ps(a.lo, _mm_and_ps(by.lo, sign)), _mm_xor_ps(a.hi, _mm_and_ps(by.hi, sign))};
}
inline Floats withSign(Floats a, Floats of) { return flipSign(abs(a), of); }
inline Floats floor(Floats a) { return {_mm_floor_ps(a.lo), _mm_floor_ps(a.hi)}; }
// The next float; of those that are not negative.
inline Floats nextFloat(Floats a) {
    const auto half = [](__m128 x) {
        return _mm_castsi128_ps(_mm_add_epi32(_mm_castps_si128(x), _mm_set1_epi32(1)));
    };
    return {half(a.lo), half(a.hi)};
}
inline Floats roughInverse(Floats a) { return {_mm_rcp_ps(a.lo), _mm_rcp_ps(a.hi)}; }

inline Mask operator<(Floats a, Floats b) {
    return {_mm_cmplt_ps(a.lo, b.lo), _mm_cmplt_ps(a.hi, b.hi)};
}
inline Mask operator<=(Floats a, Floats b) {
    return {_mm_cmple_ps(a.lo, b.lo), _mm_cmple_ps(a.hi, b.hi)};
}
inline Mask operator>(Floats a, Floats b) { return b < a; }
inline Mask operator>=(Floats a, Floats b) { return b <= a; }
inline Mask operator==(Floats a, Floats b) {
    return {_mm_cmpeq_ps(a.lo, b.lo), _mm_cmpeq_ps(a.hi, b.hi)};
}
inline Mask notGreater(Floats a, Floats b) {
    return {_mm_cmpngt_ps(a.lo, b.lo), _mm_cmpngt_ps(a.hi, b.hi)};
}
inline Ints operator&(Ints a, Ints b) {
    return {_mm_and_si128(a.lo, b.lo), _mm_and_si128(a.hi, b.hi)};
}
inline Ints operator+(Ints a, Ints b) {
    return {_mm_add_epi32(a.lo, b.lo), _mm_add_epi32(a.hi, b.hi)};
}
inline Mask operator<(Ints a, Ints b) {
    const __m128i top = _mm_set1_epi32(static_cast<int>(0x80000000u));
    const auto less = [&](__m128i x, __m128i y) {
        return _mm_castsi128_ps(_mm_cmpgt_epi32(_mm_xor_si128(y, top), _mm_xor_si128(x, top)));
    };
    return {less(a.lo, b.lo), less(a.hi, b.hi)};
}
inline Mask operator==(Ints a, Ints b) {
    return {_mm_castsi128_ps(_mm_cmpeq_epi32(a.lo, b.lo)),
            _mm_castsi128_ps(_mm_cmpeq_epi32(a.hi, b.hi))};
}
inline Mask operator&(Mask a, Mask b) { return {_mm_and_ps(a.lo, b.lo), _mm_and_ps(a.hi, b.hi)}; }
inline Mask operator|(Mask a, Mask b) { return {_mm_or_ps(a.lo, b.lo), _mm_or_ps(a.hi, b.hi)}; }
inline unsigned bits(Mask m) {
    return static_cast<unsigned>(_mm_movemask_ps(m.lo) | _mm_movemask_ps(m.hi) << 4);
}
inline Mask maskOf(unsigned laneBits) {
    const __m128i all = _mm_set1_epi32(static_cast<int>(laneBits));
    const __m128i low = _mm_setr_epi32(1, 2, 4, 8), high = _mm_setr_epi32(16, 32, 64, 128);
    return {_mm_castsi128_ps(_mm_cmpeq_epi32(_mm_and_si128(all, low), low)),
            _mm_castsi128_ps(_mm_cmpeq_epi32(_mm_and_si128(all, high), high))};
}
inline Floats select(Mask m, Floats a, Floats b) {
    return {_mm_blendv_ps(b.lo, a.lo, m.lo), _mm_blendv_ps(b.hi, a.hi, m.hi)};
}
// min(a, b) where the mask is set, a elsewhere.
inline Floats minWhere(Mask m, Floats a, Floats b) { return min(a, select(m, b, a)); }
inline Ints select(Mask m, Ints a, Ints b) {
    return {_mm_blendv_epi8(b.lo, a.lo, _mm_castps_si128(m.lo)),
            _mm_blendv_epi8(b.hi, a.hi, _mm_castps_si128(m.hi))};
}
// Byte shuffles on both halves: an index with its top bit set gives zero.
inline Floats permute(Floats a, Ints lanes) {
    const auto half = [&](__m128i lane) {
        const __m128i bytes = _mm_add_epi32(_mm_mullo_epi32(lane, _mm_set1_epi32(0x04040404)),
                                            _mm_set1_epi32(0x03020100));
        const __m128i inLow = _mm_or_si128(bytes, _mm_cmpgt_epi32(lane, _mm_set1_epi32(3)));
        const __m128i inHigh = _mm_or_si128(_mm_sub_epi32(bytes, _mm_set1_epi32(0x10101010)),
                                            _mm_cmplt_epi32(lane, _mm_set1_epi32(4)));
        return _mm_castsi128_ps(_mm_or_si128(_mm_shuffle_epi8(_mm_castps_si128(a.lo), inLow),
                                             _mm_shuffle_epi8(_mm_castps_si128(a.hi), inHigh)));
    };
    return {half(lanes.lo), half(lanes.hi)};
}
inline Ints permute(Ints a, Ints lanes) {
    const Floats b = permute(Floats(_mm_castsi128_ps(a.lo), _mm_castsi128_ps(a.hi)), lanes);
    return {_mm_castps_si128(b.lo), _mm_castps_si128(b.hi)};
}

template <class Fn> inline unsigned bitsOf(Fn&& fn) {
    unsigned all = 0;
    for (int i = 0; i < 4; ++i) all |= static_cast<unsigned>(_mm_movemask_pd(fn(i))) << 2 * i;
    return all;
}
inline unsigned less(const Doubles& a, const Doubles& b) {
    return bitsOf([&](int i) { return _mm_cmplt_pd(a.v[i], b.v[i]); });
}
inline unsigned atMost(const Doubles& a, const Doubles& b) {
    return bitsOf([&](int i) { return _mm_cmple_pd(a.v[i], b.v[i]); });
}
inline Mask operator<(const Doubles& a, const Doubles& b) {
    const auto less = [&](int i) { return _mm_castpd_ps(_mm_cmplt_pd(a.v[i], b.v[i])); };
    return {_mm_shuffle_ps(less(0), less(1), 0x88), _mm_shuffle_ps(less(2), less(3), 0x88)};
}
inline Doubles select(Mask m, const Doubles& a, const Doubles& b) {
    const __m128 twice[4] = {_mm_unpacklo_ps(m.lo, m.lo), _mm_unpackhi_ps(m.lo, m.lo),
                             _mm_unpacklo_ps(m.hi, m.hi), _mm_unpackhi_ps(m.hi, m.hi)};
    return quarters([&](int i) { return _mm_blendv_pd(b.v[i], a.v[i], _mm_castps_pd(twice[i])); });
}

inline float smallest(Floats a) {
    __m128 m = _mm_min_ps(a.lo, a.hi);
    m = _mm_min_ps(m, _mm_movehl_ps(m, m));
    return _mm_cvtss_f32(_mm_min_ss(m, _mm_shuffle_ps(m, m, 1)));
}
inline float largest(Floats a) { return -smallest(Floats(0.0f) - a); }

template <bool Largest> inline Floats foldRows(const float (*rows)[W]) {
    const auto fold = [&](__m128 a, __m128 b) {
        return Largest ? _mm_max_ps(a, b) : _mm_min_ps(a, b);
    };
    const auto half = [&](int first) {
        const auto row = [&](int i) {
            const float* const p = rows[first + i];
            return fold(_mm_load_ps(p), _mm_load_ps(p + 4));
        };
        const auto two = [&](__m128 a, __m128 b) {
            return fold(_mm_unpacklo_ps(a, b), _mm_unpackhi_ps(a, b));
        };
        const __m128 a = two(row(0), row(1)), b = two(row(2), row(3));
        return fold(_mm_movelh_ps(a, b), _mm_movehl_ps(b, a));
    };
    return {half(0), half(4)};
}
inline Floats smallestOfRows(const float (*rows)[W]) { return foldRows<false>(rows); }
inline Floats largestOfRows(const float (*rows)[W]) { return foldRows<true>(rows); }

inline void loadVectors(const float* p, Floats& x, Floats& y, Floats& z) {
    const auto four = [](const float* q, __m128& u, __m128& v, __m128& w) {
        const __m128 a = _mm_loadu_ps(q), b = _mm_loadu_ps(q + 4), c = _mm_loadu_ps(q + 8);
        const __m128 xy = _mm_shuffle_ps(b, c, _MM_SHUFFLE(2, 1, 3, 2));
        const __m128 yz = _mm_shuffle_ps(a, b, _MM_SHUFFLE(1, 0, 2, 1));
        u = _mm_shuffle_ps(a, xy, _MM_SHUFFLE(2, 0, 3, 0));
        v = _mm_shuffle_ps(yz, xy, _MM_SHUFFLE(3, 1, 2, 0));
        w = _mm_shuffle_ps(yz, c, _MM_SHUFFLE(3, 0, 3, 1));
    };
    four(p, x.lo, y.lo, z.lo);
    four(p + 12, x.hi, y.hi, z.hi);
}

LANES_END
