// Environment: an equirectangular picture around the scene, seen where rays meet no surface.
// Directions are Blender's: the middle of the picture is towards +x, its upper edge is +z, and the
// left quarter is towards +y. Up::Y turns all that by 90 degrees about x, so that the upper edge is
// +y and the left quarter towards -z.
#pragma once

#include "texture/texture.h"

#include <optional>
#include <string>
#include <vector>

class Environment {
public:
    // The picture turned about its upward axis by rotationRad, +x towards the left quarter. Fails
    // (ErrorKind::Input) when the picture's numbers do not fill its rectangle.
    enum class Up { Z, Y };
    Environment(StoredImage image, ColorSpace space, Interpolation interpolation, Up up,
                double rotationRad);

    // u = 1/2 - (atan2(y, x) - rotation) / 2 pi, going round; v = 1/2 + latitude / pi from the
    // bottom, held at the poles. dir has any length; zero counts as +x.
    Rgb radiance(Vec3 dir) const;

    // All that radiance() is made of: for lanes, which look many ways at once.
    struct View {
        Up up;
        double turns; // the rotation
    };
    const TexelGrid& grid() const { return grid_; }
    View view() const { return view_; }

private:
    TexelGrid grid_;
    View view_;
};

// SkyCells: how bright a picture around the scene is, cell by cell, for who samples it as a lamp.

struct SkyCells {
    int width = 0, height = 0;
    std::vector<float> luminance; // rows from the bottom, from the left
};
// The mean over all texels that have a say in a cell, between texels those of the next cell too: a
// cell is black only where the picture is. The cells are the picture's texels, or larger ones.
SkyCells skyCells(const Environment& environment, int mostColumns, int mostRows, int threads = 1);

// What is wrong with a picture that is to light the scene, with the place of the first such pixel
// from the left and from the top: one that is negative, or no number. Nothing if all is well.
std::optional<std::string> whyNoLight(const StoredImage& image);
