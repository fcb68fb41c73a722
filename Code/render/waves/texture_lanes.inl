// The formulas of Texture::color(), TexelGrid::at() and linearFromSrgb(), lane by lane and in their
// order. Numbers of texels are whole doubles: exact, and no conversions on the way to an address.
// Included by the file of each instruction set inside its namespace.

class ColorLanes {
public:
    explicit ColorLanes(const ByteTexture& texture)
        : texture_(texture), width_(texture.width), height_(texture.height) {}

    // Of the W points of a block from `first` on.
    void colors(TextureBlock& block, std::size_t first) const {
        const Doubles u(Floats::load(block.u + first)), v(Floats::load(block.v + first));
        const auto mapped = [&](double fromU, double fromV, double offset) {
            return Doubles(fromU) * u + Doubles(fromV) * v + Doubles(offset);
        };
        const Taps x = taps(mapped(texture_.sFromU, texture_.sFromV, texture_.offsetS), width_);
        const Taps y = taps(mapped(texture_.tFromU, texture_.tFromV, texture_.offsetT), height_);
        std::array<Ints, 4> texels{texelsAt(x.lo, y.lo), Ints(0u), Ints(0u), Ints(0u)};
        if (!texture_.isNearest) {
            texels[1] = texelsAt(x.hi, y.lo);
            texels[2] = texelsAt(x.lo, y.hi);
            texels[3] = texelsAt(x.hi, y.hi);
        }
        const bool isGrey = texture_.asksAlpha || texture_.channels < 3;
        for (int c = 0; c < (isGrey ? 1 : 3); ++c) {
            const Doubles code = mixed(texels, c, x.weight, y.weight);
            const Floats encoded = (code / Doubles(255.0)).toFloats();
            const Floats value =
                texture_.isSrgb && !texture_.asksAlpha ? decoded(encoded) : encoded;
            for (int to = c; to < (isGrey ? 3 : c + 1); ++to) value.store(block.color[to] + first);
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

    Taps taps(Doubles s, double size) const {
        const Doubles zero(0.0), one(1.0);
        switch (texture_.extension) {
        case Extension::Repeat:
            s = s - floor(s);
            s = select(s < one, s, zero);
            break;
        case Extension::Extend: s = min(max(s, zero), one); break;
        case Extension::Clip: s = min(max(s, Doubles(-2.0)), Doubles(2.0)); break;
        }
        const Doubles texels = s * Doubles(size);
        const Doubles x = texture_.isNearest ? texels : texels - Doubles(0.5);
        const Doubles below = floor(x);
        return {tap(below, size), tap(below + one, size), x - below};
    }

    Tap tap(const Doubles& i, double size) const {
        const Doubles zero(0.0), end(size);
        const Mask isInside = maskOf(less(i, end) & ~less(i, zero));
        const Mask all = maskOf((1u << W) - 1);
        if (texture_.extension != Extension::Repeat)
            return {min(max(i, zero), Doubles(size - 1)),
                    texture_.extension == Extension::Clip ? isInside : all};
        const Doubles notBelow = select(i < zero, i + end, i);
        return {select(notBelow < end, notBelow, notBelow - end), all};
    }

    // Byte c: component c, or alpha where that is asked; zeros outside.
    Ints texelsAt(const Tap& x, const Tap& y) const {
        const Mask isInside = x.isInside & y.isInside;
        const bool hasAlpha = texture_.channels % 2 == 0;
        if (texture_.asksAlpha && !hasAlpha) return select(isInside, Ints(255u), Ints(0u));
        const double skipped = texture_.asksAlpha ? texture_.channels - 1 : 0;
        const Doubles row = Doubles(height_ - 1) - y.number;
        const Doubles texel = row * Doubles(width_) + x.number;
        const Ints offset = wholeOf(texel * Doubles(texture_.channels) + Doubles(skipped));
        return select(isInside, bytesAt(offset), Ints(0u));
    }
    // Four bytes, or as many as there are.
    Ints bytesAt(Ints offset) const {
        const std::size_t size = texture_.bytes.size();
        const auto end = static_cast<std::uint32_t>(size - std::min<std::size_t>(size, 3));
        if (bits(offset < Ints(end)) == (1u << W) - 1)
            return fourBytesAt(texture_.bytes.data(), offset);
        alignas(64) std::uint32_t at[W];
        offset.store(at);
        for (std::uint32_t& x : at) {
            const auto rest = texture_.bytes.subspan(x);
            x = 0;
            std::memcpy(&x, rest.data(), std::min(rest.size(), sizeof x));
        }
        return Ints::load(at);
    }

    Doubles mixed(const std::array<Ints, 4>& texels, int component, const Doubles& weightX,
                  const Doubles& weightY) const {
        const auto code = [&](std::size_t i) { return doublesOf(byteOf(texels[i], component)); };
        if (texture_.isNearest) return code(0);
        const Doubles one(1.0);
        const auto lerp = [&](const Doubles& a, const Doubles& b, const Doubles& weight) {
            return a * (one - weight) + b * weight;
        };
        return lerp(lerp(code(0), code(1), weightX), lerp(code(2), code(3), weightX), weightY);
    }

    static Floats decoded(Floats encoded) {
        const Doubles s(min(max(encoded, Floats(0.0f)), Floats(1.0f)));
        const Ints k = wholeOf(s * Doubles(255.0) + Doubles(0.5));
        const double* const table = &srgb::decodeNodes().front().value;
        constexpr int kStride = sizeof(srgb::DecodeNode) / sizeof(double);
        const Doubles value = elementsAt<kStride>(table, k),
                      inverse = elementsAt<kStride>(table + 1, k);
        const Doubles u = (s - doublesOf(k) / Doubles(255.0)) * inverse;
        const Doubles curve =
            value * (Doubles(1.0) +
                     u * (Doubles(2.4) + u * (Doubles(1.68) + u * Doubles(0.224))));
        const unsigned dark = atMost(s, Doubles(srgb::kDecodeThreshold));
        if (dark == 0) return curve.toFloats();
        return select(maskOf(dark), s / Doubles(12.92), curve).toFloats();
    }

    const ByteTexture& texture_;
    double width_, height_;
};

void textureColors(const ByteTexture& texture, TextureBlock& block, std::size_t count) {
    const ColorLanes lanes(texture);
    for (std::size_t first = 0; first < count; first += W) lanes.colors(block, first);
}
