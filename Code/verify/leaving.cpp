// T5 and the acne of T6: a ray that leaves a surface by the error bound of its point does not meet
// that surface again on the side it left to. Truth is the shape: from outside of a convex body no
// ray into the half space of its tangent plane meets it, one to the inside always does.
#include "base/text.h"
#include "integrate/shading.h"
#include "verify/groups.h"
#include "verify/lamp_ray.h"
#include "verify/placed_solid.h"
#include "verify/shape_kinds.h"

namespace battery {

namespace {

using meshes::Random;

// A direction to the side of `n` (seen by the rounded numbers), often along the surface.
Vec3 leavingTo(Random& random, Vec3d n, double leastCosine) {
    for (;;) {
        Vec3d d = random.direction();
        if (random.chance(0.4)) {
            d = d - n * dot(d, n);
            if (length(d) < 0.01) continue;
            d = normalize(d) + n * random.logUniform(1e-9, 1e-2);
        }
        const Vec3 rounded = toFloat(d);
        if (dot(toDouble(rounded), n) > leastCosine) return rounded;
    }
}

// A plane without end is met again a long way off along its rounded normal.
double leastCosineFor(const kit::Kind& kind) { return kind.name == "infinite plane" ? 1e-6 : 0; }

// A shape of a kind somewhere: 1e-4 to 1e4 in size, at up to 1e4 from the origin.
struct PlacedKind {
    const kit::Kind& kind;
    Transform map;
    std::unique_ptr<Shape> shape;
    double size, sharpest; // points with a larger error have no float that is safely inside
};

PlacedKind placedKind(Random& random) {
    const kit::Kind& kind = kit::kinds()[random.below(kit::kinds().size())];
    const double size = random.logUniform(1e-4, 1e4);
    const Vec3d factors = kit::randomFactors(random, size);
    Vec3d offset;
    if (random.chance(0.7)) offset = random.inBox(random.logUniform(1e-4, 1e4));
    const Transform map = kit::placed(random, factors, offset);
    const Vec3d sides{std::fabs(factors.x), std::fabs(factors.y), std::fabs(factors.z)};
    const double thinnest = min(sides.x, min(sides.y, sides.z));
    // A hundredth of the thickness, or of the radius of curvature at the end of a needle.
    const double sharpest = 0.01 * thinnest * (kind.name == "cube" ? 1 : thinnest / maxAbs(sides));
    return {kind, map, kind.make(map), size, sharpest};
}

// Towards the object's box, its faces, a hair inside its rim or edges, and its tips; from close by
// or from up to 1e8 sizes away.
Ray rayAt(Random& random, const PlacedKind& at) {
    Vec3d target = random.inBox(1);
    const std::size_t axis = random.below(3);
    const double along = target[axis];
    if (random.chance(0.5)) target[axis] = target[axis] < 0 ? -1 : 1;
    if (random.chance(0.3)) {
        target = at.kind.rim(random);
        if (at.kind.name == "cube") target[axis] = along;
        target = target * (1 - random.logUniform(1e-12, 1e-3));
    }
    if (random.chance(0.1)) target = {0, 0, random.chance(0.5) ? 1.0 : -1.0};
    const double distance = random.chance(0.8) ? 4 : random.logUniform(1e-8, 1e8);
    return kit::rayThrough(at.map.point(random.direction() * distance), at.map.point(target));
}

void leaveKind(Random& random, const PlacedKind& at, const Surface& s, Tally& tally) {
    constexpr int kRays = 40; // from a point
    const Vec3d ng = toDouble(s.ng);
    const double leastCosine = leastCosineFor(at.kind);
    std::vector<Hit> hits;
    for (int i = 0; i < kRays; ++i) {
        const float side = at.kind.isFlat && random.chance(0.5) ? -1.0f : 1.0f;
        Ray out;
        out.org = leave(s, s.ng * side);
        out.dir = leavingTo(random, ng * static_cast<double>(side), leastCosine);
        ++tally.cases;
        Hit hit;
        if (at.shape->intersect(out, hit) || at.shape->occludes(out))
            tally.fail([&] { return cat(at.kind.name, " meets itself, ", shown(out)); });
        if (!at.kind.isClosed || static_cast<double>(s.error) > at.sharpest) continue;
        Ray in;
        in.org = leave(s, -s.ng);
        in.dir = leavingTo(random, -ng, 0);
        hits.clear();
        at.shape->collect(in, hits);
        ++tally.cases;
        if (hits.size() != 1)
            tally.fail([&] {
                return cat(hits.size(), " crossings from inside a ", at.kind.name, ", ", shown(in));
            });
    }
}

Tally fromFormulas(const Effort& effort) {
    constexpr int kRaysAt = 60; // a shape
    return inBatches(effort, 51, 220, [](Random& random, Tally& tally) {
        const PlacedKind at = placedKind(random);
        std::vector<Hit> hits;
        for (int i = 0; i < kRaysAt; ++i) {
            const Ray ray = rayAt(random, at);
            hits.clear();
            at.shape->collect(ray, hits);
            for (const Hit& hit : hits) leaveKind(random, at, at.shape->surface(ray, hit), tally);
        }
    });
}

PlacedSolid someConvexSolid(Random& random) {
    for (;;) {
        const Solid& solid = solids()[random.below(solids().size())];
        if (!solid.isConvex) continue;
        return random.chance(0.7) ? placedNear(random, solid) : placedFar(random, solid);
    }
}

// The surface of a point that a ray from outside really meets.
bool aimedSurface(Random& random, const PlacedSolid& at, Surface& surface) {
    Ray ray;
    ray.org = toFloat(at.sceneFromSolid.point(random.direction() * 3.0));
    ray.dir = toFloat(at.onTriangle(random, at.someTriangle(random))) - ray.org;
    if (random.chance(0.5)) ray.dir = normalize(ray.dir);
    const Hit hit = at.set.closest(ray);
    if (!hit.isHit()) return false;
    surface = at.shape().surface(ray, hit);
    return true;
}

// A start on the inside is off the surface by its error; where the solid is thinner than that, as
// at the rim of a small fan far from the middle of the scene, it is out of the other side, and its
// ray proves nothing.
bool isOutBehind(const PlacedSolid& at, const Surface& s, Vec3 start) {
    const double off = length(toDouble(start) - toDouble(s.p));
    return off < 1.5 * static_cast<double>(s.error) && !at.contains(start);
}

Tally fromMeshes(const Effort& effort) {
    constexpr int kPoints = 120, kRays = 40; // of a solid, from a point
    return inBatches(effort, 52, 32, [](Random& random, Tally& tally) {
        const PlacedSolid at = someConvexSolid(random);
        for (int i = 0; i < kPoints; ++i) {
            Surface s;
            if (!aimedSurface(random, at, s)) continue;
            const Vec3d ng = toDouble(s.ng);
            for (int k = 0; k < kRays; ++k) {
                Ray ray;
                ray.org = leave(s, s.ng);
                ray.dir = leavingTo(random, ng, 0);
                ++tally.cases;
                if (k % 4 == 0 ? at.set.closest(ray).isHit() : at.set.occluded(ray))
                    tally.fail([&] { return cat("meets itself: ", at.name, ", ", shown(ray)); });
                if (k % 4 != 0) continue;
                ray.org = leave(s, -s.ng);
                ray.dir = leavingTo(random, -ng, 0);
                ++tally.cases;
                if (!at.set.closest(ray).isHit() && !isOutBehind(at, s, ray.org))
                    tally.fail([&] { return cat("leaks: ", at.name, ", ", shown(ray)); });
            }
        }
    });
}

// Shadow rays as the renderer casts them: from a point lamp, or towards the sun.
void castShadowRays(Random& random, const Surface& s, const Shape& shape, std::string_view name,
                    double leastCosine, Tally& tally) {
    constexpr int kRays = 24;
    for (int i = 0; i < kRays; ++i) {
        Ray ray;
        if (random.chance(0.2)) {
            ray = {leave(s, s.ng), leavingTo(random, toDouble(s.ng), leastCosine), 0, kInfinityF,
                   0};
        } else {
            // Few from very far: their pads open many boxes, 50 us a ray.
            const double furthest = random.chance(0.97) ? 30 : 1.5e4;
            const Vec3 lamp = toFloat(random.direction() * random.logUniform(1.5, furthest));
            if (!(dot(s.ng, normalize(lamp - s.p)) > 0)) continue;
            ray = rayFromLamp(s, s.ng, lamp, 0);
        }
        ++tally.cases;
        if (shape.occludes(ray))
            tally.fail([&] { return cat("shadow on itself: ", name, ", ", shown(ray)); });
    }
}

Tally acneOfFormulas(const Effort& effort) {
    return inBatches(effort, 65, 300, [](Random& random, Tally& tally) {
        const kit::Kind& kind = kit::kinds()[random.below(kit::kinds().size())];
        if (!kind.isClosed && !kind.isFlat) return; // inside a tube there may well be shadow
        const Transform map = random.affine(8, 1) * Transform::scale(random.logUniform(0.01, 1));
        const auto shape = kind.make(map);
        for (int i = 0; i < 150; ++i) {
            const Ray ray =
                kit::rayThrough(map.point(random.direction() * 4.0), map.point(random.inBox(1)));
            Hit hit;
            if (shape->intersect(ray, hit))
                castShadowRays(random, shape->surface(ray, hit), *shape, kind.name,
                               leastCosineFor(kind), tally);
        }
    });
}

Tally acneOfMeshes(const Effort& effort) {
    return inBatches(effort, 66, 32, [](Random& random, Tally& tally) {
        const PlacedSolid at = someConvexSolid(random);
        for (int i = 0; i < 500; ++i) {
            Surface s;
            if (aimedSurface(random, at, s))
                castShadowRays(random, s, at.shape(), at.name, 0, tally);
        }
    });
}

constexpr Row kLeavingRows[] = {
    {"T5a", "rays that leave a shape with a formula do not meet it again", "", 0, true,
     fromFormulas},
    {"T5b", "the same of convex meshes", "", 0, true, fromMeshes},
    {"T6e", "no shadow of a shape with a formula on its own lit side", "", 0, true, acneOfFormulas},
    {"T6f", "the same of convex meshes", "", 0, true, acneOfMeshes},
};

} // namespace

std::span<const Row> leavingRows() { return kLeavingRows; }

} // namespace battery
