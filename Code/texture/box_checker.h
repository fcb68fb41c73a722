// The exact mean of a checkerboard over a footprint: what part of it has the odd colour.
#pragma once

#include "texture/footprint.h"

#include <algorithm>
#include <cmath>

// The mean over [x - w / 2, x + w / 2] of a wave that is 1 on [0, 1), -1 on [1, 2), and so on; its
// integral is a triangle of the same period. Beyond a cell the mean is at most 1 / w.
inline double boxOfSquareWave(double x, double w) {
    const auto integral = [](double at) {
        const double f = at - 2 * std::floor(at / 2);
        return f < 1 ? f : 2 - f;
    };
    const double near = x - 2 * std::floor(x / 2); // far away its digits are the cell's number
    if (!(w > 0)) return near < 1 ? 1 : -1;
    return (integral(near + w / 2) - integral(near - w / 2)) / w;
}

// The part of a footprint around uv where floor(u) + floor(v) is odd. A long footprint is taken as
// up to sixteen boxes along it.
inline double oddPart(Vec2d uv, const UvFootprint& footprint) {
    constexpr double kMostBoxes = 16;
    const auto inDouble = [](Vec2 v) {
        return Vec2d{static_cast<double>(v.x), static_cast<double>(v.y)};
    };
    const auto lengthOf = [](double x, double y) { return std::sqrt(x * x + y * y); };
    const Vec2d along = inDouble(footprint.along), across = inDouble(footprint.across);
    const double wide = lengthOf(across.x, across.y), longest = lengthOf(along.x, along.y);
    const double boxes =
        wide > 0 ? std::clamp(std::ceil(longest / wide), 1.0, kMostBoxes) : kMostBoxes;
    const double widthU = lengthOf(along.x / boxes, across.x),
                 widthV = lengthOf(along.y / boxes, across.y);
    double sum = 0;
    for (double i = 0; i < boxes; ++i) {
        const double at = (2 * i + 1) / boxes / 2 - 0.5;
        sum += boxOfSquareWave(uv.x + at * along.x, widthU) *
               boxOfSquareWave(uv.y + at * along.y, widthV);
    }
    return std::clamp(0.5 * (1 - sum / boxes), 0.0, 1.0);
}
