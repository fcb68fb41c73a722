// Triangulation: exact signs, known polygons, and random ones whose triangles must cover them once.
#include "read/mesh/triangulate.h"

#include "check.h"
#include "read/mesh/exact_orientation.h"

#include <algorithm>
#include <chrono>
#include <numeric>
#include <random>
#include <set>

namespace {

using Triangles = std::vector<std::array<std::uint32_t, 3>>;
using Polygon = std::vector<Vec2d>;

Triangles trianglesOf(const std::vector<Vec3d>& corners) {
    Triangles triangles;
    triangulate(corners, triangles);
    return triangles;
}

// In the plane with axis `normal` dropped; `slope` tilts it, but leaves that axis the longest.
std::vector<Vec3d> placed(const Polygon& polygon, std::size_t normal = 2, double slope = 0) {
    std::vector<Vec3d> corners(polygon.size());
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        corners[i][(normal + 1) % 3] = polygon[i].x;
        corners[i][(normal + 2) % 3] = polygon[i].y;
        corners[i][normal] = slope * (polygon[i].x - polygon[i].y);
    }
    return corners;
}

double twiceArea(Vec2d a, Vec2d b, Vec2d c) {
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}
double twiceArea(const Polygon& p) {
    double area = 0;
    for (std::size_t i = 1; i + 1 < p.size(); ++i) area += twiceArea(p[0], p[i], p[i + 1]);
    return area;
}

// All wound as the polygon and their areas its area: then none overlap and nothing is left out.
void checkCovers(const Polygon& p, const Triangles& triangles, const std::string& what) {
    CHECK_INFO(triangles.size() == p.size() - 2, what << ": " << triangles.size());
    const double area = twiceArea(p);
    const int turn = area < 0 ? -1 : 1;
    double sum = 0;
    std::vector<bool> used(p.size());
    for (const auto& t : triangles) {
        for (const std::uint32_t i : t) used.at(i) = true;
        const int sign = orientation(p[t[0]], p[t[1]], p[t[2]]);
        CHECK_INFO(sign * turn >= 0, what << ": triangle " << t[0] << ' ' << t[1] << ' ' << t[2]
                                          << " is turned round");
        sum += std::fabs(twiceArea(p[t[0]], p[t[1]], p[t[2]]));
    }
    CHECK_INFO(std::fabs(sum - std::fabs(area)) <= 1e-12 * std::fabs(area) + 1e-300,
               what << ": areas " << sum << " of " << std::fabs(area));
    CHECK_INFO(std::find(used.begin(), used.end(), false) == used.end(),
               what << ": a corner is not used");
}
// Both ways round, from several first corners, in all three planes.
void checkPolygon(Polygon p, const std::string& what) {
    for (int turned = 0; turned < 2; ++turned) {
        for (std::size_t i = 0; i < 3; ++i) {
            checkCovers(p, trianglesOf(placed(p, i, i == 1 ? 0.9 : 0)),
                        what + (turned ? " reversed" : "") + ", start " + std::to_string(i));
            std::rotate(p.begin(), p.begin() + 1 + static_cast<std::ptrdiff_t>(i) % 2, p.end());
        }
        std::reverse(p.begin(), p.end());
    }
}
// None without area either: what a polygon without three corners in line allows.
bool hasFlatTriangle(const Polygon& p) {
    for (const auto& t : trianglesOf(placed(p)))
        if (orientation(p[t[0]], p[t[1]], p[t[2]]) == 0) return true;
    return false;
}

double uniform(std::mt19937& random) { return static_cast<double>(random()) / 4294967296.0; }

Polygon star(std::mt19937& random, std::size_t n) {
    Polygon p;
    for (std::size_t i = 0; i < n; ++i) {
        const double angle = 2 * M_PI * (static_cast<double>(i) + 0.9 * uniform(random)) /
                             static_cast<double>(n),
                     radius = 0.05 + uniform(random);
        p.push_back({radius * std::cos(angle), radius * std::sin(angle)});
    }
    return p;
}

