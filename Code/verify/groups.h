// The groups of the battery, each in a file of its own: a new one is a row here.
#pragma once

#include "verify/battery.h"

#include <array>

namespace battery {

std::span<const Row> leakRows();       // T1 to T4: rays that get out of closed meshes
std::span<const Row> leavingRows();    // T5, T6: rays that meet what they leave; contacts
std::span<const Row> placementRows();  // T7 to T9: size and place of the scene
std::span<const Row> sameBitsRows();   // T10, T11, T17: trees, threads, tiles, features
std::span<const Row> shapeRows();      // T13, T14: shapes with a formula against wide arithmetic
std::span<const Row> hostileRows();    // T15, T16: grazing, degenerate and impossible input
std::span<const Row> coplanarRows();   // T18: surfaces in one plane
std::span<const Row> mediaRows();      // T19: glass in glass
std::span<const Row> furnaceRows();    // T20: energy of materials
std::span<const Row> lightRows();      // T21: lamps against form factors
std::span<const Row> treeRows();       // T24: the worst for a tree
std::span<const Row> terminatorRows(); // T25: the edge of the shadow on coarse meshes

inline constexpr std::array kGroups = {leakRows,     leavingRows,  placementRows, sameBitsRows,
                                       shapeRows,    hostileRows,  coplanarRows,  mediaRows,
                                       furnaceRows,  lightRows,    treeRows,      terminatorRows};

} // namespace battery
