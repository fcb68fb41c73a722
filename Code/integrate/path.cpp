#include "integrate/integrator.h"

#include "integrate/lobed_wave.h"
#include "integrate/shading_kernel.h"
#include "sample/dimensions.h"

#include <bit>
#include <utility>

namespace {

class PathWave : LobedWave {
    // With what density a light was sampled where a path came from.
    auto pdfOf() const {
        return [this](const PathState& from, std::uint32_t light, Vec3 dir) {
            return light == PathLights::kNone ? 0.0f : lights_.pdf(from.p, from.n, light, dir);
        };
    }

public:
    explicit PathWave(const Wave& wave) : LobedWave(wave) {}

    void run() {
        findPoints();
        addMissed(pdfOf());
        addMet(pdfOf());
        path_.shadowRays.clear();
        memory_.next.clear(), path_.nextStates.clear();
        const PointBatch& points = memory_.points;
        for (std::size_t b = 0; b < points.blocks(); ++b)
            for (unsigned rest = pointsWith(LobedMaterial::kEmits, b); rest != 0; rest &= rest - 1)
                addEmission(b * kPoints + static_cast<std::size_t>(std::countr_zero(rest)),
                            pdfOf());
        listAlike([&](std::size_t k, const LobedMaterial& of) {
            return (of.lobes != 0 || (of.flags & LobedMaterial::kSeeThrough) != 0) &&
                   !stateOf(points.ray[k]).isLast;
        });
        path_.filledWith = PathMemory::kMixed;
        forEachAlike([&](const AlikePoints& of) { scatter(of); });
        traceShadowRays(path_.shadowRays,
                        [&](std::uint32_t slot, Rgb light) { wave_.add(slot, light); });
    }

private:
    void scatter(const AlikePoints& of) {
        PathBlock& block = path_.block;
        block.lit = block.open = block.scattered = block.single = block.diffuse =
            block.transmitted = 0;
        std::uint32_t pixels[kPoints], samples[kPoints];
        takePixels(of, pixels, samples);
        drawNumbers(pixels, samples);
        takeThroughputs(of, block.throughput);
        block.points = of.all();
        if (scene_.hasSeeThrough()) block.points &= ~goStraight(of);
        if (block.points == 0) return;
        fillLobes(of);
        if (limits_.filterGlossy > 0) filterGlossy(of);
        const std::uint32_t flags = path_.lobes.flags;
        if ((flags & kHasSides) != 0) findBoundaries(of, block.eta);
        context_.settings.isa->shading->scatter(lights_, *of.at, path_.lobes, block);
        if ((flags & kAnswersLights) != 0 && !lights_.isEmpty())
            wave_.counts.skipped.unlitSamples +=
                static_cast<std::uint64_t>(std::popcount(block.points & ~block.lit));
        takeLight(of);
        takeRays(of, flags);
    }

    void drawNumbers(const std::uint32_t (&pixels)[kPoints],
                     const std::uint32_t (&samples)[kPoints]) {
        PathNumbers& numbers = path_.block.numbers;
        PairDrawer drawer(*context_.settings.isa->camera, pixels, samples);
        for (const auto& [slot, to] : {std::pair(BounceSlot::LightPick, &numbers.choice),
                                       std::pair(BounceSlot::LightUv, &numbers.onLight),
                                       std::pair(BounceSlot::BsdfUv, &numbers.direction),
                                       std::pair(BounceSlot::Roulette, &numbers.goesOn)})
            drawer.draw(context_.sampler, dimension(wave_.depth, slot), 1, to);
    }

    // Points that rays go through as if they weren't there; returns which.
    unsigned goStraight(const AlikePoints& among) {
        unsigned straight = 0;
        for (std::size_t i = 0; i < among.size; ++i) {
            const std::size_t k = among.number[i];
            const SceneMaterial& of = memory_.points.at.of(k);
            if (!of.seeThrough()) continue;
            const ShadedPoint at = memory_.points.at[k];
            if (!(path_.block.numbers.goesOn.v[i] < 1 - opacityOf(k))) continue;
            straight |= 1u << i;
            const std::uint32_t ray = memory_.points.ray[k];
            PathState state = stateOf(ray);
            if (++state.transparent > limits_.transparentDepth || isBlack(of.filter)) continue;
            if (context_.filtersTextures()) state.cone = waves::coneThrough(wave_, k);
            const PathBatch& rays = wave_.rays;
            memory_.next.push(
                {leave(at.surface, -at.eye.ng), rays.dir[ray], 0, kInfinityF, rays.time[ray]},
                rays.sample[ray], rays.weight[ray] * of.filter, rays.medium[ray], rays.stream[ray],
                rays.seesLights[ray]);
            path_.nextStates.push_back(state);
            ++wave_.counts.refract;
        }
        return straight;
    }

