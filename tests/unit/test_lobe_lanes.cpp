// Lobes in lanes of every set of instructions that this machine has give the bits of one lane, and
// numbers for all that scenes can have.
#include "base/cpu.h"
#include "base/math.h"
#include "check.h"
#include "unit/lobe_ops.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <iterator>
#include <random>
#include <span>
#include <string>

namespace test_lobe_lanes {

namespace {

using lobe_op::kPoints;
using lobe_op::Points;
using lobe_op::Results;

constexpr unsigned kSeed = 53;

class Draw {
public:
    explicit Draw(std::uint32_t kind) : type_(lobeTypes()[kind]) {}

    Points points() {
        Points p{};
        for (std::size_t k = 0; k < kPoints; ++k) {
            std::size_t at = 0;
            for (const LobeField& field : type_.fields)
                for (int i = 0; i < field.count; ++i) p.numbers[at++][k] = number(field);
            p.eta[k] = eta();
            direction(p.toEye, k, false);
            direction(p.toLight, k, true);
            if (oneOf(6)) opposite(p, k);
            p.pick[k] = place(), p.u[k] = place(), p.v[k] = place();
        }
        return p;
    }

private:
    bool oneOf(std::uint32_t count) { return word() % count == 0; }
    std::uint32_t word() { return static_cast<std::uint32_t>(random_() >> 16); }
    float unit() { return static_cast<float>(word() >> 8) * 0x1p-24f; }
    float place() { // in [0,1)
        constexpr float kEnds[] = {0, 0x1p-24f, 0.5f, 1 - 0x1p-24f};
        return oneOf(4) ? kEnds[word() % std::size(kEnds)] : unit();
    }
    float number(const LobeField& field) {
        const float roughs[] = {0, 1e-3f, 1.001e-3f, 5e-3f, 0.03f, 1};
        if (std::string(field.name) == "roughness" && oneOf(2))
            return roughs[word() % std::size(roughs)];
        switch (word() % 6) {
        case 0: return field.least;
        case 1: return field.most;
        case 2: return field.start[0];
        default: return field.least + unit() * (std::min(field.most, 1e3f) - field.least);
        }
    }
    float eta() {
        constexpr float kEnds[] = {1,    1 + 0x1p-23f, 1 - 0x1p-24f, 1.00001f, 0.999f, 1e-6f,
                                   1e6f, 1.5f,         1 / 1.5f,     1e-3f,    1e3f};
        return oneOf(2) ? kEnds[word() % std::size(kEnds)] : 0.3f + 3 * unit();
    }
    void direction(float (&v)[3][kPoints], std::size_t k, bool anySide) {
        const double phi = 2 * kPi * static_cast<double>(unit());
        constexpr float kHeights[] = {1, 1e-3f, 1e-6f, 1e-20f, 0x1p-140f, 0.999999f};
        const float height = oneOf(3) ? kHeights[word() % std::size(kHeights)] : unit() + 0x1p-26f;
        const double z = std::min(double{height}, 1.0), sine = std::sqrt((1 - z) * (1 + z));
        v[0][k] = static_cast<float>(sine * std::cos(phi));
        v[1][k] = static_cast<float>(sine * std::sin(phi));
        v[2][k] = anySide && oneOf(2) ? -static_cast<float>(z) : static_cast<float>(z);
        if (anySide && oneOf(16)) v[2][k] = 0;
    }
    // Light from where special things happen: mirrored, straight through, from the eye itself.
    void opposite(Points& p, std::size_t k) {
        const std::uint32_t way = word() % 3;
        const float across = way == 2 ? 1 : -1, up = way == 1 ? -1 : 1;
        for (int axis = 0; axis < 2; ++axis) p.toLight[axis][k] = across * p.toEye[axis][k];
        p.toLight[2][k] = up * p.toEye[2][k];
    }

    LobeType type_;
    std::mt19937_64 random_{kSeed};
};

std::string shown(std::uint32_t kind, const Points& p, std::size_t k) {
    std::ostringstream out;
    out << std::hexfloat << lobeTypes()[kind].name;
    for (const auto& number : p.numbers) out << " " << number[k];
    out << ", eta " << p.eta[k] << ", to eye";
    for (const auto& axis : p.toEye) out << " " << axis[k];
    out << ", to light";
    for (const auto& axis : p.toLight) out << " " << axis[k];
    out << ", " << p.pick[k] << " " << p.u[k] << " " << p.v[k] << ", seed " << kSeed;
    return out.str();
}

struct Lanes {
    const char* name;
    bool (*supported)();
    void (*compute)(std::uint32_t kind, const Points& in, Results& out);
};
#if defined(__x86_64__)
constexpr Lanes kAll[] = {{"sse", hasSse, lobe_op::sse},
                          {"avx2", hasAvx2, lobe_op::avx2},
                          {"avx512", hasAvx512, lobe_op::avx512}};
#else
constexpr std::span<const Lanes> kAll;
#endif

void checkFinite(std::uint32_t kind, const Points& in, const Results& r) {
    for (std::size_t row = 0; row < lobe_op::kResults; ++row)
        for (std::size_t k = 0; k < kPoints; ++k)
            CHECK_INFO(std::isfinite(r.of[row][k]),
                       "result " << row << " is " << r.of[row][k] << ": " << shown(kind, in, k));
    for (std::size_t k = 0; k < kPoints; ++k) { // below, albedo, eval, pdf
        bool isPart = true;
        for (std::size_t row = 0; row < 6; ++row)
            isPart = isPart && r.of[row][k] >= 0 && r.of[row][k] <= 1.0001f;
        CHECK_INFO(isPart, shown(kind, in, k));
        for (std::size_t row = 6; row < 10; ++row)
            CHECK_INFO(r.of[row][k] >= 0 || row == 9, shown(kind, in, k));
    }
}

} // namespace

TEST(lobe_lanes_are_the_one_lane) {
    const int count = check::scaled(60);
    for (std::uint32_t kind = 0; kind < lobeTypes().size(); ++kind) {
        Draw draw(kind);
        for (int round = 0; round < count; ++round) {
            const Points in = draw.points();
            Results expected, out;
            kernels::one::computeLobes(kind, in, expected);
            checkFinite(kind, in, expected);
            for (const Lanes& lanes : kAll) {
                if (!lanes.supported()) continue;
                lanes.compute(kind, in, out);
                for (std::size_t row = 0; row < lobe_op::kResults; ++row)
                    for (std::size_t k = 0; k < kPoints; ++k)
                        CHECK_INFO(std::bit_cast<std::uint32_t>(out.of[row][k]) ==
                                       std::bit_cast<std::uint32_t>(expected.of[row][k]),
                                   lanes.name << " result " << row << " is " << out.of[row][k]
                                              << ", expected " << expected.of[row][k] << ": "
                                              << shown(kind, in, k));
            }
        }
    }
    std::printf("%zu lobes on %d times %zu points, seed %u\n", lobeTypes().size(), count, kPoints,
                kSeed);
}

} // namespace test_lobe_lanes
