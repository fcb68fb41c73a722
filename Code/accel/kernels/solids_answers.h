// What rays of a packet have met: the best hits, what hides them, and what only the shape itself
// can tell.
#pragma once

#include "accel/kernels/solids.h"
#include "accel/kernels/solids_objects.h"
#include "accel/kernels/solids_spheres.h"
#include "base/ray.h"
#include "simd/lanes.h"

#include <bit>
#include <cstdint>
#include <limits>

LANES_BEGIN

class PacketAnswers : public PacketSpheres {
protected:
    PacketAnswers(const SolidTree& tree, const SolidCalls& calls, const RaySpan& rays)
        : PacketSpheres(tree, rays), calls_(calls) {}

    RayRanges ranges() const { return {columns_.tMin, best_}; }

    void hide(unsigned lanes, std::uint8_t* hidden) {
        if (lanes != 0) lastHider_ = asked_;
        live_ &= ~lanes;
        for (; lanes != 0; lanes &= lanes - 1) hidden[ray_[std::countr_zero(lanes)]] = 1;
    }

    // Of one lane, that of the shape itself.
    void askFor(const SolidTree::Solid& solid, int lane, float tEntry, Hit* hits) {
        Hit& hit = hits[ray_[lane]];
        if (!calls_.nearer(calls_.set, rays_[ray_[lane]], solid.number, tEntry, hit)) return;
        alignas(64) float best[W];
        best_.store(best);
        best[lane] = hit.t, number_[lane] = hit.shape;
        limit(Floats::load(best));
    }
    void askFor(const SolidTree::Solid& solid, int lane, float, std::uint8_t* hidden) {
        if (calls_.hides(calls_.set, rays_[ray_[lane]], solid.number)) hide(1u << lane, hidden);
    }

    [[gnu::noinline]] void ask(const SolidTree::Solid& solid, Floats entry, unsigned lanes,
                               Hit* hits) {
        alignas(64) float z[W], dz[W], best[W];
        entry.store(z), lanes_.dz.store(dz), best_.store(best);
        bool improved = false;
        for (; lanes != 0; lanes &= lanes - 1) {
            const int i = std::countr_zero(lanes);
            Hit& hit = hits[ray_[i]];
            if (!calls_.nearer(calls_.set, rays_[ray_[i]], solid.number, z[i] / dz[i], hit))
                continue;
            best[i] = hit.t;
            number_[i] = hit.shape;
            improved = true;
        }
        if (improved) limit(Floats::load(best));
    }
    [[gnu::noinline]] void ask(const SolidTree::Solid& solid, Floats, unsigned lanes,
                               std::uint8_t* hidden) {
        for (; lanes != 0; lanes &= lanes - 1) {
            const int i = std::countr_zero(lanes);
            if (!calls_.hides(calls_.set, rays_[ray_[i]], solid.number)) continue;
            hide(1u << i, hidden);
        }
    }

    // The choice between hits and the best ones. Inlined, as lanes that are found would go through
    // memory: 2 to 4 % of pictures.
    [[gnu::always_inline]] void take(const SolidTree::Solid& solid, const FoundLanes& found,
                                     Floats entry, unsigned lanes, Hit* hits) {
        const Floats nearest = max(entry / lanes_.dz, found.t);
        const unsigned better = nearerLanes(solid, lanes & found.met & ~found.undecided, nearest);
        if (better != 0) {
            alignas(64) float ts[W], us[W];
            nearest.store(ts), found.lost.store(us);
            for (unsigned rest = better; rest != 0; rest &= rest - 1) {
                const int i = std::countr_zero(rest);
                hits[ray_[i]] = {
                    .t = ts[i], .u = us[i], .prim = found.partOf(i), .shape = solid.number};
                number_[i] = solid.number;
            }
            limit(select(maskOf(better), nearest, best_));
        }
        if (const unsigned asking = lanes & found.undecided; asking != 0)
            ask(solid, entry, asking, hits);
    }
    void take(const SolidTree::Solid& solid, const FoundLanes& found, Floats entry, unsigned lanes,
              std::uint8_t* hidden) {
        hide(lanes & found.met & ~found.undecided, hidden);
        if (const unsigned asking = lanes & found.undecided; asking != 0)
            ask(solid, entry, asking, hidden);
    }

    // Lanes whose new hit is the best one.
    unsigned nearerLanes(const SolidTree::Solid& solid, unsigned lanes, Floats nearest) const {
        const unsigned equal = lanes & bits(nearest == best_);
        return (lanes & bits(nearest < best_)) | lowerNumbers(equal, solid);
    }

    unsigned lowerNumbers(unsigned lanes, const SolidTree::Solid& solid) const {
        unsigned lower = 0;
        for (; lanes != 0; lanes &= lanes - 1) {
            const int i = std::countr_zero(lanes);
            if (solid.number < number_[i]) lower |= 1u << i;
        }
        return lower;
    }

    // Hides what comes next from the lamp, too, more often than not.
    std::uint32_t lastHider_ = std::numeric_limits<std::uint32_t>::max();
    std::uint32_t asked_ = 0; // place of the solid
    const SolidCalls& calls_;
};

LANES_END
