// All that a lobe computes of kPoints points, in the lanes of this unit (simd/region.h).
#pragma once

#include "material/lobes.h"
#include "unit/lobe_op.h"

#include <cstddef>
#include <cstdint>

LANES_BEGIN

template <class L>
void computeLobe(const lobe_op::Points& in, std::size_t first, lobe_op::Results& out) {
    const auto at = [&](const float* column) { return Floats::load(column + first); };
    const auto vector = [&](const float(&v)[3][lobe_op::kPoints]) {
        return Floats3{at(v[0]), at(v[1]), at(v[2])};
    };
    std::size_t row = 0;
    const auto put = [&](Floats a) { a.store(out.of[row++] + first); };
    const auto put3 = [&](const Floats3& a) { put(a.x), put(a.y), put(a.z); };
    const auto putSample = [&](const LobeSample& s) {
        put3(s.toLight), put3(s.weight), put(s.pdf);
        put(select(s.single, Floats(1.0f), Floats(0.0f)));
    };

    const LobeNumbers numbers{in.numbers[0] + first, lobe_op::kPoints, at(in.eta)};
    const L lobe(numbers);
    const Floats3 toEye = vector(in.toEye), toLight = vector(in.toLight);
    const Floats pick = at(in.pick), u = at(in.u), v = at(in.v);
    put3(lobe.below(toEye)), put3(lobe.albedo(toEye)), put3(lobe.eval(toEye, toLight));
    if constexpr (requires { lobe.sample(toEye, pick, u, v); }) {
        put(lobe.pdf(toEye, toLight));
        putSample(lobe.sample(toEye, pick, u, v));
    }
    if constexpr (requires { lobe.branch(toEye, true, u, v); }) {
        putSample(lobe.branch(toEye, false, u, v)), putSample(lobe.branch(toEye, true, u, v));
    }
    while (row < lobe_op::kResults) put(Floats(0.0f));
}

inline void computeLobes(std::uint32_t kind, const lobe_op::Points& in, lobe_op::Results& out) {
    for (std::size_t first = 0; first < lobe_op::kPoints; first += W)
        forLobe(kind, [&]<class L>() { computeLobe<L>(in, first, out); });
}

LANES_END
