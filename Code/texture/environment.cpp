#include "texture/environment.h"

#include "base/math.h"

#include <utility>

Environment::Environment(StoredImage image, ColorSpace space, Interpolation interpolation, Up up,
                         double rotationRad)
    : grid_(std::move(image), space, interpolation), up_(up), turns_(rotationRad * kInvTwoPi) {}

Environment::Place Environment::place(Vec3 dir) const {
    const Vec3d w = toDouble(dir);
    const Vec3d d = up_ == Up::Z ? w : Vec3d{w.x, -w.z, w.y};
    return {0.5 - exact::atan2(d.y, d.x) * kInvTwoPi + turns_,
            // asin(z) of a unit vector, without its loss of digits near the poles.
            0.5 + exact::atan2(d.z, std::sqrt(d.x * d.x + d.y * d.y)) * kInvPi};
}
