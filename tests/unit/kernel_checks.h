// Every kernel that this CPU runs against the scalar code: the same hits, to the last bit.
#pragma once

#include "accel/kernels/kernels.h"
#include "check.h"
#include "shape/mesh.h"
#include "verify/hostile_rays.h"

#include <memory>
#include <sstream>
#include <string>
#include <vector>

namespace kernel_checks {

using battery::RayList;

inline std::vector<const Isa*> vectorKernels() {
    std::vector<const Isa*> out;
    for (const Isa& kernel : allIsas())
        if (kernel.supported() && kernel.triangles != nullptr) out.push_back(&kernel);
    return out;
}

// The same mesh with the tree of each kernel, and that of the scalar code.
struct Meshes {
    explicit Meshes(const MeshGeometry& bare) : scalar(bare) {
        scalar.finish(true);
        for (const Isa* kernel : vectorKernels()) {
            wide.push_back(std::make_unique<MeshGeometry>(bare));
            wide.back()->finish(true, *kernel);
        }
    }
    MeshGeometry scalar;
    std::vector<std::unique_ptr<MeshGeometry>> wide;
};

inline std::string shown(const Ray& r) {
    std::ostringstream out;
    out.precision(9);
    out << "org " << r.org.x << ' ' << r.org.y << ' ' << r.org.z << " dir " << r.dir.x << ' '
        << r.dir.y << ' ' << r.dir.z << " t " << r.tMin << ' ' << r.tMax;
    return out.str();
}
inline std::string shown(const Hit& h) {
    std::ostringstream out;
    out.precision(9);
    if (h.isHit())
        out << "triangle " << h.prim << " at " << h.t << ' ' << h.u << ' ' << h.v;
    else
        out << "nothing";
    return out.str();
}

inline bool isSame(const TriangleHit& a, const Hit& b) {
    if (!b.isHit()) return a.t == kInfinityF && a.triangle == TriangleHit::kNone;
    return a.t == b.t && a.triangle == b.prim;
}

struct Counts {
    std::size_t rays = 0, hits = 0, hidden = 0;
};

// Asks all kernels about the rays; the scalar code says what is right.
inline void compare(const Meshes& meshes, const RayList& rays, const std::string& name,
                    Counts& counts) {
    const std::size_t n = rays.org.size();
    const Mesh oracle(meshes.scalar, {0}, {{0, 0}});
    std::vector<Hit> expected(n), got(n);
    std::vector<TriangleHit> brief(n);
    std::vector<std::uint8_t> expectedHidden(n), hidden(n);
    for (std::size_t i = 0; i < n; ++i) {
        const Ray ray = rays.span()[i];
        expected[i].t = ray.tMax;
        if (oracle.intersect(ray, expected[i])) expected[i].shape = 3;
        expectedHidden[i] = oracle.occludes(ray);
        counts.hits += expected[i].isHit(), counts.hidden += expectedHidden[i];
    }
    counts.rays += n;
    for (const auto& geometry : meshes.wide) {
        const Mesh mesh(*geometry, {0}, {{0, 0}});
        CHECK(mesh.takesBatches());
        got.assign(n, {.t = -7}), brief.assign(n, {.t = -7}); // for rays that nobody answers
        mesh.intersectBatch(rays.span(), 3, got);
        closestHits(*geometry->isa, geometry->wideMesh(), rays.span(), brief);
        mesh.occludesBatch(rays.span(), hidden);
        for (std::size_t i = 0; i < n; ++i) {
            CHECK_INFO(battery::haveSameBits(got[i], expected[i]) && isSame(brief[i], expected[i]),
                       name << ", " << geometry->isa->name << ", ray " << i << " of " << n << ": "
                            << shown(rays.span()[i]) << ": " << shown(got[i])
                            << ", without u and v: " << brief[i].triangle << " at " << brief[i].t
                            << ", expected " << shown(expected[i]));
            CHECK_INFO(hidden[i] == expectedHidden[i],
                       name << ", " << geometry->isa->name << ", ray " << i << " of " << n << ": "
                            << shown(rays.span()[i]) << ": hidden " << int(hidden[i]));
        }
    }
}

} // namespace kernel_checks
