// The formulas of TexelGrid::color() and linearFromSrgb(), lane by lane and in their order. Numbers
// of texels are whole doubles: exact, and no conversions on the way to an address.
#pragma once

#include "base/math.h"
#include "image/colour.h"
#include "simd/double_double_lanes.h"
#include "simd/lanes.h"
#include "texture/picture_lanes.h"
#include "texture/texture.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>

LANES_BEGIN

class TexelLanes {
public:
    explicit TexelLanes(const ByteTexels& texels)
        : texels_(texels), width_(texels.width), height_(texels.height) {}

    // Lane by lane TexelGrid::color(), or alpha(), at s and t; to W floats of each channel.
    void colors(const Doubles& s, const Doubles& t, float* r, float* g, float* b) const {
        const Taps x = taps(s, width_, texels_.extensionS);
        const Taps y = taps(t, height_, texels_.extensionT);
        std::array<Ints, 4> texels{texelsAt(x.lo, y.lo), Ints(0u), Ints(0u), Ints(0u)};
        if (!texels_.isNearest) {
            texels[1] = texelsAt(x.hi, y.lo);
            texels[2] = texelsAt(x.lo, y.hi);
            texels[3] = texelsAt(x.hi, y.hi);
        }
        const Covering covering = coveringOf(texels, x.weight, y.weight);
        float* const channels[] = {r, g, b};
        const bool isGrey = texels_.asksAlpha || texels_.channels < 3;
        for (int c = 0; c < (isGrey ? 1 : 3); ++c) {
            const Doubles code = colourOf(texels, c, x.weight, y.weight, covering);
            const Floats encoded = (code / Doubles(255.0)).toFloats();
            const Floats value = texels_.isSrgb && !texels_.asksAlpha ? decoded(encoded) : encoded;
            for (int to = c; to < (isGrey ? 3 : c + 1); ++to) value.store(channels[to]);
        }
    }

private:
    struct Tap {
        Doubles number;
        Mask isInside;
    };
    struct Taps {
        Tap lo, hi;
        Doubles weight; // of hi
    };

    Taps taps(Doubles s, double size, Extension extension) const {
        const Doubles zero(0.0), one(1.0);
        switch (extension) {
        case Extension::Repeat:
            s = s - floor(s);
            s = select(s < one, s, zero);
            break;
        case Extension::Extend: s = min(max(s, zero), one); break;
        case Extension::Clip: s = min(max(s, Doubles(-2.0)), Doubles(2.0)); break;
        }
        const Doubles texels = s * Doubles(size);
        const Doubles x = texels_.isNearest ? texels : texels - Doubles(0.5);
        const Doubles below = floor(x);
        return {tap(below, size, extension), tap(below + one, size, extension), x - below};
    }

    static Tap tap(const Doubles& i, double size, Extension extension) {
        const Doubles zero(0.0), end(size);
        const Mask isInside = maskOf(less(i, end) & ~less(i, zero));
        const Mask all = maskOf((1u << W) - 1);
        if (extension != Extension::Repeat)
            return {min(max(i, zero), Doubles(size - 1)),
                    extension == Extension::Clip ? isInside : all};
        const Doubles notBelow = select(i < zero, i + end, i);
        return {select(notBelow < end, notBelow, notBelow - end), all};
    }

    // Where texels of different alpha meet, and what all of them cover.
    struct Covering {
        unsigned uneven = 0; // lanes
        Doubles covered{0.0};
    };
    bool mayBeUneven() const {
        const bool isClipped =
            texels_.extensionS == Extension::Clip || texels_.extensionT == Extension::Clip;
        return !texels_.asksAlpha && !texels_.isNearest && (texels_.channels % 2 == 0 || isClipped);
    }
    int alphaByte() const { return texels_.channels == 2 ? 1 : 3; }
    Covering coveringOf(const std::array<Ints, 4>& texels, const Doubles& weightX,
                        const Doubles& weightY) const {
        if (!mayBeUneven()) return {};
        const Doubles first = alphaOf(texels[0]);
        unsigned even = (1u << W) - 1;
        for (std::size_t i = 1; i < 4; ++i) {
            const Doubles other = alphaOf(texels[i]);
            even &= atMost(first, other) & atMost(other, first);
        }
        const unsigned uneven = ~even & ((1u << W) - 1);
        if (uneven == 0) return {};
        const Doubles covered =
            mixedOf([&](std::size_t i) { return alphaOf(texels[i]); }, weightX, weightY);
        return {uneven & less(Doubles(0.0), covered), covered};
    }
    Doubles alphaOf(const Ints& texel) const { return doublesOf(byteOf(texel, alphaByte())); }
    Doubles colourOf(const std::array<Ints, 4>& texels, int component, const Doubles& weightX,
                     const Doubles& weightY, const Covering& covering) const {
        const Doubles plain = mixed(texels, component, weightX, weightY);
        if (covering.uneven == 0) return plain;
        const auto share = [&](std::size_t i) {
            return alphaOf(texels[i]) * doublesOf(byteOf(texels[i], component));
        };
        const Doubles shares = mixedOf(share, weightX, weightY);
        return select(maskOf(covering.uneven), shares / covering.covered, plain);
    }

