// What W rays have in common that start close together and go nearly the same way: a line through
// their middle, and how far they are from it. All of them have the same dominant axis and sign, so
// that a depth is a plane for all: interval arithmetic along that axis (Reshetov, Soupikov and
// Hurley 2005; Boulos, Wald and Shirley 2006). What is said is conservative. A triangle that
// canonicalKey() accepts is met by the ray's line within 4 units of rounding of the space's size on
// either axis (see RaySetup), its key is that of a depth no nearer than where the ray enters its
// box padded by 32 of them, and a beam is 256 units wider and longer than its rays. Of these 32 are
// lost to rounding: where rays are at the start is off by 7 of them at most, and at the far plane
// by 7 more; the line there, which its slope takes part in, by 15. Others are for where the line
// meets the triangle: a ray whose hit is between its start and its end may do so beside them, by
// 181 units where its plane is not edge-on to it (TrianglePlane::kSteep), in which a ray and the
// borders of the beam go 204 apart. Of planes that are, the triangle is within 11 units of the ray
// at the hit's own depth.
#pragma once

#include "accel/kernels/ray_lanes.h"
#include "accel/kernels/wide_tree.h"
#include "accel/ray_setup.h"
#include "base/math.h"
#include "simd/lanes.h"

#include <bit>
#include <cmath>
#include <cstddef>

LANES_BEGIN

class BeamShape {
public:
    std::size_t k, kx, ky; // RaySetup's
    unsigned rays = 0;     // that have the axis and sign of the first one of `lanes`

    // False, and nothing else, for rays that go apart.
    bool set(const RayColumns& c, const RayAxes& axes, unsigned lanes, Floats zCut, float extent) {
        chooseRays(axes, lanes);
        if (std::popcount(rays) < kFewestRays) return false;
        const Mask on = maskOf(rays);
        const auto least = [&](Floats v) { return smallest(select(on, v, Floats(kInfinityF))); };
        const auto most = [&](Floats v) { return largest(select(on, v, Floats(-kInfinityF))); };
        if (most(axes.Sx) - least(axes.Sx) > kWidest || most(axes.Sy) - least(axes.Sy) > kWidest)
            return false;
        room_ = 8 * most(axes.errorIn(extent));
        const Floats depth = c.org[k] * Floats(sign_);
        start_ = least(depth);
        late_ = depth - Floats(start_);
        endAt(zCut);
        // Between two planes the rays are no farther from a line than the chord of how far they are
        // from it there, for that distance is a convex function of the depth.
        const float last = ::max(::min(extent - start_, end_), room_) * 1.001f;
        const auto sides = [&](Floats origin, Floats S) {
            const Floats first = origin - S * late_, second = first + S * Floats(last);
            const float lo = least(first), hi = most(first);
            const float lo2 = least(second), hi2 = most(second);
            const float half = 0.5f * (hi - lo), half2 = 0.5f * (hi2 - lo2);
            return Side(0.5f * (lo + hi), (0.5f * (lo2 + hi2) - 0.5f * (lo + hi)) / last,
                        half * 1.000001f + room_, ::max(0.0f, (half2 - half) / last) * 1.000001f);
        };
        x_ = sides(c.org[kx], axes.Sx), y_ = sides(c.org[ky], axes.Sy);
        return true;
    }

    // Nothing behind these depths matters to the rays.
    void endAt(Floats zCut) {
        const Floats end = select(maskOf(rays), late_ + zCut, Floats(-kInfinityF));
        end_ = (largest(end) + room_) * 1.000001f;
    }
    float end() const { return end_; }

