// LobedWave: what integrators over lobes share: the points of a wave of rays, what their rays see
// of sky, lamps and surfaces that shine, and the lobes of points that are alike.
#pragma once

#include "integrate/cones_of_rays.h"
#include "integrate/path_memory.h"
#include "integrate/path_numbers.h"
#include "integrate/points.h"
#include "integrate/wave.h"
#include "sample/power_heuristic.h"
#include "scene/path_lights.h"

#include <algorithm>
#include <bit>
#include <span>
#include <utility>

class LobedWave {
public:
    static constexpr std::size_t kPoints = PointBlock::kPoints;

    explicit LobedWave(const Wave& wave)
        : wave_(wave), context_(wave.context), scene_(context_.scene), memory_(wave.memory),
          path_(memory_.path), lights_(scene_.pathLights()), materials_(scene_.lobedMaterials()),
          limits_(context_.settings.picture) {}

protected:
    const PathState& stateOf(std::size_t ray) const { return path_.states[ray]; }

    void findPoints() {
        waves::findPoints(
            wave_,
            [&] {
                if (!context_.checkers.empty()) waves::mixCheckers(wave_);
            },
            [&](std::size_t b) { return pointsWith(LobedMaterial::kLitOutside, b); });
        if (wave_.depth == 0 && context_.wantsFirstHits) describeFirstHits(wave_);
    }

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

    // What part of a light's radiance a ray adds that has met it, if its direction was sampled with
    // a density: the light was sampled as well, with lampPdf() per steradian.
    template <class LampPdf> float partOfHit(std::size_t i, const LampPdf& lampPdf) const {
        const PathState& state = stateOf(i);
        if (!(state.pdf > 0)) return 1;
        return kernels::one::powerHeuristic(state.pdf, lampPdf(state)).v;
    }

    // `lampPdf(state, light, direction)`: see partOfHit(); light may be PathLights::kNone.
    template <class LampPdf> void addMissed(const LampPdf& lampPdf) {
        const PointBatch& points = memory_.points;
        const std::span<const Rgb> seen = waves::backgroundsOf(wave_);
        const Rgb background = seen.empty() ? scene_.background(Vec3{}) : Rgb{};
        for (std::size_t m = 0; m < points.missedCount; ++m) {
            const std::uint32_t i = points.missed[m];
            const Rgb radiance = seen.empty() ? background : seen[m];
            add(i, radiance * partOfHit(i, [&](const PathState& state) {
                       return lampPdf(state, lights_.sky(), normalize(wave_.rays.dir[i]));
                   }));
        }
    }
    // Lamps that are no shapes, and that rays go through.
    template <class LampPdf> void addMet(const LampPdf& lampPdf) {
        if (!lights_.hasUnshaped()) return;
        const PathBatch& rays = wave_.rays;
        for (std::size_t i = 0; i < rays.size(); ++i) {
            const PathState& state = stateOf(i);
            if (!(state.pdf > 0) && (rays.seesLights[i] & lights_.unshapedSeenBy()) == 0) continue;
            float end = kInfinityF;
            if (memory_.hits[i].isHit()) end = memory_.hits[i].t;
            lights_.meet(rays.org[i], rays.dir[i], end, state.pdf > 0 ? 0 : rays.seesLights[i],
                         [&](std::uint32_t light, Rgb radiance) {
                             add(i, radiance * partOfHit(i, [&](const PathState& from) {
                                        return lampPdf(from, light, rays.dir[i]);
                                    }));
                         });
        }
    }
    // What the surface at point k emits.
    template <class LampPdf> void addEmission(std::size_t k, const LampPdf& lampPdf) {
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
        Rgb radiance = emission * opacityOf(k);
        if (of.isLamp && light != PathLights::kNone) // it may not be the same for all directions
            radiance = lights_.radianceOf(light, wave_.rays.org[i], normalize(wave_.rays.dir[i]),
                                          radiance);
        add(i, radiance * partOfHit(i, [&](const PathState& state) {
                   return lampPdf(state, light, normalize(wave_.rays.dir[i]));
               }));
    }

    // The part of light that point k does not let straight through.
    float opacityOf(std::size_t k) const {
        const SceneMaterial& of = memory_.points.at.of(k);
        if (of.pictures->opacity == nullptr) return of.opacity;
        return opacityAt(of, memory_.points.at.uv(k), waves::footprintAt(wave_, k));
    }

