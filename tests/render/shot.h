// Renders scenes that are written as native text inside a test, for the closed-form pictures.
#pragma once

#include "base/math.h"
#include "base/text.h"
#include "base/transform.h"
#include "image/image.h"
#include "render/render.h"
#include "scene/scene.h"

#include <functional>
#include <string>
#include <vector>

namespace shot {

struct Shot {
    Image color;
    CodedImage codes; // see RenderSettings::onlyCodes
    std::vector<AovImage> aovs;
    Stats stats;
    Rgb at(int x, int y) const { return color.pixel(x, y); }
    const Image& aov(Aov which) const;
};
using Tweak = std::function<void(RenderSettings&)>;

// readTxt and validate; "raytracer 1" is put in front. Throws what they throw.
SceneDesc parse(const std::string& text);
// One thread, scalar kernel, textures from textureFolder(), then what `tweak` changes.
Shot render(const SceneDesc& desc, const Tweak& tweak = {});
Shot render(const std::string& text, const Tweak& tweak = {});

// A folder of this process for pictures that scenes name; removed at the end.
const std::string& textureFolder();
// Writes a float picture (read back as it is, always linear) of value(u, v) at the centres of the
// texels, v from the bottom; returns `name`.
std::string writeTexture(const std::string& name, int width, int height,
                         const std::function<Rgb(double, double)>& value);

// Settings of one ray through the middle of one pixel, up to the number of bounces.
inline constexpr const char* kOnePixel =
    "settings {\n resolution 1 1\n samples 1\n jitter false\n texture_filter none\n max_depth ";

// Square pictures of one sample in the middle of each pixel, from high above, looking straight down
// on the square of side `side` about (x, y) = centre; +y is up in the picture.
struct TopView {
    int pixels = 3;
    double side = 2;
    Vec2d centre{0, 0};
    double height = 10;
    int samples = 1;
    std::string more = {}; // lines of settings
    std::string text() const;
    Vec2d place(int x, int y) const {
        return {centre.x + ((x + 0.5) / pixels - 0.5) * side,
                centre.y - ((y + 0.5) / pixels - 0.5) * side};
    }
};

// Mean of a channel over all pixels, and the standard error of that mean when the pixels are
// independent samples of one number.
struct Estimate {
    double mean = 0, sigma = 0;
};
Estimate estimate(const Image& image, float Rgb::*channel = &Rgb::r);

double largest(const Image& image); // over all pixels and channels
double smallest(const Image& image);
// Largest |a - b| over all pixels and channels.
double maxDifference(const Image& a, const Image& b);
// Pixels that differ in any bit.
int differingPixels(const Image& a, const Image& b);

double length3(Vec3d v);

} // namespace shot

// |value - expected| <= relative * |expected|, in all three channels.
#define CHECK_RGB(value, expected, relative)                                                       \
    do {                                                                                           \
        const Rgb rgb_ = (value);                                                                  \
        const Vec3d wanted_ = (expected);                                                          \
        CHECK_NEAR(rgb_.r, wanted_.x, (relative)*std::fabs(wanted_.x));                            \
        CHECK_NEAR(rgb_.g, wanted_.y, (relative)*std::fabs(wanted_.y));                            \
        CHECK_NEAR(rgb_.b, wanted_.z, (relative)*std::fabs(wanted_.z));                            \
    } while (false)
