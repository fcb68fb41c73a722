// The groups of the battery, each in a file of its own: a new one is a row here.
#pragma once

#include "verify/battery.h"

#include <array>

namespace battery {

std::span<const Row> shapeRows();      // T13: where rays meet shapes with a formula
std::span<const Row> solverRows();     // T14: roots of quadratics
std::span<const Row> grazingRows();    // T15: rays all but along surfaces
std::span<const Row> hostileRows();    // T15: triangles that are none
std::span<const Row> badRayRows();     // T16: rays that are none
std::span<const Row> coplanarRows();   // T18: quads in one plane
std::span<const Row> treeRows();       // T24: trees over what builders are afraid of
std::span<const Row> terminatorRows(); // T25: the edge of the light on coarse meshes

inline constexpr std::array kGroups = {
    shapeRows,
    solverRows,
    grazingRows,
    hostileRows,
    badRayRows,
    coplanarRows,
    treeRows,
    terminatorRows,
};

} // namespace battery