    // Byte c: component c, or alpha where that is asked; zeros outside. Byte 3 of colours without
    // alpha is 255, inside.
    Ints texelsAt(const Tap& x, const Tap& y) const {
        const Mask isInside = x.isInside & y.isInside;
        const bool hasAlpha = texels_.channels % 2 == 0;
        if (texels_.asksAlpha && !hasAlpha) return select(isInside, Ints(255u), Ints(0u));
        const double skipped = texels_.asksAlpha ? texels_.channels - 1 : 0;
        const Doubles row = Doubles(height_ - 1) - y.number;
        const Doubles texel = row * Doubles(width_) + x.number;
        const Ints offset = wholeOf(texel * Doubles(texels_.channels) + Doubles(skipped));
        const Ints bytes = bytesAt(offset);
        const bool isOpaque = !texels_.asksAlpha && !hasAlpha;
        return select(isInside, isOpaque ? (bytes & Ints(0xffffffu)) + Ints(0xff000000u) : bytes,
                      Ints(0u));
    }
    // Four bytes, or as many as there are.
    Ints bytesAt(Ints offset) const {
        const std::size_t size = texels_.bytes.size();
        const auto end = static_cast<std::uint32_t>(size - std::min<std::size_t>(size, 3));
        if (bits(offset < Ints(end)) == (1u << W) - 1)
            return fourBytesAt(texels_.bytes.data(), offset);
        alignas(64) std::uint32_t at[W];
        offset.store(at);
        for (std::uint32_t& x : at) {
            const auto rest = texels_.bytes.subspan(x);
            x = 0;
            std::memcpy(&x, rest.data(), std::min(rest.size(), sizeof x));
        }
        return Ints::load(at);
    }

    Doubles mixed(const std::array<Ints, 4>& texels, int component, const Doubles& weightX,
                  const Doubles& weightY) const {
        const auto code = [&](std::size_t i) { return doublesOf(byteOf(texels[i], component)); };
        return texels_.isNearest ? code(0) : mixedOf(code, weightX, weightY);
    }
    // of(i) is a number of texel i: lower left, lower right, upper left, upper right.
    template <class Fn>
    static Doubles mixedOf(const Fn& of, const Doubles& weightX, const Doubles& weightY) {
        const Doubles one(1.0);
        const auto lerp = [&](const Doubles& a, const Doubles& b, const Doubles& weight) {
            return a * (one - weight) + b * weight;
        };
        return lerp(lerp(of(0), of(1), weightX), lerp(of(2), of(3), weightX), weightY);
    }

    static Floats decoded(Floats encoded) {
        const Doubles s(min(max(encoded, Floats(0.0f)), Floats(1.0f)));
        const Ints k = wholeOf(s * Doubles(255.0) + Doubles(0.5));
        const double* const table = &srgb::decodeNodes().front().value;
        constexpr int kStride = sizeof(srgb::DecodeNode) / sizeof(double);
        Doubles value(0.0), inverse(0.0);
        pairsAt<kStride>(table, k, value, inverse);
        const Doubles u = (s - doublesOf(k) / Doubles(255.0)) * inverse;
        const Doubles curve =
            value * (Doubles(1.0) + u * (Doubles(2.4) + u * (Doubles(1.68) + u * Doubles(0.224))));
        const unsigned dark = atMost(s, Doubles(srgb::kDecodeThreshold));
        if (dark == 0) return curve.toFloats();
        return select(maskOf(dark), s / Doubles(12.92), curve).toFloats();
    }

    const ByteTexels& texels_;
    double width_, height_;
};

// The formulas of Texture::color(), lane by lane and in their order.

void textureColors(const ByteTexture& texture, TextureBlock& block, std::size_t count) {
    const TexelLanes texels(texture.texels);
    for (std::size_t first = 0; first < count; first += W) {
        const Doubles u(Floats::load(block.u + first)), v(Floats::load(block.v + first));
        const auto mapped = [&](double fromU, double fromV, double offset) {
            return Doubles(fromU) * u + Doubles(fromV) * v + Doubles(offset);
        };
        texels.colors(mapped(texture.sFromU, texture.sFromV, texture.offsetS),
                      mapped(texture.tFromU, texture.tFromV, texture.offsetT),
                      block.color[0] + first, block.color[1] + first, block.color[2] + first);
    }
}

// The formulas of Environment::place() and, for bytes, of TexelGrid::color(), lane by lane and in
// their order.

void environmentColors(const Environment::View& view, EnvironmentBlock& block, std::size_t count) {
    for (std::size_t first = 0; first < count; first += W) {
        const auto of = [&](int axis) { return Doubles(Floats::load(block.dir[axis] + first)); };
        const bool isZUp = view.up == Environment::Up::Z;
        const Doubles x = of(0), y = isZUp ? of(1) : Doubles(-0.0) - of(2), z = of(isZUp ? 2 : 1);
        const Doubles s = Doubles(0.5) - anglesOf(y, x) * Doubles(kInvTwoPi) + Doubles(view.turns);
        const Doubles t = Doubles(0.5) + anglesOf(z, sqrt(x * x + y * y)) * Doubles(kInvPi);
        if (view.texels)
            TexelLanes(*view.texels)
                .colors(s, t, block.color[0] + first, block.color[1] + first,
                        block.color[2] + first);
        else
            s.store(block.s + first), t.store(block.t + first);
    }
}

LANES_END
