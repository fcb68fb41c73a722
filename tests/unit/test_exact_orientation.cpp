// The sign of a triangle's area is exact, however close its corners are to a line.
#include "read/mesh/exact_orientation.h"

#include "check.h"

#include <cstdint>
#include <random>

namespace test_exact_orientation {

TEST(triangulate_orientation_is_exact) {
    // Shewchuk's example: on a grid of ulps around (0.5, 0.5), against the line through 12 and 24.
    const double ulp = 0x1p-53;
    for (int i = 0; i < 64; ++i)
        for (int j = 0; j < 64; ++j) {
            const Vec2d p{0.5 + i * ulp, 0.5 + j * ulp};
            const int expected = i == j ? 0 : j > i ? 1 : -1;
            CHECK_INFO(orientation({12, 12}, {24, 24}, p) == expected, i << ' ' << j);
            CHECK_INFO(orientation({24, 24}, p, {12, 12}) == expected, i << ' ' << j);
            CHECK_INFO(orientation({24, 24}, {12, 12}, p) == -expected, i << ' ' << j);
        }
    // Whole numbers, where __int128 knows.
    for (std::uint32_t seed = 0; seed < check::scaled(20000u); ++seed) {
        std::mt19937_64 random(seed);
        const auto number = [&] {
            return static_cast<std::int64_t>(random() >> 11) - (std::int64_t{1} << 52);
        };
        const std::int64_t ax = number(), ay = number(), bx = number(), by = number();
        // Near the middle of a and b, or anywhere.
        std::int64_t cx = (ax + bx) / 2, cy = (ay + by) / 2;
        if (seed % 4 == 0) cx = number();
        if (seed % 4 == 1) cy += static_cast<std::int64_t>(random() % 3) - 1;
        __extension__ using Wide = __int128;
        const Wide area =
            static_cast<Wide>(ax - cx) * (by - cy) - static_cast<Wide>(ay - cy) * (bx - cx);
        const int expected = area > 0 ? 1 : area < 0 ? -1 : 0;
        const auto d = [](std::int64_t v) { return static_cast<double>(v); };
        CHECK_INFO(orientation({d(ax), d(ay)}, {d(bx), d(by)}, {d(cx), d(cy)}) == expected,
                   "seed " << seed);
    }
}

} // namespace test_exact_orientation
