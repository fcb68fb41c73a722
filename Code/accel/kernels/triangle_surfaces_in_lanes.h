// surfaceOf() of shape/mesh_surface.cpp at W hits.
#pragma once

#include "accel/kernels/still_surfaces_in_lanes.h"
#include "accel/kernels/surface_columns.h"
#include "accel/kernels/surface_lanes.h"
#include "simd/vectors3.h"
#include "simd/lanes.h"

#include <cstddef>

LANES_BEGIN

// The hits of a block from `first` on.
class TriangleLanes {
public:
    TriangleLanes(const TrianglesMet& met, std::size_t first)
        : met_(met), first_(first), v_{ofTriangle(met.corner[0]), ofTriangle(met.corner[1]),
                                       ofTriangle(met.corner[2])} {}

    // Returns the lanes that it does not know.
    unsigned describe(TriangleSurfaces& out) const {
        const Floats u = load(met_.u), v = load(met_.v);
        const Doubles3 weights{(Doubles(1.0) - Doubles(u)) - Doubles(v), Doubles(u), Doubles(v)};
        const Doubles3 sides[3] = {v_[2] - v_[1], v_[0] - v_[2], v_[1] - v_[0]};
        const Doubles3 across = cross(sides[2], v_[2] - v_[0]);
        const Doubles twiceArea = sqrt(dot(across, across));
        const Doubles error = Doubles(kTriangleError) * Doubles(largestCoordinate());

        const Doubles clearance = Doubles(kEdgeClearance) * error, zero(0.0);
        const Doubles far2 = (Doubles(1.01) * clearance) * clearance, area2 = twiceArea * twiceArea;
        const auto isFar = [&](const Doubles& weight, const Doubles3& side) {
            return (zero < weight) & (far2 * dot(side, side) < (weight * weight) * area2);
        };
        const unsigned known = bits(isFar(weights.x, sides[0]) & isFar(weights.y, sides[1]) &
                                    isFar(weights.z, sides[2]));

        const Floats3 p = Floats3::of((v_[0] * weights.x + v_[1] * weights.y) + v_[2] * weights.z);
        const Floats3 ng = Floats3::of(across / twiceArea);
        store(p, out.p), store(ng, out.ng);
        error.toFloats().store(out.error + first_);
        smooth(p, ng, weights, out);
        return ~known & met_.used >> first_ & kAll;
    }

private:
    static constexpr unsigned kAll = (1u << W) - 1;
    using Lane = TrianglesMet::Lane;
    Floats load(const Lane& lane) const { return Floats::load(lane + first_); }
    // A number of the triangle, or of each lane's.
    Floats ofTriangle(const Lane& lane) const { return met_.onOne ? Floats(lane[0]) : load(lane); }
    Doubles3 ofTriangle(const Lane (&v)[3]) const {
        return Doubles3::of(ofTriangle(v[0]), ofTriangle(v[1]), ofTriangle(v[2]));
    }
    void store(const Floats3& v, Lane (&to)[3]) const {
        v.x.store(to[0] + first_), v.y.store(to[1] + first_), v.z.store(to[2] + first_);
    }

    Floats largestCoordinate() const {
        Floats most(0.0f);
        for (const auto& corner : met_.corner)
            for (const Lane& axis : corner) most = max(most, abs(ofTriangle(axis)));
        return most;
    }

    // Interpolated normals and the lift to the curve that they pretend.
    void smooth(const Floats3& p, const Floats3& ng, const Doubles3& weights,
                TriangleSurfaces& out) const {
        const unsigned lanes = met_.smooth >> first_ & kAll;
        const Floats zero(0.0f);
        Floats3 ns = ng, lift{zero, zero, zero};
        if (lanes != 0) {
            const Mask has = maskOf(lanes);
            const Floats3 curved = interpolated(ng);
            const Mask takes = has & (dot(curved, ng) > zero);
            ns = select(takes, curved, ng);
            if (met_.wantsLift) lift = select(has, liftToCurve(p, ng, weights), lift);
        }
        store(ns, out.ns), store(lift, out.lift);
    }

    Floats3 interpolated(const Floats3& ng) const {
        const Floats u = load(met_.u), v = load(met_.v), w = (Floats(1.0f) - u) - v;
        const auto mix = [&](std::size_t axis) {
            return (ofTriangle(met_.normal[0][axis]) * w + ofTriangle(met_.normal[1][axis]) * u) +
                   ofTriangle(met_.normal[2][axis]) * v;
        };
        const Doubles3 ns = Doubles3::of(mix(0), mix(1), mix(2));
        const Doubles length2 = dot(ns, ns), zero(0.0);
        return select(zero < length2, Floats3::of(ns / sqrt(length2)), ng);
    }

    Floats3 liftToCurve(const Floats3& at, const Floats3& ng, const Doubles3& weights) const {
        const Floats3 dir{load(met_.dir[0]), load(met_.dir[1]), load(met_.dir[2])};
        const Doubles zero(0.0);
        const Doubles side = select(dot(ng, dir) <= Floats(0.0f), Doubles(1.0), Doubles(-1.0));
        const Doubles3 p = Doubles3::of(at.x, at.y, at.z);
        const Doubles weight[3] = {weights.x, weights.y, weights.z};
        Doubles3 lift{zero, zero, zero};
        for (std::size_t i = 0; i < 3; ++i) {
            const Doubles3 normal = ofTriangle(met_.normal[i]);
            const Doubles length2 = dot(normal, normal);
            const Doubles below = side * dot(p - v_[i], normal);
            const Mask lifts = (zero < length2) & (below < zero);
            lift = select(lifts, lift - normal * (((weight[i] * side) * below) / length2), lift);
        }
        return Floats3::of(lift);
    }

    const TrianglesMet& met_;
    std::size_t first_;
    Doubles3 v_[3];
};

void triangleSurfaces(const TrianglesMet& met, TriangleSurfaces& out) {
    out.unknown = 0;
    for (std::size_t first = 0; first < TrianglesMet::kHits; first += W)
        if ((met.used >> first) != 0)
            out.unknown |= TriangleLanes(met, first).describe(out) << first;
}

LANES_END
