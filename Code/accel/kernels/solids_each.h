// A solid of its own for each lane of a register: all of one formula, met by any rays of the
// packet, with the bits of solids_meet.h.
#pragma once

#include "accel/kernels/ray_lanes.h"
#include "accel/kernels/solids.h"
#include "accel/kernels/solids_hulls.h"
#include "accel/kernels/solids_meet.h"
#include "accel/kernels/solids_objects.h"
#include "accel/kernels/solids_spheres.h"
#include "accel/kernels/solids_tubes.h"
#include "base/cpu.h"
#include "simd/lanes.h"

#include <bit>
#include <cstddef>
#include <cstdint>

LANES_BEGIN

class PacketEach : public PacketSolids {
protected:
    using PacketSolids::PacketSolids;

    // `solids`: places times 4, and anything below. Of a lane of the packet each, which may be
    // there several times.
    template <Answer A, class Result>
    [[gnu::noinline]] void meetEach(SolidTree::Meets formula, const std::uint32_t* solids,
                                    const std::uint8_t* lanes, unsigned on, Result* results) {
        const Ints lane = Ints::bytes(lanes);
        const auto at = [&](Floats x) { return permute(x, lane); };
        Floats entry;
        const float* box[W];
        for (int i = 0; i < W; ++i) box[i] = &tree_.boxes[solids[i] >> 2].lo.x;
        on &= enteringEach(box, lane, entry);
        if (on == 0) return;
        const RayColumns rays = permuted(columns_, lane);
        const RayRanges ranges{rays.tMin, at(best_)};
        const FoundLanes found = formula == SolidTree::Meets::Sphere
                                     ? findSpheres<A>(solids, rays, ranges, on)
                                     : findTubes<A>(formula, solids, rays, ranges, on);
        const Floats tEntry = entry / at(lanes_.dz);
        takeEach(solids, lanes, on, found, tEntry, ranges, results);
    }

    const SolidTree::Solid& solidOf(std::uint32_t ref) const { return tree_.solids[ref >> 2]; }

    static RayColumns permuted(const RayColumns& c, Ints lane) {
        const auto at = [&](Floats a) { return permute(a, lane); };
        return {{at(c.org[0]), at(c.org[1]), at(c.org[2])},
                {at(c.dir[0]), at(c.dir[1]), at(c.dir[2])},
                at(c.tMin),
                at(c.tMax),
                false};
    }

private:
    template <Answer A>
    FoundLanes findSpheres(const std::uint32_t* solids, const RayColumns& rays,
                           const RayRanges& ranges, unsigned on) const {
        alignas(64) double map[12][W], radius[W];
        bool turned = false;
        for (int i = 0; i < W; ++i) {
            const SolidTree::Solid& solid = solidOf(solids[i]);
            turned |= solid.turned;
            radius[i] = solid.shape->radius;
        }
        storeMaps(solids, map);
        const SphereRoots roots =
            PacketSpheres::meet(on, rays, MapLanes{map}, turned, Doubles::load(radius));
        if constexpr (A == Answer::Closest) return PacketSpheres::firstOf(roots, ranges);
        return {.t = Floats(0.0f), .lost = Floats(0.0f), .met = hides(roots, ranges)};
    }

    template <Answer A>
    FoundLanes findTubes(SolidTree::Meets formula, const std::uint32_t* solids,
                         const RayColumns& rays, const RayRanges& ranges, unsigned on) const {
        using enum SolidTree::Meets;
        alignas(64) double map[12][W], radius[W], slope[W] = {}, narrowZ[W] = {}, wallStretch[W],
                                                  endStretch[W];
        unsigned front = 0;
        for (int i = 0; i < W; ++i) {
            const SolidTree::Tube& tube = tree_.tubes[solidOf(solids[i]).part];
            const StillTube& exact = tube.exact;
            radius[i] = exact.radius;
            wallStretch[i] = tube.wallStretch, endStretch[i] = tube.endStretch;
            front |= unsigned{exact.side == ::Facets::Side::Front} << i;
            if (exact.cone) slope[i] = exact.cone->slope, narrowZ[i] = exact.cone->narrowZ;
        }
        storeMaps(solids, map);
        const Tubes<MapLanes> tubes{formula == CappedTube || formula == CappedCone,
                                    formula == Cone || formula == CappedCone,
                                    front,
                                    0,
                                    {map},
                                    Doubles::load(radius),
                                    Doubles::load(slope),
                                    Doubles::load(narrowZ),
                                    Doubles::load(wallStretch),
                                    Doubles::load(endStretch)};
        const TubeRoots roots = PacketTubes::meet(rays, tubes);
        if constexpr (A == Answer::Closest)
            return PacketTubes::firstOf(rays, tubes, roots, ranges, on);
        return {.t = Floats(0.0f),
                .lost = Floats(0.0f),
                .met = hides(roots, ranges),
                .undecided = roots.undecided};
    }

