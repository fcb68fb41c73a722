// Environment: an equirectangular picture around the scene, seen where rays meet no surface.
// Directions are Blender's: the middle of the picture is towards +x, its upper edge is +z, and the
// left quarter is towards +y. Up::Y turns all that by 90 degrees about x, so that the upper edge is
// +y and the left quarter towards -z.
#pragma once

#include "texture/texel_grid.h"

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

private:
    TexelGrid grid_;
    Up up_;
    double turns_; // rotation / 2 pi
};
