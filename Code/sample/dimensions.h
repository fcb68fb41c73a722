// The fixed slots of random numbers: which dimension of a sample decides what.
// Switching a feature off leaves the numbers of all others as they were.
#pragma once

#include <cstdint>

inline constexpr std::uint32_t kPixelDimension = 0; // 0-1: place in the pixel
inline constexpr std::uint32_t kLensDimension = 2;  // 2-3: place on the lens
inline constexpr std::uint32_t kTimeDimension = 4;  // 4: time in the shutter; 5 is spare

// Eight per bounce. Two-dimensional slots are even, as Sobol pairs start there.
enum class BounceSlot : std::uint32_t {
    LightPick = 0, // which light, where one is chosen
    Lobe = 1,      // reflect, transmit, ...
    LightUv = 2,   // 2-3: place on the light
    BsdfUv = 4,    // 4-5: direction of the bounce
    Roulette = 6,  // end the path or not
    Spare = 7,
};

// Depth 0 is the hit of the camera ray.
constexpr std::uint32_t dimension(int depth, BounceSlot slot) {
    return 6 + 8 * static_cast<std::uint32_t>(depth) + static_cast<std::uint32_t>(slot);
}
