// What rays in many directions see of the picture around the scene, a register of them at a time:
// Environment::radiance(), operation by operation and so bit by bit.
#pragma once

#include "texture/environment.h"

#include <cstddef>

struct alignas(64) EnvironmentBlock {
    static constexpr std::size_t kRays = 64;
    float dir[3][kRays] = {};
    double s[kRays], t[kRays]; // Environment::Place, if the picture is not of bytes
    float color[3][kRays];     // if it is
};

// The first `count` rays of the block; others may be answered too. Null for the scalar kernel.
using EnvironmentColorsFn = void (*)(const Environment::View& view, EnvironmentBlock& block,
                                     std::size_t count);
