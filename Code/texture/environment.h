// Environment: an equirectangular picture around the scene, seen where rays meet no surface.
// Directions are Blender's: the middle of the picture is towards +x, its upper edge is +z, and the
// left quarter is towards +y. Up::Y turns all that by 90 degrees about x, so that the upper edge is
// +y and the left quarter towards -z.
#pragma once

#include "texture/byte_texture.h"

#include <optional>

class Environment {
public:
    // The picture turned about its upward axis by rotationRad, +x towards the left quarter. Fails
    // (ErrorKind::Input) when the picture's numbers do not fill its rectangle.
    enum class Up { Z, Y };
    Environment(StoredImage image, ColorSpace space, Interpolation interpolation, Up up,
                double rotationRad);

    // u = 1/2 - (atan2(y, x) - rotation) / 2 pi, going round; v = 1/2 + latitude / pi from the
    // bottom, held at the poles. dir has any length; zero counts as +x.
    Rgb radiance(Vec3 dir) const { return radiance(place(dir)); }

    // Where a direction is in the picture, from its left and its lower edge.
    struct Place {
        double s, t;
    };
    Place place(Vec3 dir) const;
    Rgb radiance(Place at) const {
        return grid_.color(at.s, at.t, Extension::Repeat, Extension::Extend);
    }

    // What place() and radiance() know, as plain data, valid as long as this; texels only of bytes.
    struct View {
        Up up;
        double turns;
        std::optional<ByteTexels> texels;
    };
    const TexelGrid& grid() const { return grid_; }
    View view() const { return {up_, turns_, grid_.bytes(Extension::Repeat, Extension::Extend)}; }

private:
    TexelGrid grid_;
    Up up_;
    double turns_; // rotation / 2 pi
};
