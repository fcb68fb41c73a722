#include "integrate/integrator.h"

#include "integrate/lobed_wave.h"
#include "integrate/shading_kernel.h"
#include "sample/dimensions.h"
#include "sample/warp.h"

#include <algorithm>
#include <array>
#include <bit>
#include <span>
#include <utility>

namespace {

template <class Fn> void forEachBit(unsigned bits, const Fn& fn) {
    for (; bits != 0; bits &= bits - 1) fn(static_cast<std::size_t>(std::countr_zero(bits)));
}

class WhittedWave : LobedWave {
public:
    explicit WhittedWave(const Wave& wave)
        : LobedWave(wave, {.isOneChosen = false,
                           .samples = static_cast<float>(
                               wave.context.settings.picture.lightSamples)}) {}

    void run() {
        findPoints();
        addMissed();
        addMet();
        memory_.next.clear();
        path_.shadowRays.clear();
        path_.sums.assign(memory_.points.count, Rgb{});
        path_.filledWith = PathMemory::kMixed;
        std::size_t lamp = 0;
        do {
            beginLamps(lamp);
            if (lamp == 0) beginPoints();
            forEachAlike([&](const AlikePoints& of) { shade(of, lamp == 0); });
            const auto add = [&](std::uint32_t k, Rgb light) { path_.sums[k] += light; };
            if (lamp == 0) traceShadowRays(path_.shadowRays, add);
            for (std::size_t i = 0; i < lamps_.size(); ++i)
                if (!lights_.entry(lamps_[i].light).isOpen) traceShadowRays(path_.lampRays[i], add);
            lamp += lamps_.size();
        } while (lamp < lights_.size());
        for (std::size_t k = 0; k < memory_.points.count; ++k)
            if (!isBlack(path_.sums[k])) wave_.add(memory_.points.slot[k], path_.sums[k]);
    }

private:
    // The lamps from this one on whose shadow rays are kept at a time.
    void beginLamps(std::size_t first) {
        constexpr std::size_t kMostSamples = 64;
        std::size_t count = 0, soft = 0;
        for (; count < path_.lamps.size() && first + count < lights_.size(); ++count) {
            LampQueue& lamp = path_.lamps[count];
            lamp.light = static_cast<std::uint32_t>(first + count);
            const bool isSoft = lights_.entry(lamp.light).isSoft;
            lamp.samples = isSoft ? static_cast<std::uint32_t>(limits_.lightSamples) : 1;
            if (count > 0 && soft + lamp.samples > kMostSamples) break;
            if (isSoft) soft += lamp.samples;
            lamp.share = 1 / static_cast<float>(lamp.samples);
            path_.lampRays[count].clear();
        }
        lamps_ = std::span(path_.lamps).first(count);
        if (path_.places.size() < soft) path_.places.resize(soft);
        NumberPairs* places = path_.places.data();
        for (LampQueue& lamp : lamps_) {
            const bool isSoft = lights_.entry(lamp.light).isSoft;
            lamp.places = isSoft ? places : nullptr;
            if (isSoft) places += lamp.samples;
        }
    }

    // What is done before lobes are looked at.
    void beginPoints() {
        const PointBatch& points = memory_.points;
        for (std::size_t b = 0; b < points.blocks(); ++b) {
            forEachBit(pointsWith(LobedMaterial::kEmits, b),
                       [&](std::size_t i) { addEmission(b * kPoints + i); });
            forEachBit(pointsWith(LobedMaterial::kSeeThrough, b),
                       [&](std::size_t i) { goStraight(b * kPoints + i); });
        }
        listAlike([&](std::size_t k, const LobedMaterial& of) {
            return of.lobes != 0 && !isBlack(points.weight[k]);
        });
    }
    // All that is done at some points for these lamps; the first time, all but lamps as well.
    void shade(const AlikePoints& of, bool isFirst) {
        fillLobes(of);
        WhittedBlock& block = path_.whitted;
        const std::uint32_t flags = path_.lobes.flags;
        const bool goesOn = wave_.depth < limits_.maxDepth;
        takeThroughputs(of, block.throughput);
        if ((flags & kHasSides) != 0) findBoundaries(of, block.eta);
        block.points = of.all();
        block.litOutside = of.at->litApart;
        block.besideRays = goesOn;
        block.takesEvenLight = isFirst && (flags & kDiffuse) != 0 && !isBlack(scene_.ambient());
        block.sendsRays = isFirst && goesOn && (flags & kSpawnsRays) != 0;
        std::copy_n(of.number, of.size, block.number);
        const std::span<LampQueue> lamps =
            (flags & kAnswersLights) != 0 ? lamps_ : std::span<LampQueue>();
        drawNumbers(of, lamps);
        for (std::size_t i = 0; i < lamps.size(); ++i) beginRays(lamps[i], path_.lampRays[i]);
        context_.settings.isa->shading->whitted(lights_, lamps, *of.at, path_.lobes, block,
                                                path_.bounces);
        if (block.takesEvenLight) addEvenLight(of);
        if (path_.bounces.rays > 0) takeBounces(of);
        for (std::size_t i = 0; i < lamps.size(); ++i) {
            wave_.counts.skipped.unlitSamples += of.size * lamps[i].samples - lamps[i].rays;
            takeRays(lamps[i], path_.lampRays[i], path_.lampOrigins[i]);
        }
    }
    // Numbers for rays of lobes, and places on soft lamps for all samples.
    void drawNumbers(const AlikePoints& of, std::span<const LampQueue> lamps) {
        WhittedBlock& block = path_.whitted;
        const bool spreads = block.sendsRays && (path_.lobes.flags & LobedMaterial::kSpreads) != 0;
        const auto isSoft = [](const LampQueue& lamp) { return lamp.places != nullptr; };
        if (!spreads && std::none_of(lamps.begin(), lamps.end(), isSoft)) return;
        std::uint32_t pixels[kPoints], samples[kPoints];
        takePixels(of, pixels, samples);
        PairDrawer drawer(*context_.settings.isa->camera, pixels, samples);
        const auto slot = [&](BounceSlot of) { return dimension(wave_.depth, of); };
        if (spreads) {
            drawer.draw(context_.sampler, slot(BounceSlot::LightPick), 1, &block.choice);
            drawer.draw(context_.sampler, slot(BounceSlot::BsdfUv), 1, &block.direction);
        }
        NumberPairs* places = path_.places.data();
        for (const LampQueue& lamp : lamps) {
            if (!isSoft(lamp)) continue;
            drawer.draw(context_.lampSamplers[lamp.light], slot(BounceSlot::LightUv), lamp.samples,
                        places);
            places += lamp.samples;
        }
    }

