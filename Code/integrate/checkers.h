// Checkers: planes of two materials, seen as the mean of both over what a ray stands for.
#pragma once

#include "accel/still_shape.h"
#include "scene/scene.h"

#include <cstdint>
#include <vector>

struct Wave;

struct Checker {
    std::uint32_t shape; // its number
    const StillShape* plane;
    // The lobes of both materials are of the same kinds and have no pictures: their numbers are
    // mixed. Else each sample has one of the materials, as often as its part says.
    bool mixes;
};

// Returns those of a scene whose integrator has lobes, by ascending number; planes that move are
// none.
std::vector<Checker> checkersOf(const Scene& scene);

// A point with the lobes of two materials.
struct MaterialMix {
    std::uint32_t other = 0;
    float part = 0; // of the other one
};

namespace waves {
// Stage of the wave, after its points have surfaces: decides what materials those on checkers have,
// and writes wave.memory.path.mixes, by point.
void mixCheckers(const Wave& wave);
} // namespace waves
