// The groups of the battery, each in a file of its own: a new one is a row here.
#pragma once

#include "verify/battery.h"

#include <array>

namespace battery {

std::span<const Row> leakRows();          // T1 to T3: closed meshes
std::span<const Row> crackRows();         // T4: borders that meshes share
std::span<const Row> leavingRows();       // T5: rays that leave a surface; acne
std::span<const Row> contactRows();       // T6: shadows where things touch
std::span<const Row> placementRows();     // T7 to T9: the same picture at every size and place
std::span<const Row> sameBitsRows();      // T10, T11, T17: the same bits however it is rendered
std::span<const Row> kernelRows();        // T10: the same hits by every kernel
std::span<const Row> elementaryRows();    // T12: sin, exp, pow and so on against binary128
std::span<const Row> shapeRows();         // T13: where rays meet shapes with a formula
std::span<const Row> solverRows();        // T14: roots of quadratics
std::span<const Row> grazingRows();       // T15: rays all but along surfaces
std::span<const Row> hostileRows();       // T15: triangles that are none
std::span<const Row> hostileCornerRows(); // T15: corners that are none
std::span<const Row> badRayRows();        // T16: rays that are none
std::span<const Row> coplanarRows();      // T18: quads in one plane
std::span<const Row> mediaRows();         // T19: glass in water in ice
std::span<const Row> furnaceRows();       // T20: materials under a white sky
std::span<const Row> lightRows();         // T21: lamps with an area against closed forms
std::span<const Row> densityRows();       // T22: what is sampled against its density
std::span<const Row> pathRows();          // T23: paths in closed rooms, lamps in rough metal
std::span<const Row> treeRows();          // T24: trees over what builders are afraid of
std::span<const Row> terminatorRows();    // T25: the edge of the light on coarse meshes

inline constexpr std::array kGroups = {
    leakRows,          crackRows,      leavingRows,  contactRows,    placementRows, sameBitsRows,
    kernelRows,        elementaryRows, shapeRows,    solverRows,     grazingRows,   hostileRows,
    hostileCornerRows, badRayRows,     coplanarRows, mediaRows,      furnaceRows,   lightRows,
    densityRows,       pathRows,       treeRows,     terminatorRows,
};

} // namespace battery