bool cross(Vec2d a, Vec2d b, Vec2d c, Vec2d d) {
    return orientation(a, b, c) * orientation(a, b, d) < 0 &&
           orientation(c, d, a) * orientation(c, d, b) < 0;
}
// Random corners, then pairs of crossing sides are exchanged, which shortens the way, until none is
// left. Few different coordinates: many corners in line.
Polygon untangled(std::mt19937& random, std::size_t n, std::uint32_t grid) {
    Polygon p;
    std::set<std::pair<std::uint32_t, std::uint32_t>> seen;
    while (p.size() < n) {
        const auto x = random() % grid, y = random() % grid;
        if (seen.insert({x, y}).second)
            p.push_back({static_cast<double>(x), static_cast<double>(y)});
    }
    for (bool changed = true; changed;) {
        changed = false;
        for (std::size_t i = 0; i < n; ++i)
            for (std::size_t j = i + 2; j < n; ++j)
                if (cross(p[i], p[i + 1], p[j], p[(j + 1) % n])) {
                    std::reverse(p.begin() + static_cast<std::ptrdiff_t>(i) + 1,
                                 p.begin() + static_cast<std::ptrdiff_t>(j) + 1);
                    changed = true;
                }
    }
    return p;
}
// Does no corner lie on another side? Crossing sides are gone, touching ones may be left.
bool touchesItself(const Polygon& p) {
    const std::size_t n = p.size();
    for (std::size_t i = 0; i < n; ++i)
        for (std::size_t j = 0; j < n; ++j) {
            const Vec2d a = p[j], b = p[(j + 1) % n], c = p[i];
            if (i != j && i != (j + 1) % n && orientation(a, b, c) == 0 &&
                std::min(a.x, b.x) <= c.x && c.x <= std::max(a.x, b.x) &&
                std::min(a.y, b.y) <= c.y && c.y <= std::max(a.y, b.y))
                return true;
        }
    return false;
}

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

TEST(triangulate_random_simple_polygons) {
    for (std::uint32_t seed = 0; seed < check::scaled(200u); ++seed) {
        std::mt19937 random(seed);
        checkPolygon(star(random, 5 + random() % 60), "star, seed " + std::to_string(seed));
    }
    std::uint32_t touching = 0, done = 0;
    for (std::uint32_t seed = 0; done < check::scaled(200u); ++seed) {
        std::mt19937 random(seed);
        const bool fine = seed % 4 == 0;
        const Polygon p = untangled(random, 5 + random() % (fine ? 60 : 16), fine ? 100000 : 12);
        if (touchesItself(p)) {
            ++touching;
            CHECK_EQUAL(trianglesOf(placed(p)).size(), p.size() - 2);
            continue;
        }
        ++done;
        checkPolygon(p, "untangled, seed " + std::to_string(seed));
        CHECK_INFO(!hasFlatTriangle(p), "seed " << seed);
    }
    CHECK(touching > 0);
}

// Slivers whose areas are at the end of double: corners a few ulps beside a slanted line.
TEST(triangulate_slivers) {
    for (std::uint32_t seed = 0; seed < check::scaled(200u); ++seed) {
        std::mt19937 random(seed);
        // There along the line, back a few ulps above it: simple, as x is ascending.
        Polygon p;
        const int n = 4 + static_cast<int>(random() % 12);
        const double slope = 0.1 + uniform(random);
        for (int i = 0; i <= n; ++i) p.push_back({1 + i * 0.25, slope * (1 + i * 0.25)});
        for (int i = n; i >= 0; --i) {
            const double x = 1 + i * 0.25, y = slope * x;
            p.push_back({x, y + static_cast<double>(1 + random() % 5) * 0x1p-48});
        }
        const Triangles triangles = trianglesOf(placed(p));
        CHECK_EQUAL(triangles.size(), p.size() - 2);
        for (const auto& t : triangles)
            CHECK_INFO(orientation(p[t[0]], p[t[1]], p[t[2]]) >= 0, "seed " << seed);
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
