// Triangulation of known polygons, good and bad, and the time for long ones.
#include "unit/triangulate_kit.h"

#include <chrono>

namespace test_triangulate {

using triangulate_kit::checkPolygon;
using triangulate_kit::hasFlatTriangle;
using triangulate_kit::placed;
using triangulate_kit::Polygon;
using triangulate_kit::Triangles;
using triangulate_kit::trianglesOf;
using triangulate_kit::uniform;

namespace {

Polygon spiral(std::size_t turns) {
    Polygon p;
    const std::size_t n = turns * 12;
    for (int side = 0; side < 2; ++side)
        for (std::size_t k = 0; k <= n; ++k) {
            const std::size_t i = side ? n - k : k;
            const double angle = 2 * M_PI * static_cast<double>(i) / 12,
                         radius = 1 + static_cast<double>(i) / 12 + side * 0.5;
            p.push_back({radius * std::cos(angle), radius * std::sin(angle)});
        }
    return p;
}
// Teeth of a comb, with corners in line at their ends.
Polygon comb(std::size_t n) {
    Polygon p{{0, -1}};
    const auto teeth = static_cast<double>(n / 2);
    p.push_back({teeth, -1});
    for (std::size_t i = 0; p.size() < n; ++i) {
        const double x = teeth - static_cast<double>(i) / 2;
        p.push_back({x, i % 2 ? 0.0 : 100.0});
    }
    return p;
}

} // namespace

TEST(triangulate_few_corners) {
    CHECK(trianglesOf({}).empty());
    CHECK(trianglesOf({{0, 0, 0}, {1, 0, 0}}).empty());
    CHECK((trianglesOf({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}) == Triangles{{0, 1, 2}}));
    CHECK(
        (trianglesOf(placed({{0, 0}, {1, 0}, {1, 1}, {0, 1}})) == Triangles{{0, 1, 2}, {0, 2, 3}}));
    // What is there already stays.
    Triangles triangles{{7, 8, 9}};
    triangulate(placed({{0, 0}, {1, 0}, {1, 1}, {0, 1}}), triangles);
    CHECK((triangles == Triangles{{7, 8, 9}, {0, 1, 2}, {0, 2, 3}}));
    // An arrow head has one good diagonal only, wherever its notch is.
    Polygon arrow{{0, 0}, {2, -1}, {0, 2}, {0.5, 0.5}};
    for (int i = 0; i < 4; ++i) {
        checkPolygon(arrow, "arrow " + std::to_string(i));
        std::rotate(arrow.begin(), arrow.begin() + 1, arrow.end());
    }
}

TEST(triangulate_convex_is_a_fan) {
    for (std::size_t n : {5u, 16u, 17u, 100u}) {
        Polygon p;
        for (std::size_t i = 0; i < n; ++i) {
            const double angle = 2 * M_PI * static_cast<double>(i) / static_cast<double>(n);
            p.push_back({std::cos(angle), std::sin(angle)});
        }
        for (int turned = 0; turned < 2; ++turned) {
            const Triangles triangles = trianglesOf(placed(p, 1, 0.5));
            CHECK_EQUAL(triangles.size(), n - 2);
            for (std::uint32_t i = 0; i < triangles.size(); ++i)
                CHECK_INFO((triangles[i] == std::array<std::uint32_t, 3>{0, i + 1, i + 2}), i);
            std::reverse(p.begin(), p.end());
        }
    }
}

TEST(triangulate_corners_in_line) {
    // Middle points on the sides: no triangle needs to be flat, the fan's first would be.
    const Polygon square{{0, 0}, {1, 0}, {2, 0}, {2, 1}, {2, 2}, {1, 2}, {0, 2}, {0, 1}};
    checkPolygon(square, "square");
    CHECK(!hasFlatTriangle(square));
    const Polygon side{{0, 0}, {1, 0}, {2, 0}, {3, 0}, {4, 0}, {2, 5}};
    checkPolygon(side, "side");
    CHECK(!hasFlatTriangle(side));
    const Polygon house{{0, 0}, {2, 0}, {2, 2}, {1, 2}, {1, 1}, {0, 1}};
    checkPolygon(house, "L");
    CHECK(!hasFlatTriangle(house));
}

TEST(triangulate_bridges_and_touching) {
    // A square with a square hole, joined by a bridge that is walked twice.
    checkPolygon({{0, 0}, {9, 0}, {9, 9}, {0, 9}, {0, 0}, {3, 3}, {3, 6}, {6, 6}, {6, 3}, {3, 3}},
                 "hole");
    // Two holes on one bridge.
    checkPolygon({{0, 0},
                  {9, 0},
                  {9, 9},
                  {0, 9},
                  {0, 0},
                  {1, 1},
                  {1, 3},
                  {3, 3},
                  {5, 5},
                  {5, 7},
                  {7, 7},
                  {7, 5},
                  {5, 5},
                  {3, 3},
                  {3, 1},
                  {1, 1}},
                 "two holes");
    checkPolygon({{0, 0}, {4, 0}, {4, 4}, {2, 4}, {2, 2}, {2, 4}, {0, 4}}, "whisker inside");
    checkPolygon({{0, 0}, {4, 0}, {4, 4}, {2, 4}, {2, 6}, {2, 4}, {0, 4}}, "whisker outside");
    checkPolygon({{0, 0}, {2, 0}, {2, 1}, {1, 0}, {0, 1}}, "corner on a side");
    checkPolygon({{0, 0}, {1, 0}, {1, 1}, {2, 1}, {2, 2}, {1, 2}, {1, 1}, {0, 1}}, "two squares");
    checkPolygon({{0, 0}, {0, 0}, {3, 0}, {3, 0}, {3, 0}, {1, 1}, {1, 1}, {0, 3}}, "repeated");
}

// No plane at all, or two: as many triangles as ever, and the time is finite.
TEST(triangulate_bad_polygons) {
    const std::vector<std::vector<Vec3d>> bad = {
        std::vector<Vec3d>(9, {1, 2, 3}),
        {{0, 0, 0}, {1, 1, 1}, {3, 3, 3}, {2, 2, 2}, {5, 5, 5}},
        {{0, 0, 0}, {2, 2, 0}, {2, 0, 0}, {0, 2, 0}},                    // bow tie
        {{0, 1, 0}, {1, -1, 0}, {-1, 0.5, 0}, {1, 0.5, 0}, {-1, -1, 0}}, // pentagram
        {{0, 0, 0}, {1, 0, 5}, {1, 1, 0}, {0, 1, 5}, {-1, 0.5, -5}},     // not flat
        {{1e60, 0, 0}, {-1e60, 1e60, 0}, {1e-300, -1e60, 0}, {0, 0, 0}, {5, 5, 1e60}},
        {{1e-300, 0, 0}, {0, 1e-300, 0}, {-1e-300, 0, 0}, {0, -1e-300, 0}, {1e-310, 0, 0}},
    };
    for (const auto& corners : bad) {
        const Triangles triangles = trianglesOf(corners);
        CHECK_EQUAL(triangles.size(), corners.size() - 2);
        for (const auto& t : triangles)
            for (const std::uint32_t i : t) CHECK(i < corners.size());
    }
    for (std::uint32_t seed = 0; seed < check::scaled(300u); ++seed) {
        std::mt19937 random(seed);
        std::vector<Vec3d> corners(4 + random() % 40);
        const std::size_t grid = 1 + random() % 6;
        for (Vec3d& p : corners)
            p = {static_cast<double>(random() % grid), static_cast<double>(random() % grid),
                 static_cast<double>(random() % 2 * (seed % 2))};
        CHECK_INFO(trianglesOf(corners).size() == corners.size() - 2, "seed " << seed);
    }
}

TEST(triangulate_spirals_and_combs) {
    for (const std::size_t turns : {1u, 3u, 20u})
        checkPolygon(spiral(turns), "spiral of " + std::to_string(turns));
    checkPolygon(comb(2000), "comb");
}

// The longest polygon that readers let through, as a comb: each tooth is a blocker for long.
TEST(triangulate_time_is_bounded) {
    const auto start = std::chrono::steady_clock::now();
    const Polygon p = comb(kMostCorners);
    CHECK_EQUAL(trianglesOf(placed(p)).size(), kMostCorners - 2);
    std::mt19937 random(1);
    Polygon tangle;
    for (int i = 0; i < 4000; ++i) tangle.push_back({uniform(random), uniform(random)});
    CHECK_EQUAL(trianglesOf(placed(tangle)).size(), tangle.size() - 2);
    const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
    // 0.1 s measured; ten times as long on a busy machine, and a hundred times under sanitizers.
    CHECK_INFO(seconds.count() < 20, seconds.count());
}

} // namespace test_triangulate
