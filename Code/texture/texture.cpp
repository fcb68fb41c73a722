#include "texture/texture.h"

#include "base/error.h"
#include "base/math.h"
#include "image/colour.h"

#include <utility>

Texture::Texture(StoredImage image, const TextureParams& params)
    : grid_(std::move(image), params.space, params.interpolation), extension_(params.extension),
      channel_(params.channel), offset_(params.offset) {
    const exact::SinCos turn = exact::sinCos(params.rotationRad);
    sFromU_ = turn.cos * params.scale.x;
    sFromV_ = -turn.sin * params.scale.y;
    tFromU_ = turn.sin * params.scale.x;
    tFromV_ = turn.cos * params.scale.y;
}

Vec2d Texture::mapped(Vec2 uv) const {
    const double u = static_cast<double>(uv.x), v = static_cast<double>(uv.y);
    return {sFromU_ * u + sFromV_ * v + offset_.x, tFromU_ * u + tFromV_ * v + offset_.y};
}

Rgb Texture::color(Vec2 uv) const {
    const Vec2d st = mapped(uv);
    if (channel_ == TextureParams::Channel::Color)
        return grid_.color(st.x, st.y, extension_, extension_);
    const float alpha = grid_.alpha(st.x, st.y, extension_, extension_);
    return {alpha, alpha, alpha};
}

float Texture::valueAt(Vec2d st) const {
    if (channel_ == TextureParams::Channel::Color)
        return luminance(grid_.color(st.x, st.y, extension_, extension_));
    return grid_.alpha(st.x, st.y, extension_, extension_);
}

float Texture::valueOf(Rgb color) const {
    return channel_ == TextureParams::Channel::Color ? luminance(color) : color.r;
}

float Texture::value(Vec2 uv) const { return valueAt(mapped(uv)); }

std::optional<ByteTexture> Texture::bytes() const {
    auto texels = grid_.bytes(extension_, extension_);
    if (!texels) return {};
    texels->asksAlpha = channel_ == TextureParams::Channel::Alpha;
    return ByteTexture{*texels, sFromU_, sFromV_, tFromU_, tFromV_, offset_.x, offset_.y};
}

Vec2 Texture::gradient(Vec2 uv) const {
    const Vec2d st = mapped(uv);
    const auto slope = [&](Vec2d halfTexel, int size) {
        const double up = static_cast<double>(valueAt(st + halfTexel));
        return (up - static_cast<double>(valueAt(st - halfTexel))) * size;
    };
    const double ds = slope({0.5 / grid_.width(), 0}, grid_.width());
    const double dt = slope({0, 0.5 / grid_.height()}, grid_.height());
    return {static_cast<float>(sFromU_ * ds + tFromU_ * dt),
            static_cast<float>(sFromV_ * ds + tFromV_ * dt)};
}

namespace {

// What stands for 1.
constexpr double largest(std::uint8_t) { return 255; }
constexpr double largest(std::uint16_t) { return 65535; }
constexpr double largest(float) { return 1; }

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

template <class Fn> auto TexelGrid::mixedAt(const Tap& x, const Tap& y, Fn&& fn) const {
    const auto of = [&]<class Number>(const std::vector<Number>& numbers) {
        // y from the bottom, the file's rows from the top.
        const auto texel = [&](int i, int j) -> const Number* {
            if (i == kOutside || j == kOutside) return nullptr;
            const auto row = static_cast<std::size_t>(image_.height - 1 - j);
            return numbers.data() +
                   (row * static_cast<std::size_t>(image_.width) + static_cast<std::size_t>(i)) *
                       static_cast<std::size_t>(image_.channels);
        };
        constexpr double kOne = largest(Number{});
        const auto number = [](const Number* at, int i) {
            if (at == nullptr) return 0.0;
            return i == kOpaque ? kOne : static_cast<double>(at[i]);
        };
        const Number* const first = texel(x.lo, y.lo);
        if (isNearest_) {
            const auto unit = [&](int i) { return number(first, i) / kOne; };
            return fn(unit, unit);
        }
        const Number* const second = texel(x.hi, y.lo);
        const Number* const third = texel(x.lo, y.hi);
        const Number* const fourth = texel(x.hi, y.hi);
        const auto mixed = [&](const auto& of) {
            return lerp(lerp(of(first), of(second), x.weight),
                        lerp(of(third), of(fourth), x.weight), y.weight);
        };
        const auto unit = [&](int i) {
            return mixed([&](const Number* at) { return number(at, i); }) / kOne;
        };
        const auto alpha = [&](const Number* at) { return number(at, alphaNumber()); };
        const double some = alpha(first);
        const bool isEven = some == alpha(second) && some == alpha(third) && some == alpha(fourth);
        const double covered = isEven ? 0 : mixed(alpha);
        return fn(unit, [&](int i) {
            if (!(covered > 0)) return unit(i);
            const auto share = [&](const Number* at) { return alpha(at) * number(at, i); };
            return mixed(share) / covered / kOne;
        });
    };
    switch (image_.depth) {
    case StoredImage::Depth::Bits8: return of(image_.bytes);
    case StoredImage::Depth::Bits16: return of(image_.words);
    case StoredImage::Depth::Float: break;
    }
    return of(image_.floats);
}

Rgb TexelGrid::color(double s, double t, Extension extensionS, Extension extensionT) const {
    const Tap x = tap(s, image_.width, extensionS), y = tap(t, image_.height, extensionT);
    return mixedAt(x, y, [&](const auto&, const auto& covering) {
        const auto decoded = [&](int i) {
            const float value = static_cast<float>(covering(i));
            return isSrgb_ ? linearFromSrgb(value) : value;
        };
        const float first = decoded(0);
        if (image_.channels < 3) return Rgb{first, first, first};
        return Rgb{first, decoded(1), decoded(2)};
    });
}

float TexelGrid::alpha(double s, double t, Extension extensionS, Extension extensionT) const {
    const Tap x = tap(s, image_.width, extensionS), y = tap(t, image_.height, extensionT);
    return mixedAt(x, y, [&](const auto& unit, const auto&) {
        return static_cast<float>(unit(alphaNumber()));
    });
}

std::optional<ByteTexels> TexelGrid::bytes(Extension extensionS, Extension extensionT) const {
    if (image_.depth != StoredImage::Depth::Bits8) return {};
    ByteTexels texels;
    texels.bytes = image_.bytes;
    texels.width = image_.width, texels.height = image_.height, texels.channels = image_.channels;
    texels.isSrgb = isSrgb_, texels.isNearest = isNearest_;
    texels.extensionS = extensionS, texels.extensionT = extensionT;
    return texels;
}
