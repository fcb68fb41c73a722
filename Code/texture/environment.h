// Environment: an equirectangular picture around the scene, seen where rays meet no surface.
// Its place is that of sample/sky_place.h.
#pragma once

#include "sample/sky_place.h"
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

    // Returns the colour of a direction of any length, see placesOf(): round and round, and held at
    // the poles.
    Rgb radiance(Vec3 dir) const;

    // All that radiance() is made of: for lanes, which look many ways at once.
    const TexelGrid& grid() const { return grid_; }
    const SkyPlace& place() const { return place_; }

private:
    TexelGrid grid_;
    SkyPlace place_;
};

// SkyCells: how bright a picture around the scene is, cell by cell, to be sampled as a lamp.

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
