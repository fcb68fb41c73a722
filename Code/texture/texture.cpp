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
    const Texel texel = grid_.at(st.x, st.y, extension_, extension_);
    if (channel_ == TextureParams::Channel::Color) return texel.color;
    return {texel.alpha, texel.alpha, texel.alpha};
}

float Texture::valueAt(Vec2d st) const {
    const Texel texel = grid_.at(st.x, st.y, extension_, extension_);
    return channel_ == TextureParams::Channel::Color ? luminance(texel.color) : texel.alpha;
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
    return {static_cast<float>(sFromU_ * ds + tFromU_ * dt),
            static_cast<float>(sFromV_ * ds + tFromV_ * dt)};
}
