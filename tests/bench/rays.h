// The ray sets of `bench`: what a renderer asks of one mesh, in the order in which it
// would ask. Camera, light and rays are those of published measurements of other ray tracers, so
// that the rates can be put side by side.
#pragma once

#include "accel/kernels/kernels.h"
#include "shape/mesh.h"

#include <cstddef>
#include <string>
#include <vector>

struct BenchRays {
    std::string name;
    bool anyHit = false;
    std::vector<Vec3> org, dir;
    std::vector<float> tMin, tMax, time;
    std::vector<std::size_t> batches; // where each batch starts, and the end

    std::size_t size() const { return org.size(); }
    std::size_t batchCount() const { return batches.size() - 1; }
    RaySpan batch(std::size_t i) const;
    RaySpan part(std::size_t first, std::size_t count) const;
    void push(Vec3 from, Vec3 to, float tEnd);
    void endBatch() { batches.push_back(size()); }
};

// Outside: off the box around the mesh, which fills a third of the picture; light above and behind.
// Inside: from one end of the box along it, light below its ceiling.
enum class BenchView { Outside, Inside };

// primary: 1024 x 1024 camera rays; shadow: from a point light to every hit; bounce: a diffuse
// direction from every hit, nearest and any. In tiles of 16 x 16 pixels, 4 x 4 inside.
// The mesh must have been finished, with any tree.
std::vector<BenchRays> benchRays(const MeshGeometry& geometry, BenchView from = BenchView::Outside);
