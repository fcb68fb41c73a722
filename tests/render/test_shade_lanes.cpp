// Points by the register: every lane has the bits of shading and lighting up its point alone.
#include "check.h"
#include "shot.h"

#include "render/point_columns.h"
#include "render/waves/shade_lanes.h"
#include "verify/meshes.h"

#include <array>
#include <bit>
#include <optional>

namespace test_shade_lanes {

using meshes::Random;

namespace {

constexpr std::size_t kPoints = PointColumns::kPoints;
using Vectors = std::array<Vec3, kPoints>;
using Colours = std::array<Rgb, kPoints>;

bool sameBits(float a, float b) {
    return std::bit_cast<std::uint32_t>(a) == std::bit_cast<std::uint32_t>(b);
}
bool sameBits(Vec3 a, Vec3 b) {
    return sameBits(a.x, b.x) && sameBits(a.y, b.y) && sameBits(a.z, b.z);
}
bool sameBits(Rgb a, Vec3 b) { return sameBits(Vec3{a.r, a.g, a.b}, b); }
bool sameBits(const ShadedPoint::Side& a, const ShadedPoint::Side& b) {
    return sameBits(a.ng, b.ng) && sameBits(a.ns, b.ns) && sameBits(a.n, b.n);
}

// The first material is lit on the side that is seen, the second one outside.
std::optional<Scene> materials() {
    const std::string text = shot::TopView{}.text() +
                             "sphere s {\n material a\n}\nmaterial a {\n diffuse 1 1 1\n}\n"
                             "material b {\n lit_side outside\n}\n";
    const SceneDesc desc = shot::parse(text);
    RenderSettings settings;
    settings.picture = desc.settings;
    return std::optional<Scene>(std::in_place, desc, SourceFile{"scene", ""}, settings);
}

Rgb someColour(Random& random) {
    const Vec3 v = toFloat(random.inBox(2));
    return {v.x, v.y, v.z};
}

Vec3 someDirection(Random& random) { return toFloat(random.direction()); }

Surface someSurface(Random& random, bool flat) {
    Surface s;
    s.p = toFloat(random.inBox(2));
    s.ng = s.ns = someDirection(random);
    s.error = static_cast<float>(random.logUniform(1e-9, 1e-2));
    s.rayError = random.chance(0.5) ? 0 : 0x1p-22f;
    s.material = random.below(2), s.object = random.below(9);
    if (flat || random.chance(0.5)) return s;
    s.ns = toFloat(normalize(toDouble(s.ng) + random.direction() * 0.9));
    if (random.chance(0.5)) s.lift = s.ng * static_cast<float>(random.logUniform(1e-8, 1e-2));
    return s;
}

struct Cases {
    long long points = 0, turned = 0, apart = 0, lifted = 0;
};

// What lanes make of a block, and what single points are.
class Compared {
public:
    Compared(const Scene& scene, const ShadeLanes& lanes, Random& random)
        : scene_(scene), lanes_(lanes), count_(random.chance(0.5) ? kPoints : 1 + random.below(16)),
          used_((1u << count_) - 1) {
        columns_.setMaterials(scene.materials());
        columns_.resize(kPoints);
        const bool flat = random.chance(0.3);
        for (std::size_t k = 0; k < count_; ++k) {
            alone_[k].surface = someSurface(random, flat);
            columns_.surfaces()[k].put(alone_[k].surface);
            dirs_[k] = someDirection(random) * static_cast<float>(random.logUniform(0.1, 10));
            if (random.chance(0.2)) // grazing
                dirs_[k] = toFloat(cross(toDouble(alone_[k].surface.ng), random.direction())) +
                           alone_[k].surface.ng * (random.chance(0.5) ? 1e-3f : -1e-3f);
            const auto weight = [&] { return static_cast<float>(random.unit()); };
            weights_[k] = {weight(), weight(), weight()};
        }
    }

    bool see(Cases& cases) {
        unsigned outside = 0;
        for (std::size_t k = 0; k < count_; ++k)
            outside |= static_cast<unsigned>(alone_[k].surface.material == 1) << k;
        const unsigned away = lanes_.see(columns_.block(0), dirs_.data(), used_, outside);
        bool same = (away & ~used_) == 0;
        for (std::size_t k = 0; k < count_; ++k) {
            if ((away >> k & 1) != 0) {
                const ShadedPoint at = columns_[k];
                SurfaceBlock::set(columns_.block(0).n, k, shading::turnedAway(at.toEye, at.eye));
            }
            const Ray ray{{}, dirs_[k], 0, kInfinityF, 0};
            ShadedPoint& alone = alone_[k];
            shadeSurface<false>(scene_, ray, {}, alone);
            const ShadedPoint at = columns_[k];
            same &= sameBits(at.toEye, alone.toEye) && at.front == alone.front &&
                    at.of == alone.of && sameBits(at.eye, alone.eye) &&
                    sameBits(at.lit, alone.lit) && sameBits(at.surface.lift, alone.surface.lift);
            cases.turned += (away >> k & 1) != 0;
            cases.apart += columns_.block(0).isLitApart(k);
        }
        cases.points += static_cast<long long>(count_);
        return same;
    }

