// Numbers of pictures, read between their texels and decoded to linear light, in lanes;
// TexelGrid::color() and alpha() are the one lane of it. Numbers of texels are whole doubles:
// exact, and no conversions on the way to an address.
#pragma once

#include "image/colour.h"
#include "simd/lanes.h"
#include "texture/texture.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>

LANES_BEGIN

// Returns linear light, in [0,1], from sRGB codes as parts of the largest: within 1 ulp of the
// exact value, and monotone over the 256 pieces of the table to that accuracy. NaN counts as 0.
inline Floats linearFromSrgb(Floats encoded) {
    const Doubles s(min(max(encoded, Floats(0.0f)), Floats(1.0f)));
    const Ints k = wholeOf(s * Doubles(255.0) + Doubles(0.5));
    const double* const table = &srgb::decodeNodes().front().value;
    constexpr int kStride = sizeof(srgb::DecodeNode) / sizeof(double);
    Doubles value(0.0), inverse(0.0);
    pairsAt<kStride>(table, k, value, inverse);
    // (1 + u)^2.4 by the binomial series; |u| < 0.021, the next term is below 7e-9.
    const Doubles u = (s - doublesOf(k) / Doubles(255.0)) * inverse;
    const Doubles curve =
        value * (Doubles(1.0) + u * (Doubles(2.4) + u * (Doubles(1.68) + u * Doubles(0.224))));
    const unsigned dark = atMost(s, Doubles(srgb::kDecodeThreshold));
    if (dark == 0) return curve.toFloats();
    return select(maskOf(dark), s / Doubles(12.92), curve).toFloats();
}

// A texel for each lane: its numbers, and number kOpaque of those without alpha; zeros outside.
inline constexpr int kOpaque = 3;
struct ByteTexels {
    static constexpr double kOne = 255; // what stands for 1
    Ints bytes;
    Doubles number(int i) const { return doublesOf(byteOf(bytes, i)); }
};
struct WordTexels {
    static constexpr double kOne = 65535;
    const std::uint16_t* at[W]; // null: outside
    bool isOpaque;
    Doubles number(int i) const {
        alignas(64) double numbers[W];
        for (std::size_t lane = 0; lane < W; ++lane)
            numbers[lane] = at[lane] == nullptr        ? 0
                            : isOpaque && i == kOpaque ? kOne
                                                       : static_cast<double>(at[lane][i]);
        return Doubles::load(numbers);
    }
};
struct FloatTexels {
    static constexpr double kOne = 1;
    Floats numbers[4];
    Doubles number(int i) const { return Doubles(numbers[i]); }
};

// Four numbers that follow each other, for each lane in an array of its own.
class FloatRows {
public:
    explicit FloatRows(std::span<const float> numbers) : whole_(wholeOf(numbers)) {
        for (std::span<const float>& row : numbers_) row = numbers;
    }
    explicit FloatRows(const std::span<const float> (&numbers)[W]) : whole_(0u) {
        alignas(64) std::uint32_t whole[W];
        for (std::size_t i = 0; i < W; ++i)
            numbers_[i] = numbers[i], whole[i] = wholeOf(numbers[i]);
        whole_ = Ints::load(whole);
    }
    // Loads those from each number on, or as many as there are.
    void load(Ints first, Floats (&to)[4]) const {
        alignas(64) std::uint32_t at[W];
        first.store(at);
        const float* rows[W];
        for (std::size_t i = 0; i < W; ++i) rows[i] = numbers_[i].data() + at[i];
        unsigned atEnd = ~bits(first < whole_) & ((1u << W) - 1);
        if (atEnd == 0) return loadRows(rows, to);
        float copies[W][4] = {};
        for (; atEnd != 0; atEnd &= atEnd - 1) {
            const auto i = static_cast<std::size_t>(std::countr_zero(atEnd));
            const auto rest = numbers_[i].subspan(at[i]);
            for (std::size_t k = 0; k < rest.size() && k < 4; ++k) copies[i][k] = rest[k];
            rows[i] = copies[i];
        }
        loadRows(rows, to);
    }

private:
    // Up to where four numbers follow each other.
    static std::uint32_t wholeOf(std::span<const float> numbers) {
        const std::size_t size = numbers.size();
        return static_cast<std::uint32_t>(size - std::min<std::size_t>(size, 3));
    }
    std::span<const float> numbers_[W];
    Ints whole_;
};

