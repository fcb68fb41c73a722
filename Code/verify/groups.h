// The groups of the battery, each in a file of its own: a new one is a row here.
#pragma once

#include "verify/battery.h"

#include <array>

namespace battery {

std::span<const Row> mediaRows();      // T19: glass in water in ice
std::span<const Row> furnaceRows();    // T20: materials under a white sky
std::span<const Row> lightRows();      // T21: lamps with an area against closed forms
std::span<const Row> terminatorRows(); // T25: the edge of the light on coarse meshes

inline constexpr std::array kGroups = {
    mediaRows,
    furnaceRows,
    lightRows,
    terminatorRows,
};

} // namespace battery
