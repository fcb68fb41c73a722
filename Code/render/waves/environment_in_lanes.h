// The formulas of Environment::place() and, for bytes, of TexelGrid::color(), lane by lane and in
// their order.
#pragma once

#include "base/math.h"
#include "render/waves/environment_lanes.h"
#include "render/waves/texel_lanes.h"
#include "simd/angle_lanes.h"
#include "simd/lanes.h"

#include <cstddef>

LANES_BEGIN

void environmentColors(const Environment::View& view, EnvironmentBlock& block, std::size_t count) {
    for (std::size_t first = 0; first < count; first += W) {
        const auto of = [&](int axis) { return Doubles(Floats::load(block.dir[axis] + first)); };
        const bool isZUp = view.up == Environment::Up::Z;
        const Doubles x = of(0), y = isZUp ? of(1) : Doubles(-0.0) - of(2), z = of(isZUp ? 2 : 1);
        const Doubles s = Doubles(0.5) - anglesOf(y, x) * Doubles(kInvTwoPi) + Doubles(view.turns);
        const Doubles t = Doubles(0.5) + anglesOf(z, sqrt(x * x + y * y)) * Doubles(kInvPi);
        if (view.texels)
            TexelLanes(*view.texels)
                .colors(s, t, block.color[0] + first, block.color[1] + first,
                        block.color[2] + first);
        else
            s.store(block.s + first), t.store(block.t + first);
    }
}

LANES_END
