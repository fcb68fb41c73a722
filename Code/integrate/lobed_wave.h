// LobedWave: what integrators over lobes share: the points of a wave of rays, and the lobes of points
// that are alike.
#pragma once

#include "integrate/integrator.h"
#include "integrate/lit_wave.h"
#include "integrate/path_numbers.h"

#include <algorithm>
#include <bit>
#include <span>
#include <utility>

class LobedWave : protected LitWave {
public:
    using LitWave::LitWave;

protected:
    void findPoints() {
        waves::findPoints(
            wave_,
            [&] {
                if (!context_.checkers.empty()) waves::mixCheckers(wave_);
            },
            [&](std::size_t b) { return pointsWith(LobedMaterial::kLitOutside, b); });
        if (wave_.depth == 0 && context_.wantsFirstHits) describeFirstHits(wave_);
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
        const bool isFiltered =
            painted != 0 && context_.filtersTextures() &&
            waves::findFootprints(wave_, at, of.number, painted, footprints_);
        while (painted != 0) {
            const std::uint32_t one = at.material[std::countr_zero(painted)];
            unsigned points = 0;
            for (unsigned rest = painted; rest != 0; rest &= rest - 1) {
                const int i = std::countr_zero(rest);
                points |= unsigned{at.material[i] == one} << i;
            }
            lobes.paint(materials_, materials_[one], points, at, context_.pictures,
                        isFiltered ? &footprints_ : nullptr);
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
    waves::Boundary boundaries_[kPoints];
    FootprintBlock footprints_;
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
