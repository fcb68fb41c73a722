#include "texture/texel_grid.h"

#include "base/error.h"
#include "base/math.h"
#include "image/colour.h"

#include <array>
#include <utility>

namespace {

// Whole codes as parts of the largest; of 8 bits by a table, as dividing is slow.
constexpr auto kUnit8 = [] {
    std::array<double, 256> table{};
    for (int code = 0; code < 256; ++code) table[static_cast<std::size_t>(code)] = code / 255.0;
    return table;
}();
double unitOf(std::uint8_t code) { return kUnit8[code]; }
double unitOf(std::uint16_t code) { return code / 65535.0; }
double unitOf(float value) { return static_cast<double>(value); }

// std::floor() is a call on plain x86-64.
double floorOf(double x) {
    if (!(std::fabs(x) < 0x1p31)) return std::floor(x);
    const double cut = static_cast<double>(static_cast<std::int64_t>(x));
    return cut > x ? cut - 1 : cut;
}

} // namespace

TexelGrid::TexelGrid(StoredImage image, ColorSpace space, Interpolation interpolation)
    : image_(std::move(image)),
      isSrgb_(space == ColorSpace::Srgb && image_.depth != StoredImage::Depth::Float),
      isNearest_(interpolation == Interpolation::Nearest) {
    std::size_t count = 0;
    switch (image_.depth) {
    case StoredImage::Depth::Bits8: count = image_.bytes.size(); break;
    case StoredImage::Depth::Bits16: count = image_.words.size(); break;
    case StoredImage::Depth::Float: count = image_.floats.size(); break;
    }
    const bool hasSides =
        image_.width > 0 && image_.height > 0 && image_.channels >= 1 && image_.channels <= 4;
    if (!hasSides || count != static_cast<std::size_t>(image_.width) *
                                  static_cast<std::size_t>(image_.height) *
                                  static_cast<std::size_t>(image_.channels))
        fail(ErrorKind::Input, "texture: error: the picture's data does not match its size");
}

TexelGrid::Tap TexelGrid::tap(double s, int size, Extension extension) const {
    // Limits keep the conversion to int safe; NaN becomes 0.
    switch (extension) {
    case Extension::Repeat:
        s -= floorOf(s);
        if (!(s >= 0 && s < 1)) s = 0; // rounded up to 1, infinite or NaN
        break;
    case Extension::Extend: s = clamp(s, 0.0, 1.0); break;
    case Extension::Clip: s = clamp(s, -2.0, 2.0); break;
    }
    const double x = isNearest_ ? s * size : s * size - 0.5;
    const double below = floorOf(x);
    const auto texel = [&](int i) {
        if (i >= 0 && i < size) return i;
        if (extension == Extension::Clip) return kOutside;
        if (extension == Extension::Repeat) return i < 0 ? i + size : i - size;
        return i < 0 ? 0 : size - 1;
    };
    const int lo = static_cast<int>(below);
    if (isNearest_) return {texel(lo), texel(lo), 0};
    return {texel(lo), texel(lo + 1), x - below};
}

// y from the bottom, the file's rows from the top.
template <class Number>
TexelGrid::Channels TexelGrid::stored(const std::vector<Number>& numbers, int x, int y) const {
    if (x == kOutside || y == kOutside) return {};
    const auto row = static_cast<std::size_t>(image_.height - 1 - y);
    const auto channels = static_cast<std::size_t>(image_.channels);
    const std::size_t first =
        (row * static_cast<std::size_t>(image_.width) + static_cast<std::size_t>(x)) * channels;
    Channels c;
    const Number* number = numbers.data() + first;
    c.r = c.g = c.b = unitOf(number[0]);
    if (channels >= 3) {
        c.g = unitOf(number[1]);
        c.b = unitOf(number[2]);
    }
    c.a = channels % 2 == 0 ? unitOf(number[channels - 1]) : 1;
    return c;
}

template <class Number>
TexelGrid::Channels TexelGrid::mixed(const std::vector<Number>& numbers, const Tap& x,
                                     const Tap& y) const {
    const Channels first = stored(numbers, x.lo, y.lo);
    if (isNearest_) return first;
    const auto mix = [](const Channels& a, const Channels& b, double weight) {
        return Channels{lerp(a.r, b.r, weight), lerp(a.g, b.g, weight), lerp(a.b, b.b, weight),
                        lerp(a.a, b.a, weight)};
    };
    return mix(mix(first, stored(numbers, x.hi, y.lo), x.weight),
               mix(stored(numbers, x.lo, y.hi), stored(numbers, x.hi, y.hi), x.weight), y.weight);
}

Texel TexelGrid::at(double s, double t, Extension extensionS, Extension extensionT) const {
    const Tap x = tap(s, image_.width, extensionS), y = tap(t, image_.height, extensionT);
    Channels c;
    switch (image_.depth) {
    case StoredImage::Depth::Bits8: c = mixed(image_.bytes, x, y); break;
    case StoredImage::Depth::Bits16: c = mixed(image_.words, x, y); break;
    case StoredImage::Depth::Float: c = mixed(image_.floats, x, y); break;
    }
    const auto decoded = [&](double encoded) {
        const float value = static_cast<float>(encoded);
        return isSrgb_ ? linearFromSrgb(value) : value;
    };
    return {{decoded(c.r), decoded(c.g), decoded(c.b)}, static_cast<float>(c.a)};
}
