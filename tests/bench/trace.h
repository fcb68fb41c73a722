// Tracing the rays of `bench` with the functions that the renderer calls, with any number
// of threads. Every ray leaves its answer in memory, as other programs' measurements have it.
#pragma once

#include "base/ray.h"
#include "bench/rays.h"

#include <cstddef>
#include <cstdint>
#include <vector>

class ThreadPool;

class BenchTracer {
public:
    BenchTracer(const MeshGeometry& geometry, const BenchRays& rays, ThreadPool& pool);
    // withUv: of a nearest hit also u and v, which the renderer computes once for every hit of a
    // path; else t and the triangle.
    void trace(bool withUv);
    // How many rays of the last trace() met something.
    std::size_t hitCount() const;

private:
    void traceBatch(std::size_t number, bool withUv);

    const MeshGeometry& geometry_;
    Mesh mesh_;
    const BenchRays& rays_;
    ThreadPool& pool_;
    // Of each ray. One of the three is written.
    std::vector<TriangleHit> nearest_;
    std::vector<Hit> withUv_;
    std::vector<std::uint8_t> hidden_;
    bool hasUv_ = false;
};
