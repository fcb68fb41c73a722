// The table of exact::atan2(), for who takes its steps in lanes.
#pragma once

#include "base/double_double.h"

#include <array>

namespace exact {

extern const std::array<DoubleDouble, 17> kAtanTable; // atan(k / 16)
inline constexpr DoubleDouble kHalfPiDd{0x1.921fb54442d18p0, 0x1.1a62633145c07p-54};

} // namespace exact
