#include "render/path/whitted_lobes.h"

#include "render/path/lobed_wave.h"
#include "render/path/shading_kernel.h"
#include "sample/warp.h"

#include <algorithm>
#include <bit>
#include <utility>

namespace {

// Lamps whose shadow rays are kept at a time: lobes are written again for each so many.
constexpr std::size_t kLampsTogether = 8;

class WhittedWave : LobedWave {
    // With what density a lamp was sampled beside a ray of a rough lobe.
    auto pdfOf() const {
        return [this](const PathState& from, std::uint32_t light, Vec3 dir) {
            if (light == PathLights::kNone) return 0.0f;
            return lights_.pdfOfLight(from.p, light, dir) *
                   static_cast<float>(limits_.lightSamples);
        };
    }

public:
    explicit WhittedWave(const Wave& wave) : LobedWave(wave) {}

    void run() {
        findPoints();
        addMissed(pdfOf());
        addMet(pdfOf());
        memory_.next.clear(), path_.nextStates.clear();
        path_.shadowRays.clear();
        path_.sums.assign(memory_.points.count, Rgb{});
        const std::size_t lamps = lights_.size(), blocks = memory_.points.blocks();
        std::size_t lamp = 0;
        do {
            const std::size_t end = std::min(lamp + kLampsTogether, lamps);
            for (RayBatch& rays : path_.lampRays) rays.clear();
            for (std::size_t b = 0; b < blocks; ++b) shadeBlock(b, lamp, end);
            if (lamp == 0) {
                traceShadowRays(path_.shadowRays,
                                [&](std::uint32_t k, Rgb light) { path_.sums[k] += light; });
                addSums();
            }
            for (; lamp < end; ++lamp) {
                traceShadowRays(path_.lampRays[lamp % kLampsTogether],
                                [&](std::uint32_t k, Rgb light) { path_.sums[k] += light; });
                addSums();
            }
        } while (lamp < lamps);
        sortRays();
    }

private:
    void addSums() {
        for (std::size_t k = 0; k < memory_.points.count; ++k) {
            if (isBlack(path_.sums[k])) continue;
            wave_.add(memory_.points.slot[k], path_.sums[k]);
            path_.sums[k] = {};
        }
    }

    // All that is done at the points of a block while lamps `from` to `end` are asked; the first
    // time, all but lamps as well.
    void shadeBlock(std::size_t b, std::size_t from, std::size_t end) {
        PointBatch& points = memory_.points;
        const PointBlock& at = points.at.block(b);
        const std::size_t first = b * kPoints, size = points.sizeOf(b);
        unsigned waiting = 0;
        for (std::size_t i = 0; i < size; ++i) {
            const LobedMaterial& of = materials_[at.material[i]];
            if (from == 0) {
                if ((of.flags & LobedMaterial::kEmits) != 0) addEmission(first + i, pdfOf());
                if (points.at.of(first + i).seeThrough()) goStraight(first + i);
            }
            if (of.lobes != 0 && !isBlack(points.weight[first + i])) waiting |= 1u << i;
        }
        if (waiting == 0) return;
        takeThroughputs(b, path_.lamp.throughput);
        while (waiting != 0) {
            const unsigned alike = fillAlike(b, waiting);
            waiting &= ~alike;
            if ((path_.lobes.flags & kHasSides) != 0) findBoundaries(b, alike, path_.lamp.eta);
            if (from == 0) {
                addAmbient(b, alike);
                sendRays(b, alike);
            }
            if ((path_.lobes.flags & kAnswersLights) == 0) continue;
            for (std::size_t lamp = from; lamp < end; ++lamp) askLamp(b, alike, lamp);
        }
    }

    // Rays straight on; what is left of the point's weight is for its lobes.
    void goStraight(std::size_t k) {
        PointBatch& points = memory_.points;
        const Material here = materialAt(points.at[k]);
        points.weight[k] = points.weight[k] * here.opacity;
        const std::size_t i = points.ray[k];
        const PathBatch& rays = wave_.rays;
        const Rgb weight = rays.weight[i] * here.filter * (1 - here.opacity);
        if (!(here.opacity < 1) || !goesOn(weight)) return;
        const ShadedPoint at = points.at[k];
        push(k, kStraight, leave(at.surface, -at.eye.ng), rays.dir[i], weight, rays.medium[i],
             rays.stream[i], rays.seesLights[i], stateOf(i));
        ++wave_.counts.refract;
    }
    bool goesOn(Rgb weight) const {
        return wave_.depth < limits_.maxDepth && waves::worthTracing(wave_, weight);
    }