    // Rays straight on; what is left of the point's weight is for its lobes.
    void goStraight(std::size_t k) {
        PointBatch& points = memory_.points;
        const ShadedPoint at = points.at[k];
        const float opacity = opacityOf(k);
        points.weight[k] = points.weight[k] * opacity;
        const std::size_t i = points.ray[k];
        const PathBatch& rays = wave_.rays;
        const Rgb weight = rays.weight[i] * at.of->filter * (1 - opacity);
        if (!(opacity < 1) || wave_.depth >= limits_.maxDepth) return;
        if (!waves::worthTracing(wave_, weight)) {
            ++wave_.counts.skipped.weakRays;
            return;
        }
        memory_.next.push({leave(at.surface, -at.eye.ng), rays.dir[i], 0, kInfinityF, rays.time[i]},
                          rays.sample[i], weight, rays.medium[i], rays.stream[i],
                          rays.seesLights[i]);
        makeRoomForStates();
        PathState& state = path_.nextStates[memory_.next.size() - 1];
        state = stateOf(i);
        if (context_.filtersTextures()) state.cone = waves::coneThrough(wave_, k);
        ++wave_.counts.refract;
    }

    void addEvenLight(const AlikePoints& of) {
        const Rgb ambient = scene_.ambient();
        for (std::size_t i = 0; i < of.size; ++i) {
            const Vec3 part = SurfaceBlock::get(path_.whitted.evenLight, i);
            const Rgb light = ambient * Rgb{part.x, part.y, part.z};
            if (scene_.ambientReach() > 0)
                sendToSky(of.number[i], light);
            else
                path_.sums[of.number[i]] += light;
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

    // Shadow rays of a lamp are written behind those that it has.
    static void beginRays(LampQueue& lamp, RayBatch& rays) {
        const std::size_t to = rays.extend((lamp.samples + 1) * kPoints);
        lamp.to = {&rays.org[to], &rays.dir[to], &rays.tMax[to], &rays.sample[to],
                   &rays.weight[to]};
        lamp.rays = 0;
    }
    // Takes them, or the light itself where lamps cast no shadows.
    void takeRays(const LampQueue& lamp, RayBatch& rays, PathMemory::Origins& origins) {
        const PathLights::Entry& entry = lights_.entry(lamp.light);
        const std::size_t from = rays.size() - (lamp.samples + 1) * kPoints, to = from + lamp.rays;
        wave_.counts.shadow += lamp.rays;
        if (entry.isOpen) {
            for (std::size_t i = from; i < to; ++i) path_.sums[rays.sample[i]] += rays.weight[i];
            return rays.shrink(from);
        }
        rays.shrink(to);
        if (!entry.isPlace || !(origins.place == entry.place)) origins = {entry.place, 0};
        if (entry.isPlace && origins.count < to) {
            std::fill_n(rays.org.data() + origins.count, to - origins.count, entry.place);
            origins.count = to;
        }
        if (!scene_.moves()) return; // all times are 0, as they are in new arrays
        for (std::size_t i = from; i < to; ++i)
            rays.time[i] = wave_.rays.time[memory_.points.ray[rays.sample[i]]];
    }

    void takeBounces(const AlikePoints& of) {
        const PointBatch& points = memory_.points;
        const PathBatch& rays = wave_.rays;
        const BounceQueue& from = path_.bounces;
        PathBatch& next = memory_.next;
        const std::size_t first = next.size();
        std::size_t to = next.extend(from.rays);
        makeRoomForStates();
        // This has the last ray of each point: a mirror and glass that reflects totally send the
        // same one.
        std::array<std::size_t, kPoints> last;
        last.fill(first + from.rays);
        for (std::size_t r = 0; r < from.rays; ++r) {
            const std::size_t k = of.number[from.point[r]], ray = points.ray[k];
            const Rgb weight = points.weight[k] * from.weight[r];
            if (!waves::worthTracing(wave_, weight)) {
                ++wave_.counts.skipped.weakRays;
                continue;
            }
            const bool crosses =
                from.isBelow[r] &&
                (lobeTypes()[path_.lobes.lobe[(from.branch[r] - 1) / 2].kind].flags & kHasSides) !=
                    0;
            if (const std::size_t same = last[from.point[r]]; same < to && from.pdf[r] == 0 &&
                                                              next.dir[same] == from.dir[r] &&
                                                              path_.nextStates[same].pdf == 0) {
                next.weight[same] = next.weight[same] + weight;
                ++wave_.counts.skipped.sharedRays;
                continue;
            }
            last[from.point[r]] = to;
            ++(from.isBelow[r] ? wave_.counts.refract : wave_.counts.reflect);
            next.org[to] = from.org[r], next.dir[to] = from.dir[r];
            next.tMin[to] = 0, next.tMax[to] = kInfinityF, next.time[to] = rays.time[ray];
            next.sample[to] = rays.sample[ray], next.weight[to] = weight;
            next.medium[to] = crosses ? boundaries_[from.point[r]].after : rays.medium[ray];
            next.stream[to] = waves::streamOf(rays.stream[ray], from.branch[r]);
            next.seesLights[to] = PathLights::kSeesAsReflection;
            PathState& state = path_.nextStates[to];
            state.pdf = from.pdf[r];
            if (state.pdf > 0) state.p = SurfaceBlock::get(of.at->p, from.point[r]);
            if (context_.filtersTextures())
                state.cone =
                    waves::coneAfter(wave_, k, from.dir[r], from.pdf[r],
                                     crosses ? &boundaries_[from.point[r]] : nullptr);
            if (wave_.depth > 0) path_.order.push_back(orderOf(k, from.branch[r]));
            ++to;
        }
        next.shrink(to);
        sortRays(of, first);
    }

    // One for each ray of the next wave, and maybe more.
    void makeRoomForStates() {
        if (path_.nextStates.size() < memory_.next.org.size())
            path_.nextStates.resize(memory_.next.org.size());
    }

    std::span<LampQueue> lamps_; // those that are asked now

    // Rays of one sample have to come in the order of their points and branches, so that its sum
    // does not depend on what stands beside them in blocks.
    static std::uint32_t orderOf(std::size_t k, std::uint32_t branch) {
        return static_cast<std::uint32_t>(k << 5 | branch);
    }
    // Whether some of the points may be of one sample.
    static bool mayShareSamples(const PointBatch& points, const AlikePoints& of) {
        std::uint64_t seen = 0;
        for (std::size_t i = 0; i < of.size; ++i)
            seen |= std::uint64_t{1} << (points.slot[of.number[i]] & 63);
        return static_cast<std::size_t>(std::popcount(seen)) < of.size;
    }
    // Brings the rays of some points, those from `first` on, into that order.
    void sortRays(const AlikePoints& of, std::size_t first) {
        std::vector<std::uint32_t>& order = path_.order;
        PathBatch& next = memory_.next;
        if (order.empty()) return;
        if (!std::is_sorted(order.begin(), order.end()) && mayShareSamples(memory_.points, of)) {
            std::uint16_t from[BounceQueue::kMost];
            for (std::size_t i = 0; i < order.size(); ++i) from[i] = static_cast<std::uint16_t>(i);
            std::sort(from, from + order.size(),
                      [&](std::size_t x, std::size_t y) { return order[x] < order[y]; });
            path_.sorted.clear(), path_.sortedStates.clear();
            for (std::size_t r = 0; r < order.size(); ++r) {
                const std::size_t i = first + from[r];
                path_.sorted.push(next.ray(i), next.sample[i], next.weight[i], next.medium[i],
                                  next.stream[i], next.seesLights[i]);
                path_.sortedStates.push_back(path_.nextStates[i]);
            }
            next.shrink(first);
            for (std::size_t r = 0; r < order.size(); ++r) {
                const PathBatch& s = path_.sorted;
                next.push(s.ray(r), s.sample[r], s.weight[r], s.medium[r], s.stream[r],
                          s.seesLights[r]);
                path_.nextStates[first + r] = path_.sortedStates[r];
            }
        }
        order.clear();
    }
};

} // namespace

void integrateWhitted(const IntegratorContext& context, SampleChunk& chunk, WaveMemory& memory,
                      RayCounts& counts, std::uint64_t& cameraHits) {
    integrateInWaves<WhittedWave>(context, chunk, memory, counts, cameraHits);
}
