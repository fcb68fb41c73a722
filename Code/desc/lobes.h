// LobeForm: a type of lobe as scenes write it. Reader, writer, validation and tests walk these
// tables, which come from the lobes themselves (material/lobe_types.h).
#pragma once

#include "desc/range.h"
#include "desc/scene_desc.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

struct LobeFieldForm {
    std::string_view name;
    std::size_t first = 0, count = 0; // of its numbers in LobeDesc::numbers
    Range range;                      // of each of them
};

struct LobeForm {
    std::string_view name;
    std::vector<LobeFieldForm> fields; // in the order of the type
    LobeDesc usual;                    // where only the type is said
    bool sendsOn = false;              // a part of the light; else what it says is no part of any
};
// The forms of all lobes, by LobeDesc::kind.
std::span<const LobeForm> lobeForms();
std::span<const std::string_view> lobeNames();

// How the weight and what multiplies values are written.
inline constexpr std::string_view kLobeWord = "lobe", kWeightWord = "weight", kTimesWord = "times",
                                  kWithoutWord = "without", kCoversWord = "covers";
inline constexpr Range kFactorStrength = kUnit;

// The largest sum of one channel of the weights of lobes that are no covers and send light on, or
// the largest weight of a cover, as far as no picture multiplies them. Above 1 they are scaled to
// 1, covers each by itself.
double sumOfWeights(const MaterialDesc& material);
inline constexpr double kMostOfWeights = 1 + 1e-6; // as 0.9 and 0.1 that were floats