    void filterGlossy(const AlikePoints& of) {
        const float radius = static_cast<float>(limits_.filterGlossy);
        for (std::size_t i = 0; i < of.size; ++i)
            path_.lobes.leastAlpha[i] =
                stateOf(memory_.points.ray[of.number[i]]).leastAlpha(radius);
    }

    // Shadow rays to the chosen lamps.
    void takeLight(const AlikePoints& of) {
        const PathBlock& block = path_.block;
        for (unsigned lit = block.lit & block.points; lit != 0; lit &= lit - 1) {
            const auto i = static_cast<std::size_t>(std::countr_zero(lit));
            const std::size_t k = of.number[i];
            const std::uint32_t ray = memory_.points.ray[k], slot = memory_.points.slot[k];
            const Vec3 v = SurfaceBlock::get(block.fromLamp, i);
            Rgb light{v.x, v.y, v.z};
            clampIndirect(light, stateOf(ray).bounces());
            ++wave_.counts.shadow;
            if ((block.open >> i & 1) != 0) {
                wave_.add(slot, light);
                continue;
            }
            path_.shadowRays.push({SurfaceBlock::get(block.lampOrg, i),
                                   SurfaceBlock::get(block.toLamp, i), 0, block.lampEnd[i],
                                   wave_.rays.time[ray]},
                                  slot, light);
        }
    }

    // Rays that go on.
    void takeRays(const AlikePoints& of, std::uint32_t flags) {
        const PathBlock& block = path_.block;
        const PathBatch& rays = wave_.rays;
        for (unsigned on = block.scattered & block.points; on != 0; on &= on - 1) {
            const auto i = static_cast<std::size_t>(std::countr_zero(on));
            const std::size_t k = of.number[i];
            const std::uint32_t ray = memory_.points.ray[k];
            PathState state = stateOf(ray);
            const bool isDiffuse = (block.diffuse >> i & 1) != 0,
                       isTransmitted = (block.transmitted >> i & 1) != 0,
                       isSingle = (block.single >> i & 1) != 0;
            if (!limits_.caustics && state.diffuse > 0 && !isDiffuse) continue;
            if (isTransmitted)
                state.isLast = ++state.transmission > limits_.transmissionDepth;
            else if (isDiffuse)
                state.isLast = ++state.diffuse > limits_.diffuseDepth;
            else
                state.isLast = ++state.glossy > limits_.glossyDepth;
            const int bounces = state.bounces();
            state.isLast |= bounces > limits_.maxDepth;
            // The last ray is traced for the light that was weighted against it.
            if (state.isLast && isSingle) continue;
            const Vec3 w = SurfaceBlock::get(block.weight, i);
            Rgb weight = rays.weight[ray] * Rgb{w.x, w.y, w.z};
            if (bounces > kBouncesWithoutRoulette) {
                const float go = clamp(maxChannel(weight), kLeastToGo, 1.0f);
                if (!(block.numbers.goesOn.u[i] < go)) {
                    ++wave_.counts.skipped.endedPaths;
                    continue;
                }
                weight = weight * (1 / go);
            }
            state.pdf = block.pdf[i];
            if (!isSingle) state.leastPdf = min(state.leastPdf, state.pdf);
            state.p = SurfaceBlock::get(of.at->p, i);
            state.n = (flags & kTransmits) != 0 ? Vec3{} : SurfaceBlock::get(of.at->n, i);
            const bool crosses = isTransmitted && (flags & kHasSides) != 0;
            // What diffuse light shows of pictures is blurred as it is: single points cost less.
            if (context_.filtersTextures())
                state.cone = isDiffuse
                                 ? RayCone{}
                                 : waves::coneAfter(wave_, k, SurfaceBlock::get(block.dir, i),
                                                    state.pdf, crosses ? &boundaries_[i] : nullptr);
            memory_.next.push({SurfaceBlock::get(block.org, i), SurfaceBlock::get(block.dir, i), 0,
                               kInfinityF, rays.time[ray]},
                              rays.sample[ray], weight,
                              crosses ? boundaries_[i].after : rays.medium[ray], rays.stream[ray],
                              PathLights::kSeesAsReflection);
            path_.nextStates.push_back(state);
            ++(isTransmitted ? wave_.counts.refract
               : isDiffuse   ? wave_.counts.indirect
                             : wave_.counts.reflect);
        }
    }
    static constexpr int kBouncesWithoutRoulette = 3;
    static constexpr float kLeastToGo = 0.05f;
};

} // namespace

void integratePath(const IntegratorContext& context, SampleChunk& chunk, WaveMemory& memory,
                   RayCounts& counts, std::uint64_t& cameraHits) {
    integrateInWaves<PathWave>(context, chunk, memory, counts, cameraHits);
}