    void storeMaps(const std::uint32_t* solids, double (&map)[12][W]) const {
        const double* rows[W];
        for (int i = 0; i < W; ++i) rows[i] = solidOf(solids[i]).shape->objectFromWorld().data();
        for (std::size_t axis = 0; axis < 3; ++axis) {
            storeRows(rows, map + 4 * axis);
            for (const double*& from : rows) from += 4;
        }
    }

    // RayLanes::entering() for a box each, of which `row` is the start.
    unsigned enteringEach(const float* (&row)[W], Ints lane, Floats& entry) const {
        Floats a[4], b[4];
        loadRows(row, a);
        for (const float*& from : row) from += 2;
        loadRows(row, b);
        const Floats lo[3] = {a[0], a[1], a[2]}, hi[3] = {b[1], b[2], b[3]};
        Floats exit = permute(zCut_, lane);
        entry = Floats(0.0f);
        for (int axis = 0; axis < 3; ++axis) {
            const Floats r = permute(lanes_.r[axis], lane);
            const Mask back = r < Floats(0.0f);
            entry =
                max(select(back, hi[axis], lo[axis]) * r + permute(lanes_.nearOffset[axis], lane),
                    entry);
            exit = min(select(back, lo[axis], hi[axis]) * r + permute(lanes_.farOffset[axis], lane),
                       exit);
        }
        return bits(entry <= exit);
    }

    void takeEach(const std::uint32_t* solids, const std::uint8_t* lanes, unsigned on,
                  const FoundLanes& found, Floats tEntry, const RayRanges& ranges, Hit* hits) {
        const Floats nearest = max(tEntry, found.t);
        improveEach(solids, lanes, on & found.met & ~found.undecided & bits(nearest <= ranges.best),
                    nearest, found, hits);
        if (const unsigned asking = on & found.undecided; asking != 0) {
            alignas(64) float entry[W];
            tEntry.store(entry);
            askEach(solids, lanes, asking, entry, hits);
        }
    }
    // One after the other: several may be of one ray.
    [[gnu::always_inline]] void improveEach(const std::uint32_t* solids, const std::uint8_t* lanes,
                                            unsigned met, Floats nearest, const FoundLanes& found,
                                            Hit* hits) {
        if (met == 0) return;
        alignas(64) float t[W], lost[W], best[W];
        nearest.store(t), found.lost.store(lost), best_.store(best);
        bool improved = false;
        for (; met != 0; met &= met - 1) {
            const int i = std::countr_zero(met);
            const std::uint8_t lane = lanes[i];
            const std::uint32_t number = solidOf(solids[i]).number;
            if (!(t[i] < best[lane] || (t[i] == best[lane] && number < number_[lane]))) continue;
            hits[ray_[lane]] = {.t = t[i], .u = lost[i], .prim = found.partOf(i), .shape = number};
            best[lane] = t[i], number_[lane] = number;
            improved = true;
        }
        if (improved) limit(Floats::load(best));
    }
    void takeEach(const std::uint32_t* solids, const std::uint8_t* lanes, unsigned on,
                  const FoundLanes& found, Floats tEntry, const RayRanges&, std::uint8_t* hidden) {
        unsigned met = 0;
        for (unsigned rest = on & found.met & ~found.undecided; rest != 0; rest &= rest - 1) {
            const int i = std::countr_zero(rest);
            met |= 1u << lanes[i];
            asked_ = solids[i] >> 2;
        }
        if (met != 0) hide(met, hidden);
        if (const unsigned asking = on & found.undecided; asking != 0) {
            alignas(64) float entry[W];
            tEntry.store(entry);
            askEach(solids, lanes, asking, entry, hidden);
        }
    }

    template <class Result>
    [[gnu::noinline]] void askEach(const std::uint32_t* solids, const std::uint8_t* lanes,
                                   unsigned asking, const float* tEntry, Result* results) {
        for (; asking != 0; asking &= asking - 1) {
            const int i = std::countr_zero(asking);
            asked_ = solids[i] >> 2;
            askFor(solidOf(solids[i]), lanes[i], tEntry[i], results);
        }
    }
};

LANES_END
