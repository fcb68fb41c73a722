// Which shadow rays need not be traced: what is said of boxes, against the rays themselves.
#include "render/occluders.h"

#include "analytic_kit.h"
#include "check.h"
#include "render/waves/hidden_point.h"
#include "render/waves/lamp_lanes.h"

namespace test_occluders {

using kit::Random;

namespace {

// A few shapes in [-1,1]^3, as scenes have them.
ShapeSet scatter(Random& random, int count) {
    ShapeSet set;
    for (int i = 0; i < count; ++i) {
        // Spheres and upright cubes are told more of.
        const kit::Kind& kind = random.chance(0.4) ? kit::kindNamed("sphere")
                                : random.chance(0.3)
                                    ? kit::kindNamed("cube")
                                    : kit::kinds()[random.below(kit::kinds().size())];
        Vec3d factors{random.logUniform(0.05, 0.5), random.logUniform(0.05, 0.5),
                      random.logUniform(0.05, 0.5)};
        if (random.coin()) factors = Vec3d{1, 1, 1} * factors.x;
        // Upright ones fill their boxes.
        const Vec3d at = random.inBox(0.6);
        const Transform map = random.chance(0.4)
                                  ? Transform::translate(at) * Transform::scale(factors)
                                  : kit::placed(random, factors, at);
        set.add(kind.make(map),
                random.chance(0.2) ? ShapeSet::Shadow::SeeThrough : ShapeSet::Shadow::Opaque);
    }
    set.finish(true);
    return set;
}

} // namespace

// Points on one shape, a few next to each other or far apart, and a lamp: where nothing may be in
// between, no ray between the points and the lamp meets anything.
TEST(occluders_never_miss_one) {
    Random random(511);
    int clear = 0, shaded = 0;
    for (int i = 0; i < check::scaled(1500); ++i) {
        const ShapeSet set = scatter(random, 1 + static_cast<int>(random.below(8)));
        const Occluders occluders(set);
        CHECK(occluders.canTell());
        // Rays at one place of the picture: the points that they meet on the first shape.
        const Vec3d eye = random.outwards(1.5, 3), target = random.inBox(0.7);
        const double spread = random.logUniform(1e-3, 0.3);
        struct Met {
            Surface surface;
            Vec3 side;
        };
        std::vector<Met> met;
        Bounds box;
        std::uint32_t shape = Hit::kNoShape;
        bool inside = false;
        for (int k = 0; k < 12; ++k) {
            const Ray ray = kit::rayThrough(eye, target + random.inBox(spread));
            const Hit hit = set.closest(ray);
            if (!hit.isHit()) continue;
            const Surface s = set.shapes[hit.shape]->surface(ray, hit);
            const bool isBack = dot(s.ng, ray.dir) > 0;
            if (shape == Hit::kNoShape) shape = hit.shape, inside = isBack;
            if (hit.shape != shape || isBack != inside) continue;
            met.push_back({s, isBack ? -s.ng : s.ng});
            box.extend(s.p);
        }
        if (met.empty()) continue;
        const Vec3 lamp = toFloat(random.inBox(2));
        const bool mayHide = occluders.mayHide(box, shape, inside, {lamp, lamp});
        for (const Met& m : met) {
            if (!(dot(m.side, lamp - m.surface.p) > 0)) continue;
            const Vec3 start = m.surface.p + m.side * m.surface.error;
            const Ray ray{start, lamp - start, 0, 1, 0};
            std::vector<Hit> through;
            set.seeThroughHits(ray, through);
            const bool isHidden = set.occluded(ray) || !through.empty();
            CHECK_INFO(!isHidden || mayHide, "case " << i << ", shape " << shape);
            ++(isHidden ? shaded : clear);
        }
    }
    // Both happen, or the test says nothing.
    CHECK_INFO(clear > check::scaled(1000) && shaded > check::scaled(100),
               clear << " clear, " << shaded << " shaded");
}

namespace {

// Places where rays have met a set of shapes, as lanes want them.
struct MetPoints {
    LitBlock block{};
    std::vector<Vec3> starts, sides;
};
MetPoints meet(Random& random, const ShapeSet& set) {
    MetPoints met;
    LitBlock& block = met.block;
    for (int k = 0; k < 60 && met.starts.size() < LitBlock::kPoints; ++k) {
        const Ray ray = kit::rayThrough(random.outwards(1.5, 3), random.inBox(0.7));
        const Hit hit = set.closest(ray);
        if (!hit.isHit()) continue;
        const Surface s = set.shapes[hit.shape]->surface(ray, hit);
        const bool isBack = dot(s.ng, ray.dir) > 0;
        const std::size_t to = met.starts.size();
        const Vec3 side = isBack ? -s.ng : s.ng;
        const Vec3 lift = random.chance(0.2) ? side * 1e-3f : Vec3{};
        for (std::size_t axis = 0; axis < 3; ++axis) {
            block.p[axis][to] = s.p[axis], block.lift[axis][to] = lift[axis];
            block.n[axis][to] = block.ng[axis][to] = side[axis];
            block.weight[axis][to] = block.diffuse[axis][to] = 1;
        }
        block.shape[to] = hit.shape;
        block.used |= 1u << to;
        if (isBack) block.inside |= 1u << to;
        met.starts.push_back(s.p + side * s.error + lift), met.sides.push_back(side);
    }
    return met;
}

} // namespace

// The same for each point by itself, by the lanes of every kernel, and a lamp with a size.
TEST(occluders_in_lanes_never_miss_one) {
    Random random(512);
    int clear = 0, shaded = 0, known = 0, dark = 0;
    for (int i = 0; i < check::scaled(600); ++i) {
        const ShapeSet set = scatter(random, 1 + static_cast<int>(random.below(8)));
        const Occluders occluders(set);
        const auto [block, starts, sides] = meet(random, set);
        PointEmission lamp{toFloat(random.inBox(2)), {1, 1, 1}, {}, 0};
        lamp.radius = static_cast<float>(random.logUniform(1e-3, random.coin() ? 1 : 0.1));
        for (const Isa& kernel : allIsas()) {
            const HiddenPointsFn inLanes =
                kernel.supported() ? lanesOf(kernel.lamps).hiddenPoints : nullptr;
            if (!inLanes) continue;
            const HiddenPoints found = inLanes(occluders, block, lamp.ball());
            const unsigned hidden = found.maybe, surely = found.surely;
            CHECK_INFO((hidden & ~block.used) == 0, kernel.name << " case " << i);
            CHECK_INFO((surely & ~hidden) == 0, kernel.name << " case " << i);
            for (std::size_t k = 0; k < starts.size(); ++k) {
                const bool mayHide = (hidden >> k & 1) != 0, hides = (surely >> k & 1) != 0;
                known += !mayHide, dark += hides;
                const auto at = [&](const float(&v)[3][LitBlock::kPoints]) {
                    return Vec3{v[0][k], v[1][k], v[2][k]};
                };
                const HidingPlace alone{at(block.p), at(block.lift), block.shape[k],
                                        (block.inside >> k & 1) != 0};
                CHECK_INFO(::mayHide(occluders, alone, lamp.ball()) == mayHide,
                           kernel.name << " case " << i << " point " << k << " alone");
                for (int n = 0; n < 6; ++n) {
                    const Vec3 place =
                        lamp.position + toFloat(random.direction() *
                                                (static_cast<double>(lamp.radius) * random.unit()));
                    const Vec3 way = place - starts[k];
                    if (!(dot(sides[k], way) > 0)) continue;
                    const Ray ray{starts[k], way, 0, 1, 0};
                    std::vector<Hit> through;
                    set.seeThroughHits(ray, through);
                    const bool isOpaque = set.occluded(ray);
                    const bool isHidden = isOpaque || !through.empty();
                    CHECK_INFO(!isHidden || mayHide,
                               kernel.name << " case " << i << " point " << k);
                    CHECK_INFO(isOpaque || !hides, kernel.name << " case " << i << " point " << k);
                    ++(isHidden ? shaded : clear);
                }
            }
        }
    }
    CHECK_INFO(clear > check::scaled(1000) && shaded > check::scaled(1000) &&
                   known > check::scaled(1000) && dark > check::scaled(100),
               clear << " clear, " << shaded << " shaded, " << known << " points known, " << dark
                     << " of them dark");
}

namespace {

struct Lines {
    int clear = 0, hidden = 0, unsure = 0, wrong = 0;
};

// What is said of single lines to the lamp is what their shadow rays say.
void judge(Random& random, const ShapeSet& set, const MetPoints& met, const PointEmission& lamp,
           int number, Lines& lines) {
    const Occluders occluders(set);
    SamplesOnLamp samples;
    samples.count = LitBySamples::kMost, samples.points = met.block.used;
    for (std::size_t k = 0; k < LitBlock::kPoints; ++k)
        samples.index[k] = random.below(1u << 31), samples.x[k] = random.below(1u << 31),
        samples.y[k] = random.below(1u << 31);
    for (const Isa& kernel : allIsas()) {
        const LightBySamplesFn inLanes =
            kernel.supported() ? lanesOf(kernel.lamps).bySamples : nullptr;
        if (!inLanes) continue;
        LitBySamples all, told; // of all lines, and with what is known
        HiddenPoints none;
        none.maybe = met.block.used, none.areShapesKnown = true, none.byShape.fill(0);
        inLanes(lamp, met.block, samples, occluders, none, all);
        const HiddenPoints found =
            lanesOf(kernel.lamps).hiddenPoints(occluders, met.block, lamp.ball());
        inLanes(lamp, met.block, samples, occluders, found, told);
        for (std::size_t n = 0; n < LitBySamples::kRoom; ++n) {
            const std::size_t s = n / LitBlock::kPoints, k = n % LitBlock::kPoints;
            if (!all.isLit(s, k) || (found.maybe >> k & 1) == 0) continue;
            if (told.isUnsure(s, k)) {
                lines.wrong += !told.isLit(s, k), ++lines.unsure;
                continue;
            }
            const Ray ray{
                met.starts[k], {all.dir[0][n], all.dir[1][n], all.dir[2][n]}, 0, all.tMax[n], 0};
            std::vector<Hit> through;
            set.seeThroughHits(ray, through);
            const bool isRight =
                told.isLit(s, k) ? !set.occluded(ray) && through.empty() : set.occluded(ray);
            ++(told.isLit(s, k) ? lines.clear : lines.hidden);
            if (!isRight && ++lines.wrong <= 3)
                CHECK_INFO(false,
                           kernel.name << " case " << number << " point " << k << " sample " << s);
        }
    }
}

} // namespace

TEST(occluders_in_lanes_know_lines) {
    Random random(513);
    Lines lines;
    for (int i = 0; i < check::scaled(400); ++i) {
        const ShapeSet set = scatter(random, 1 + static_cast<int>(random.below(8)));
        const MetPoints met = meet(random, set);
        PointEmission lamp{toFloat(random.inBox(2)), {1, 1, 1}, {}, 0};
        lamp.radius = static_cast<float>(random.logUniform(1e-3, 1));
        judge(random, set, met, lamp, i, lines);
    }
    CHECK_EQUAL(lines.wrong, 0);
    CHECK_INFO(lines.clear > check::scaled(2000) && lines.hidden > check::scaled(300) &&
                   lines.unsure > check::scaled(5000),
               lines.clear << " clear, " << lines.hidden << " hidden, " << lines.unsure
                           << " unsure");
}

// Lines that begin or end in an upright cube, that stay in it, and that pass along its faces nearer
// than rounding is told from passing by.
TEST(occluders_in_lanes_know_lines_at_upright_cubes) {
    Random random(514);
    Lines lines;
    const double side = 0.25, near = 0x1p-14;
    for (int i = 0; i < check::scaled(300); ++i) {
        ShapeSet set;
        set.add(kit::kindNamed("cube").make(Transform::scale(side)), ShapeSet::Shadow::Opaque);
        set.finish(true);
        const bool isLampInside = random.chance(0.3);
        const Vec3d at = random.inBox(isLampInside ? 0.9 * side : 1);
        PointEmission lamp{toFloat(at), {1, 1, 1}, {}, 1e-7f};
        const std::size_t axis = random.below(3);
        // Over the face of that axis, if the lamp is as high.
        const double height = side + random.uniform(-near, near);
        if (!isLampInside && random.coin()) lamp.position[axis] = static_cast<float>(height);
        MetPoints met;
        for (std::size_t k = 0; k < LitBlock::kPoints; ++k) {
            Vec3 p = toFloat(random.inBox(random.chance(0.3) ? 0.9 * side : 1));
            if (random.coin()) p[axis] = static_cast<float>(side + random.uniform(-near, near));
            const Vec3 up = normalize(lamp.position - p);
            for (std::size_t a = 0; a < 3; ++a) {
                met.block.p[a][k] = p[a], met.block.n[a][k] = met.block.ng[a][k] = up[a];
                met.block.weight[a][k] = met.block.diffuse[a][k] = 1;
            }
            met.block.shape[k] = 1; // another one
            met.starts.push_back(p), met.sides.push_back(up);
        }
        met.block.used = 0xffff;
        judge(random, set, met, lamp, i, lines);
    }
    CHECK_EQUAL(lines.wrong, 0);
    CHECK_INFO(lines.hidden > check::scaled(20000) && lines.unsure > check::scaled(2000),
               lines.hidden << " hidden, " << lines.unsure << " unsure");
}

// And it is said where it is plain to see.
TEST(occluders_see_what_is_clear) {
    ShapeSet set;
    const kit::Kind& sphere = kit::kindNamed("sphere");
    set.add(sphere.make(Transform::scale(0.5)), ShapeSet::Shadow::Opaque);
    set.add(sphere.make(Transform::translate({3, 0, 0})), ShapeSet::Shadow::Opaque);
    set.finish(true);
    const Occluders occluders(set);
    const Bounds top{{-0.1f, -0.1f, 0.45f}, {0.1f, 0.1f, 0.5f}}, above{{0, 0, 4}, {0, 0, 4}};
    CHECK(!occluders.mayHide(top, 0, false, above)); // its own inside is below
    CHECK(occluders.mayHide(top, 0, true, above));   // from there the shape is in between
    CHECK(occluders.mayHide(top, 1, false, above));  // and for what lies on another shape
    const Bounds behind{{6, 0, 0.5f}, {6, 0, 0.5f}};
    CHECK(occluders.mayHide(top, 0, false, behind)); // the other sphere
    const Bounds aside{{0, 6, 0.5f}, {0, 6, 0.5f}};
    CHECK(!occluders.mayHide(top, 0, false, aside));

    ShapeSet crowd;
    for (int i = 0; i < 100; ++i)
        crowd.add(sphere.make(Transform::translate({3.0 * i, 0, 0})), ShapeSet::Shadow::Opaque);
    crowd.finish(true);
    CHECK(!Occluders(crowd).canTell());
}

} // namespace test_occluders
