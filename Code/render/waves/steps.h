// Steps: what the wave loop does for some scenes only. Every stage of the loop is compiled with and
// without the steps that are its own, and a picture runs the stages for just what its scene needs
// (whitted.cpp), so that a step that is not needed takes no time. A step may be left out only where
// it would change nothing: T17 of the battery compares what scenes give with all of them.
#pragma once

#include "render/scene.h"

struct Steps {
    bool softLamps = false;  // lamps are sampled at random places
    bool lampBodies = false; // lamps that camera rays can see
    bool bounces = false;    // mirrors and transmission: waves after the first
    bool textures = false;   // pictures on materials; texture coordinates are asked for
    bool seeThrough = false; // surfaces that let rays go straight on, and light through to others
    bool branches = false;   // a ray may give several: not just plain mirrors
    bool draws = false;      // random numbers behind the first hit: soft lamps, rough surfaces

    constexpr bool operator==(const Steps&) const = default;
};

// What pictures of this scene need; everything unless the settings let pictures be specialised.
Steps stepsFor(const Scene& scene, const RenderSettings& settings);

// Calls fn<answers...>(): what is known when it runs becomes known to the compiler.
template <bool... kAnswers, class Fn> void compiledFor(const Fn& fn) {
    fn.template operator()<kAnswers...>();
}
template <bool... kAnswers, class Fn, class... More>
void compiledFor(const Fn& fn, bool answer, More... more) {
    if (answer)
        compiledFor<kAnswers..., true>(fn, more...);
    else
        compiledFor<kAnswers..., false>(fn, more...);
}
