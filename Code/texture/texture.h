// Texture: a picture over the uv coordinates of a surface, and TexelGrid, the numbers of pictures.
#pragma once

#include "image/image.h"
#include "texture/footprint.h"

#include <memory>

enum class Extension { Repeat, Extend, Clip };
enum class Interpolation { Bilinear, Nearest };
// How a file's whole numbers encode light. Float files are always linear.
enum class ColorSpace { Srgb, Linear };

// TexelGrid: the stored numbers of a picture, read between its texels. Texture and Environment say
// where; what is outside is the extension's business. Knows nothing about uv maps or directions.
class TexelGrid {
public:
    // Fails (ErrorKind::Input) when the picture's numbers do not fill its rectangle.
    TexelGrid(StoredImage image, ColorSpace space, Interpolation interpolation);

    int width() const { return image_.width; }
    int height() const { return image_.height; }
    const StoredImage& image() const { return image_; }
    bool isSrgb() const { return isSrgb_; }
    bool isNearest() const { return isNearest_; }

    // s from left to right, t from BOTTOM to top, both 0..1 over the picture; any number is safe.
    // Bilinear: x = s width - 1/2 between the centres of texels. Numbers are filtered as they are
    // stored and decoded to linear afterwards: this is what Cycles does with 8-bit sRGB (decoding
    // first is off by 0.23 on black/white edges), and 16-bit files look the same as 8-bit ones.
    // Clip: everything outside is transparent black.
    // Between texels of different alpha each counts as much as it covers, as in a picture whose
    // colours are multiplied by alpha, filtered, and divided by it: what is transparent has no
    // colour that could be seen at the edge of a cut-out. Where nothing covers, colours are mixed
    // as they are.
    Rgb color(double s, double t, Extension extensionS, Extension extensionT) const;
    // Never encoded, and transparency does not darken the colour; 1 without an alpha channel.
    float alpha(double s, double t, Extension extensionS, Extension extensionT) const;

private:
    StoredImage image_;
    bool isSrgb_, isNearest_;
};

// Where a point is looked up: s = (sFromU u + sFromV v) + offsetS, t likewise.
struct TextureMap {
    double sFromU, sFromV, tFromU, tFromV, offsetS, offsetT;
};

// Row 0 of the file is the top; v goes up, (0,0) is the lower left corner of the picture.
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

class MipLevels;

class Texture {
public:
    // Fails (ErrorKind::Input) when the picture's numbers do not fill its rectangle.
    Texture(StoredImage image, const TextureParams& params);
    Texture(Texture&&) noexcept;
    ~Texture();

    Rgb color(Vec2 uv) const;   // linear
    // The mean over a footprint around uv, in linear light; color(uv) where that is no wider than a
    // texel.
    Rgb color(Vec2 uv, const UvFootprint& footprint) const;
    float value(Vec2 uv) const; // luminance, or alpha
    // value() where color() is this.
    float valueOf(Rgb color) const;
    // d value / du and / dv of uv as given, for bump maps: the central difference over one texel
    // of the picture, which is the slope that bilinear filtering has half-way between two texels.
    Vec2 gradient(Vec2 uv) const;
    // All that color() is made of: for lanes, which look up many points at once.
    const TexelGrid& grid() const { return grid_; }
    const TextureMap& map() const { return map_; }
    Extension extension() const { return extension_; }
    const MipLevels& mips() const { return *mips_; }
    bool isAlpha() const { return channel_ == TextureParams::Channel::Alpha; }

private:
    Vec2d mapped(Vec2 uv) const;
    float valueAt(Vec2d st) const;

    TexelGrid grid_;
    Extension extension_;
    TextureParams::Channel channel_;
    TextureMap map_;
    std::unique_ptr<const MipLevels> mips_;
};
