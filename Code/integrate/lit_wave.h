// LitWave: light that arrives along a wave of rays: what they see of the sky, of lamps and of
// surfaces that shine, and what shadow rays let through.
#pragma once

#include "integrate/cones_of_rays.h"
#include "integrate/path_memory.h"
#include "integrate/points.h"
#include "integrate/wave.h"
#include "sample/power_heuristic.h"
#include "scene/path_lights.h"

#include <algorithm>
#include <span>

class LitWave {
public:
    static constexpr std::size_t kPoints = PointBlock::kPoints;

    LitWave(const Wave& wave, const LampSampling& sampling)
        : wave_(wave), context_(wave.context), scene_(context_.scene), memory_(wave.memory),
          path_(memory_.path), lights_(scene_.pathLights()), materials_(scene_.lobedMaterials()),
          limits_(context_.settings.picture), sampling_(sampling) {}

protected:
    const PathState& stateOf(std::size_t ray) const { return path_.states[ray]; }

    // Light that arrives along ray i, on its sample.
    void add(std::size_t i, Rgb radiance) {
        Rgb light = wave_.rays.weight[i] * radiance;
        clampIndirect(light, stateOf(i).bounces() - 1);
        wave_.add(wave_.rays.sample[i], light);
    }
    // `bounces`: of the path before the one that shows the light.
    void clampIndirect(Rgb& light, int bounces) const {
        const float most = static_cast<float>(limits_.clampIndirect);
        if (!(most > 0) || bounces < 1 || limits_.integrator != IntegratorKind::Path) return;
        const float sum = light.r + light.g + light.b;
        if (sum > 3 * most) light = light * (3 * most / sum);
    }

    // What part of the radiance of a light a ray adds that has met it along `dir`: it was sampled as
    // well, if it is one of the lamps.
    float partOfHit(std::size_t i, std::uint32_t light, Vec3 dir) const {
        const PathState& from = stateOf(i);
        if (!(from.pdf > 0)) return 1;
        float sampled = 0;
        if (light != PathLights::kNone)
            sampled = sampling_.isOneChosen
                          ? lights_.pdf(from.p, from.n, light, dir)
                          : lights_.pdfOfLight(from.p, light, dir) * sampling_.samples;
        return kernels::one::powerHeuristic(from.pdf, sampled).v;
    }

    void addMissed() {
        const PointBatch& points = memory_.points;
        const std::span<const Rgb> seen = waves::backgroundsOf(wave_);
        const Rgb background = seen.empty() ? scene_.background(Vec3{}) : Rgb{};
        if (seen.empty() && isBlack(background)) return;
        const bool isLamp = lights_.sky() != PathLights::kNone && wave_.depth > 0;
        for (std::size_t first = 0; first < points.missedCount; first += SkyBlock::kRays) {
            const std::size_t count = std::min(SkyBlock::kRays, points.missedCount - first);
            const std::uint32_t* const rays = points.missed.data() + first;
            if (isLamp) findSkyParts({rays, count});
            for (std::size_t i = 0; i < count; ++i) {
                const Rgb radiance = seen.empty() ? background : seen[first + i];
                add(rays[i], isLamp ? radiance * path_.sky.part[i] : radiance);
            }
        }
    }
    // Lamps that are no shapes, and that rays go through.
    void addMet() {
        if (!lights_.hasUnshaped()) return;
        const PathBatch& rays = wave_.rays;
        for (std::size_t i = 0; i < rays.size(); ++i) {
            const PathState& state = stateOf(i);
            if (!(state.pdf > 0) && (rays.seesLights[i] & lights_.unshapedSeenBy()) == 0) continue;
            float end = kInfinityF;
            if (memory_.hits[i].isHit()) end = memory_.hits[i].t;
            lights_.meet(rays.org[i], rays.dir[i], end, state.pdf > 0 ? 0 : rays.seesLights[i],
                         [&](std::uint32_t light, Rgb radiance) {
                             add(i, radiance * partOfHit(i, light, rays.dir[i]));
                         });
        }
    }
    // What the surface at point k emits.
    void addEmission(std::size_t k) {
        const std::uint32_t i = memory_.points.ray[k];
        const PointBlock& block = memory_.points.at.block(k / kPoints);
        const SceneMaterial& of = memory_.points.at.of(k);
        const bool isFront = block.isFront(k % kPoints);
        if (of.isLamp && wave_.rays.seesLights[i] == 0) return;
        const Vec2 uv = memory_.points.at.uv(k);
        const UvFootprint footprint =
            of.pictures->emission != nullptr ? waves::footprintAt(wave_, k) : UvFootprint{};
        const Rgb emission = emissionAt(of, uv, footprint);
        if (isBlack(emission) || (of.emitsFront && !isFront)) return;
        const Hit& hit = memory_.hits[i];
        std::uint32_t light = lights_.ofObject(block.object[k % kPoints], isFront);
        if (light == PathLights::kNone) light = lights_.ofTriangle(hit.shape, hit.prim);
        const Vec3 dir = normalize(wave_.rays.dir[i]);
        Rgb radiance = emission * opacityOf(k);
        if (of.isLamp && light != PathLights::kNone) // it may not be the same for all directions
            radiance = lights_.radianceOf(light, wave_.rays.org[i], dir, radiance);
        add(i, radiance * partOfHit(i, light, dir));
    }

    // The part of light that point k does not let straight through.
    float opacityOf(std::size_t k) const {
        const SceneMaterial& of = memory_.points.at.of(k);
        if (of.pictures->opacity == nullptr) return of.opacity;
        return opacityAt(of, memory_.points.at.uv(k), waves::footprintAt(wave_, k));
    }

    // Adds what arrives of the light of path_.shadowRays: take(sample, light).
    template <class Take> void traceShadowRays(const RayBatch& rays, const Take& take) {
        if (rays.empty()) return;
        wave_.counts.tracedShadow += rays.size();
        if (scene_.hasSeeThrough()) {
            transmitted(scene_, rays, memory_.transmittance);
            for (std::size_t i = 0; i < rays.size(); ++i)
                if (const Rgb part = memory_.transmittance[i]; !isBlack(part))
                    take(rays.sample[i], rays.weight[i] * part);
            return;
        }
        scene_.shapes().occluded(rays.span(), memory_.hidden);
        for (std::size_t i = 0; i < rays.size(); ++i)
            if (memory_.hidden[i] == 0) take(rays.sample[i], rays.weight[i]);
    }

private:
    // Writes what parts of the sky's radiance rays add that met nothing to path_.sky.
    void findSkyParts(std::span<const std::uint32_t> rays) {
        SkyBlock& block = path_.sky;
        for (std::size_t i = 0; i < rays.size(); ++i) {
            const PathState& from = stateOf(rays[i]);
            SurfaceBlock::set(block.dir, i, wave_.rays.dir[rays[i]]);
            SurfaceBlock::set(block.p, i, from.p), SurfaceBlock::set(block.n, i, from.n);
            block.pdf[i] = from.pdf;
        }
        context_.settings.isa->shading->sky(lights_, sampling_, block, rays.size());
    }

protected:
    const Wave& wave_;
    const IntegratorContext& context_;
    const Scene& scene_;
    WaveMemory& memory_;
    PathMemory& path_;
    const PathLights& lights_;
    const LobedMaterials& materials_;
    const SettingsDesc& limits_;
    const LampSampling sampling_;
};
