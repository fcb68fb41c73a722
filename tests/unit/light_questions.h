// Questions to lights, and to the choice among them, that all widths of lanes have to answer with
// the same bits: test_light_lanes.cpp.
#pragma once

#include "light/light_row.h"
#include "light/sky/sky_table.h"
#include "light/tree/light_tree.h"

#include <cstddef>
#include <cstdint>

namespace light_questions {

inline constexpr std::size_t kPoints = 64, kAnswers = 56;

struct Questions {
    std::uint32_t kind;
    alignas(64) float numbers[kLightNumbers][kPoints]; // every point has a light of its own
    alignas(64) float p[3][kPoints], n[3][kPoints], dir[3][kPoints], u[kPoints], v[kPoints];
    alignas(64) std::uint32_t bits[kPoints], light[kPoints];
    LightTreeView tree;
    SkyView sky;
};
struct Answers {
    alignas(64) std::uint32_t rows[kAnswers][kPoints] = {}; // bits of floats
    std::size_t count = 0;
};

// These run only on machines that have the instructions.
void sse(const Questions& in, Answers& out);
void avx2(const Questions& in, Answers& out);
void avx512(const Questions& in, Answers& out);

} // namespace light_questions
