// The lines that place things: translate, rotate, scale, transform, look_at.
#pragma once

#include "desc/scene_desc.h"

#include <array>
#include <cstddef>
#include <span>
#include <string_view>

struct TransformLine {
    std::string_view keyword;
    std::size_t count;   // of numbers
    bool startsWithTurn; // the first one is an angle
    bool mayBeOne;       // one number stands for all
    // worldFromObject times what the line says; sets `fault` when the numbers say nothing.
    Rows (*apply)(const Rows& before, std::span<const double> numbers, std::string_view& fault);
};
std::span<const TransformLine> transformLines();
// Tells whether the view of look_at's nine numbers goes along its up direction, to 1e-10 radians:
// the roll of a camera would be decided by rounding.
bool isViewAlong(std::span<const double> numbers);
// Does one of their keywords, or "key", begin with this letter? Most lines say something else.
bool mayPlace(char first);
