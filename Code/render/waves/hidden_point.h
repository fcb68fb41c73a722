// Whether something may hide a lamp from one point: what hiddenPoints() says of it among others
// (lamp_lanes.h), by the same operations and so to the same answer.
#pragma once

#include "base/vec.h"
#include "light/point_emission.h"

#include <cstdint>

class Occluders;

struct HidingPlace {
    Vec3 p, lift; // a point, and how far shadow rays are lifted off it
    std::uint32_t shape;
    bool inside; // of the shape, where the lamp is seen from
};

// `occluders` can tell.
bool mayHide(const Occluders& occluders, const HidingPlace& place, const LampBall& lamp);