    void addAmbient(std::size_t b, unsigned alike) {
        const Rgb ambient = scene_.ambient();
        if (isBlack(ambient) || (path_.lobes.flags & kDiffuse) == 0) return;
        PathBlock& block = path_.block;
        block.points = alike;
        std::copy_n(path_.lamp.eta, kPoints, block.eta);
        context_.settings.isa->shading->ambient(memory_.points.at.block(b), path_.lobes, block);
        for (; alike != 0; alike &= alike - 1) {
            const auto i = static_cast<std::size_t>(std::countr_zero(alike));
            const Vec3 part = SurfaceBlock::get(block.weight, i);
            const std::size_t k = b * kPoints + i;
            const Rgb light = memory_.points.weight[k] * ambient * Rgb{part.x, part.y, part.z};
            if (scene_.ambientReach() > 0)
                sendToSky(k, light);
            else
                path_.sums[k] += light;
        }
    }
    // Even light counts by what part of the sky a point sees, weighted by the cosine.
    void sendToSky(std::size_t k, Rgb light) {
        const PointBatch& points = memory_.points;
        const ShadedPoint at = points.at[k];
        const std::uint32_t ray = points.ray[k];
        const Frame frame = frameAround(at.eye.n);
        const auto samples = static_cast<std::uint32_t>(limits_.lightSamples);
        const Rgb share = light * (1 / static_cast<float>(samples));
        for (std::uint32_t s = 0; s < samples; ++s) {
            const Vec2 u = context_.skySampler.get2D(
                wave_.rays.stream[ray],
                wave_.chunk.sampleNumber[wave_.rays.sample[ray]] * samples + s,
                dimension(wave_.depth, BounceSlot::LightUv));
            const Vec3 dir = frame.toWorld(cosineHemisphereFromSquare(u));
            if (!(dot(dir, at.eye.ng) > 0)) continue;
            ++wave_.counts.shadow;
            path_.shadowRays.push(
                {leave(at.surface, at.eye.ng), dir, 0, scene_.ambientReach(), wave_.rays.time[ray]},
                static_cast<std::uint32_t>(k), share);
        }
    }

    // Light of a lamp: the rays of its samples, or the light itself where it casts no shadows.
    void askLamp(std::size_t b, unsigned alike, std::size_t number) {
        const PointBatch& points = memory_.points;
        const PathLights::Entry& lamp = lights_.entry(static_cast<std::uint32_t>(number));
        LampBlock& block = path_.lamp;
        block.points = alike;
        block.litOutside = points.at.block(b).litApart;
        const int samples = lamp.isSoft ? limits_.lightSamples : 1;
        block.samples = static_cast<float>(samples);
        block.besideRays = wave_.depth < limits_.maxDepth;
        RayBatch& rays = path_.lampRays[number % kLampsTogether];
        for (int s = 0; s < samples; ++s) {
            if (lamp.isSoft) drawPlaces(b, alike, number, s);
            block.lit = 0;
            context_.settings.isa->shading->lamp(lights_, static_cast<std::uint32_t>(number),
                                                 points.at.block(b), path_.lobes, block);
            for (unsigned lit = block.lit & alike; lit != 0; lit &= lit - 1) {
                const auto i = static_cast<std::size_t>(std::countr_zero(lit));
                const std::size_t k = b * kPoints + i;
                const Vec3 v = SurfaceBlock::get(block.light, i);
                if (lamp.isOpen) {
                    path_.sums[k] += {v.x, v.y, v.z};
                    continue;
                }
                ++wave_.counts.shadow;
                rays.push({SurfaceBlock::get(block.org, i), SurfaceBlock::get(block.dir, i), 0,
                           block.end[i], wave_.rays.time[points.ray[k]]},
                          static_cast<std::uint32_t>(k), {v.x, v.y, v.z});
            }
        }
    }
    void drawPlaces(std::size_t b, unsigned alike, std::size_t number, int s) {
        const PointBatch& points = memory_.points;
        const Sampler& sampler = context_.lampSamplers[number];
        const auto samples = static_cast<std::uint32_t>(limits_.lightSamples);
        for (; alike != 0; alike &= alike - 1) {
            const auto i = static_cast<std::size_t>(std::countr_zero(alike));
            const std::size_t ray = points.ray[b * kPoints + i];
            const Vec2 place =
                sampler.get2D(wave_.rays.stream[ray],
                              wave_.chunk.sampleNumber[wave_.rays.sample[ray]] * samples +
                                  static_cast<std::uint32_t>(s),
                              dimension(wave_.depth, BounceSlot::LightUv));
            path_.lamp.u[i] = place.x, path_.lamp.v[i] = place.y;
        }
    }

    // ---- rays of the next wave

    static constexpr std::uint32_t kStraight = 0;

