#include "render/path/path.h"

#include "render/path/lobed_wave.h"
#include "render/path/shading_kernel.h"

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
        for (std::size_t b = 0; b < memory_.points.blocks(); ++b) scatterBlock(b);
        traceShadowRays(path_.shadowRays,
                        [&](std::uint32_t slot, Rgb light) { wave_.add(slot, light); });
    }

private:
    void scatterBlock(std::size_t b) {
        const PointBatch& points = memory_.points;
        const PointBlock& at = points.at.block(b);
        PathBlock& block = path_.block;
        const std::size_t first = b * kPoints, size = points.sizeOf(b);
        block.lit = block.open = block.scattered = block.single = block.diffuse =
            block.transmitted = 0;
        unsigned waiting = 0; // points whose lobes are asked
        for (std::size_t k = first; k < first + size; ++k) {
            const std::size_t i = k - first;
            const LobedMaterial& of = materials_[at.material[i]];
            if ((of.flags & LobedMaterial::kEmits) != 0) addEmission(k, pdfOf());
            const bool answers = of.lobes != 0 || (of.flags & LobedMaterial::kSeeThrough) != 0;
            if (!answers || stateOf(points.ray[k]).isLast) continue;
            waiting |= 1u << i;
        }
        if (waiting == 0) return;
        std::uint32_t pixels[kPoints], samples[kPoints];
        takePixels(b, pixels, samples);
        drawNumbers(context_, wave_.depth, pixels, samples, block.numbers);
        takeThroughputs(b, block.throughput);
        waiting &= ~goStraight(b, waiting);
        while (waiting != 0) waiting &= ~scatterAlike(b, waiting);
    }

    // Points that rays go through as if they weren't there; returns which.
    unsigned goStraight(std::size_t b, unsigned points) {
        unsigned straight = 0;
        for (; points != 0; points &= points - 1) {
            const auto i = static_cast<std::size_t>(std::countr_zero(points));
            const std::size_t k = b * kPoints + i;
            const SceneMaterial& of = memory_.points.at.of(k);
            if (!of.seeThrough()) continue;
            const ShadedPoint at = memory_.points.at[k];
            if (!(path_.block.numbers.spare[i] < 1 - opacityAt(of, at.surface.uv))) continue;
            straight |= 1u << i;
            const std::uint32_t ray = memory_.points.ray[k];
            PathState state = stateOf(ray);
            if (++state.transparent > limits_.transparentDepth || isBlack(of.filter)) continue;
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

    // Scatters the light of those points that have the same kinds of lobes as the first of them.
    unsigned scatterAlike(std::size_t b, unsigned waiting) {
        const PointBlock& at = memory_.points.at.block(b);
        PathBlock& block = path_.block;
        const unsigned alike = block.points = fillAlike(b, waiting);
        const std::uint32_t flags = path_.lobes.flags;
        if ((flags & kHasSides) != 0) findBoundaries(b, alike, block.eta);
        context_.settings.isa->shading->scatter(lights_, at, path_.lobes, block);
        takeLight(b, alike);
        takeRays(b, alike, flags);
        return alike;
    }

    // Shadow rays to the chosen lamps.
    void takeLight(std::size_t b, unsigned alike) {
        const PathBlock& block = path_.block;
        for (unsigned lit = block.lit & alike; lit != 0; lit &= lit - 1) {
            const auto i = static_cast<std::size_t>(std::countr_zero(lit));
            const std::size_t k = b * kPoints + i;
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
    void takeRays(std::size_t b, unsigned alike, std::uint32_t flags) {
        const PathBlock& block = path_.block;
        const PathBatch& rays = wave_.rays;
        for (unsigned on = block.scattered & alike; on != 0; on &= on - 1) {
            const auto i = static_cast<std::size_t>(std::countr_zero(on));
            const std::size_t k = b * kPoints + i;
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
                if (!(block.numbers.roulette[i] < go)) continue;
                weight = weight * (1 / go);
            }
            state.pdf = block.pdf[i];
            state.p = SurfaceBlock::get(memory_.points.at.block(b).p, i);
            state.n = (flags & kTransmits) != 0
                          ? Vec3{}
                          : SurfaceBlock::get(memory_.points.at.block(b).n, i);
            const bool crosses = isTransmitted && (flags & kHasSides) != 0;
            memory_.next.push({SurfaceBlock::get(block.org, i), SurfaceBlock::get(block.dir, i), 0,
                               kInfinityF, rays.time[ray]},
                              rays.sample[ray], weight,
                              crosses ? boundaries_[i].after : rays.medium[ray], rays.stream[ray],
                              PathBatch::kSeesAsReflection);
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
