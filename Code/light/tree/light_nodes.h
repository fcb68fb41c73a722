// LightNode: a light, or a group of them, in the tree by which one of many is chosen. 32 bytes; the
// two children of a group follow each other, in one line of the cache.
#pragma once

#include "light/tree/light_bounds.h"

#include <cstdint>
#include <span>

struct LightNode {
    float centre[3];              // of a ball around all places; of what is distant x is
                                  // LightBounds::reach2
    float intensity;              // sum; 0 for none
    std::uint32_t radiusAndX;     // upper half: the ball's radius, a float without its lower half;
                                  // lower half: x of the axis
    std::uint32_t yAndZ;          // of the axis
    std::uint32_t spreadAndReach; // cosines: 16 bits, then 14 bits, then the flags
    std::uint32_t child;          // kLightLeaf + light, or the pair of its children

    static constexpr std::uint32_t kTwoSided = 1, kDistant = 2;      // flags
    static constexpr float kCosineSteps = 32767, kReachSteps = 8191; // -1 to 1 is twice as many
};
static_assert(sizeof(LightNode) == 32);
inline constexpr std::uint32_t kLightLeaf = 0x80000000u;

// Makes a node that bounds at least as much.
LightNode packedNode(const LightBounds& bounds, std::uint32_t child);

// What the lanes see of a LightPicker.
struct LightTreeView {
    const LightNode* pairs = nullptr;      // two nodes each; empty for one light
    const std::uint32_t* trails = nullptr; // of each light: bit i is set where the way from the
                                           // root goes to the second child of a pair in step i
    std::uint32_t lit = 0;  // how many lights are not dark
    std::uint32_t only = 0; // the light, if it is one
};
