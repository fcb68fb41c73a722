// Lanes of every set of instructions that this machine has give the bits of the one-lane code.
#include "base/cpu.h"
#include "check.h"
#include "unit/simd_ops.h"

#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <ios>
#include <iterator>
#include <limits>
#include <random>
#include <span>

namespace test_simd_lanes {

namespace {

using simd_ops::Alike;
using simd_ops::kNumbers;
using simd_ops::Numbers;
using simd_ops::Op;

constexpr unsigned kSeed = 71;

// Numbers of all sizes, and those that code goes wrong at.
class Draw {
public:
    std::uint32_t word() { return static_cast<std::uint32_t>(engine_() >> 16); }
    float number() {
        constexpr float kInf = std::numeric_limits<float>::infinity();
        constexpr std::uint32_t kBits[] = {0x7fc00000, 0xffc01234, 0x7f800001, // NaN, one signals
                                           0x00000001, 0x807fffff, 0x00800000, 0x7f7fffff};
        constexpr float kSpecial[] = {
            0.0f, -0.0f,   kInf,           -kInf,           1.0f,    -1.0f,    0.5f,         -0.5f,
            2.5f, 0x1p23f, 0x1.fffffep22f, -0x1.fffffep22f, 0x1p31f, -0x1p31f, 0x1.000002p0f};
        switch (word() % 5) {
        case 0: return std::bit_cast<float>(kBits[word() % std::size(kBits)]);
        case 1: return kSpecial[word() % std::size(kSpecial)];
        case 2: return std::bit_cast<float>(word());
        case 3: return static_cast<float>(static_cast<std::int32_t>(word() % 65) - 32) * 0.25f;
        default: return static_cast<float>(static_cast<std::int32_t>(word())) * 0x1p-20f;
        }
    }
    double wide() {
        constexpr double kSpecial[] = {0x1p31,        0x1p31 - 0.5, 0x1p31 - 1,      -0x1p31,
                                       -0x1p31 - 0.5, -0x1p31 - 1,  0x1p52 + 0.5,    -0x1p52 - 0.5,
                                       0x1p-1074,     0x1p-1022,    0x1.fffffefp127, 0x1.ffffffp127,
                                       0x1p-150,      0x1.8p-149,   1e300,           -1e300};
        switch (word() % 5) {
        case 0: return kSpecial[word() % std::size(kSpecial)];
        case 1: return number();
        case 2: // between two floats, in the middle or close to it
            return double{number()} * (1 + 0x1p-24 + (word() % 3 - 1.0) * 0x1p-52);
        case 3: return std::bit_cast<double>(std::uint64_t{word()} << 32 | word());
        default: return static_cast<std::int32_t>(word()) * 0.5;
        }
    }
    std::uint32_t whole() {
        constexpr std::uint32_t kSpecial[] = {0, 1, 0x7fffffff, 0x80000000, 0x80000001, 0xffffffff};
        return word() % 3 == 0 ? kSpecial[word() % std::size(kSpecial)] : word() >> word() % 32;
    }
    Numbers numbers() {
        Numbers n;
        const auto fill = [&](auto& to, auto next) {
            for (auto& x : to) x = next();
        };
        for (float(*of)[kNumbers] : {&n.a, &n.b, &n.c}) fill(*of, [&] { return number(); });
        for (double(*of)[kNumbers] : {&n.x, &n.y}) fill(*of, [&] { return wide(); });
        for (std::uint32_t(*of)[kNumbers] : {&n.i, &n.j}) fill(*of, [&] { return whole(); });
        for (std::size_t k = 0; k < kNumbers; ++k) // equal ones, too
            if (word() % 8 == 0) n.b[k] = n.a[k], n.y[k] = n.x[k], n.j[k] = n.i[k];
        n.chosen = word() & 0xffff;
        return n;
    }

private:
    std::mt19937_64 engine_{kSeed};
};

bool areAlike(Alike alike, std::uint64_t a, std::uint64_t b) {
    const auto isNaN = [&](std::uint64_t x) {
        return alike == Alike::Float
                   ? std::isnan(std::bit_cast<float>(static_cast<std::uint32_t>(x)))
                   : std::isnan(std::bit_cast<double>(x));
    };
    return a == b || (alike != Alike::Bits && isNaN(a) && isNaN(b));
}

struct Lanes {
    const char* name;
    std::size_t width;
    bool (*supported)();
    std::span<const Op> (*ops)();
};
#if defined(__x86_64__)
constexpr Lanes kAll[] = {{"sse", 8, hasSse, simd_ops::sse},
                          {"avx2", 8, hasAvx2, simd_ops::avx2},
                          {"avx512", 16, hasAvx512, simd_ops::avx512}};
#else
constexpr std::span<const Lanes> kAll;
#endif

void checkAgainstOneLane(const Lanes& lanes, int count) {
    const std::span<const Op> expectedOps = kernels::one::kSimdOps, ops = lanes.ops();
    CHECK_EQUAL(ops.size(), expectedOps.size());
    Draw draw;
    for (int round = 0; round < count; ++round) {
        const Numbers in = draw.numbers();
        for (std::size_t o = 0; o < ops.size(); ++o) {
            std::uint64_t out[kNumbers], expected[kNumbers];
            for (std::size_t k = 0; k < kNumbers; k += lanes.width) ops[o].run(in, k, out);
            for (std::size_t k = 0; k < kNumbers; ++k) expectedOps[o].run(in, k, expected);
            for (std::size_t k = 0; k < kNumbers; ++k) {
                auto* const other = ops[o].other;
                CHECK_INFO(areAlike(ops[o].alike, out[k], expected[k]) ||
                               (other && areAlike(ops[o].alike, out[k], other(in, k))),
                           lanes.name << " " << ops[o].name << ": " << std::hex << out[k]
                                      << ", expected " << expected[k] << "; a, b, c, x, y "
                                      << std::hexfloat << in.a[k] << " " << in.b[k] << " "
                                      << in.c[k] << " " << in.x[k] << " " << in.y[k] << ", i, j "
                                      << in.i[k] << " " << in.j[k] << ", round " << std::dec
                                      << round << ", seed " << kSeed);
            }
        }
    }
}

} // namespace

TEST(simd_lanes_are_the_one_lane) {
    const int count = check::scaled(300);
    for (const Lanes& lanes : kAll) {
        if (!lanes.supported()) continue;
        checkAgainstOneLane(lanes, count);
        std::printf("%s lanes: %zu operations on %d times %zu numbers, seed %u\n", lanes.name,
                    std::size(kernels::one::kSimdOps), count, kNumbers, kSeed);
    }
}

// What the registers are compared with is itself what was meant.
TEST(simd_one_lane) {
    using namespace kernels::one;
    constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
    CHECK_EQUAL(min(Floats(kNaN), Floats(1.0f)).v, 1.0f);
    CHECK(std::isnan(min(Floats(1.0f), Floats(kNaN)).v));
    CHECK_EQUAL(max(Floats(kNaN), Floats(1.0f)).v, 1.0f);
    CHECK(std::signbit(min(Floats(0.0f), Floats(-0.0f)).v));
    CHECK(!std::signbit(max(Floats(-0.0f), Floats(0.0f)).v));
    CHECK(bits(notGreater(Floats(kNaN), Floats(1.0f))) == 1);
    CHECK(bits(Ints(1u) < Ints(0x80000000u)) == 1);
    CHECK_EQUAL(wholeOf(Doubles(-2.5)).v, 0xfffffffeu);
    CHECK_EQUAL(wholeOf(Doubles(0x1p31)).v, 0x80000000u);
    CHECK_EQUAL(shiftedRight<5>(Ints(0u - 64)).v, 0u - 2);
    CHECK_EQUAL(powersOfTwo(Ints(0u - 1022)).v, 0x1p-1022);
    CHECK_EQUAL(spread(5, 0x80000110u), 0x80000010u);
    CHECK_EQUAL(nextFloat(Floats(1.0f)).v, 1 + 0x1p-23f);
    CHECK_EQUAL(withSign(Doubles(2.0), Doubles(-0.0)).v, -2.0);
}

} // namespace test_simd_lanes
