#include "texture/texture.h"

#include "base/error.h"
#include "base/math.h"
#include "texture/mip_levels.h"
#include "texture/pictures_in_lanes.h"

#include <utility>

Texture::Texture(StoredImage image, const TextureParams& params)
    : grid_(std::move(image), params.space, params.interpolation), extension_(params.extension),
      channel_(params.channel), mips_(std::make_unique<const MipLevels>(grid_)) {
    const exact::SinCos turn = exact::sinCos(params.rotationRad);
    map_ = {turn.cos * params.scale.x, -turn.sin * params.scale.y,
            turn.sin * params.scale.x, turn.cos * params.scale.y,
            params.offset.x,           params.offset.y};
}

Texture::Texture(Texture&&) noexcept = default;
Texture::~Texture() = default;

Vec2d Texture::mapped(Vec2 uv) const {
    const auto [s, t] = kernels::one::mappedBy(map_, uv.x, uv.y);
    return {s.v, t.v};
}

Rgb Texture::color(Vec2 uv) const {
    const Vec2d st = mapped(uv);
    if (channel_ == TextureParams::Channel::Color)
        return grid_.color(st.x, st.y, extension_, extension_);
    const float alpha = grid_.alpha(st.x, st.y, extension_, extension_);
    return {alpha, alpha, alpha};
}

Rgb Texture::color(Vec2 uv, const UvFootprint& footprint) const {
    using namespace kernels::one;
    if (footprint.isPoint()) return color(uv);
    const PictureAxes axes = axesOf(map_, footprint.along.x, footprint.along.y, footprint.across.x,
                                    footprint.across.y);
    const Floats3 mean = FilteredTexels(*this).colors(mappedBy(map_, uv.x, uv.y), axes);
    return {mean.x.v, mean.y.v, mean.z.v};
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

Vec2 Texture::gradient(Vec2 uv) const {
    const Vec2d st = mapped(uv);
    const auto slope = [&](Vec2d halfTexel, int size) {
        const double up = static_cast<double>(valueAt(st + halfTexel));
        return (up - static_cast<double>(valueAt(st - halfTexel))) * size;
    };
    const double ds = slope({0.5 / grid_.width(), 0}, grid_.width());
    const double dt = slope({0, 0.5 / grid_.height()}, grid_.height());
    return {static_cast<float>(map_.sFromU * ds + map_.tFromU * dt),
            static_cast<float>(map_.sFromV * ds + map_.tFromV * dt)};
}

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

Rgb TexelGrid::color(double s, double t, Extension extensionS, Extension extensionT) const {
    Rgb out;
    kernels::one::TexelLanes(*this, extensionS, extensionT, false)
        .colors(s, t, &out.r, &out.g, &out.b);
    return out;
}

float TexelGrid::alpha(double s, double t, Extension extensionS, Extension extensionT) const {
    Rgb out;
    kernels::one::TexelLanes(*this, extensionS, extensionT, true)
        .colors(s, t, &out.r, &out.g, &out.b);
    return out.r;
}
