// What the maps of lamps say of shadow rays, against the rays themselves.
#include "render/lamp_map/lamp_map.h"

#include "analytic_kit.h"
#include "check.h"

#include <algorithm>
#include <bit>
#include <limits>
#include <vector>

namespace test_lamp_map {

using kit::Random;

namespace {

// Blunt cones, of which a tube inside is known, and some cubes, with a ball inside.
std::unique_ptr<const Shape> airyOne(Random& random, const Transform& map) {
    if (random.chance(0.2)) return kit::kindNamed("cube").make(map);
    const double top = random.uniform(0.5, 1);
    const bool isUp = random.coin();
    return std::make_unique<Cone>(map, isUp ? 1 : top, isUp ? top : 1, random.coin(), 0u, 0u);
}

// Many solids in a cube of half that size and a floor below them: mostly such as fill their hulls,
// or such as fill most of them.
ShapeSet crowd(Random& random, const Isa& kernel, double half) {
    ShapeSet set;
    const int count = 20 + static_cast<int>(random.below(200));
    const double size = random.logUniform(0.02, 0.3) * half;
    const bool isFlat = random.chance(0.2); // in a plane, as a field of them
    const double airy = random.chance(0.5) ? 0 : random.unit();
    for (int i = 0; i < count; ++i) {
        const kit::Kind& kind = random.chance(0.5) ? kit::kindNamed("sphere")
                                : random.chance(0.8)
                                    ? kit::kindNamed("cylinder")
                                    : kit::kinds()[random.below(kit::kinds().size())];
        const double radius = size * random.logUniform(0.1, 1);
        Vec3d factors{radius, radius, radius * random.logUniform(0.3, 8)};
        if (kind.name == kit::kindNamed("sphere").name) factors.z = radius;
        Vec3d at = random.inBox(half);
        if (isFlat) at.z = 0;
        const Transform map = Transform::translate(at) * random.turn() * Transform::scale(factors);
        set.add(random.chance(airy) ? airyOne(random, map) : kind.make(map),
                random.chance(0.02) ? ShapeSet::Shadow::None : ShapeSet::Shadow::Opaque);
    }
    if (random.coin())
        set.add(kit::kindNamed("disk").make(Transform::translate({0, 0, -1.3 * half}) *
                                            Transform::scale({4 * half, 4 * half, 1})),
                ShapeSet::Shadow::Opaque);
    set.finish(true, kernel);
    return set;
}

struct Case {
    ShapeSet set;
    std::shared_ptr<const LampMap> map;
    PointEmission lamp;
};
Case someCase(Random& random, const Isa& kernel) {
    const double half = random.chance(0.6) ? 0.7 : random.logUniform(1e-5, 100);
    Case out{crowd(random, kernel, half), nullptr, {}};
    const Vec3d at = random.chance(0.2)
                         ? random.inBox(2 * half)
                         : random.outwards(2 * half, half * random.logUniform(3, 300));
    out.lamp = {toFloat(at), {1, 1, 1}, {0, 0, 1}, 0};
    if (auto shapes = MappedShapes::of(out.set))
        out.map = makeLampMap(std::make_shared<const MappedShapes>(std::move(*shapes)),
                              out.lamp.position);
    return out;
}

struct Counts {
    long long rays = 0, hidden = 0, lit = 0, unsure = 0, maps = 0, none = 0;
    long long hiddenByCores = 0; // or by others of the same crowd
};

// Asks the map about the points `asked`, and rays about what it says.
void compare(const Case& of, const Isa& kernel, const LitBlock& block, LitByLamp& by,
             unsigned asked, int number, Counts& counts) {
    by.lit = by.unsure = asked;
    const LitByLamp before = by;
    lanesOf(kernel.lamps).askMap(*of.map, {&block, 1}, {&by, 1});
    CHECK_INFO((by.lit & ~asked) == 0 && (by.unsure & ~by.lit) == 0,
               kernel.name << " case " << number);
    for (unsigned rest = asked; rest != 0; rest &= rest - 1) {
        const auto i = static_cast<std::size_t>(std::countr_zero(rest));
        const Ray ray{of.lamp.position,
                      {before.dir[0][i], before.dir[1][i], before.dir[2][i]},
                      0,
                      before.tMax[i],
                      0};
        ++counts.rays;
        const bool isHidden = (by.lit >> i & 1) == 0;
        if ((by.unsure >> i & 1) != 0) {
            ++counts.unsure;
            continue;
        }
        CHECK_INFO(of.set.occluded(ray) == isHidden, kernel.name << " case " << number << " point "
                                                                 << i << ": said to be "
                                                                 << (isHidden ? "hidden" : "lit"));
        ++(isHidden ? counts.hidden : counts.lit);
        counts.hiddenByCores += isHidden && !of.map->shapes->cores.empty();
    }
}

// Points where rays through the crowd have met it.
LitBlock somePoints(Random& random, const ShapeSet& set, double extent) {
    LitBlock block{};
    for (std::size_t k = 0; k < LitBlock::kPoints; ++k) {
        const Vec3d eye = random.outwards(1.5 * extent, 3 * extent);
        const Ray ray = kit::rayThrough(eye, random.inBox(0.7 * extent));
        const Hit hit = set.closest(ray);
        if (!hit.isHit()) continue;
        const Surface s = set.shapes[hit.shape]->surface(ray, hit);
        const bool isBack = dot(s.ng, ray.dir) > 0;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            block.p[axis][k] = s.p[axis];
            block.n[axis][k] = block.ng[axis][k] = isBack ? -s.ng[axis] : s.ng[axis];
            block.weight[axis][k] = block.diffuse[axis][k] = 1;
        }
        block.error[k] = s.error, block.rayError[k] = s.rayError;
        block.shape[k] = hit.shape;
        block.used |= 1u << k;
        if (isBack) block.inside |= 1u << k;
    }
    return block;
}

// From a ball's centre to where the picture shows it farthest to the left, right, top or bottom.
Vec3d farthest(const LampMap& map, Vec3d centre, double radius, Random& random) {
    const Vec3d axis = toDouble(random.coin() ? map.right : map.up), ahead = toDouble(map.ahead);
    const double x = dot(centre, axis), z = dot(centre, ahead);
    const double side = random.coin() ? 1 : -1;
    const double angle =
        std::atan2(x, z) + side * std::asin(std::min(1.0, radius / std::sqrt(x * x + z * z)));
    return (axis * std::cos(angle) - ahead * std::sin(angle)) * side;
}

// Directions that maps have to be careful with: borders of cells, edges of solids, none at all.
void aim(Random& random, const Case& of, std::size_t i, LitByLamp& by) {
    const LampMap& map = *of.map;
    Vec3d dir;
    const auto& hulls = map.shapes->hulls;
    const auto& hull = hulls[random.below(hulls.size())];
    const Vec3d centre = toDouble(hull.centre - map.lamp);
    if (random.chance(0.4)) {
        const auto border = [&](std::size_t axis) {
            const double cell = static_cast<double>(random.below(map.cells() + 1));
            return (cell - static_cast<double>(map.offset[axis])) /
                   static_cast<double>(map.scale[axis]);
        };
        dir = toDouble(map.ahead) + toDouble(map.right) * border(0) + toDouble(map.up) * border(1);
        dir = dir * (length(centre) * random.uniform(0.5, 2));
    } else {
        // Past the hull's edge, and up to where it may begin or end.
        const Vec3d along = toDouble(hull.axis) *
                            (static_cast<double>(hull.halfLength) * random.uniform(-1.01, 1.01));
        const double radius = static_cast<double>(hull.radius);
        const Vec3d aside = random.coin() ? normalize(cross(centre, random.direction()))
                                          : farthest(map, centre + along, radius, random);
        const double off = random.chance(0.4)   ? 1
                           : random.chance(0.3) ? random.uniform(0.4, 1) // where a core may end
                                                : 1 + random.signedLogUniform(1e-8, 1e-1);
        dir = centre + along + aside * (off * radius);
        if (random.coin()) dir = dir * (1 + random.signedLogUniform(1e-8, 1));
    }
    const Vec3 to = toFloat(dir);
    for (std::size_t axis = 0; axis < 3; ++axis) by.dir[axis][i] = to[axis];
    by.tMax[i] = random.coin() ? 1 : static_cast<float>(random.uniform(0.5, 1));
    if (random.chance(0.05)) {
        constexpr float kOdd[] = {
            0, std::numeric_limits<float>::quiet_NaN(), kInfinityF, -kInfinityF, 1e-30f, 1e30f};
        (random.chance(0.2) ? by.tMax : by.dir[random.below(3)])[i] = kOdd[random.below(6)];
    }
}

std::uint32_t someOnMap(const LampMap& map) {
    const auto& hullOf = map.shapes->hullOf;
    std::uint32_t shape = 0;
    while (hullOf[shape] == MappedShapes::kNoHull) ++shape;
    return shape;
}

template <class Fn> void forEachKernel(Fn&& fn) {
    for (const Isa& kernel : allIsas())
        if (kernel.supported() && lanesOf(kernel.lamps).askMap != nullptr) fn(kernel);
}

} // namespace

