// Cylinders and cones: where all rays of a packet meet one, with the bits of shape/cylinder.cpp and
// shape/cone.cpp, and which side of it they see.
#pragma once

#include "simd/double_double_lanes.h"
#include "accel/kernels/ray_lanes.h"
#include "accel/kernels/solids.h"
#include "accel/kernels/solids_facets.h"
#include "accel/kernels/solids_objects.h"
#include "simd/lanes.h"

#include <limits>

LANES_BEGIN

// Tubes of one form.
template <class Map> struct Tubes {
    bool caps, isCone;
    unsigned front, back; // lanes that meet only that side
    Map map;
    Doubles radius, slope, narrowZ, wallStretch, endStretch; // see StillTube, SolidTree::Tube
};
template <class Map> Tubes<Map> sameTube(const SolidTree::Tube& tube, const Map& map) {
    const StillTube& t = tube.exact;
    const StillTube::Cone cone = t.cone.value_or(StillTube::Cone{});
    return {t.caps,
            t.cone.has_value(),
            t.side == ::Facets::Side::Front ? ~0u : 0,
            t.side == ::Facets::Side::Back ? ~0u : 0,
            map,
            t.radius,
            cone.slope,
            cone.narrowZ,
            tube.wallStretch,
            tube.endStretch};
}

class PacketTubes : public PacketFacets {
protected:
    using PacketFacets::PacketFacets, PacketFacets::meet, PacketFacets::seesSide;

    // Where they are inside of its wall, which has no end.
    struct WallRange {
        Doubles enter, exit;
        unsigned met, undecided; // lanes; the others miss it
    };
    struct TubeRoots {
        ObjectRays rays;
        Floats t[2], lost[2]; // ascending; lost: by rounding, as in Hit::u
        unsigned met[2];      // lanes
        unsigned end[2];      // lanes that meet an end there, not the wall
        unsigned ahead;       // lanes along the axis
        unsigned undecided;
    };

    // AnalyticShape::rootsOf() with Cylinder::roots() or Cone::roots(), operation by operation.
    template <class Map>
    [[gnu::always_inline]] static TubeRoots meet(const RayColumns& columns,
                                                 const Tubes<Map>& tube) {
        const ObjectRays rays = objectRays(columns, tube.map, true);
        const auto& [ox, oy, oz, dx, dy, dz] = rays;
        const Doubles zero(0.0), one(1.0), most(std::numeric_limits<double>::max());
        WallRange wall = tube.isCone ? inCone(rays, tube.radius, tube.slope, tube.narrowZ)
                                     : inCylinder(rays, tube.radius);
        wall.met &= atMost((dx * dx + dy * dy) + dz * dz, most) &
                    atMost((ox * ox + oy * oy) + oz * oz, most);
        TubeRoots out{rays, {}, {}, {wall.met, wall.met}, {0, 0}, 0, wall.undecided};
        if (tube.caps) {
            out.ahead = ~atMost(dz, zero);
            out.undecided |= ~out.ahead & atMost(zero, dz);
            const Doubles low = (Doubles(-1.0) - oz) / dz, high = (one - oz) / dz;
            const Doubles in = min(low, high), beyond = max(low, high);
            // A cylinder's rim is of its end, that of a cone of its wall.
            out.end[0] = tube.isCone ? ~atMost(in, wall.enter) : atMost(wall.enter, in);
            out.end[1] = tube.isCone ? ~atMost(wall.exit, beyond) : atMost(beyond, wall.exit);
            wall.enter = max(wall.enter, in), wall.exit = min(wall.exit, beyond);
            out.met[0] &= atMost(wall.enter, wall.exit), out.met[1] = out.met[0];
        } else {
            const auto isWithin = [&](const Doubles& t) {
                const Doubles z = rays.oz + rays.dz * t;
                return atMost(z, one) & atMost(Doubles(-1.0), z);
            };
            out.met[0] &= isWithin(wall.enter), out.met[1] &= isWithin(wall.exit);
        }
        out.t[0] = wall.enter.toFloats(), out.t[1] = wall.exit.toFloats();
        out.lost[0] = (wall.enter - Doubles(out.t[0])).toFloats();
        out.lost[1] = (wall.exit - Doubles(out.t[1])).toFloats();
        return out;
    }

    // What is met first. Who can't be sure to see the wanted side is undecided.
    template <class Map>
    [[gnu::always_inline]] static FoundLanes firstOf(const RayColumns& columns,
                                                     const Tubes<Map>& tube, const TubeRoots& roots,
                                                     const RayRanges& ranges, unsigned lanes) {
        const unsigned first = roots.met[0] & bits(roots.t[0] > ranges.tMin);
        const Mask isFirst = maskOf(first);
        FoundLanes found{.t = select(isFirst, roots.t[0], roots.t[1]),
                         .lost = select(isFirst, roots.lost[0], roots.lost[1]),
                         .undecided = roots.undecided};
        found.met = (first | roots.met[1]) & ranges.hits(found.t);
        const unsigned ends = (first & roots.end[0]) | (~first & roots.end[1]);
        const unsigned bottom = ~(first ^ roots.ahead);
        static_assert(StillTube::Wall == 0 && StillTube::Bottom == 1 && StillTube::Top == 2);
        found.part[0] = ends & bottom, found.part[1] = ends & ~bottom;
        lanes &= found.met & (tube.front | tube.back);
        if (lanes != 0)
            found.undecided |=
                lanes & ~seesSide(columns, tube, roots, ends, first, found.t, found.lost);
        return found;
    }
    static unsigned hides(const TubeRoots& roots, const RayRanges& ranges) {
        return (roots.met[0] & ranges.hides(roots.t[0])) |
               (roots.met[1] & ranges.hides(roots.t[1]));
    }

