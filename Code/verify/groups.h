// The groups of the battery, each in a file of its own: a new one is a row here.
#pragma once

#include "verify/battery.h"

#include <array>

namespace battery {

std::span<const Row> leakRows();       // T1 to T3: closed meshes
std::span<const Row> crackRows();      // T4: borders that meshes share
std::span<const Row> leavingRows();    // T5, T6: rays that leave a surface
std::span<const Row> terminatorRows(); // T25: the edge of the light on coarse meshes

inline constexpr std::array kGroups = {
    leakRows,
    crackRows,
    leavingRows,
    terminatorRows,
};

} // namespace battery
