// Where the points of a block are on the map of a lamp, and how far along their lists, W at a time.
#pragma once

#include "base/vec.h"
#include "render/lamp_map/lamp_map.h"
#include "render/occluders.h"
#include "render/waves/lamp_lanes.h"
#include "simd/lanes.h"

#include <cstddef>
#include <cstdint>

LANES_BEGIN

// W points of a block, seen from the lamp.
class LanesOnMap {
public:
    LanesOnMap(const LampMap& map, const LitBlock& block, const LitByLamp& by, std::size_t first,
               unsigned lanes)
        : map_(map), block_(block), first_(first), slack_(map.slack) {
        for (std::size_t axis = 0; axis < 3; ++axis)
            dir_[axis] = Floats::load(by.dir[axis] + first);
        tMax_ = Floats::load(by.tMax + first);
        length2_ = fma(dir_[0], dir_[0], fma(dir_[1], dir_[1], dir_[2] * dir_[2]));
        length_ = sqrt(length2_);
        unsure_ = lanes & ~sane();
        live_ = lanes & ~unsure_;
        unsure_ |= besideOthers(live_);
        findCells();
        findReach();
    }

    unsigned unsure() const { return unsure_; }
    unsigned onMap() const { return live_; } // that have a list there
    std::uint32_t cell(int lane) const {
        const auto column = static_cast<std::uint32_t>(column_[lane]);
        const auto row = static_cast<std::uint32_t>(row_[lane]);
        return column | row << map_.logCells;
    }
    // Beyond the last step all entries are, behind NaN none: the first entry that is too far.
    std::uint32_t reach(int lane) const {
        constexpr auto kMost = static_cast<float>((1u << (32 - LampMap::kHullBits)) - 2);
        return steps_[lane] < kMost ? static_cast<std::uint32_t>(steps_[lane]) << LampMap::kHullBits
                                    : ~0u;
    }

private:
    // Neither empty, nor without end, nor of NaN.
    unsigned sane() const {
        const Floats zero(0.0f), one(1.0f);
        return bits((length2_ > Floats(0x1p-80f)) & (length2_ < Floats(0x1p80f)) & (tMax_ > zero) &
                    (tMax_ <= one));
    }

    unsigned othersThan(std::uint32_t shape, bool hidesOutside, bool hidesInside) const {
        const unsigned inside = block_.inside >> first_;
        return ~bits(Ints::load(block_.shape + first_) == Ints(shape)) |
               (inside & (hidesInside ? ~0u : 0)) | (~inside & (hidesOutside ? ~0u : 0));
    }

    // Lanes that other shapes may hide.
    unsigned besideOthers(unsigned lanes) const {
        unsigned met = 0;
        for (const Occluder& other : map_.others) {
            const unsigned asked =
                lanes & ~met & othersThan(other.shape, other.hidesOutside, other.hidesInside);
            if (asked == 0) continue;
            Mask apart = maskOf(0);
            for (std::size_t axis = 0; axis < 3; ++axis) {
                const Floats lamp(map_.lamp[axis]), end = fma(dir_[axis], tMax_, lamp);
                apart = apart | (min(end, lamp) > Floats(other.box.hi[axis]) + slack_) |
                        (max(end, lamp) < Floats(other.box.lo[axis]) - slack_);
            }
            if (other.plane) {
                const Vec3 n = other.plane->n;
                const float lamp = dot(n, map_.lamp) + other.plane->offset;
                // The point may be far outside of the scene.
                const Floats room = fma(length_, Floats(0x1p-18f), slack_ + slack_);
                const Floats rise = fma(along(n), tMax_, Floats(lamp)), zero(0.0f);
                if (lamp > 2 * map_.slack) apart = apart | (rise > room);
                if (lamp < -2 * map_.slack) apart = apart | (rise < zero - room);
            }
            met |= asked & ~bits(apart);
        }
        return met;
    }

    Floats along(Vec3 axis) const {
        return fma(Floats(axis.x), dir_[0], fma(Floats(axis.y), dir_[1], Floats(axis.z) * dir_[2]));
    }

    // Who is not in the picture is taken away: nothing is there.
    void findCells() {
        const Floats depth = along(map_.ahead), zero(0.0f);
        live_ &= ~bits(depth <= Floats(LampMap::kLeastCosine) * length_);
        const Floats perDepth = Floats(1.0f) / depth, end(static_cast<float>(map_.cells()));
        const Floats x = fma(along(map_.right) * perDepth, Floats(map_.scale[0]),
                             Floats(map_.offset[0])),
                     y = fma(along(map_.up) * perDepth, Floats(map_.scale[1]),
                             Floats(map_.offset[1]));
        const unsigned isIn = bits((x >= zero) & (x < end) & (y >= zero) & (y < end));
        const unsigned isOut = bits(x < zero) | bits(x >= end) | bits(y < zero) | bits(y >= end);
        unsure_ |= live_ & ~isIn & ~isOut; // NaN
        live_ &= isIn;
        x.store(column_), y.store(row_);
    }

    void findReach() {
        const Floats reach = fma(tMax_, length_, slack_);
        const Floats step = (reach - Floats(map_.firstStep)) * Floats(map_.perStep);
        max(step + Floats(1.0f), Floats(0.0f)).store(steps_);
    }

    const LampMap& map_;
    const LitBlock& block_;
    std::size_t first_;
    Floats slack_, dir_[3], tMax_, length2_, length_;
    unsigned live_, unsure_;
    alignas(64) float column_[W], row_[W], steps_[W];
};

LANES_END
