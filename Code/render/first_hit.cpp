// The integrators that show what the camera ray met, and ambient occlusion from there.
#include "render/integrator.h"
#include "render/shading.h"
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
    case IntegratorKind::Ao: break;
    }
    return first.albedo;
}

} // namespace

Rgb objectColor(std::uint32_t object) {
    const std::uint64_t bits = mixBits(object);
    const auto channel = [&](int shift) {
        return 0.1f + 0.9f * static_cast<float>((bits >> shift) & 255) / 255;
    };
    return {channel(0), channel(8), channel(16)};
}

FirstHit describeFirstHit(const Scene& scene, const Ray& ray, const ShadedPoint& at) {
    const Vec3d position = toDouble(at.surface.p);
    const auto [eye, axis] = scene.camera().view(ray.time);
    FirstHit first;
    first.hit = true;
    first.depth = static_cast<float>(dot(position - eye, axis) / scene.frame().scale);
    first.normal = at.eye.n;
    first.position = toFloat(scene.frame().worldPoint(position));
    first.albedo = materialAt(at).diffuse;
    first.object = at.surface.object + 1;
    first.uv = at.surface.uv;
    return first;
}

void integrateFirstHit(const IntegratorContext& context, SampleChunk& chunk, WaveMemory& memory,
                       RayCounts& counts, std::uint64_t& cameraHits) {
    const PathBatch& rays = chunk.cameraRays;
    counts.camera += rays.size();
    closest(context.scene, rays, memory.hits);
    for (std::size_t i = 0; i < rays.size(); ++i) {
        if (!memory.hits[i].isHit()) continue;
        ++cameraHits;
        const Ray ray = rays.ray(i);
        chunk.first[i] =
            describeFirstHit(context.scene, ray, shade(context.scene, ray, memory.hits[i]));
        chunk.radiance[i] = shown(context.settings.integrator, chunk.first[i]);
    }
}

void integrateAo(const IntegratorContext& context, SampleChunk& chunk, WaveMemory& memory,
                 RayCounts& counts, std::uint64_t& cameraHits) {
    const PathBatch& rays = chunk.cameraRays;
    const int repeats = context.settings.picture.lightSamples;
    const float share = 1.0f / static_cast<float>(repeats);
    const Sampler sampler = context.sampler.stream(0, repeats);
    counts.camera += rays.size();
    closest(context.scene, rays, memory.hits);
    memory.shadowRays.clear();
    for (std::size_t i = 0; i < rays.size(); ++i) {
        if (!memory.hits[i].isHit()) {
            chunk.radiance[i] = {1, 1, 1};
            continue;
        }
        ++cameraHits;
        const Ray ray = rays.ray(i);
        const ShadedPoint at = shade(context.scene, ray, memory.hits[i]);
        if (context.wantsFirstHits) chunk.first[i] = describeFirstHit(context.scene, ray, at);
        const Frame frame = frameAround(at.eye.n);
        for (int k = 0; k < repeats; ++k) {
            const std::uint32_t index = chunk.ids[i].index * static_cast<std::uint32_t>(repeats) +
                                        static_cast<std::uint32_t>(k);
            const Vec2 u = sampler.get2D(rays.stream[i], index, dimension(0, BounceSlot::LightUv));
            const Vec3 dir = frame.toWorld(cosineHemisphereFromSquare(u));
            if (!(dot(dir, at.eye.ng) > 0)) continue;
            memory.shadowRays.push({leave(at.surface, at.eye.ng), dir, 0, kInfinityF, ray.time},
                                   static_cast<std::uint32_t>(i), Rgb{share, share, share});
        }
    }
    counts.indirect += memory.shadowRays.size();
    transmitted(context.scene, memory.shadowRays, memory.transmittance);
    for (std::size_t i = 0; i < memory.shadowRays.size(); ++i)
        chunk.radiance[memory.shadowRays.sample[i]] +=
            memory.shadowRays.weight[i] * memory.transmittance[i];
}
