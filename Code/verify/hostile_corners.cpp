// T15: triangles with corners at NaN or infinity, in a mesh itself: readers and
// validate() let none through, but a mesh does not rely on it. Trees over them have to end, and
// rays find the other triangles as a list of those alone has them.
#include "base/text.h"
#include "verify/groups.h"

#include <limits>

namespace battery {

namespace {

using meshes::Random;
using Triangle = std::array<Vec3, 3>;

Triangle someTriangle(Random& random) {
    const Vec3d centre = random.inBox(1);
    const double size = random.logUniform(0.01, 1);
    const auto corner = [&] { return toFloat(centre + random.inBox(size)); };
    return {corner(), corner(), corner()};
}

void spoil(Random& random, Triangle& triangle) {
    const float nan = std::numeric_limits<float>::quiet_NaN();
    const float values[] = {nan, -nan, kInfinityF, -kInfinityF};
    const auto bad = [&] { return values[random.below(std::size(values))]; };
    Vec3& corner = triangle[random.below(3)];
    switch (random.below(3)) {
    case 0: corner[random.below(3)] = bad(); break;
    case 1: corner = {bad(), bad(), bad()}; break;
    default: triangle = {Vec3{bad(), bad(), bad()}, {bad(), bad(), bad()}, {bad(), bad(), bad()}};
    }
}

struct IndexedTriangles {
    std::vector<Triangle> all, good;
    std::vector<std::uint32_t> goodAmongAll; // numbers
};

// From none but good ones to none but bad ones.
IndexedTriangles someTriangles(Random& random) {
    IndexedTriangles out;
    const std::size_t count = 1 + random.below(400);
    const double share = random.chance(0.2) ? random.below(2) : random.unit();
    for (std::size_t i = 0; i < count; ++i) {
        Triangle triangle = someTriangle(random);
        if (random.chance(share)) {
            spoil(random, triangle);
        } else {
            out.good.push_back(triangle);
            out.goodAmongAll.push_back(static_cast<std::uint32_t>(i));
        }
        out.all.push_back(triangle);
    }
    return out;
}

MeshGeometry geometryOf(const std::vector<Triangle>& triangles, bool withTree, const Isa& kernel) {
    MeshGeometry g;
    for (const Triangle& t : triangles) {
        const auto n = static_cast<std::uint32_t>(g.points.size());
        g.points.insert(g.points.end(), t.begin(), t.end());
        g.triangles.push_back({n, n + 1, n + 2});
    }
    g.finish(withTree, kernel);
    return g;
}

struct Answers {
    std::vector<Hit> hits;
    std::vector<std::uint8_t> hidden;
};
Answers ask(const MeshGeometry& geometry, const RaySpan& rays) {
    const Mesh mesh(geometry, {0}, {{0, 0}});
    Answers out{std::vector<Hit>(rays.size()), std::vector<std::uint8_t>(rays.size())};
    mesh.intersectBatch(rays, 0, out.hits);
    mesh.occludesBatch(rays, out.hidden);
    return out;
}

Tally corners(const Effort& effort) {
    constexpr std::size_t kRays = 64;
    return inBatches(effort, 153, 40, [](Random& random, Tally& tally) {
        const IndexedTriangles triangles = someTriangles(random);
        std::vector<Vec3> org(kRays), dir(kRays);
        for (std::size_t i = 0; i < kRays; ++i) {
            org[i] = toFloat(random.inBox(2));
            dir[i] = toFloat(random.inBox(1)) - org[i];
        }
        const std::vector<float> tMin(kRays, 0), tMax(kRays, kInfinityF), time(kRays, 0);
        const RaySpan rays{org, dir, tMin, tMax, time};
        const Isa& plain = oneLane();
        const Answers truth = ask(geometryOf(triangles.good, false, plain), rays);
        for (const Isa& kernel : allIsas()) {
            if (!kernel.supported()) continue;
            const Answers found = ask(geometryOf(triangles.all, true, kernel), rays);
            for (std::size_t i = 0; i < kRays; ++i) {
                ++tally.cases;
                Hit wanted = truth.hits[i];
                if (wanted.isHit()) wanted.prim = triangles.goodAmongAll[wanted.prim];
                if (found.hits[i] == wanted && found.hidden[i] == truth.hidden[i]) continue;
                tally.fail([&] {
                    return cat(kernel.name, ", ", triangles.good.size(), " good of ",
                               triangles.all.size(), ", ray ", i, ": t ",
                               static_cast<double>(found.hits[i].t), ", wanted ",
                               static_cast<double>(wanted.t));
                });
            }
        }
    });
}

constexpr Row kHostileCornersRows[] = {
    {"T15d", "meshes with corners at NaN and infinity: the others are found", "", 0, true, corners},
};

} // namespace

std::span<const Row> hostileCornerRows() { return kHostileCornersRows; }

} // namespace battery
