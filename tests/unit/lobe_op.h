// What test_lobe_lanes.cpp compares between the sets of instructions: all that a lobe computes.
#pragma once

#include "material/lobe_types.h"

#include <cstddef>
#include <cstdint>

namespace lobe_op {

inline constexpr std::size_t kPoints = 16; // as many as the widest registers have
inline constexpr std::size_t kResults = 34;

struct Points {
    alignas(64) float numbers[kLobeNumbers][kPoints], eta[kPoints];
    alignas(64) float toEye[3][kPoints], toLight[3][kPoints];
    alignas(64) float pick[kPoints], u[kPoints], v[kPoints];
};
struct Results {
    alignas(64) float of[kResults][kPoints]; // 0 where the lobe has no such function
};

// For lobe number `kind`; these run only on machines that have the instructions.
void sse(std::uint32_t kind, const Points& in, Results& out);
void avx2(std::uint32_t kind, const Points& in, Results& out);
void avx512(std::uint32_t kind, const Points& in, Results& out);

} // namespace lobe_op
