// Texture: a picture over the uv coordinates of a surface.
// Row 0 of the file is the top; v goes up, (0,0) is the lower left corner of the picture.
#pragma once

#include "texture/byte_texture.h"

#include <optional>

struct TextureParams {
    enum class Channel { Color, Alpha }; // Alpha: the file's alpha channel as a grey picture
    ColorSpace space = ColorSpace::Srgb;
    Interpolation interpolation = Interpolation::Bilinear;
    Extension extension = Extension::Repeat;
    Channel channel = Channel::Color;
    // The picture is looked up at rotate(scale * uv) + offset, as Blender's Mapping node of type
    // Point: the rotation turns u towards v.
    Vec2d scale{1, 1};
    double rotationRad = 0;
    Vec2d offset{0, 0};
};

class Texture {
public:
    // Fails (ErrorKind::Input) when the picture's numbers do not fill its rectangle.
    Texture(StoredImage image, const TextureParams& params);

    Rgb color(Vec2 uv) const;   // linear
    float value(Vec2 uv) const; // luminance, or alpha
    // value() where color() is this.
    float valueOf(Rgb color) const;
    // d value / du and / dv of uv as given, for bump maps: the central difference over one texel
    // of the picture, which is the slope that bilinear filtering has half-way between two texels.
    Vec2 gradient(Vec2 uv) const;
    // The same texture as plain data, valid as long as this one; empty unless it is of bytes.
    std::optional<ByteTexture> bytes() const;

private:
    Vec2d mapped(Vec2 uv) const;
    float valueAt(Vec2d st) const;

    TexelGrid grid_;
    Extension extension_;
    TextureParams::Channel channel_;
    double sFromU_, sFromV_, tFromU_, tFromV_; // rotation * scale
    Vec2d offset_;
};
