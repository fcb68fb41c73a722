// The groups of the battery, each in a file of its own: a new one is a row here.
#pragma once

#include "verify/battery.h"

#include <array>

namespace battery {

std::span<const Row> shapeRows();      // T13: where rays meet shapes with a formula
std::span<const Row> solverRows();     // T14: roots of quadratics
std::span<const Row> terminatorRows(); // T25: the edge of the light on coarse meshes

inline constexpr std::array kGroups = {
    shapeRows,
    solverRows,
    terminatorRows,
};

} // namespace battery