TEST(lamp_maps_say_what_rays_do) {
    forEachKernel([](const Isa& kernel) {
        Random random(521);
        Counts counts;
        for (int i = 0; i < check::scaled(600); ++i) {
            const Case of = someCase(random, kernel);
            ++(of.map ? counts.maps : counts.none);
            if (!of.map) continue;
            for (int b = 0; b < 4; ++b) {
                const LitBlock block =
                    somePoints(random, of.set, static_cast<double>(maxAbs(of.map->shapes->box.hi)));
                LitByLamp by{};
                lanesOf(kernel.lamps).byLamp(of.lamp, block, block.used, by);
                compare(of, kernel, block, by, by.lit, i, counts);
            }
        }
        std::printf("%s: %lld maps and none in %lld cases, %lld rays: %lld hidden, %lld lit\n",
                    kernel.name, counts.maps, counts.none, counts.rays, counts.hidden, counts.lit);
        // Most of them, though some crowds are smaller than what rounding takes.
        CHECK_INFO(counts.hidden + counts.lit > counts.rays / 2 &&
                       counts.hidden > counts.rays / 20 && counts.lit > counts.rays / 4 &&
                       counts.hiddenByCores > counts.rays / 100 && counts.none > 0,
                   kernel.name << ": " << counts.unsure << " unsure, " << counts.hiddenByCores
                               << " hidden where there are cores");
    });
}