    void sendRays(std::size_t b, unsigned alike) {
        if (wave_.depth >= limits_.maxDepth) return;
        const LobeBlock& lobes = path_.lobes;
        bool areDrawn = false;
        for (std::size_t l = 0; l < lobes.count; ++l) {
            const std::uint32_t flags = lobeTypes()[lobes.lobe[l].kind].flags;
            if (!spawnsInWhitted(flags)) continue;
            if (!std::exchange(areDrawn, true)) drawDirections(b, alike);
            const bool hasBoth = (flags & kReflects) != 0 && (flags & kTransmits) != 0;
            for (const bool transmits : {false, true})
                if (hasBoth || !transmits) sendLobe(b, alike, l, transmits, flags);
        }
    }
    void drawDirections(std::size_t b, unsigned alike) {
        const PointBatch& points = memory_.points;
        std::uint32_t pixels[kPoints] = {}, samples[kPoints] = {};
        for (; alike != 0; alike &= alike - 1) {
            const auto i = static_cast<std::size_t>(std::countr_zero(alike));
            const std::size_t ray = points.ray[b * kPoints + i];
            pixels[i] = wave_.rays.stream[ray];
            samples[i] = wave_.chunk.sampleNumber[wave_.rays.sample[ray]];
        }
        drawNumbers(context_, wave_.depth, pixels, samples, path_.block.numbers);
    }
    void sendLobe(std::size_t b, unsigned alike, std::size_t lobe, bool transmits,
                  std::uint32_t flags) {
        const PointBatch& points = memory_.points;
        const PathBatch& rays = wave_.rays;
        PathBlock& block = path_.block;
        block.points = alike;
        block.scattered = block.single = block.diffuse = block.transmitted = 0;
        std::copy_n(path_.lamp.eta, kPoints, block.eta);
        context_.settings.isa->shading->bounce(points.at.block(b), path_.lobes, lobe, transmits,
                                               block);
        const auto branch = static_cast<std::uint32_t>(1 + 2 * lobe + transmits);
        for (unsigned sent = block.scattered & alike; sent != 0; sent &= sent - 1) {
            const auto i = static_cast<std::size_t>(std::countr_zero(sent));
            const std::size_t k = b * kPoints + i, ray = points.ray[k];
            const Vec3 w = SurfaceBlock::get(block.weight, i);
            const Rgb weight = points.weight[k] * Rgb{w.x, w.y, w.z};
            if (!waves::worthTracing(wave_, weight)) continue;
            PathState state;
            state.pdf = block.pdf[i];
            state.p = SurfaceBlock::get(points.at.block(b).p, i);
            const bool isTransmitted = (block.transmitted >> i & 1) != 0;
            const bool crosses = isTransmitted && (flags & kHasSides) != 0;
            ++(isTransmitted ? wave_.counts.refract : wave_.counts.reflect);
            push(k, branch, SurfaceBlock::get(block.org, i), SurfaceBlock::get(block.dir, i),
                 weight, crosses ? boundaries_[i].after : rays.medium[ray],
                 waves::streamOf(rays.stream[ray], branch), PathBatch::kSeesAsReflection, state);
        }
    }

    // One more ray, of a branch of point k.
    void push(std::size_t k, std::uint32_t branch, Vec3 org, Vec3 dir, Rgb weight,
              MediumTree::Inside medium, std::uint32_t stream, std::uint8_t seesLights,
              const PathState& state) {
        const std::size_t ray = memory_.points.ray[k];
        memory_.next.push({org, dir, 0, kInfinityF, wave_.rays.time[ray]}, wave_.rays.sample[ray],
                          weight, medium, stream, seesLights);
        path_.nextStates.push_back(state);
        path_.order.push_back(static_cast<std::uint32_t>(k << 5 | branch));
    }
    // Puts rays into the order of their points and branches, which they have but for blocks of
    // several kinds of material: sums of samples with several rays must not depend on blocks.
    void sortRays() {
        std::vector<std::uint32_t>& order = path_.order;
        if (std::is_sorted(order.begin(), order.end())) return order.clear();
        std::vector<std::uint32_t> from(order.size());
        for (std::uint32_t i = 0; i < from.size(); ++i) from[i] = i;
        std::sort(from.begin(), from.end(),
                  [&](std::uint32_t a, std::uint32_t b) { return order[a] < order[b]; });
        PathBatch sorted;
        std::vector<PathState> states;
        const PathBatch& next = memory_.next;
        for (const std::uint32_t i : from) {
            sorted.push(next.ray(i), next.sample[i], next.weight[i], next.medium[i], next.stream[i],
                        next.seesLights[i]);
            states.push_back(path_.nextStates[i]);
        }
        std::swap(memory_.next, sorted), std::swap(path_.nextStates, states);
        order.clear();
    }
};

} // namespace

void integrateLobes(const IntegratorContext& context, SampleChunk& chunk, WaveMemory& memory,
                    RayCounts& counts, std::uint64_t& cameraHits) {
    integrateInWaves<WhittedWave>(context, chunk, memory, counts, cameraHits);
}
