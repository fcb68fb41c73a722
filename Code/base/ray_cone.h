// RayCone: how wide a ray is. A ray of the camera stands for a part of a pixel, one that a rough
// surface scatters for a part of all directions; what they meet is seen as the mean over the width.
#pragma once

#include "base/vec.h"

#include <algorithm>
#include <cmath>
#include <numbers>

struct RayCone {
    float width = 0;  // across the ray, where it starts
    float spread = 0; // by which it widens per length: the full angle in radians

    float widthAt(float distance) const { return width + spread * distance; }
    // Returns the cone of a ray that goes on from there.
    RayCone from(float distance) const { return {widthAt(distance), spread}; }
    // Returns the cone of light that is refracted from where the index is `eta` times that behind the surface: the
    // product of the index, the width and the spread stays, and the width is that of the same spot
    // on the surface. The cosines are those before and behind it.
    RayCone refracted(float eta, float cosBefore, float cosBehind) const {
        if (!(cosBefore > 0) || !(cosBehind > 0)) return *this;
        const float narrower = std::sqrt(cosBehind / cosBefore);
        return {width * narrower, spread * eta / narrower};
    }
    // Returns the cone of a direction that was sampled with a density per steradian, from a lobe that so many
    // samples of a pixel stand for together: each has its share of the sphere, and no more than
    // kWidestSpread.
    RayCone scattered(float pdf, float inverseSamples) const {
        constexpr float kWidestSpread = 0.3f;
        const float solidAngle = inverseSamples / pdf;
        const float whole = std::sqrt(solidAngle * (4 * std::numbers::inv_pi_v<float>));
        return {width, std::max(spread, std::min(whole, kWidestSpread))};
    }
};
