// Environment: an equirectangular picture around the scene, seen where rays meet no surface.
// Directions are Blender's: the middle of the picture is towards +x, its upper edge is +z, and the
// left quarter is towards +y.
#pragma once

#include "texture/texel_grid.h"

class Environment {
public:
    // The picture turned about +z by rotationRad, +x towards +y. Fails (ErrorKind::Input) when
    // the picture's numbers do not fill its rectangle.
    Environment(StoredImage image, ColorSpace space, Interpolation interpolation,
                double rotationRad);

    // u = 1/2 - (atan2(y, x) - rotation) / 2 pi, going round; v = 1/2 + latitude / pi from the
    // bottom, held at the poles. dir has any length; zero counts as +x.
    Rgb radiance(Vec3 dir) const;

private:
    TexelGrid grid_;
    double turns_; // rotation / 2 pi
};
