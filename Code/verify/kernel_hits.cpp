// T10: what a ray meets does not depend on the kernel that looks for it. The scalar code, with a
// tree or, for every fourth set of triangles, without any, says what is right.
#include "base/text.h"
#include "verify/groups.h"
#include "verify/hostile_rays.h"
#include "verify/specimens.h"

#include <algorithm>

namespace battery {

namespace {

using meshes::Random;

constexpr std::size_t kRaysOfSet = 2048; // of each kind and set of triangles

// The same triangles with the tree of each kernel, and for the scalar code. Those that have no tree
// there have the best one here.
struct Meshes {
    MeshGeometry scalar;
    std::vector<MeshGeometry> wide;

    Meshes(const MeshGeometry& bare, bool withTree) : scalar(bare) {
        scalar.finish(withTree);
        for (const Isa& kernel : allIsas()) {
            if (!kernel.supported() || kernel.triangles == nullptr) continue;
            wide.push_back(bare);
            wide.back().finish(true, kernel);
        }
    }
};

std::string shownHit(const Hit& hit) {
    if (!hit.isHit()) return "nothing";
    const auto digits = [](float x) { return shortest(static_cast<double>(x)); };
    return cat("triangle ", hit.prim, " at ", digits(hit.t), ", u ", digits(hit.u), ", v ",
               digits(hit.v));
}

// Returns the nearest hits.
std::vector<Hit> compare(const Meshes& meshes, const RayList& rays, const char* name,
                         Tally& tally) {
    const std::size_t n = rays.size();
    const Mesh oracle(meshes.scalar, {0}, {{0, 0}});
    std::vector<Hit> right(n), hits(n);
    std::vector<std::uint8_t> isHidden(n), hidden(n);
    for (std::size_t i = 0; i < n; ++i) {
        const Ray ray = rays.span()[i];
        right[i].t = ray.tMax;
        if (oracle.intersect(ray, right[i])) right[i].shape = 0;
        isHidden[i] = oracle.occludes(ray);
    }
    tally.cases += n;
    for (const MeshGeometry& mesh : meshes.wide) {
        closestHits(*mesh.isa, mesh.wideMesh(), rays.span(), 0, hits);
        anyHits(*mesh.isa, mesh.wideMesh(), rays.span(), hidden);
        for (std::size_t i = 0; i < n; ++i) {
            const auto where = [&] {
                return cat(name, ", kernel ", mesh.isa->name, ", ", mesh.triangles.size(),
                           " triangles, ", textOf(rays.span()[i]), ", t in ",
                           shortest(static_cast<double>(rays.tMin[i])), " to ",
                           shortest(static_cast<double>(rays.tMax[i])), ": ");
            };
            if (!haveSameBits(hits[i], right[i]))
                tally.fail([&] {
                    return cat(where(), shownHit(hits[i]), " instead of ", shownHit(right[i]));
                });
            if ((hidden[i] != 0) != (isHidden[i] != 0))
                tally.fail([&] { return cat(where(), isHidden[i] ? "not hidden" : "hidden"); });
        }
    }
    return right;
}

// Rays that go on where others hit: from the same origin, behind the hit.
RayList restarts(const RayList& rays, const std::vector<Hit>& hits) {
    RayList out;
    for (std::size_t i = 0; i < hits.size(); ++i)
        if (hits[i].t < rays.tMax[i])
            out.push({.org = rays.org[i], .dir = rays.dir[i], .tMin = hits[i].t});
    return out;
}

// Shadow rays from each origin to what its rays hit.
RayList toHits(const RayList& rays, const std::vector<Hit>& hits) {
    RayList out;
    for (std::size_t i = 0; i < hits.size(); ++i)
        if (hits[i].t < rays.tMax[i])
            out.push({.org = rays.org[i], .dir = rays.dir[i] * hits[i].t, .tMax = 1});
    return out;
}

void compareWithFollowers(const Meshes& meshes, const RayList& rays, const char* name,
                          Tally& tally) {
    const std::vector<Hit> hits = compare(meshes, rays, name, tally);
    if (const RayList on = restarts(rays, hits); on.size() > 0)
        compare(meshes, on, cat(name, ", going on").c_str(), tally);
    if (const RayList lit = toHits(rays, hits); lit.size() > 0)
        compare(meshes, lit, cat(name, ", to what they hit").c_str(), tally);
}

void compareAll(const Meshes& meshes, Random& random, Tally& tally) {
    const auto withFollowers = [&](const RayList& rays, const char* name) {
        compareWithFollowers(meshes, rays, name, tally);
    };
    withFollowers(looseRays(random, meshes.scalar, kRaysOfSet), "loose rays");
    withFollowers(raysFromPoints(random, meshes.scalar, kRaysOfSet), "rays from points");
    withFollowers(raysInBeams(random, meshes.scalar, kRaysOfSet), "rays side by side");
    withFollowers(raysInPlanes(random, meshes.scalar, kRaysOfSet / 4), "rays in planes");
    withFollowers(beamsInPlanes(random, meshes.scalar, kRaysOfSet / 2),
                  "rays side by side in planes");
}

Tally hostileTriangles(const Effort& effort) {
    return inBatches(effort, 210, 4, [](Random& random, Tally& tally) {
        const std::size_t sizes[] = {1, 17, 300, 2000};
        const std::size_t size = 1 + random.below(sizes[random.below(4)]);
        const Meshes meshes(meshes::geometryOf(meshes::soup(random, size), false),
                            !random.chance(size < 300 ? 0.25 : 0));
        compareAll(meshes, random, tally);
    });
}

Tally closedMeshes(const Effort& effort) {
    return inBatches(effort, 211, 4, [](Random& random, Tally& tally) {
        const auto some = [&]() -> MeshDesc {
            switch (random.below(5)) {
            case 0: return meshes::cube();
            case 1: return meshes::icosphere(1 + static_cast<int>(random.below(4)));
            case 2: return meshes::torus(0.3, 3 + static_cast<int>(random.below(60)), 24);
            case 3: return meshes::doubleFan(3 + static_cast<int>(random.below(60)));
            default: return meshes::tetra(4);
            }
        };
        MeshDesc mesh = some();
        const Transform place = random.affine(3, 0.5);
        for (Vec3d& p : mesh.points) p = place.point(p);
        compareAll(Meshes(toGeometry(mesh, {}), true), random, tally);
    });
}

// Walls, floors and boxes are modelled on whole numbers.
Tally latticeTriangles(const Effort& effort) {
    return inBatches(effort, 212, 4, [](Random& random, Tally& tally) {
        const std::size_t sizes[] = {2, 17, 300, 2000};
        const std::uint32_t halves[] = {1, 2, 4, 16};
        const std::size_t size = 1 + random.below(sizes[random.below(4)]);
        const std::uint32_t half = halves[random.below(4)];
        const Meshes meshes(meshes::geometryOf(meshes::latticeSoup(random, size, half), false),
                            !random.chance(size < 300 ? 0.25 : 0));
        compareWithFollowers(meshes, raysOnLattice(random, 2 * half, 3 * kRaysOfSet),
                             "rays on a lattice", tally);
        compareWithFollowers(meshes, raysFromPoints(random, meshes.scalar, kRaysOfSet),
                             "rays from points", tally);
    });
}

constexpr Row kKernelHitsRows[] = {
    {"T10b", "hits of every kernel and of the scalar code: hostile triangles", "", 0, true,
     hostileTriangles},
    {"T10c", "the same: closed meshes", "", 0, true, closedMeshes},
    {"T10d", "the same: triangles of whole numbers, rays between whole numbers", "", 0, true,
     latticeTriangles},
};

} // namespace

std::span<const Row> kernelRows() { return kKernelHitsRows; }

} // namespace battery
