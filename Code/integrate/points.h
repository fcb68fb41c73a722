// Stage of the wave: hits -> points. Every surface that a ray has met is described once.
#pragma once

#include "base/cpu.h"
#include "integrate/shading_kernel.h"
#include "integrate/wave.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstring>
#include <type_traits>

namespace waves {

// Which rays have met something, and which nothing. Neighbours do alike more often than not.
inline void listHits(std::span<const Hit> hits, std::size_t rays, PointBatch& points) {
    constexpr std::size_t kTogether = 16;
    std::uint32_t *met = points.ray.data(), *missed = points.missed.data();
    for (std::size_t first = 0; first < rays; first += kTogether) {
        const std::size_t count = std::min(kTogether, rays - first);
        std::size_t found = 0;
        if (count == kTogether) {
#pragma GCC unroll 16
            for (std::size_t i = 0; i < kTogether; ++i) found += hits[first + i].isHit();
        }
        const auto number = static_cast<std::uint32_t>(first);
        if (count == kTogether && (found == 0 || found == kTogether)) {
            std::uint32_t*& to = found == 0 ? missed : met;
            for (std::uint32_t i = 0; i < kTogether; ++i) to[i] = number + i;
            to += kTogether;
            continue;
        }
        for (std::uint32_t i = number; i < first + count; ++i) {
            *met = *missed = i;
            met += hits[i].isHit(), missed += !hits[i].isHit();
        }
    }
    points.count = static_cast<std::size_t>(met - points.ray.data());
    points.missedCount = static_cast<std::size_t>(missed - points.missed.data());
}

// Of a block's points: the weights of their rays, and the samples that these belong to.
inline void takeSamples(const PathBatch& rays, std::size_t b, PointBatch& points) {
    constexpr std::size_t kPoints = PointColumns::kPoints;
    const std::size_t first = b * kPoints, size = points.sizeOf(b);
    const std::uint32_t *const ray = &points.ray[first], from = ray[0];
    Rgb* const weight = &points.weight[first];
    std::uint32_t* const slot = &points.slot[first];
    if (size == kPoints && ray[kPoints - 1] - from == kPoints - 1) {
        std::copy_n(&rays.weight[from], kPoints, weight);
        std::copy_n(&rays.sample[from], kPoints, slot);
        return;
    }
    for (std::size_t i = 0; i < size; ++i)
        weight[i] = rays.weight[ray[i]], slot[i] = rays.sample[ray[i]];
}

// Have all of these rays met the same part of one shape?
template <std::size_t kRays> bool haveMetOne(const Hit* hits, const std::uint32_t* rays) {
    const auto different = [&](std::size_t i) {
        const Hit &first = hits[rays[0]], &other = hits[rays[i]];
        return (other.shape ^ first.shape) | (other.prim ^ first.prim);
    };
    if (different(kRays - 1) != 0) return false; // most that haven't
    std::uint32_t any = 0;
    for (std::size_t i = 1; i < kRays - 1; ++i) any |= different(i);
    return any == 0;
}

// Puts points that lanes do into lists by kind, the others into one of their own. Thousands of
// shapes are more than the nearest caches hold, so each is asked for when it is listed.
inline void sortPoints(const Wave& wave) {
    const StillsInLanes& stills = wave.context.stillsInLanes;
    const Hit* const hits = wave.memory.hits.data();
    PointBatch& points = wave.memory.points;
    PointLists& lists = wave.memory.pointLists;
    lists.clear(points.at.size());
    const std::uint32_t *const rays = points.ray.data(),
                               count = static_cast<std::uint32_t>(points.count);
    const StillsInLanes::One* const all = stills.shapes.data();
    const bool hasStills = !stills.shapes.empty();
    struct Place {
        std::size_t list;
        const StillShape* shape;
    };
    const auto placeOf = [&](const Hit& hit) -> Place {
        const StillsInLanes::One still = hasStills ? all[hit.shape] : StillsInLanes::One{};
        if (still.shape == nullptr || (still.parts >> hit.prim & 1) == 0)
            return {PointLists::kOnOthers, nullptr};
        prefetch(*still.shape);
        return {PointLists::onStills(still.kindOf(hit.prim), still.wantsUv), still.shape};
    };
    constexpr std::uint32_t kTogether = 16;
    for (std::uint32_t first = 0; first < count; first += kTogether) {
        const std::uint32_t end = std::min(first + kTogether, count);
        if (end - first == kTogether && haveMetOne<kTogether>(hits, rays + first)) {
            const Hit& hit = hits[rays[first]];
            const Place place = placeOf(hit);
            lists.pushAlike(place.list, rays + first, first, kTogether, place.shape);
            continue;
        }
        for (std::uint32_t k = first; k < end; ++k) {
            if (hasStills && k + kTogether < count)
                __builtin_prefetch(&all[hits[rays[k + kTogether]].shape]);
            const Hit& hit = hits[rays[k]];
            const Place place = placeOf(hit);
            lists.push(place.list, rays[k], k, place.shape);
        }
    }
}

// All that are on still shapes with a formula together, the others by runs on one shape.
inline void findSurfaces(const Wave& wave) {
    const IntegratorContext& context = wave.context;
    const std::vector<Hit>& hits = wave.memory.hits;
    const PointLists& lists = wave.memory.pointLists;
    PointBatch& points = wave.memory.points;
    if (points.count == 0) return;
    sortPoints(wave);
    for (std::size_t b = 0; b < points.blocks(); ++b) points.at.block(b).clear();
    const SurfacePlaces out = points.at.surfaces();
    for (std::size_t k = 0; k < StillShape::kKinds; ++k)
        for (const bool wantsUv : {false, true}) {
            const auto kind = static_cast<StillShape::Kind>(k);
            const std::size_t list = PointLists::onStills(kind, wantsUv);
            if (!lists.rays(list).empty())
                context.surfaceLanes.stills({kind, wave.rays.span(), hits, lists.rays(list),
                                             lists.points(list), lists.shapes(list), wantsUv},
                                            out);
        }
    const std::span<const std::uint32_t> rays = lists.rays(PointLists::kOnOthers),
                                         to = lists.points(PointLists::kOnOthers);
    std::size_t end = 0;
    for (std::size_t begin = 0; begin < rays.size(); begin = end) {
        const std::uint32_t shape = hits[rays[begin]].shape;
        for (end = begin + 1; end < rays.size() && hits[rays[end]].shape == shape;) ++end;
        context.scene.shapes().shapes[shape]->surfaces(
            {wave.rays.span(), hits, rays.subspan(begin, end - begin),
             to.subspan(begin, end - begin), context.surfaceNeeds, context.surfaceLanes},
            out);
    }
}

// Numbers of rays that lanes want to find next to each other: the part of an array where they are,
// or a copy.
template <class T> class RowOfRays {
public:
    RowOfRays(const std::vector<T>& all, const std::uint32_t* rays, std::size_t count) {
        constexpr std::size_t kPoints = PointColumns::kPoints;
        row_ = &all[rays[0]];
        if (count == kPoints && rays[kPoints - 1] - rays[0] == kPoints - 1) return;
        for (std::size_t i = 0; i < kPoints; ++i)
            std::memcpy(copy_ + i * sizeof(T), &all[rays[i < count ? i : 0]], sizeof(T));
        row_ = reinterpret_cast<const T*>(copy_);
    }
    const T* data() const { return row_; }

private:
    static_assert(std::is_trivially_copyable_v<T>);
    const T* row_;
    alignas(T) std::byte copy_[PointColumns::kPoints * sizeof(T)]; // is not zeroed first
};

// Describes how the points of a block are seen.
inline void seeBlock(const Wave& wave, std::size_t b, unsigned litOutside) {
    const IntegratorContext& context = wave.context;
    const Scene& scene = context.scene;
    PointBatch& points = wave.memory.points;
    PointBlock& block = points.at.block(b);
    const std::size_t first = b * PointColumns::kPoints, size = points.sizeOf(b);
    unsigned bent = 0;
    for (std::size_t i = 0; scene.anyMaterial().pictures && i < size; ++i) {
        if (!scene.materials()[block.material[i]].bendsNormals()) continue;
        const std::uint32_t ray = points.ray[first + i];
        SurfaceBlock::set(
            block.n, i,
            shading::bentNormal(scene, wave.rays.ray(ray), wave.memory.hits[ray], block.at(i)));
        bent |= 1u << i;
    }
    const RowOfRays<Vec3> dirs(wave.rays.dir, &points.ray[first], size);
    unsigned away =
        context.settings.isa->shading->see(block, dirs.data(), points.usedOf(b), litOutside, bent);
    for (; away != 0; away &= away - 1) {
        const auto i = static_cast<std::size_t>(std::countr_zero(away));
        const ShadedPoint at = points.at[first + i];
        SurfaceBlock::set(block.n, i, shading::turnedAway(at.toEye, at.eye));
    }
}

// Finds all points of a wave. `mix()` may change materials of surfaces; `litOutside(b)`: those of
// block b whose materials are lit outside whichever side is seen.
template <class Mix, class LitOutside>
void findPoints(const Wave& wave, const Mix& mix, const LitOutside& litOutside) {
    PointBatch& points = wave.memory.points;
    points.clear(wave.rays.size());
    listHits(wave.memory.hits, wave.rays.size(), points);
    points.at.setMaterials(wave.context.scene.materials());
    findSurfaces(wave);
    mix();
    for (std::size_t b = 0; b < points.blocks(); ++b) {
        seeBlock(wave, b, litOutside(b));
        takeSamples(wave.rays, b, points);
    }
}

} // namespace waves
