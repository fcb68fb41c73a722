// Whitted ray tracing (Whitted 1980) with distributed effects (Cook et al. 1984), in waves: all
// rays of one depth are traced together, shaded together, and spawn the next wave. The sums of a
// sample run over waves, and inside a wave over rays in the order of their parents, so they do not
// depend on how samples are grouped.
#include "render/integrator.h"
#include "render/lamp_ray.h"
#include "render/shading.h"
#include "render/to_float.h"
#include "sample/dimensions.h"
#include "sample/hash.h"

namespace {

class Waves {
public:
    Waves(const IntegratorContext& context, SampleChunk& chunk, WaveMemory& memory,
          RayCounts& counts)
        : context_(context), scene_(context.scene), settings_(context.settings), chunk_(chunk),
          memory_(memory), counts_(counts), cutoff_(toFloat(settings_.picture.cutoff)) {}

    void run(std::uint64_t& cameraHits) {
        memory_.rays = chunk_.cameraRays;
        memory_.media = context_.media;
        counts_.camera += memory_.rays.size();
        for (int depth = 0; !memory_.rays.empty(); ++depth) {
            closest(scene_, memory_.rays, memory_.hits);
            memory_.next.clear();
            memory_.shadowRays.clear();
            for (std::size_t i = 0; i < memory_.rays.size(); ++i) {
                if (memory_.hits[i].isHit()) {
                    if (depth == 0) ++cameraHits;
                    shadeRay(i, depth);
                } else {
                    add(memory_.rays.sample[i],
                        memory_.rays.weight[i] * scene_.background(memory_.rays.dir[i]));
                }
            }
            addDirectLight();
            std::swap(memory_.rays, memory_.next);
        }
    }

private:
    void add(std::uint32_t slot, Rgb radiance) { chunk_.radiance[slot] += radiance; }

    // The light of all shadow rays of this wave that reach their lamp.
    void addDirectLight() {
        const RayBatch& rays = memory_.shadowRays;
        counts_.shadow += rays.size();
        transmitted(scene_, rays, memory_.transmittance);
        for (std::size_t i = 0; i < rays.size(); ++i)
            add(rays.sample[i], rays.weight[i] * memory_.transmittance[i]);
    }

    void shadeRay(std::size_t i, int depth) {
        const PathBatch& rays = memory_.rays;
        const Ray ray = rays.ray(i);
        const std::uint32_t slot = rays.sample[i];
        const ShadedPoint at = shade(scene_, ray, memory_.hits[i]);
        if (depth == 0 && context_.wantsFirstHits)
            chunk_.first[slot] = describeFirstHit(scene_, ray, at);
        Rgb weight = rays.weight[i];
        if (at.isLamp) {
            if (at.front && rays.seesLights[i]) add(slot, weight * at.material.emission);
            return;
        }
        const bool goesOn = depth < settings_.picture.maxDepth;
        if (at.material.opacity < 1) {
            const Rgb straight = weight * at.material.filter * (1 - at.material.opacity);
            if (goesOn && worthTracing(straight)) {
                ++counts_.refract;
                memory_.next.push({leave(at.surface, -at.eye.ng), ray.dir, 0, kInfinityF, ray.time},
                                  slot, straight, rays.medium[i], rays.stream[i],
                                  rays.seesLights[i] != 0);
            }
            weight = weight * at.material.opacity;
            if (isBlack(weight)) return;
        }
        add(slot, weight * (at.material.emission + at.material.diffuse * scene_.ambient()));
        if (!isBlack(at.material.diffuse) || !isBlack(at.material.specular))
            castShadowRays(at, weight, i, depth);
        if (goesOn) spawnBounces(at, weight, i, depth);
    }

    bool worthTracing(Rgb weight) const {
        const float most = maxChannel(weight);
        return most > 0 && most >= cutoff_;
    }

    void castShadowRays(const ShadedPoint& at, Rgb weight, std::size_t i, int depth) {
        for (std::size_t l = 0; l < scene_.lights().size(); ++l) {
            const Light& light = *scene_.lights()[l];
            const bool soft = light.isSoft() && settings_.switches.softShadows;
            const int count = soft ? settings_.picture.lightSamples : 1;
            for (int k = 0; k < count; ++k) {
                const LightSample sample = soft ? light.sample(at.surface.p, place(l, k, i, depth))
                                                : light.centre(at.surface.p);
                addLightSample(at, weight, i, light, soft, sample,
                               1.0f / static_cast<float>(count));
            }
        }
    }

