// Steps: what the wave loop does for some scenes only. The loop is compiled for a few sets of steps
// (whitted.cpp); a picture is made by the first that covers what its scene needs. A step may be
// left out only where it would change nothing, so that all sets that cover a scene give the same
// bits: T17 of the battery compares them.
#pragma once

#include "render/scene.h"

#include <array>
#include <cstddef>

struct Steps {
    bool softLamps = false;  // lamps are sampled at random places
    bool lampBodies = false; // lamps that camera rays can see
    bool bounces = false;    // mirrors and transmission: waves after the first
    bool textures = false;   // pictures on materials; texture coordinates are asked for
    bool seeThrough = false; // surfaces that let rays go straight on, and light through to others

    constexpr bool cover(const Steps& need) const {
        return (softLamps || !need.softLamps) && (lampBodies || !need.lampBodies) &&
               (bounces || !need.bounces) && (textures || !need.textures) &&
               (seeThrough || !need.seeThrough);
    }
};

// The sets that the loop is compiled for, narrowest first; the last one is everything.
inline constexpr std::array kCompiledSteps{
    Steps{},
    Steps{.softLamps = true, .lampBodies = true},
    Steps{.bounces = true},
    Steps{.softLamps = true, .lampBodies = true, .bounces = true},
    Steps{.softLamps = true, .lampBodies = true, .textures = true},
    Steps{.softLamps = true, .lampBodies = true, .bounces = true, .textures = true},
    Steps{true, true, true, true, true},
};

// What pictures of this scene need; everything unless the settings let pictures be specialised.
Steps stepsFor(const Scene& scene, const RenderSettings& settings);
// Which of kCompiledSteps does it: the first that covers the need.
std::size_t compiledFor(const Steps& need);