    // Points of the block whose materials have one of these flags.
    unsigned pointsWith(std::uint32_t flags, std::size_t b) const {
        if ((materials_.flagsOfAll() & flags) == 0) return 0;
        const std::uint32_t* const number = memory_.points.at.block(b).material;
        unsigned points = 0;
        for (std::size_t i = 0; i < memory_.points.sizeOf(b); ++i)
            points |= unsigned{(materials_[number[i]].flags & flags) != 0} << i;
        return points;
    }

    // Up to sixteen points whose materials have the same kinds of lobes.
    struct AlikePoints {
        const PointBlock* at = nullptr;
        const std::uint32_t* number = nullptr; // ascending
        std::size_t size = 0;

        unsigned all() const { return (1u << size) - 1; }
    };
    // Lists the points that have lobes and of which isShaded(k) holds.
    template <class IsShaded> void listAlike(const IsShaded& isShaded) {
        const PointBatch& points = memory_.points;
        constexpr std::uint16_t kNone = 0xffff;
        std::vector<std::uint32_t>& next = path_.alikeStarts;
        next.assign(materials_.signatures() + 1, 0);
        path_.signatures.resize(points.count);
        for (std::size_t k = 0; k < points.count; ++k) {
            const LobedMaterial& of =
                materials_[points.at.block(k / kPoints).material[k % kPoints]];
            const std::uint16_t signature = isShaded(k, of) ? of.signature : kNone;
            path_.signatures[k] = signature;
            if (signature != kNone) ++next[signature + 1u];
        }
        for (std::size_t i = 1; i < next.size(); ++i) next[i] += next[i - 1];
        path_.alike.resize(next.back());
        for (std::size_t k = 0; k < points.count; ++k)
            if (const std::uint16_t signature = path_.signatures[k]; signature != kNone)
                path_.alike[next[signature]++] = static_cast<std::uint32_t>(k);
    }
    // Calls fn(points) for those that are listed, so that the order of points of one sample does
    // not depend on others.
    template <class Fn> void forEachAlike(const Fn& fn) {
        const PointBatch& points = memory_.points;
        const std::uint32_t* const list = path_.alike.data();
        for (std::size_t from = 0, to = 0; from < path_.alike.size(); from = to) {
            if (isWholeBlock(from)) {
                to = from + points.sizeOf(list[from] / kPoints);
                fn(AlikePoints{&points.at.block(list[from] / kPoints), list + from, to - from});
                continue;
            }
            const std::uint16_t signature = path_.signatures[list[from]];
            for (to = from + 1; to < path_.alike.size() && to - from < kPoints &&
                                path_.signatures[list[to]] == signature && !isWholeBlock(to);)
                ++to;
            gather({list + from, to - from});
            fn(AlikePoints{&path_.gathered, list + from, to - from});
        }
    }

