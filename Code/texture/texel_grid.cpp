#include "texture/texel_grid.h"

#include "base/error.h"
#include "base/math.h"
#include "image/colour.h"

#include <utility>

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
        s -= std::floor(s);
        if (!(s >= 0 && s < 1)) s = 0; // rounded up to 1, infinite or NaN
        break;
    case Extension::Extend: s = clamp(s, 0.0, 1.0); break;
    case Extension::Clip: s = clamp(s, -2.0, 2.0); break;
    }
    const double x = isNearest_ ? s * size : s * size - 0.5;
    const double below = std::floor(x);
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

double TexelGrid::number(std::size_t index) const {
    switch (image_.depth) {
    case StoredImage::Depth::Bits8: return image_.bytes[index] / 255.0;
    case StoredImage::Depth::Bits16: return image_.words[index] / 65535.0;
    case StoredImage::Depth::Float: break;
    }
    return static_cast<double>(image_.floats[index]);
}

// y from the bottom, the file's rows from the top.
TexelGrid::Channels TexelGrid::stored(int x, int y) const {
    if (x == kOutside || y == kOutside) return {};
    const auto row = static_cast<std::size_t>(image_.height - 1 - y);
    const auto channels = static_cast<std::size_t>(image_.channels);
    const std::size_t first =
        (row * static_cast<std::size_t>(image_.width) + static_cast<std::size_t>(x)) * channels;
    Channels c;
    c.r = c.g = c.b = number(first);
    if (channels >= 3) {
        c.g = number(first + 1);
        c.b = number(first + 2);
    }
    c.a = channels % 2 == 0 ? number(first + channels - 1) : 1;
    return c;
}

Texel TexelGrid::at(double s, double t, Extension extensionS, Extension extensionT) const {
    const Tap x = tap(s, image_.width, extensionS), y = tap(t, image_.height, extensionT);
    Channels c = stored(x.lo, y.lo);
    if (!isNearest_) {
        const auto mix = [](const Channels& a, const Channels& b, double weight) {
            return Channels{lerp(a.r, b.r, weight), lerp(a.g, b.g, weight), lerp(a.b, b.b, weight),
                            lerp(a.a, b.a, weight)};
        };
        c = mix(mix(c, stored(x.hi, y.lo), x.weight),
                mix(stored(x.lo, y.hi), stored(x.hi, y.hi), x.weight), y.weight);
    }
    const auto decoded = [&](double encoded) {
        const float value = static_cast<float>(encoded);
        return isSrgb_ ? linearFromSrgb(value) : value;
    };
    return {{decoded(c.r), decoded(c.g), decoded(c.b)}, static_cast<float>(c.a)};
}
