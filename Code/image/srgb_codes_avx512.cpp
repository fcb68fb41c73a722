// 8-bit sRGB codes of many pixels, for the registers of AVX-512: the curve itself, and a look at
// the table only near the steps from one code to the next.
#include "image/byte_lanes.h"

#if defined(__x86_64__)
#include "base/target.h"
#include "image/colour.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <immintrin.h>

AVX512_REGION_BEGIN
namespace byte_lanes::avx512 {
namespace {

constexpr std::size_t kFloats = 16;
using Floats __attribute__((vector_size(sizeof(float) * kFloats))) = float;
using Words __attribute__((vector_size(sizeof(float) * kFloats))) = std::int32_t;

constexpr std::int32_t kCode = 65536; // codes have 16 bits behind the point
constexpr int kOctaves = 13;          // smaller floats have code 0

// 1.055 x^(1 / 2.4) in codes where the octaves start, by the lowest four bits of their exponents.
constexpr auto kOctaveStarts = [] {
    std::array<float, kFloats> table{};
    double start = 1.055 * 255 * kCode; // of the octave at 1, exponent 127
    for (std::size_t octave = 1; octave <= kOctaves; ++octave) {
        start /= 1.3348398541700344; // 2^(1 / 2.4)
        table[(127 - octave) % kFloats] = static_cast<float>(start);
    }
    return table;
}();

// x^(1 / 2.4) in [1, 2): a minimax polynomial, within 1.4e-6.
Floats rootInOctave(Floats x) {
    Floats sum = x * 0.00533313188f - 0.05065334f;
    sum = sum * x + 0.206318125f;
    sum = sum * x - 0.488464875f;
    sum = sum * x + 0.950480619f;
    return sum * x + 0.376987705f;
}

// 255 srgb(x) + 1/2 in codes.
Words codesOf(Floats linear) {
    const __m512 least = _mm512_set1_ps(1.0f / (1 << kOctaves));
    const __m512 most = _mm512_set1_ps(0x1.fffffep-1f);
    const Floats x = _mm512_min_ps(_mm512_max_ps(linear, least), most); // `least` instead of NaN
    const Words bits = reinterpret_cast<Words>(x);
    const auto inOctave = reinterpret_cast<Floats>((bits & 0x7FFFFF) | 0x3F800000);
    const Floats start = _mm512_permutexvar_ps(reinterpret_cast<__m512i>(bits >> 23),
                                               _mm512_loadu_ps(kOctaveStarts.data()));
    constexpr float kWhole = 255.0f * kCode, kHalf = 0.5f * kCode;
    const auto isLine = x <= Floats{} + static_cast<float>(srgb::kEncodeThreshold);
    const Floats line = x * (12.92f * kWhole) + kHalf;
    const Floats curve = rootInOctave(inOctave) * start + (kHalf - 0.055f * kWhole);
    return __builtin_convertvector(isLine ? line : curve, Words);
}

// Is any so near to a step that its whole part may be wrong? The largest error is 24 (of all floats
// between the first and the last step).
bool isInDoubt(Words codes) {
    constexpr std::int32_t kDoubt = 32; // a power of two: what is nearer has no bit above it
    const auto moved = reinterpret_cast<__m512i>(codes + kDoubt);
    return _mm512_testn_epi32_mask(moved, _mm512_set1_epi32(kCode - 2 * kDoubt)) != 0;
}

[[gnu::noinline]] void oneByOne(const unsigned char* floats, std::uint8_t* out) {
    for (std::size_t k = 0; k < kFloats; ++k) {
        float x;
        std::memcpy(&x, floats + sizeof x * k, sizeof x);
        out[k] = srgb8FromLinear(x);
    }
}

} // namespace

void srgb8(std::span<const Rgb> pixels, std::uint8_t* out) {
    static_assert(sizeof(Rgb) == 3 * sizeof(float));
    if (pixels.size() < kFloats) return srgb8FromLinear(pixels, out);
    const auto* const bytes = reinterpret_cast<const unsigned char*>(pixels.data());
    const std::size_t last = 3 * pixels.size() - kFloats;
    for (std::size_t i = 0; i < last + kFloats; i += kFloats) {
        i = std::min(i, last); // the last ones overlap those before
        const unsigned char* const from = bytes + sizeof(float) * i;
        Floats linear;
        std::memcpy(&linear, from, sizeof linear);
        const Words codes = codesOf(linear);
        const __m128i whole = _mm512_cvtepi32_epi8(reinterpret_cast<__m512i>(codes >> 16));
        std::memcpy(out + i, &whole, sizeof whole);
        if (isInDoubt(codes)) [[unlikely]]
            oneByOne(from, out + i);
    }
}

} // namespace byte_lanes::avx512
KERNEL_REGION_END
#endif
