// What the filter of denoise.h reads and writes, by columns, and the function in lanes that runs
// it. Knows numbers only.
#pragma once

#include <cstddef>

// One half of the samples of a picture, in planes of rows with a border: colours there are so far
// from all others that no pixel takes them.
struct DenoisePlanes {
    // Left of a row, and right of it, where the last register may begin in the row.
    static constexpr int kBorderLeft = 16, kBorderRight = 32;
    static constexpr float kOutside = 1e30f;

    int width = 0, height = 0;
    int radius = 0; // of the window around a pixel, up to kBorderLeft
    std::size_t stride = 0;
    // Each from pixel (0, 0) on. Colours, which are averaged, and what pixels are compared by.
    const float *color[3] = {}, *compared[3] = {};
    // How large the square of the difference of two that are compared may be: the share of a pixel,
    // and the larger one that it has when it looks for others.
    const float *room[3] = {}, *ownRoom[3] = {};
    // What the first hits of a pixel's samples show, and one over the squared distance from which on
    // other pixels show something else.
    const float *albedo[3] = {}, *normal[3] = {};
    const float *albedoScale = nullptr, *normalScale = nullptr;
    // 0 for pixels that are replaced by what is around them, if there is anything, else 1.
    const float* trust = nullptr;
};

struct DenoiseLanes {
    // The filtered colours of a row, with room for a register more than it has, and what part of a
    // pixel's variance is left in them.
    void (*row)(const DenoisePlanes& planes, int y, float* const (&to)[3], float* left);
};