class TexelLanes {
public:
    // The grid stays as long as this. wantsAlpha: three times the alpha instead of the colour.
    TexelLanes(const TexelGrid& grid, Extension extensionS, Extension extensionT, bool wantsAlpha)
        : grid_(grid), extensionS_(extensionS), extensionT_(extensionT), wantsAlpha_(wantsAlpha),
          channels_(grid.image().channels), width_(grid.width()), height_(grid.height()) {}

    // Stores W floats of each channel.
    void colors(const Doubles& s, const Doubles& t, float* r, float* g, float* b) const {
        const Taps x = taps(s, width_, extensionS_), y = taps(t, height_, extensionT_);
        float* const to[] = {r, g, b};
        switch (grid_.image().depth) {
        case StoredImage::Depth::Bits8: return mix<ByteTexels>(x, y, to);
        case StoredImage::Depth::Bits16: return mix<WordTexels>(x, y, to);
        case StoredImage::Depth::Float: return mix<FloatTexels>(x, y, to);
        }
    }

private:
    // Texels that coordinates fall between.
    struct Tap {
        Doubles number;
        Mask isInside;
    };
    struct Taps {
        Tap lo, hi;
        Doubles weight; // of hi
    };

    Taps taps(Doubles s, double size, Extension extension) const {
        // Limits keep the conversion to whole numbers safe; NaN becomes 0, or the limit of Clip.
        const Doubles zero(0.0), one(1.0);
        switch (extension) {
        case Extension::Repeat:
            s = s - floor(s);
            s = select(s < one, s, zero); // rounded up to 1, infinite or NaN
            break;
        case Extension::Extend: s = min(max(s, zero), one); break;
        case Extension::Clip: s = min(max(s, Doubles(-2.0)), Doubles(2.0)); break;
        }
        const Doubles texels = s * Doubles(size);
        const Doubles x = grid_.isNearest() ? texels : texels - Doubles(0.5);
        const Doubles below = floor(x);
        return {tap(below, size, extension), tap(below + one, size, extension), x - below};
    }

    static Tap tap(const Doubles& i, double size, Extension extension) {
        const Doubles zero(0.0), end(size);
        const Mask all = maskOf((1u << W) - 1);
        if (extension != Extension::Repeat) {
            const Mask isInside = maskOf(less(i, end) & ~less(i, zero));
            return {min(max(i, zero), Doubles(size - 1)),
                    extension == Extension::Clip ? isInside : all};
        }
        const Doubles notBelow = select(i < zero, i + end, i);
        return {select(notBelow < end, notBelow, notBelow - end), all};
    }

    bool isClipped() const {
        return extensionS_ == Extension::Clip || extensionT_ == Extension::Clip;
    }
    bool hasAlpha() const { return channels_ % 2 == 0; }
    int alphaNumber() const { return hasAlpha() ? channels_ - 1 : kOpaque; }