TEST(lamp_maps_are_right_at_borders) {
    forEachKernel([](const Isa& kernel) {
        Random random(522);
        Counts counts;
        for (int i = 0; i < check::scaled(600); ++i) {
            const Case of = someCase(random, kernel);
            if (!of.map) continue;
            for (int b = 0; b < 8; ++b) {
                LitBlock block{};
                // Within a solid, so that nothing is left out.
                block.inside = 0xffff;
                std::fill_n(block.shape, LitBlock::kPoints, someOnMap(*of.map));
                LitByLamp by{};
                for (std::size_t k = 0; k < LitBlock::kPoints; ++k) aim(random, of, k, by);
                compare(of, kernel, block, by, 0xffff, i, counts);
            }
        }
        CHECK_INFO(counts.hidden > counts.rays / 20 && counts.lit > counts.rays / 20 &&
                       counts.unsure > counts.rays / 20 && counts.hiddenByCores > counts.rays / 100,
                   kernel.name << ": " << counts.rays << " rays, " << counts.hidden << " hidden, "
                               << counts.hiddenByCores << " of them where there are cores, "
                               << counts.lit << " lit");
    });
}

// The points of several blocks walk together, and some blocks have none.
TEST(lamp_maps_answer_many_blocks_as_each) {
    forEachKernel([](const Isa& kernel) {
        Random random(523);
        int asked = 0;
        for (int i = 0; i < check::scaled(100); ++i) {
            const Case of = someCase(random, kernel);
            if (!of.map) continue;
            const std::size_t count = 1 + random.below(40);
            std::vector<LitBlock> blocks(count);
            std::vector<LitByLamp> together(count);
            for (std::size_t b = 0; b < count; ++b) {
                std::fill_n(blocks[b].shape, LitBlock::kPoints, someOnMap(*of.map));
                blocks[b].inside = static_cast<unsigned>(random.below(1 << 16));
                for (std::size_t k = 0; k < LitBlock::kPoints; ++k) aim(random, of, k, together[b]);
                together[b].lit = static_cast<unsigned>(random.below(1 << 16));
                together[b].unsure =
                    random.chance(0.3)
                        ? 0
                        : together[b].lit & static_cast<unsigned>(random.below(1 << 16));
                asked += std::popcount(together[b].unsure);
            }
            std::vector<LitByLamp> apart = together;
            lanesOf(kernel.lamps).askMap(*of.map, blocks, together);
            for (std::size_t b = 0; b < count; ++b) {
                lanesOf(kernel.lamps).askMap(*of.map, {&blocks[b], 1}, {&apart[b], 1});
                CHECK_INFO(together[b].lit == apart[b].lit && together[b].unsure == apart[b].unsure,
                           kernel.name << " case " << i << " block " << b << " of " << count);
            }
        }
        CHECK_INFO(asked > 1000, kernel.name << ": " << asked << " points");
    });
}

} // namespace test_lamp_map
