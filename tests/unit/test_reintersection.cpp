// Stress battery T5: a ray that leaves a shape does not meet it again on the side it left to.
#include "analytic_kit.h"
#include "check.h"

using kit::Random;

namespace {

// A direction on the side of `side` (seen by the rounded numbers), often grazing.
Vec3 leaving(Random& random, Vec3d side, double leastCosine) {
    while (true) {
        Vec3d d = random.direction();
        if (random.unit() < 0.4) { // along the surface
            d = d - side * dot(d, side);
            if (length(d) < 0.01) continue;
            d = normalize(d) + side * random.logUniform(1e-9, 1e-2);
        }
        const Vec3 rounded = toFloat(d);
        if (dot(toDouble(rounded), side) > leastCosine) return rounded;
    }
}

struct Counts {
    long long outside = 0, outsideHits = 0, inside = 0, insideWrong = 0, points = 0;
};

void leave(Random& random, const kit::Kind& kind, const Shape& shape, const Surface& at,
           double sharpest, int rayCount, Counts& counts) {
    ++counts.points;
    const Vec3d ng = toDouble(at.ng);
    // A plane without end is met again a long way off along its rounded normal.
    const double leastCosine = kind.name == "infinite plane" ? 1e-6 : 0;
    std::vector<Hit> hits;
    for (int i = 0; i < rayCount; ++i) {
        const double side = kind.isFlat && random.coin() ? -1 : 1;
        Ray out;
        out.org = at.p + at.ng * (at.error * static_cast<float>(side));
        out.dir = leaving(random, ng * side, leastCosine);
        Hit hit;
        ++counts.outside;
        if (shape.intersect(out, hit) || shape.occludes(out)) ++counts.outsideHits;
        if (!kind.isClosed || at.error > sharpest) continue; // no float is safely inside
        Ray in;
        in.org = at.p - at.ng * at.error;
        in.dir = leaving(random, -ng, 0);
        hits.clear();
        shape.collect(in, hits);
        ++counts.inside;
        if (hits.size() != 1) ++counts.insideWrong;
    }
}

// 100 (times STRESS) shapes of a kind, 100 points each, 100 rays a point.
Counts battery(Random& random, const kit::Kind& kind) {
    Counts counts;
    for (int s = 0; s < check::scaled(100); ++s) {
        const double size = random.logUniform(1e-4, 1e4);
        const Vec3d factors = kit::randomFactors(random, size);
        Vec3d offset;
        if (random.unit() < 0.7) offset = random.inBox(random.logUniform(1e-4, 1e4));
        const Transform map = kit::placed(random, factors, offset);
        const auto shape = kind.make(map);
        const Vec3d sides{std::fabs(factors.x), std::fabs(factors.y), std::fabs(factors.z)};
        const double thinnest = min(sides.x, min(sides.y, sides.z));
        // A hundredth of the thickness, or of the radius of curvature at the end of a needle.
        const double sharpest =
            0.01 * thinnest * (kind.name == "cube" ? 1 : thinnest / maxAbs(sides));
        std::vector<Hit> hits;
        for (int found = 0, tries = 0; found < 100 && tries < 3000; ++tries) {
            // Towards the object's box, its faces, a hair inside its rim or edges, and its tips.
            Vec3d target = random.inBox(1);
            const auto axis = static_cast<std::size_t>(random.unit() * 3);
            const double along = target[axis];
            if (random.coin()) target[axis] = target[axis] < 0 ? -1 : 1;
            if (random.unit() < 0.3) {
                target = kind.rim(random);
                if (kind.name == "cube") target[axis] = along;
                target = target * (1 - random.logUniform(1e-12, 1e-3));
            }
            if (random.unit() < 0.1) target = {0, 0, random.coin() ? 1.0 : -1.0};
            const Ray ray = kit::rayThrough(map.point(random.direction() * 4.0), map.point(target));
            hits.clear();
            shape->collect(ray, hits);
            for (const Hit& hit : hits) {
                leave(random, kind, *shape, shape->surface(ray, hit), sharpest, 100, counts);
                ++found;
            }
        }
    }
    return counts;
}

} // namespace

TEST(reintersection_of_analytic_shapes) {
    Random random(20240501);
    for (const kit::Kind& kind : kit::kinds()) {
        const Counts counts = battery(random, kind);
        std::printf("%-15s points %lld, outside %lld hits %lld, inside %lld wrong %lld\n",
                    kind.name.c_str(), counts.points, counts.outside, counts.outsideHits,
                    counts.inside, counts.insideWrong);
        CHECK_INFO(counts.outside >= 800000, kind.name << " rays " << counts.outside);
        CHECK_INFO(counts.outsideHits == 0, kind.name << " hits itself " << counts.outsideHits);
        if (kind.isClosed) CHECK_INFO(counts.inside >= 100000, kind.name);
        CHECK_INFO(counts.insideWrong == 0, kind.name << " inside " << counts.insideWrong);
    }
}
