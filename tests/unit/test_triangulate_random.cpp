// Triangulation of random polygons: the triangles must cover them once.
#include "unit/triangulate_kit.h"

#include <set>
#include <utility>

namespace test_triangulate_random {

using triangulate_kit::checkPolygon;
using triangulate_kit::hasFlatTriangle;
using triangulate_kit::placed;
using triangulate_kit::Polygon;
using triangulate_kit::Triangles;
using triangulate_kit::trianglesOf;
using triangulate_kit::uniform;

namespace {

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

} // namespace

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

} // namespace test_triangulate_random
