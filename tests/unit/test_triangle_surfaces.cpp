// Surfaces of many hits on a mesh: every kernel gives the bits of asking hit by hit, near edges and
// on triangles without area as well, with and without normals and coordinates at the corners.
#include "analytic_kit.h"
#include "check.h"
#include "shape/mesh.h"

#include <algorithm>
#include <bit>

namespace test_triangle_surfaces {

using kit::Random;

namespace {

bool sameBits(Vec3 a, Vec3 b) {
    using Bits = std::array<std::uint32_t, 3>;
    return std::bit_cast<Bits>(a) == std::bit_cast<Bits>(b);
}
bool sameBits(const Surface& a, const Surface& b) {
    return sameBits(a.p, b.p) && sameBits(a.ng, b.ng) && sameBits(a.ns, b.ns) && a.uv == b.uv &&
           a.material == b.material && a.object == b.object && a.error == b.error &&
           a.rayError == b.rayError && sameBits(a.lift, b.lift);
}

std::uint32_t below(Random& random, std::size_t count) {
    const auto i = static_cast<std::size_t>(random.uniform(0, static_cast<double>(count)));
    return static_cast<std::uint32_t>(std::min(i, count - 1));
}

// Corners share points, now and then all three: then there is no area. Small and large ones: the
// smallest have no place that is away from their edges.
MeshGeometry someTriangles(Random& random) {
    MeshGeometry g;
    const bool hasNormals = random.coin(), hasUvs = random.coin();
    const Vec3d middle = random.inBox(0.9);
    const double size = random.logUniform(1e-7, 0.1);
    for (int i = 0; i < 12; ++i) {
        g.points.push_back(toFloat(middle + random.inBox(1) * size));
        // Any length, none too, as files have them; some point to the other side.
        g.normals.push_back(random.chance(0.1) ? Vec3{} : toFloat(random.inBox(2)));
        g.uvs.push_back({static_cast<float>(random.uniform(-3, 3)), 0.5f});
    }
    const auto corners = [&] {
        return MeshGeometry::Corners{below(random, 12), below(random, 12), below(random, 12)};
    };
    for (std::uint32_t i = 0; i < 20; ++i) {
        g.triangles.push_back(corners());
        g.slots.push_back(i % 3);
        const auto some = [&] { return random.chance(0.2) ? MeshGeometry::kWithout : corners(); };
        if (hasNormals) g.normalTriangles.push_back(some());
        if (hasUvs) g.uvTriangles.push_back(some());
    }
    return g;
}

Hit somewhere(Random& random, std::uint32_t triangle) {
    double u = random.uniform(0, 1), v = random.uniform(0, 1 - u);
    if (random.chance(0.2)) u = random.logUniform(1e-9, 1e-2);
    if (random.chance(0.1)) u = 0;
    if (random.chance(0.1)) v = 1 - u;
    return {.t = 1,
            .u = static_cast<float>(u),
            .v = static_cast<float>(v),
            .prim = triangle,
            .shape = 0};
}

} // namespace

TEST(triangle_surfaces_are_those_of_single_hits) {
    Random random(3303);
    std::size_t smooth = 0, lifted = 0;
    for (int round = 0; round < check::scaled(300); ++round) {
        const MeshGeometry geometry = someTriangles(random);
        const Mesh mesh(geometry, {3, 1, 4}, {{0, 7}, {11, 8}});
        std::vector<Vec3> org, dir;
        std::vector<float> zero(61, 0), one(61, 1);
        std::vector<Hit> hits;
        std::vector<std::uint32_t> which, to;
        for (std::uint32_t i = 0; i < 61; ++i) {
            org.push_back(toFloat(random.inBox(1))), dir.push_back(toFloat(random.inBox(1)));
            hits.push_back(somewhere(random, below(random, geometry.triangles.size())));
            if (!random.chance(0.1)) which.push_back(i), to.push_back(i);
        }
        std::reverse(to.begin(), to.end()); // places are not those of the rays
        const RaySpan rays{org, dir, zero, one, zero};
        for (const Isa& kernel : allIsas()) {
            if (!kernel.supported()) continue;
            for (const SurfaceNeeds needs :
                 {SurfaceNeeds{true, true}, {false, true}, {false, false}}) {
                std::vector<SurfaceBlock> out(4);
                const SurfacePlaces places(out.data());
                mesh.surfaces({rays, hits, which, to, needs, lanesOf(kernel.surfaces)}, places);
                for (std::size_t k = 0; k < which.size(); ++k) {
                    const std::uint32_t i = which[k];
                    const Surface alone = mesh.surfaceFor(rays[i], hits[i], needs);
                    smooth += !sameBits(alone.ns, alone.ng), lifted += alone.lift != Vec3{};
                    CHECK_INFO(sameBits(places[to[k]].surface(), alone),
                               std::string(kernel.name) + ", round " + std::to_string(round) +
                                   ", hit " + std::to_string(k) + " of " +
                                   std::to_string(which.size()));
                }
            }
        }
    }
    CHECK(smooth > 1000 && lifted > 1000); // what was compared is there
}

} // namespace test_triangle_surfaces
