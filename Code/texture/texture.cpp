#include "texture/texture.h"

#include "base/math.h"

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
