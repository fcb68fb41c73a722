// Rays that the mirrors and the glass of a block of points, sharp or rough, send on, made by lanes.
#pragma once

#include "render/waves/points.h"
#include "render/waves/single_bounces.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <span>

namespace waves {

// Rays that lanes have made, in wave.memory.next; what they are inside of and which samples they
// belong to is still to be said, and which of them don't see lamps.
struct SentRays {
    LeavingRays out;
    std::size_t first;
};
template <class MakeFn> SentRays sendFrom(const Wave& wave, const MakeFn& make) {
    PathBatch& next = wave.memory.next;
    // Lanes write whole registers.
    SentRays sent{.out = {}, .first = next.extend(3 * PointColumns::kPoints)};
    const std::size_t first = sent.first;
    make(RayPlaces{&next.org[first], &next.dir[first], nullptr, &next.weight[first]}, sent.out);
    const auto [reflected, refracted] = std::pair(sent.out.reflected, sent.out.refracted);
    const std::size_t rays = reflected + refracted;
    wave.counts.reflect += reflected, wave.counts.refract += refracted;
    next.shrink(first + rays);
    next.beEndless();
    std::fill_n(next.seesLights.data() + first, rays, PathBatch::kSeesAsReflection);
    return sent;
}

// The points of a block that mirror or refract, by what they have in common. Nothing if there are
// some that lanes don't do.
class BouncingBlock {
public:
    BouncingBlock(const Wave& wave, std::size_t b)
        : wave_(wave), block_(wave.memory.points.at.block(b)), first_(b * PointColumns::kPoints),
          rays_(&wave.memory.points.ray[first_]),
          media_(wave.rays.medium, rays_, wave.memory.points.sizeOf(b)) {
        std::array<std::uint16_t, PointColumns::kPoints> alike;
        const std::size_t sets = wave.context.bounceLanes.divide(
            block_, media_.data(), wave.memory.points.usedOf(b), alike.data());
        for (std::size_t i = 0; i < sets && areForLanes_; ++i) areForLanes_ = add(alike[i]);
    }
    bool areForLanes() const { return areForLanes_; }

    void send() const {
        if (count_ == 0) return;
        BouncePairs pairs;
        if (rough_ != 0) fill(pairs);
        const SentRays sent = sendFrom(wave_, [&](const RayPlaces& to, LeavingRays& out) {
            wave_.context.bounceLanes.bounce(
                block_, &wave_.memory.points.weight[first_], std::span(alike_).first(count_),
                rough_ != 0 ? &pairs : nullptr, wave_.context.cutoff, to, out);
        });
        describe(sent.out, sent.first);
    }

private:
    bool add(unsigned points) {
        const std::size_t k = first_ + static_cast<std::size_t>(std::countr_zero(points));
        const SceneMaterial& of = wave_.memory.points.at.of(k);
        const Material& material = of.base;
        if (of.isLamp || (isBlack(material.mirror) && isBlack(material.transmission))) return true;
        AlikePoints& some = alike_[count_++];
        some = {points, &material};
        if (material.roughness > 0) {
            if (wave_.context.pairSeeds == nullptr) return false;
            addRough(points);
        }
        if (isBlack(material.transmission) && material.fresnel != FresnelModel::Dielectric)
            return true;
        const Boundary boundary = boundaryAt(wave_, k);
        some.eta = boundary.eta, some.beyond = boundary.after;
        return true;
    }
    void addRough(unsigned points) {
        rough_ |= points;
        for (; points != 0; points &= points - 1) { // textures differ from point to point
            const auto i = static_cast<std::size_t>(std::countr_zero(points));
            if (!showsLamps(*wave_.memory.points.material[first_ + i])) withoutLamps_ |= 1u << i;
        }
    }

    // What the random numbers of rough points are made of.
    void fill(BouncePairs& pairs) const {
        constexpr std::size_t kPoints = PointColumns::kPoints;
        std::array<std::uint32_t, kPoints> streams{};
        const std::size_t size = wave_.memory.points.sizeOf(first_ / kPoints);
        for (std::size_t i = 0; i < size; ++i) {
            streams[i] = wave_.rays.stream[rays_[i]];
            pairs.sample[i] = wave_.chunk.sampleNumber[wave_.memory.points.slot[first_ + i]];
        }
        wave_.context.pairSeeds(wave_.context.sampler.seed(),
                                dimension(wave_.depth, BounceSlot::BsdfUv), streams,
                                {pairs.index, pairs.x, pairs.y});
    }

    // The rest of the rays.
    void describe(const LeavingRays& out, std::size_t first) const {
        PathBatch& next = wave_.memory.next;
        const auto row = [&](auto& column) { return column.data() + first; };
        std::uint32_t *const sample = row(next.sample), *const stream = row(next.stream);
        MediumTree::Inside* const inside = row(next.medium);
        float* const time = row(next.time);
        const std::uint32_t *const slots = &wave_.memory.points.slot[first_],
                                   *const streams = wave_.rays.stream.data(),
                                   *const before = media_.data();
        const float* const times = wave_.rays.time.data();
        Branch branch;
        std::size_t to = 0;
        // Two bits for each point.
        for (std::uint32_t rest = out.rays; rest != 0; rest &= rest - 1, ++to) {
            const auto bit = static_cast<std::size_t>(std::countr_zero(rest));
            const std::size_t i = bit / 2, which = bit % 2;
            sample[to] = slots[i], time[to] = times[rays_[i]];
            inside[to] = which == 0 ? before[i] : out.beyond[i];
            if ((withoutLamps_ >> i & 1) != 0) next.seesLights[first + to] = 0;
            if (!wave_.context.steps.draws) continue;
            branch.follow(streams[rays_[i]]);
            stream[to] = branch.streams[which];
        }
    }

    // Random numbers of both rays; most points follow one of the same pixel.
    struct Branch {
        std::uint32_t from = 0, streams[2] = {streamOf(0, kReflected), streamOf(0, kRefracted)};
        void follow(std::uint32_t stream) {
            if (stream == from) return;
            from = stream;
            streams[0] = streamOf(stream, kReflected), streams[1] = streamOf(stream, kRefracted);
        }
    };

    const Wave& wave_;
    const PointBlock& block_;
    std::size_t first_;
    const std::uint32_t* rays_; // of the points
    RowOfRays<MediumTree::Inside> media_;
    bool areForLanes_ = true;
    unsigned rough_ = 0;        // points; of these
    unsigned withoutLamps_ = 0; // those whose rays don't see lamps' bodies: see showsLamps()
    std::size_t count_ = 0;
    std::array<AlikePoints, PointColumns::kPoints> alike_;
};

} // namespace waves
