// Rays that lobes send from surfaces whose shading normal is bent: on the side of the true surface
// that the lobe says, whatever the normal is. All widths of lanes.
#include "base/math.h"
#include "check.h"
#include "isa/isa.h"
#include "scene/lobed_materials.h"
#include "scene/path_lights.h"
#include "integrate/shading_kernel.h"
#include "verify/meshes.h"

#include <cmath>
#include <memory>
#include <string>
#include <vector>

namespace test_bent_rays {

using meshes::Random;

namespace {

constexpr std::size_t kPoints = PathBlock::kPoints;

Vec3 onSide(Random& random, Vec3 side) {
    for (;;) {
        const Vec3 d = toFloat(random.direction());
        if (dot(d, side) > 1e-4f) return d;
    }
}

// Points with bent normals, seen from the outside, and what one lobe sends from them.
struct Sent {
    PointBlock points;
    LobeBlock lobes;
    PathBlock block;
    LobedMaterials materials;

    Sent(Random& random, const LobeRow& lobe, std::uint32_t flags) {
        materials.add({lobe}, {}, 0);
        lobes.begin(materials, materials[0]);
        points.clear();
        points.front = (1u << kPoints) - 1;
        for (std::size_t i = 0; i < kPoints; ++i) {
            Surface s;
            s.p = toFloat(random.inBox(1)), s.error = 1e-6f;
            s.ng = s.ns = toFloat(random.direction());
            points.put(i, s);
            for (;;) {
                const Vec3 n = random.chance(0.3) ? s.ng : onSide(random, s.ng);
                const Vec3 toEye = onSide(random, s.ng);
                if (!(dot(toEye, n) > 1e-4f)) continue; // points are shaded from the eye's side
                SurfaceBlock::set(points.n, i, n), SurfaceBlock::set(points.toEye, i, toEye);
                break;
            }
            for (auto& lane : block.throughput) lane[i] = 1;
            block.eta[i] =
                (flags & kHasSides) != 0 ? static_cast<float>(random.logUniform(0.4, 2.5)) : 1.0f;
            for (float* const lane :
                 {block.numbers.choice.u, block.numbers.onLight.u, block.numbers.onLight.v,
                  block.numbers.choice.v, block.numbers.direction.u, block.numbers.direction.v})
                lane[i] = min(static_cast<float>(random.unit()), kOneMinusUlp);
        }
        block.points = (1u << kPoints) - 1;
    }
    void scatter(const Isa& isa, const PathLights& lights) {
        block.lit = block.open = 0;
        block.scattered = block.single = block.diffuse = block.transmitted = 0;
        isa.shading->scatter(lights, points, lobes, block);
    }
    Vec3 ng(std::size_t i) const { return SurfaceBlock::get(points.ng, i); }
    Vec3 n(std::size_t i) const { return SurfaceBlock::get(points.n, i); }
    Vec3 toEye(std::size_t i) const { return SurfaceBlock::get(points.toEye, i); }
    Vec3 dir(std::size_t i) const { return SurfaceBlock::get(block.dir, i); }
    bool isSent(std::size_t i) const { return (block.scattered >> i & 1) != 0; }
    bool isTransmitted(std::size_t i) const { return (block.transmitted >> i & 1) != 0; }
};

Vec3d mirroredAbout(Vec3 n, Vec3 v) {
    const Vec3d normal = normalize(toDouble(n));
    return normal * (2 * dot(normal, toDouble(v))) - toDouble(v);
}

} // namespace

// Reflected above the surface, transmitted below it, of unit length and finite weight, and from a
// start on that side.
TEST(bent_rays_leave_on_the_right_side) {
    constexpr std::uint64_t kSeed = 94;
    const PathLights none;
    for (const Isa& isa : allIsas()) {
        if (!isa.supported()) continue;
        Random random(kSeed);
        long long sent = 0, transmitted = 0;
        for (int round = 0; round < check::scaled(400); ++round)
            for (const LobeType& type : lobeTypes()) {
                if ((type.flags & kSpawnsRays) == 0) continue;
                LobeRow lobe = lobeRow(type.name, {1, 1, 1});
                const float rough = random.chance(0.3) ? 0 : static_cast<float>(random.unit());
                for (const LobeField& field : type.fields)
                    if (field.name == std::string("roughness"))
                        setField(lobe, field.name, {rough, rough, rough});
                const auto made = std::make_unique<Sent>(random, lobe, type.flags);
                Sent& at = *made;
                at.scatter(isa, none);
                for (std::size_t i = 0; i < kPoints; ++i) {
                    if (!at.isSent(i)) continue;
                    const bool isBelow = at.isTransmitted(i);
                    ++sent, transmitted += isBelow;
                    const Vec3 side = isBelow ? -at.ng(i) : at.ng(i);
                    const Vec3 start =
                        SurfaceBlock::get(at.block.org, i) - SurfaceBlock::get(at.points.p, i);
                    const Vec3 weight = SurfaceBlock::get(at.block.weight, i);
                    CHECK_INFO((type.flags & (isBelow ? kTransmits : kReflects)) != 0 &&
                                   dot(at.dir(i), side) > 0 && dot(start, side) > 0 &&
                                   std::fabs(length(toDouble(at.dir(i))) - 1) < 1e-6 &&
                                   weight.x > 0 && weight.x < 100,
                               isa.name << ' ' << type.name << " roughness " << rough << " seed "
                                        << kSeed << " round " << round << " point " << i
                                        << ": weight " << weight.x << " rise "
                                        << dot(at.dir(i), side));
                }
            }
        CHECK_INFO(sent > 20000 && transmitted > 3000,
                   isa.name << ' ' << sent << " rays, " << transmitted << " transmitted");
    }
}

// A mirror mirrors by the bent normal, or by the surface where that leads below it: it always sends
// a ray. Smooth boundaries refract by Snell's law about the bent normal.
TEST(bent_rays_of_smooth_lobes) {
    constexpr std::uint64_t kSeed = 95;
    const PathLights none;
    for (const Isa& isa : allIsas()) {
        if (!isa.supported()) continue;
        Random random(kSeed);
        int sunk = 0, bent = 0, count = 0;
        for (int round = 0; round < check::scaled(400); ++round)
            for (const char* const name : {"mirror", "refraction"}) {
                const LobeRow lobe = lobeRow(name, {1, 1, 1});
                const std::uint32_t flags = lobeTypes()[lobe.kind].flags;
                const auto made = std::make_unique<Sent>(random, lobe, flags);
                Sent& at = *made;
                at.scatter(isa, none);
                for (std::size_t i = 0; i < kPoints; ++i) {
                    const auto about = [&] {
                        return std::string(isa.name) + ' ' + name + " round " +
                               std::to_string(round) + " point " + std::to_string(i);
                    };
                    const Vec3d n = toDouble(at.n(i)), v = toDouble(at.toEye(i)),
                                ng = toDouble(at.ng(i));
                    const double eta = static_cast<double>(at.block.eta[i]);
                    const double cosIn = dot(v, n), cos2Out = 1 - eta * eta * (1 - cosIn * cosIn);
                    const bool goesThrough = (flags & kTransmits) != 0 && cos2Out > 0;
                    if (std::fabs(cos2Out) < 1e-4) continue;
                    ++count;
                    Vec3d expected = mirroredAbout(at.n(i), at.toEye(i));
                    if (goesThrough) expected = (n * cosIn - v) * eta - n * std::sqrt(cos2Out);
                    if (std::fabs(dot(expected, ng)) < 1e-5) continue;
                    const bool isWrong = (dot(expected, ng) < 0) != goesThrough;
                    if (goesThrough) {
                        CHECK_INFO(at.isSent(i) == !isWrong, about());
                        bent += !isWrong;
                        if (isWrong) continue;
                    } else if (isWrong) {
                        ++sunk, expected = mirroredAbout(at.ng(i), at.toEye(i));
                    }
                    CHECK_INFO(at.isSent(i) && at.isTransmitted(i) == goesThrough, about());
                    CHECK_INFO(length(toDouble(at.dir(i)) - expected) < 5e-6,
                               about() << ": off by " << length(toDouble(at.dir(i)) - expected));
                }
            }
        CHECK_INFO(sunk > count / 50 && bent > count / 10,
                   isa.name << ' ' << sunk << " sank, " << bent << " bent, of " << count);
    }
}

} // namespace test_bent_rays