    // Random place on light l for its k-th sample at the hit of ray i.
    Vec2 place(std::size_t l, int k, std::size_t i, int depth) const {
        const SampleId id = chunk_.ids[memory_.rays.sample[i]];
        const auto repeats = static_cast<std::uint32_t>(settings_.picture.lightSamples);
        return context_.lightSamplers[l].get2D(memory_.rays.stream[i],
                                               id.index * repeats + static_cast<std::uint32_t>(k),
                                               dimension(depth, BounceSlot::LightUv));
    }

    // Is the light above the horizon, of the triangle or of the curve that its normals pretend?
    static bool rises(const ShadedPoint& at, Vec3 toLight) {
        return dot(at.lit.ng, toLight) > 0 ||
               (at.surface.lift != Vec3{} && dot(at.lit.ns, toLight) > 0);
    }

    void addLightSample(const ShadedPoint& at, Rgb weight, std::size_t i, const Light& light,
                        bool soft, const LightSample& sample, float share) {
        if (isBlack(sample.irradiance) || !rises(at, sample.toLight)) return;
        const Rgb reflected = reflectedLight(at.material, at.lit.n, at.toEye, sample.toLight);
        const Rgb light1 = weight * reflected * sample.irradiance * share;
        if (isBlack(light1)) return;
        const std::uint32_t slot = memory_.rays.sample[i];
        if (!light.castsShadows() || !settings_.switches.shadows) return add(slot, light1);
        const float time = memory_.rays.time[i];
        if (const auto origin = light.origin(); origin && !soft) {
            memory_.shadowRays.push(rayFromLamp(at.surface, at.lit.ng, *origin, time), slot,
                                    light1);
        } else {
            memory_.shadowRays.push({leave(at.surface, at.lit.ng) + at.surface.lift, sample.toLight,
                                     0, sample.distance * (1 - 0x1p-20f), time},
                                    slot, light1);
        }
    }

    void spawnBounces(const ShadedPoint& at, Rgb weight, std::size_t i, int depth) {
        const PathBatch& rays = memory_.rays;
        const Material& material = at.material;
        if (isBlack(material.mirror) && isBlack(material.transmission)) return;
        const std::uint32_t slot = rays.sample[i], stream = rays.stream[i];
        Vec2 u{0.5f, 0.5f};
        if (material.roughness > 0)
            u = context_.sampler.get2D(stream, chunk_.ids[slot].index,
                                       dimension(depth, BounceSlot::BsdfUv));

        MediumTree& media = memory_.media;
        const MediumTree::Inside before = rays.medium[i];
        const MediumTree::Inside after =
            at.front ? media.enter(before, at.materialId) : media.leave(before, at.materialId);
        const bool startedInside = !at.front && before == MediumTree::kNothing;
        const float iorHere = startedInside ? material.ior : iorOf(media.top(before));
        const float eta = iorHere / iorOf(media.top(after));

        const Bounces out = bounces(material, at.eye.n, at.eye.ng, at.toEye, eta, u);
        // A rough surface's highlight has counted the lamps; a sharp mirror shows their bodies.
        const bool seesLights = material.roughness <= 0 || isBlack(material.specular);
        const auto spawn = [&](const Bounce& bounce, Vec3 side, MediumTree::Inside medium,
                               std::uint32_t branch, std::uint64_t& counter) {
            const Rgb spawned = weight * bounce.weight;
            if (!worthTracing(spawned)) return;
            ++counter;
            memory_.next.push({leave(at.surface, side), bounce.dir, 0, kInfinityF, rays.time[i]},
                              slot, spawned, medium, low32(hash(stream, branch)), seesLights);
        };
        if (out.reflected) spawn(*out.reflected, at.eye.ng, before, 1, counts_.reflect);
        if (out.refracted) spawn(*out.refracted, -at.eye.ng, after, 2, counts_.refract);
    }

    float iorOf(std::uint32_t material) const {
        return material == MediumTree::kOutside ? 1.0f : scene_.materials()[material].base.ior;
    }

    const IntegratorContext& context_;
    const Scene& scene_;
    const RenderSettings& settings_;
    SampleChunk& chunk_;
    WaveMemory& memory_;
    RayCounts& counts_;
    float cutoff_;
};

} // namespace

void integrateWhitted(const IntegratorContext& context, SampleChunk& chunk, WaveMemory& memory,
                      RayCounts& counts, std::uint64_t& cameraHits) {
    Waves(context, chunk, memory, counts).run(cameraHits);
}