    // Lanes that see the wanted side for certain, of what they meet at (t, lost), which is their
    // first root or the other one: AnalyticShape::seesFront() with twice its threshold. Maps take
    // normals one way and directions the other, so that their product is the same in both spaces.
    template <class Map>
    [[gnu::always_inline]] static unsigned
    seesSide(const RayColumns& columns, const Tubes<Map>& tube, const TubeRoots& roots,
             unsigned ends, unsigned first, Floats t, Floats lost) {
        const auto& [ox, oy, oz, dx, dy, dz] = roots.rays;
        const Doubles zero(0.0), at = Doubles(t) + Doubles(lost);
        const Doubles x = ox + dx * at, y = oy + dy * at;
        const Doubles X(columns.dir[0]), Y(columns.dir[1]), Z(columns.dir[2]);
        const Doubles least = Doubles(0x1p-19) * ((X * X + Y * Y) + Z * Z);
        Doubles facing = x * dx + y * dy, nn = x * x + y * y;
        unsigned end = ~atMost(dz * dz, least * tube.endStretch);
        if (tube.isCone) {
            const Doubles z = (Doubles(-0.0) - tube.slope) * sqrt(nn);
            facing = facing + z * dz, nn = nn + z * z;
            end &= less(zero, tube.radius); // a tip is no end
        }
        const unsigned wall = ~atMost(facing * facing, least * (tube.wallStretch * nn));
        const unsigned entering = ~atMost(zero, facing), leaving = ~atMost(facing, zero);
        return (ends & end & ((tube.front & first) | (tube.back & ~first))) |
               (~ends & wall & ((tube.front & entering) | (tube.back & leaving)));
    }

private:
    // -0.0 - x is -x to the last bit, zeros included: the sign of b may choose between two roots.

    // Cylinder::insideTube().
    static WallRange inCylinder(const ObjectRays& rays, const Doubles& radius) {
        const Doubles &ox = rays.ox, &oy = rays.oy, &dx = rays.dx, &dy = rays.dy;
        const Doubles zero(0.0), minus(-0.0);
        const Doubles dd = dx * dx + dy * dy, od = ox * dx + oy * dy;
        const Doubles along = od / dd;
        const Doubles px = ox - dx * along, py = oy - dy * along;
        const Doubles ll = px * px + py * py, rr = radius * radius;
        const Doubles middle = minus - along, half = sqrt((rr - ll) / dd);
        return {middle - half, middle + half, less(zero, radius) & atMost(ll, rr),
                atMost(dd, zero)};
    }

    // Cone::insideSide(), but for lines that are no steeper than the side: a > 0.
    static WallRange inCone(const ObjectRays& rays, const Doubles& narrowRadius,
                            const Doubles& slope, const Doubles& narrowZ) {
        const auto& [ox, oy, oz, dx, dy, dz] = rays;
        const Doubles zero(0.0), minus(-0.0), most(std::numeric_limits<double>::max());
        const Doubles oTip = oz - narrowZ;
        const Doubles shift =
            minus - ((ox * dx + oy * dy) + oTip * dz) / ((dx * dx + dy * dy) + dz * dz);
        const Doubles x = ox + dx * shift, y = oy + dy * shift, z = oTip + dz * shift;
        const Doubles w = narrowRadius + slope * z, dw = slope * dz;
        const Doubles a = (dx * dx + dy * dy) - dw * dw, b = (x * dx + y * dy) - w * dw,
                      c = (x * x + y * y) - w * w;
        const Doubles discriminant = differenceOfProducts(b, b, a, c);
        const Doubles q = minus - (b + withSign(sqrt(max(discriminant, zero)), b));
        const Doubles stable = c / q, other = q / a;
        const unsigned isRoot =
            ~(atMost(q, zero) & atMost(zero, q)) & atMost(q, most) & atMost(minus - most, q);
        const unsigned isShallow = ~atMost(a, zero) & atMost(a, most);
        return {shift + min(stable, other), shift + max(stable, other), atMost(zero, discriminant),
                ~(isShallow & (isRoot | ~atMost(zero, discriminant)))};
    }

    // As in base/math.h and base/double_double.h.
    static Doubles differenceOfProducts(const Doubles& a, const Doubles& b, const Doubles& c,
                                        const Doubles& d) {
        const DoublePairs ab = twoProduct(a, b), cd = twoProduct(c, d);
        const Doubles minus(-0.0);
        const DoublePairs hi = twoSum(ab.hi, minus - cd.hi), lo = twoSum(ab.lo, minus - cd.lo);
        const DoublePairs sum = twoSum(hi.hi, lo.hi);
        return sum.hi + (sum.lo + (hi.lo + lo.lo));
    }
};

LANES_END