    bool light(Cases& cases) const {
        LitBlock lit;
        lanes_.light(columns_.block(0), weights_.data(), used_, lit);
        bool same = lit.used == used_;
        for (std::size_t k = 0; k < count_; ++k) {
            const ShadedPoint& alone = alone_[k];
            const Surface& s = alone.surface;
            const bool isLifted = (lit.lifted >> k & 1) != 0;
            const bool isInside = (lit.inside >> k & 1) != 0;
            const auto is = [&](const float(&row)[3][kPoints], Vec3 v) {
                return sameBits(SurfaceBlock::get(row, k), v);
            };
            same &= is(lit.p, s.p) && is(lit.lift, s.lift) && is(lit.n, alone.lit.n) &&
                    is(lit.ng, alone.lit.ng) && (!isLifted || is(lit.ns, alone.lit.ns)) &&
                    is(lit.toEye, alone.toEye) &&
                    sameBits(weights_[k], SurfaceBlock::get(lit.weight, k)) &&
                    sameBits(lit.error[k], s.error) && sameBits(lit.rayError[k], s.rayError) &&
                    isLifted == (s.lift != Vec3{}) &&
                    isInside == !(alone.front || alone.of->litOutside);
            cases.lifted += isLifted;
        }
        return same;
    }

private:
    const Scene& scene_;
    const ShadeLanes& lanes_;
    std::size_t count_;
    unsigned used_;
    PointColumns columns_;
    std::array<ShadedPoint, kPoints> alone_;
    Vectors dirs_{};
    Colours weights_{};
};

// For the lanes of every kernel that there are.
template <class Fn> void forAllLanes(const Fn& fn) {
    for (const Isa& kernel : allIsas())
        if (const ShadeLanes lanes = lanesOf(kernel.shade); kernel.supported() && lanes.see)
            fn(kernel.name, lanes);
}

} // namespace

TEST(shade_lanes_have_the_bits_of_single_points) {
    const std::optional<Scene> scene = materials();
    forAllLanes([&](const char* name, const ShadeLanes& lanes) {
        Random random(7001);
        Cases cases;
        for (int i = 0; i < check::scaled(2000); ++i) {
            Compared block(*scene, lanes, random);
            CHECK_INFO(block.see(cases), name << ": shading of block " << i);
            CHECK_INFO(block.light(cases), name << ": light of block " << i);
        }
        // All that there is a branch for has been there.
        for (const long long some : {cases.turned, cases.apart, cases.lifted})
            CHECK_INFO(some > cases.points / 50, name << ": " << some << " of " << cases.points);
    });
}

TEST(shade_lanes_paint_all_points_alike) {
    forAllLanes([](const char* name, const ShadeLanes& lanes) {
        Material material;
        material.diffuse = {0.1f, 0.2f, 0.3f};
        LitBlock block;
        block.used = 0x1ff;
        block.shiny[0] = 3; // of points that were here before
        lanes.paint(material, block);
        CHECK_INFO(block.shiny[0] == 0 && block.shiny[1] == 0 && block.shiny[2] == 0, name);
        material.specular = {0.4f, 0.5f, 0.6f}, material.exponent = 7;
        material.specularModel = SpecularModel::Phong;
        lanes.paint(material, block);
        CHECK_INFO(block.shiny[static_cast<std::size_t>(SpecularModel::Phong)] == 0x1ff, name);
        for (std::size_t k = 0; k < 9; ++k)
            CHECK_INFO(SurfaceBlock::get(block.diffuse, k) == (Vec3{0.1f, 0.2f, 0.3f}) &&
                           SurfaceBlock::get(block.specular, k) == (Vec3{0.4f, 0.5f, 0.6f}) &&
                           block.exponent[k] == 7,
                       name << ", point " << k);
    });
}

TEST(shade_lanes_paint_points_of_many_materials) {
    forAllLanes([](const char* name, const ShadeLanes& lanes) {
        Random random(7003);
        std::array<Material, 5> materials;
        for (std::size_t m = 0; m < materials.size(); ++m) {
            materials[m].diffuse = someColour(random),
            materials[m].exponent = static_cast<float>(m);
            if (m > 0)
                materials[m].specular =
                    m == 1 ? Rgb{0, 0, 1} : someColour(random); // one is not shiny
            materials[m].specularModel = static_cast<SpecularModel>(m % LitBlock::kModels);
        }
        for (int i = 0; i < check::scaled(200); ++i) {
            std::array<const Material*, kPoints> of;
            for (const Material*& one : of)
                one = &materials[random.below(static_cast<std::uint32_t>(materials.size()))];
            LitBlock block;
            block.used = 0xffff;
            block.shiny[1] = 3; // of points that were here before
            lanes.paintEach(of.data(), block);
            for (std::size_t k = 0; k < kPoints; ++k) {
                bool same = sameBits(of[k]->diffuse, SurfaceBlock::get(block.diffuse, k));
                for (std::size_t model = 0; model < LitBlock::kModels; ++model) {
                    const bool isShiny = !isBlack(of[k]->specular) &&
                                         of[k]->specularModel == static_cast<SpecularModel>(model);
                    same &= (block.shiny[model] >> k & 1) == unsigned{isShiny};
                    if (isShiny)
                        same &= sameBits(of[k]->specular, SurfaceBlock::get(block.specular, k)) &&
                                block.exponent[k] == of[k]->exponent;
                }
                CHECK_INFO(same, name << ", block " << i << ", point " << k);
            }
        }
    });
}

// What follows the sixteen samples stays as it was.
TEST(shade_lanes_add_glow_to_samples_in_a_row) {
    forAllLanes([](const char* name, const ShadeLanes& lanes) {
        Random random(7004);
        for (int i = 0; i < check::scaled(200); ++i) {
            Colours weights, glow;
            std::array<Rgb, kPoints + 1> radiance, expected;
            for (Colours* const row : {&weights, &glow})
                for (Rgb& colour : *row) colour = someColour(random);
            for (Rgb& colour : radiance) colour = someColour(random);
            expected = radiance;
            for (std::size_t k = 0; k < kPoints; ++k) expected[k] += weights[k] * glow[k];
            lanes.glow(weights.data(), glow.data(), radiance.data());
            for (std::size_t k = 0; k <= kPoints; ++k)
                CHECK_INFO(sameBits(radiance[k], Vec3{expected[k].r, expected[k].g, expected[k].b}),
                           name << ", row " << i << ", sample " << k);
        }
    });
}

TEST(shade_lanes_take_and_give_samples_in_a_row) {
    forAllLanes([](const char* name, const ShadeLanes& lanes) {
        Random random(7005);
        for (int i = 0; i < check::scaled(200); ++i) {
            std::array<Rgb, kPoints + 1> radiance, back;
            for (Rgb& colour : radiance) colour = someColour(random);
            back.fill({2, 3, 4});
            LightSums sums;
            lanes.take(radiance.data(), sums);
            lanes.give(sums, back.data());
            for (std::size_t k = 0; k <= kPoints; ++k) {
                const Rgb wanted = k < kPoints ? radiance[k] : Rgb{2, 3, 4};
                const bool isTaken =
                    k == kPoints || sameBits(wanted, SurfaceBlock::get(sums.sum, k));
                CHECK_INFO(isTaken && sameBits(back[k], Vec3{wanted.r, wanted.g, wanted.b}),
                           name << ", row " << i << ", sample " << k);
            }
        }
    });
}

// Rays go one after the other, and what is not hidden arrives where it belongs.
TEST(shade_lanes_aim_at_points_and_add_what_they_see) {
    forAllLanes([](const char* name, const ShadeLanes& lanes) {
        Random random(7002);
        for (int i = 0; i < check::scaled(2000); ++i) {
            LitByLamp by;
            LightSums sums, expected;
            by.lit = random.below(1u << 16);
            const unsigned shadowed = by.lit & random.below(1u << 16);
            for (std::size_t k = 0; k < kPoints; ++k) {
                SurfaceBlock::set(by.dir, k, someDirection(random));
                SurfaceBlock::set(by.light, k, someDirection(random));
                SurfaceBlock::set(sums.sum, k, someDirection(random));
                by.tMax[k] = static_cast<float>(random.unit());
            }
            expected = sums;
            std::array<Vec3, 2 * kPoints> dir;
            std::array<float, 2 * kPoints> tMax;
            std::array<std::uint8_t, kPoints> hidden{};
            lanes.aim(by, shadowed, {nullptr, dir.data(), tMax.data(), nullptr});
            std::size_t ray = 0;
            bool same = true;
            for (std::size_t k = 0; k < kPoints; ++k) {
                bool arrives = (by.lit >> k & 1) != 0;
                if ((shadowed >> k & 1) != 0) {
                    same &= dir[ray] == SurfaceBlock::get(by.dir, k) && tMax[ray] == by.tMax[k];
                    hidden[ray] = random.chance(0.5) ? 1 : 0;
                    arrives &= hidden[ray++] == 0;
                }
                if (arrives)
                    for (std::size_t c = 0; c < 3; ++c) expected.sum[c][k] += by.light[c][k];
            }
            CHECK_INFO(same, name << ": rays of block " << i);
            lanes.add(by, shadowed, hidden.data(), sums);
            for (std::size_t k = 0; k < kPoints; ++k)
                same &= SurfaceBlock::get(sums.sum, k) == SurfaceBlock::get(expected.sum, k);
            CHECK_INFO(same, name << ": sums of block " << i);
        }
    });
}

} // namespace test_shade_lanes
