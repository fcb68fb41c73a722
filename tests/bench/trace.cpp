#include "bench/trace.h"

#include "base/parallel.h"

#include <algorithm>

namespace {

// What a thread takes at once: 10 to 100 microseconds of work.
constexpr std::size_t kRaysPerJob = 4096;

} // namespace

BenchTracer::BenchTracer(const MeshGeometry& geometry, const BenchRays& rays, ThreadPool& pool)
    : geometry_(geometry), mesh_(geometry, {0}, {{0, 0}}), rays_(rays), pool_(pool),
      nearest_(rays.anyHit ? 0 : rays.size()), withUv_(nearest_.size()),
      hidden_(rays.anyHit ? rays.size() : 0) {}

void BenchTracer::trace(bool withUv) {
    hasUv_ = withUv;
    const std::size_t batches = rays_.batchCount();
    const std::size_t perJob =
        std::max<std::size_t>(1, batches * kRaysPerJob / std::max<std::size_t>(1, rays_.size()));
    pool_.run((batches + perJob - 1) / perJob, [&](std::size_t job, int) {
        for (std::size_t b = job * perJob; b < std::min(batches, (job + 1) * perJob); ++b)
            traceBatch(b, withUv);
    });
}

void BenchTracer::traceBatch(std::size_t number, bool withUv) {
    const RaySpan batch = rays_.batch(number);
    const auto mine = [&](auto& all) {
        return std::span(all).subspan(rays_.batches[number], batch.size());
    };
    if (rays_.anyHit)
        mesh_.occludesBatch(batch, mine(hidden_));
    else if (withUv)
        mesh_.intersectBatch(batch, 0, mine(withUv_));
    else if (geometry_.isa != nullptr)
        closestHits(*geometry_.isa, geometry_.wideMesh(), batch, mine(nearest_));
    else
        for (std::size_t i = 0; i < batch.size(); ++i) {
            Hit hit;
            const bool met = mesh_.intersect(batch[i], hit);
            mine(nearest_)[i] = met ? TriangleHit{hit.t, hit.prim} : TriangleHit{};
        }
}

std::size_t BenchTracer::hitCount() const {
    const auto count = [](const auto& all, auto met) {
        return static_cast<std::size_t>(std::count_if(all.begin(), all.end(), met));
    };
    if (rays_.anyHit) return count(hidden_, [](std::uint8_t h) { return h != 0; });
    if (hasUv_) return count(withUv_, [](const Hit& hit) { return hit.isHit(); });
    return count(nearest_,
                 [](const TriangleHit& hit) { return hit.triangle != TriangleHit::kNone; });
}