    // Writes the lobes of points.
    void fillLobes(const AlikePoints& of) {
        const PointBlock& at = *of.at;
        const std::uint32_t number = at.material[0];
        const LobedMaterial& first = materials_[number];
        LobeBlock& lobes = path_.lobes;
        const bool isPlain = first.factors == 0 && !isMixed(of) &&
                             (first.flags & LobedMaterial::kAnisotropic) == 0 &&
                             std::all_of(at.material, at.material + of.size,
                                         [&](std::uint32_t other) { return other == number; });
        if (isPlain && path_.filledWith == number) return;
        path_.filledWith = isPlain ? number : PathMemory::kMixed;
        lobes.begin(materials_, first);
        if (isPlain) return;
        unsigned painted = 0;
        for (std::size_t i = 0; i < of.size; ++i) {
            const LobedMaterial& other = materials_[at.material[i]];
            lobes.flags |= other.flags;
            painted |= unsigned{other.factors != 0} << i;
            if (at.material[i] != number) lobes.put(materials_, other, i);
            if ((other.flags & LobedMaterial::kAnisotropic) != 0) turn(lobes, of.number[i], i);
        }
        while (painted != 0) {
            const std::uint32_t one = at.material[std::countr_zero(painted)];
            unsigned points = 0;
            for (unsigned rest = painted; rest != 0; rest &= rest - 1) {
                const int i = std::countr_zero(rest);
                points |= unsigned{at.material[i] == one} << i;
            }
            if (context_.filtersTextures())
                for (unsigned rest = points; rest != 0; rest &= rest - 1) {
                    const auto i = static_cast<std::size_t>(std::countr_zero(rest));
                    footprints_[i] = waves::footprintAt(wave_, of.number[i]);
                }
            lobes.paint(materials_, materials_[one], points, at, context_.pictures,
                        context_.filtersTextures() ? footprints_ : nullptr);
            painted &= ~points;
        }
        if (isMixed(of))
            for (std::size_t i = 0; i < of.size; ++i)
                if (const MaterialMix& mix = path_.mixes[of.number[i]]; mix.part > 0)
                    lobes.mix(materials_, materials_[mix.other], i, mix.part);
    }
    // What is on both sides of points whose lobes ask for it; their `eta` goes to the column.
    void findBoundaries(const AlikePoints& of, LobeBlock::Lane& eta) {
        for (std::size_t i = 0; i < of.size; ++i) {
            boundaries_[i] = waves::boundaryAt(wave_, of.number[i]);
            eta[i] = boundaries_[i].eta;
        }
    }
    void takeThroughputs(const AlikePoints& of, LobeBlock::Lane (&throughput)[3]) const {
        for (std::size_t i = 0; i < of.size; ++i) {
            const Rgb& weight = memory_.points.weight[of.number[i]];
            throughput[0][i] = weight.r, throughput[1][i] = weight.g, throughput[2][i] = weight.b;
        }
    }
    // The pixels and samples that random numbers of the points are drawn for.
    void takePixels(const AlikePoints& of, std::uint32_t (&pixels)[kPoints],
                    std::uint32_t (&samples)[kPoints]) const {
        for (std::size_t i = 0; i < kPoints; ++i) {
            const std::size_t ray = memory_.points.ray[of.number[std::min(i, of.size - 1)]];
            pixels[i] = wave_.rays.stream[ray];
            samples[i] = wave_.chunk.sampleNumber[wave_.rays.sample[ray]];
        }
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
    // Whether all points of a block follow each other in the list from this place on.
    bool isWholeBlock(std::size_t place) const {
        const std::uint32_t k = path_.alike[place];
        if (k % kPoints != 0) return false;
        const std::size_t size = memory_.points.sizeOf(k / kPoints);
        const std::size_t last = place + size - 1;
        return last < path_.alike.size() && path_.alike[last] == k + size - 1 &&
               path_.signatures[path_.alike[last]] == path_.signatures[k];
    }
    // Whether some of the points have the lobes of two materials.
    bool isMixed(const AlikePoints& of) const {
        return !path_.mixes.empty() &&
               std::any_of(of.number, of.number + of.size,
                           [&](std::uint32_t k) { return path_.mixes[k].part > 0; });
    }
    // Puts points together into path_.gathered.
    void gather(std::span<const std::uint32_t> numbers) {
        PointBlock& to = path_.gathered;
        to.curved = to.front = to.litApart = 0;
        for (std::size_t i = 0; i < numbers.size(); ++i)
            to.take(i, memory_.points.at.block(numbers[i] / kPoints), numbers[i] % kPoints);
    }
    // Lays the lobes of point k, which is place i of the block, along dp/du.
    void turn(LobeBlock& lobes, std::size_t k, std::size_t i) const {
        const std::size_t ray = memory_.points.ray[k];
        const Hit& hit = memory_.hits[ray];
        const Shape& shape = *scene_.shapes().shapes[hit.shape];
        SurfaceBlock::set(lobes.tangent, i, shape.derivatives(wave_.rays.ray(ray), hit).dpdu);
        lobes.turned |= 1u << i;
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
    waves::Boundary boundaries_[kPoints];
    UvFootprint footprints_[kPoints];
};

// Runs WaveOf for one wave of rays after the other.
template <class WaveOf>
void integrateInWaves(const IntegratorContext& context, SampleChunk& chunk, WaveMemory& memory,
                      RayCounts& counts, std::uint64_t& cameraHits) {
    counts.camera += chunk.cameraRays.size();
    memory.media = context.media;
    memory.path.states.assign(chunk.cameraRays.size(), PathState{});
    if (context.filtersTextures()) waves::makeCones(context, chunk.cameraRays, memory.path.states);
    const PathBatch* rays = &chunk.cameraRays;
    for (int depth = 0; !rays->empty(); ++depth) {
        const Wave wave{context, *rays, depth, chunk, memory, counts};
        closest(context.scene, *rays, memory.hits);
        WaveOf(wave).run();
        if (depth == 0) cameraHits += memory.points.count;
        counts.points += memory.points.count;
        counts.skipped.unshadedPoints += memory.points.count - memory.path.alike.size();
        std::swap(memory.rays, memory.next);
        std::swap(memory.path.states, memory.path.nextStates);
        rays = &memory.rays;
    }
}
