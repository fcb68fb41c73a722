// Filter: the pixel filter, used by importance: samples are placed with the filter's density, so
// every sample has weight 1 and belongs to one pixel (Ernst 2006). All filters here are positive.
// Knows nothing about pictures.
#pragma once

#include "base/vec.h"

#include <vector>

enum class FilterKind { Box, Tent, Gaussian, BlackmanHarris };

class Filter {
public:
    // Width in pixels as Cycles counts it (film.cpp): Box and Tent reach width/2 to each side,
    // BlackmanHarris reaches width, Gaussian has sigma = width/4 and is cut at 1.5 width.
    // A width of 0 puts all samples into the centre.
    Filter(FilterKind kind, double width);

    // Offset from the centre of the pixel, in pixels, for u in [0,1)^2; (0.5, 0.5) gives (0, 0).
    // It is monotone in u, so stratified u give stratified offsets. The share of samples left of
    // any offset is right to 2e-6.
    Vec2 sample(Vec2 u) const;
    // The unnormalised density at an offset along one axis, in pixels; separable.
    double value(double offset) const;
    double radius() const { return radius_; } // no offset is larger, in pixels
    // All that sample() is made of: for lanes, which take many samples at once.
    static constexpr int kSteps = 1024;
    struct Spread {
        FilterKind kind;
        double radius;
        // Of the smooth kinds: entry i of kSteps + 1 is where, in radii from the centre,
        // 1 - (i / kSteps)^2 of its half of the samples are nearer; linear between.
        const float* inverse;
    };
    Spread spread() const { return {kind_, radius_, inverse_.data()}; }
    FilterKind kind() const { return kind_; }

private:
    FilterKind kind_;
    double width_, radius_;
    std::vector<float> inverse_; // of the CDF, upper half; only for the two smooth kinds
};
