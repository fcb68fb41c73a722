// Footprints of cones on surfaces, in lanes; footprintOn() is the one lane of it.
#pragma once

#include "simd/lanes.h"
#include "simd/vectors3.h"
#include "texture/picture_lanes.h"

#include <cstddef>

LANES_BEGIN

struct UvAxes {
    Floats u, v;
};
struct FootprintLanes {
    UvAxes along, across;
};

// Returns the texture coordinates of vectors along surfaces.
class UvOf {
public:
    UvOf(const Floats3& dpdu, const Floats3& dpdv)
        : dpdu_(Doubles3::of(dpdu.x, dpdu.y, dpdu.z)), dpdv_(Doubles3::of(dpdv.x, dpdv.y, dpdv.z)),
          n_(cross(dpdu_, dpdv_)), area2_(dot(n_, n_)) {}

    // isUsable: loses the lanes where nothing is to be seen of a picture.
    UvAxes operator()(const Doubles3& along, Mask& isUsable) const {
        constexpr double kMost = 1e6; // of uv
        const Doubles zero(0.0);
        const Mask isFlat = zero < area2_;
        const Doubles u = select(isFlat, dot(cross(along, dpdv_), n_) / area2_, zero),
                      v = select(isFlat, dot(cross(dpdu_, along), n_) / area2_, zero);
        isUsable = isUsable & (abs(u) < Doubles(kMost)) & (abs(v) < Doubles(kMost));
        return {u.toFloats(), v.toFloats()};
    }

private:
    Doubles3 dpdu_, dpdv_, n_;
    Doubles area2_;
};

inline FootprintLanes footprintsOn(Floats width, const Floats3& dir, const Floats3& n,
                                   const Floats3& dpdu, const Floats3& dpdv) {
    constexpr double kLeastCosine = 1.0 / 1024; // the length is no more than so many widths
    const Doubles w(width), zero(0.0), one(1.0);
    const Doubles3 normal = Doubles3::of(n.x, n.y, n.z), ray = Doubles3::of(dir.x, dir.y, dir.z);
    const Doubles cosine = dot(ray, normal);
    const Doubles3 level = ray - normal * cosine;
    const Doubles length2 = dot(level, level);
    const Mask isAskew = Doubles(1e-12) < length2;
    Doubles3 axis = level / sqrt(length2);
    if (bits(isAskew) != (1u << W) - 1) { // straight from above any axis will do
        const Mask isUpright = abs(normal.x) < Doubles(0.5);
        const Doubles3 side{select(isUpright, one, zero), select(isUpright, zero, one), zero};
        const Doubles3 any = cross(normal, side);
        axis = select(isAskew, axis, any / sqrt(dot(any, any)));
    }
    const UvOf uvOf(dpdu, dpdv);
    Mask isUsable = width > Floats(0.0f);
    const UvAxes along = uvOf(axis * (w / max(Doubles(kLeastCosine), abs(cosine))), isUsable),
                 across = uvOf(cross(normal, axis) * w, isUsable);
    const auto usable = [&](const UvAxes& of) -> UvAxes {
        return {select(isUsable, of.u, Floats(0.0f)), select(isUsable, of.v, Floats(0.0f))};
    };
    return {usable(along), usable(across)};
}

// The cones of W points of a block.
inline FootprintLanes footprintsOf(const FootprintBlock& block, std::size_t first) {
    const auto of = [&](const FootprintBlock::Lane(&v)[3]) -> Floats3 {
        return {Floats::load(v[0] + first), Floats::load(v[1] + first), Floats::load(v[2] + first)};
    };
    return footprintsOn(Floats::load(block.width + first), of(block.dir), of(block.normal),
                        of(block.dpdu), of(block.dpdv));
}

inline void findFootprints(FootprintBlock& block, std::size_t count) {
    for (std::size_t first = 0; first < count; first += W) {
        const FootprintLanes found = footprintsOf(block, first);
        found.along.u.store(block.along[0] + first), found.along.v.store(block.along[1] + first);
        found.across.u.store(block.across[0] + first);
        found.across.v.store(block.across[1] + first);
    }
}

LANES_END