    // Rows of the file come from the top, y from the bottom.
    Ints firstNumber(const Tap& x, const Tap& y) const {
        const Doubles row = Doubles(height_ - 1) - y.number;
        return wholeOf((row * Doubles(width_) + x.number) * Doubles(channels_));
    }
    template <class Texels> Texels texelsAt(const Tap& x, const Tap& y) const {
        const Mask isInside = x.isInside & y.isInside;
        const Ints first = firstNumber(x, y);
        if constexpr (std::is_same_v<Texels, ByteTexels>) {
            const Ints bytes = bytesAt(grid_.image().bytes, first);
            const Ints whole = hasAlpha() ? bytes : (bytes & Ints(0xffffffu)) + Ints(0xff000000u);
            return {select(isInside, whole, Ints(0u))};
        } else if constexpr (std::is_same_v<Texels, FloatTexels>) {
            FloatTexels out;
            FloatRows(grid_.image().floats).load(first, out.numbers);
            if (!hasAlpha()) out.numbers[kOpaque] = Floats(1.0f);
            if (isClipped())
                for (Floats& number : out.numbers) number = select(isInside, number, Floats(0.0f));
            return out;
        } else {
            WordTexels out;
            alignas(64) std::uint32_t number[W];
            first.store(number);
            out.isOpaque = !hasAlpha();
            for (std::size_t lane = 0; lane < W; ++lane)
                out.at[lane] = (bits(isInside) >> lane & 1) != 0
                                   ? grid_.image().words.data() + number[lane]
                                   : nullptr;
            return out;
        }
    }
    // Returns four bytes from each number on, or as many as there are.
    static Ints bytesAt(std::span<const std::uint8_t> bytes, Ints first) {
        const std::size_t size = bytes.size();
        const auto end = static_cast<std::uint32_t>(size - std::min<std::size_t>(size, 3));
        if (bits(first < Ints(end)) == (1u << W) - 1) return fourBytesAt(bytes.data(), first);
        alignas(64) std::uint32_t at[W];
        first.store(at);
        for (std::uint32_t& x : at) {
            const auto rest = bytes.subspan(x);
            x = 0;
            std::memcpy(&x, rest.data(), std::min(rest.size(), sizeof x));
        }
        return Ints::load(at);
    }

    // of(i) is a number of texel i: lower left, lower right, upper left, upper right.
    template <class Fn> static Doubles mixedOf(const Fn& of, const Taps& x, const Taps& y) {
        const Doubles one(1.0);
        const auto lerp = [&](const Doubles& a, const Doubles& b, const Doubles& weight) {
            return a * (one - weight) + b * weight;
        };
        return lerp(lerp(of(0), of(1), x.weight), lerp(of(2), of(3), x.weight), y.weight);
    }

    // Between texels of different alpha each counts as much as it covers.
    template <class Texels> void mix(const Taps& x, const Taps& y, float* const (&to)[3]) const {
        const Texels first = texelsAt<Texels>(x.lo, y.lo);
        std::array<Texels, 4> texels{first, first, first, first};
        if (!grid_.isNearest()) {
            texels[1] = texelsAt<Texels>(x.hi, y.lo);
            texels[2] = texelsAt<Texels>(x.lo, y.hi);
            texels[3] = texelsAt<Texels>(x.hi, y.hi);
        }
        const auto alphaOf = [&](std::size_t i) { return texels[i].number(alphaNumber()); };
        unsigned uneven = 0; // lanes where something covers, and not all alike
        Doubles covered(0.0);
        if (!wantsAlpha_ && !grid_.isNearest() && (hasAlpha() || isClipped())) {
            unsigned even = (1u << W) - 1;
            for (std::size_t i = 1; i < 4; ++i)
                even &= atMost(alphaOf(0), alphaOf(i)) & atMost(alphaOf(i), alphaOf(0));
            if (even != (1u << W) - 1) {
                covered = mixedOf(alphaOf, x, y);
                uneven = ~even & less(Doubles(0.0), covered);
            }
        }
        const auto unit = [&](int number) {
            const auto numberOf = [&](std::size_t i) { return texels[i].number(number); };
            Doubles mixed = grid_.isNearest() ? numberOf(0) : mixedOf(numberOf, x, y);
            if (uneven != 0) {
                const auto share = [&](std::size_t i) { return alphaOf(i) * numberOf(i); };
                mixed = select(maskOf(uneven), mixedOf(share, x, y) / covered, mixed);
            }
            if constexpr (Texels::kOne != 1) mixed = mixed / Doubles(Texels::kOne);
            return mixed.toFloats();
        };
        const bool isGrey = wantsAlpha_ || channels_ < 3;
        for (int c = 0; c < (isGrey ? 1 : 3); ++c) {
            const Floats code = unit(wantsAlpha_ ? alphaNumber() : c);
            const Floats value = grid_.isSrgb() && !wantsAlpha_ ? linearFromSrgb(code) : code;
            for (int i = c; i < (isGrey ? 3 : c + 1); ++i) value.store(to[i]);
        }
    }

    const TexelGrid& grid_;
    Extension extensionS_, extensionT_;
    bool wantsAlpha_;
    int channels_;
    double width_, height_;
};

LANES_END
