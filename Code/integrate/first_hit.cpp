// The integrators that show what the camera ray met, and ambient occlusion from there.
#include "integrate/integrator.h"
#include "integrate/points.h"
#include "integrate/shading.h"
#include "sample/dimensions.h"
#include "sample/hash.h"
#include "sample/warp.h"

#include <algorithm>

namespace {

float fraction(float x) { return x - std::floor(x); }

Rgb shown(IntegratorKind kind, const FirstHit& first) {
    if (!first.hit) return {};
    switch (kind) {
    case IntegratorKind::Normal: {
        const Vec3 n = first.normal;
        return {0.5f + 0.5f * n.x, 0.5f + 0.5f * n.y, 0.5f + 0.5f * n.z};
    }
    case IntegratorKind::Depth: return {first.depth, first.depth, first.depth};
    case IntegratorKind::Id: return objectColor(first.object);
    case IntegratorKind::Uv: return {fraction(first.uv.x), fraction(first.uv.y), 0};
    case IntegratorKind::Albedo:
    case IntegratorKind::Whitted:
    case IntegratorKind::Path:
    case IntegratorKind::Ao: break;
    }
    return first.albedo;
}

// What the camera rays meet, as a wave: memory.points, and chunk.first if the context wants it.
void findFirstHits(const IntegratorContext& context, SampleChunk& chunk, WaveMemory& memory,
                   RayCounts& counts, std::uint64_t& cameraHits) {
    const PathBatch& rays = chunk.cameraRays;
    const Wave wave{context, rays, 0, chunk, memory, counts};
    counts.camera += rays.size();
    closest(context.scene, rays, memory.hits);
    waves::findPoints(wave, [] {}, [](std::size_t) { return 0u; });
    if (context.wantsFirstHits) describeFirstHits(wave);
    cameraHits += memory.points.count;
}

} // namespace

Rgb objectColor(std::uint32_t object) {
    const std::uint64_t bits = mixBits(object);
    const auto channel = [&](int shift) {
        return 0.1f + 0.9f * static_cast<float>((bits >> shift) & 255) / 255;
    };
    return {channel(0), channel(8), channel(16)};
}

void describeFirstHits(const Wave& wave) {
    const Scene& scene = wave.context.scene;
    const Camera& camera = scene.camera();
    const PointBatch& points = wave.memory.points;
    Camera::Axes view = camera.axesAt(0);
    for (std::size_t k = 0; k < points.count; ++k) {
        const PointBlock& block = points.at.block(k / PointBlock::kPoints);
        const std::size_t i = k % PointBlock::kPoints;
        const Vec3d position = toDouble(SurfaceBlock::get(block.p, i));
        const SceneMaterial& of = points.at.of(k);
        const Vec2 uv = points.at.uv(k);
        if (camera.isMoving()) view = camera.axesAt(wave.rays.time[points.ray[k]]);
        FirstHit& first = wave.chunk.first[points.slot[k]];
        first.hit = true;
        first.depth =
            static_cast<float>(dot(position - view.eye, view.forward) / scene.frame().scale);
        first.normal = SurfaceBlock::get(block.n, i);
        first.position = toFloat(scene.frame().worldPoint(position));
        first.albedo = of.diffuse;
        if (of.pictures->diffuse) first.albedo *= of.pictures->diffuse->color(uv);
        first.object = block.object[i] + 1;
        first.uv = uv;
    }
}

void integrateFirstHit(const IntegratorContext& context, SampleChunk& chunk, WaveMemory& memory,
                       RayCounts& counts, std::uint64_t& cameraHits) {
    findFirstHits(context, chunk, memory, counts, cameraHits);
    for (std::size_t k = 0; k < memory.points.count; ++k) {
        const std::uint32_t slot = memory.points.slot[k];
        chunk.radiance[slot] = shown(context.settings.picture.integrator, chunk.first[slot]);
    }
}

void integrateAo(const IntegratorContext& context, SampleChunk& chunk, WaveMemory& memory,
                 RayCounts& counts, std::uint64_t& cameraHits) {
    const PathBatch& rays = chunk.cameraRays;
    const int repeats = context.settings.picture.lightSamples;
    const float share = 1.0f / static_cast<float>(repeats);
    const Sampler sampler = context.sampler.stream(0, repeats);
    findFirstHits(context, chunk, memory, counts, cameraHits);
    const PointBatch& points = memory.points;
    for (const std::uint32_t i : std::span(points.missed).first(points.missedCount))
        chunk.radiance[i] = {1, 1, 1};
    memory.shadowRays.clear();
    for (std::size_t point = 0; point < points.count; ++point) {
        const std::uint32_t i = points.ray[point];
        const ShadedPoint at = points.at[point];
        const Frame frame = frameAround(at.eye.n);
        for (int k = 0; k < repeats; ++k) {
            const std::uint32_t index =
                chunk.sampleNumber[i] * static_cast<std::uint32_t>(repeats) +
                static_cast<std::uint32_t>(k);
            const Vec2 u = sampler.get2D(rays.stream[i], index, dimension(0, BounceSlot::LightUv));
            const Vec3 dir = frame.toWorld(cosineHemisphereFromSquare(u));
            if (!(dot(dir, at.eye.ng) > 0)) continue;
            memory.shadowRays.push({leave(at.surface, at.eye.ng), dir, 0, kInfinityF, rays.time[i]},
                                   i, Rgb{share, share, share});
        }
    }
    counts.indirect += memory.shadowRays.size();
    transmitted(context.scene, memory.shadowRays, memory.transmittance);
    for (std::size_t i = 0; i < memory.shadowRays.size(); ++i)
        chunk.radiance[memory.shadowRays.sample[i]] +=
            memory.shadowRays.weight[i] * memory.transmittance[i];
}
