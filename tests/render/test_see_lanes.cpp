// How points are seen: what the one lane says of them, and that all kernels say the same.
#include "check.h"

#include "integrate/point_block.h"
#include "integrate/shading_kernel.h"
#include "isa/isa.h"
#include "verify/meshes.h"

#include <array>
#include <bit>

namespace test_see_lanes {

using meshes::Random;

namespace {

constexpr std::size_t kPoints = PointBlock::kPoints;

bool sameBits(const PointBlock::Lane (&a)[3], const PointBlock::Lane (&b)[3], std::size_t i) {
    for (std::size_t axis = 0; axis < 3; ++axis)
        if (std::bit_cast<std::uint32_t>(a[axis][i]) != std::bit_cast<std::uint32_t>(b[axis][i]))
            return false;
    return true;
}

Surface someSurface(Random& random, bool flat) {
    Surface s;
    s.p = toFloat(random.inBox(2));
    s.ng = s.ns = toFloat(random.direction());
    if (flat || random.chance(0.5)) return s;
    s.ns = toFloat(normalize(toDouble(s.ng) + random.direction() * 0.9));
    if (random.chance(0.5)) s.lift = s.ng * static_cast<float>(random.logUniform(1e-8, 1e-2));
    return s;
}

// Points whose surfaces are known, some with bent normals, and the directions that see them.
struct Case {
    PointBlock block{};
    std::array<Vec3, kPoints> dirs{}, bentNormals{};
    unsigned used = 0, litOutside = 0, bent = 0;

    explicit Case(Random& random) {
        const std::size_t count = random.chance(0.5) ? kPoints : 1 + random.below(kPoints);
        const bool flat = random.chance(0.3);
        block.clear();
        for (std::size_t i = 0; i < count; ++i) {
            const Surface surface = someSurface(random, flat);
            block.put(i, surface);
            dirs[i] = toFloat(random.direction() * random.logUniform(0.1, 10));
            if (random.chance(0.2)) // grazing
                dirs[i] = toFloat(cross(toDouble(surface.ng), random.direction())) +
                          surface.ng * (random.chance(0.5) ? 1e-3f : -1e-3f);
            used |= 1u << i;
            litOutside |= random.below(2) << i;
            if (!random.chance(0.2)) continue;
            bent |= 1u << i;
            bentNormals[i] = toFloat(normalize(toDouble(surface.ns) + random.direction() * 0.5));
            SurfaceBlock::set(block.n, i, bentNormals[i]);
        }
    }
};

} // namespace

TEST(points_are_seen_from_the_side_of_the_eye) {
    Random random(7001);
    long long points = 0, away = 0, apart = 0, bent = 0;
    for (int round = 0; round < check::scaled(2000); ++round) {
        const Case given(random);
        PointBlock one = given.block;
        const unsigned turned = oneLane().shading->see(one, given.dirs.data(), given.used,
                                                       given.litOutside, given.bent);
        CHECK((turned & ~given.used) == 0);
        for (std::size_t i = 0; (given.used >> i & 1) != 0 && i < kPoints; ++i) {
            const Surface surface = given.block.at(i);
            const Vec3 toEye = SurfaceBlock::get(one.toEye, i), n = SurfaceBlock::get(one.n, i);
            CHECK_NEAR(length(toEye + normalize(given.dirs[i])), 0, 1e-6);
            const bool front = dot(toEye, surface.ng) >= 0;
            CHECK_EQUAL(one.isFront(i), front);
            const bool isBent = (given.bent >> i & 1) != 0;
            const Vec3 outside = isBent ? given.bentNormals[i] : surface.ns;
            CHECK(n == (front ? outside : -outside));
            CHECK_EQUAL((turned >> i & 1) != 0, !(dot(n, toEye) > 0));
            const bool isApart = (given.litOutside >> i & 1) != 0 && !front;
            CHECK_EQUAL(one.isLitApart(i), isApart);
            if (isApart) CHECK(SurfaceBlock::get(one.litN, i) == outside);
            CHECK(one.at(i).lift == (isApart ? Vec3{} : surface.lift));
            ++points, away += turned >> i & 1, apart += isApart, bent += isBent;
        }
        for (const Isa& kernel : allIsas()) {
            if (!kernel.supported()) continue;
            PointBlock lanes = given.block;
            bool same = kernel.shading->see(lanes, given.dirs.data(), given.used, given.litOutside,
                                            given.bent) == turned &&
                        lanes.front == one.front && lanes.litApart == one.litApart;
            for (std::size_t i = 0; (given.used >> i & 1) != 0 && i < kPoints; ++i)
                same &= sameBits(lanes.toEye, one.toEye, i) && sameBits(lanes.n, one.n, i) &&
                        (!one.isLitApart(i) || sameBits(lanes.litN, one.litN, i)) &&
                        (!one.isCurved(i) || sameBits(lanes.lift, one.lift, i));
            CHECK_INFO(same, kernel.name << ": block " << round);
        }
    }
    // All that there is a branch for has been there.
    for (const long long some : {away, apart, bent})
        CHECK_INFO(some > points / 50, some << " of " << points);
}

} // namespace test_see_lanes