    // Children that rays may enter, and how deep behind the first start.
    struct Children {
        Mask any;
        Floats entry;
    };
    [[gnu::always_inline]] Children entered(const WideNode<W>& node) const {
        const int back = sign_ < 0 ? 1 : 0;
        const Floats s(sign_), first(start_);
        const Floats zNear = fms(Floats::load(node.plane[k][back]), s, first);
        const Floats zFar = fms(Floats::load(node.plane[k][1 - back]), s, first);
        Floats entry = max(zNear, Floats(0.0f)), exit = min(zFar, Floats(end_));
        const auto cut = [&](const Side& side, const float(&plane)[2][W]) {
            const Floats room = fma(zFar, Floats(side.growthInZ), Floats(side.halfInZ));
            const Floats r(side.r), at(side.offset);
            entry = max(fma(Floats::load(plane[side.back]), r, at) - room, entry);
            exit = min(fma(Floats::load(plane[1 - side.back]), r, at) + room, exit);
        };
        cut(x_, node.plane[kx]), cut(y_, node.plane[ky]);
        return {entry <= exit, entry};
    }

    // Triangles of the leaf that rays may meet: their corners are not all on one side of the beam.
    [[gnu::always_inline]] unsigned near(const WideLeaf<W>& leaf) const {
        const Ints corner[3] = {Ints::bytes(leaf.corner[0]), Ints::bytes(leaf.corner[1]),
                                Ints::bytes(leaf.corner[2])};
        const Floats z = fms(Floats::load(leaf.point[k]), Floats(sign_), Floats(start_));
        const auto overlaps = [&](const Side& side, const float* point) {
            const Floats v = fnma(z, Floats(side.slope), Floats::load(point) - Floats(side.middle));
            const Floats room = fma(z, Floats(side.growth), Floats(side.half)), zero(0.0f);
            const Floats lo = v - room, hi = v + room;
            const auto at = [&](Floats values, int c) { return permute(values, corner[c]); };
            return (min(min(at(lo, 0), at(lo, 1)), at(lo, 2)) <= zero) &
                   (zero <= max(max(at(hi, 0), at(hi, 1)), at(hi, 2)));
        };
        return bits(overlaps(x_, leaf.point[kx]) & overlaps(y_, leaf.point[ky])) &
               ((1u << leaf.count) - 1);
    }

private:
    // Bounced rays seldom pass these; beams of what goes farther apart than that would not pay.
    static constexpr int kFewestRays = W / 2;
    static constexpr float kWidest = 0.75f; // range of slopes

    // On one lateral axis.
    struct Side {
        float middle, slope; // the line, at the start
        float half, growth;  // how far the rays are from it: at the start, and more per depth
        // Slabs of boxes, in depths: RaySetup's for the line, and the room around it.
        float r, offset, halfInZ, growthInZ;
        int back; // is the upper plane the near one?

        Side() = default;
        Side(float at, float S, float width, float perDepth)
            : middle(at), slope(S), half(width), growth(perDepth),
              r(1 / std::copysign(::max(std::fabs(S), RaySetup::kSmallestSlope), S)),
              offset(-at * r), halfInZ(width * std::fabs(r)), growthInZ(perDepth * std::fabs(r)),
              back(r < 0 ? 1 : 0) {}
    };

    void chooseRays(const RayAxes& axes, unsigned lanes) {
        const unsigned alongZ = bits(axes.alongZ), alongY = bits(axes.alongY) & ~alongZ,
                       negative = bits(axes.sign < Floats(0.0f));
        const int first = std::countr_zero(lanes);
        const auto has = [&](unsigned flags) { return (flags >> first & 1) != 0; };
        const auto alike = [&](unsigned flags) { return has(flags) ? flags : ~flags; };
        rays = lanes & alike(alongZ) & alike(alongY) & alike(negative);
        k = has(alongZ) ? 2 : has(alongY) ? 1 : 0;
        kx = (k + 1) % 3, ky = (k + 2) % 3;
        sign_ = has(negative) ? -1.0f : 1.0f;
    }

    float sign_, room_;
    float start_, end_; // depths: where the first ray starts, and the last one ends after that
    Floats late_;       // how much later each ray starts
    Side x_, y_;
};

LANES_END
