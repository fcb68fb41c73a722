// Where the cameras of tests stand.
#pragma once

#include "analytic_kit.h"

namespace camera_kit {

inline Transform somewhere(kit::Random& random) {
    const double scale = random.logUniform(0.01, 100);
    return kit::placed(random, {scale, scale, scale}, random.inBox(1));
}

} // namespace camera_kit
