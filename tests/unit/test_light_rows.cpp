// Lights of a description as numbers in lanes: what today's lamps of it give.
#include "base/math.h"
#include "base/transform.h"
#include "check.h"
#include "light/tree/light_bounds.h"
#include "render/light_rows.h"
#include "render/make_light.h"
#include "unit/light_kit.h"

#include <cmath>

namespace test_light_rows {

using meshes::Random;

namespace {

kernels::one::SampledLight centreOf(const LightRow& row, Vec3 p) {
    kernels::one::SampledLight out{};
    kernels::one::forLight(row.kind, [&]<class L>() {
        out = L(kernels::one::LightNumbers{row.numbers.data(), 1}).centre(light_kit::lane(p));
    });
    return out;
}

LightDesc someLight(Random& random) {
    LightDesc desc;
    desc.kind = static_cast<LightDesc::Kind>(random.below(6));
    const Transform place = Transform::translate(random.inBox(20)) *
                            Transform::rotate(random.direction(), random.uniform(0, 6)) *
                            Transform::scale(random.uniform(0.5, 2));
    desc.worldFromLight = place.rows();
    desc.color = {random.unit(), random.unit(), random.unit()};
    if (random.chance(0.3)) desc.attenuation = {random.unit(), random.unit(), random.unit()};
    if (random.chance(0.1)) desc.attenuation = {0, 0, random.uniform(0.1, 2)};
    desc.radius = random.chance(0.4) ? 0 : random.uniform(0.01, 1);
    if (desc.kind == LightDesc::Kind::Sphere) desc.radius = random.uniform(0.01, 1);
    desc.size = {random.uniform(0.1, 3), random.uniform(0.1, 3)};
    desc.coneAngleDeg = random.uniform(20, 170), desc.blend = random.uniform(0.2, 1);
    desc.cosineFalloff = random.chance(0.5);
    desc.angleDeg = random.chance(0.4) ? 0 : random.uniform(0.01, 90);
    return desc;
}

} // namespace

TEST(light_rows_are_the_lamps_of_the_description) {
    constexpr std::uint64_t kSeed = 5180;
    Random random(kSeed);
    int lit = 0;
    for (int i = 0; i < 3000; ++i) {
        const LightDesc desc = someLight(random);
        const SceneFrame frame{random.inBox(5),
                               std::ldexp(1.0, static_cast<int>(random.below(9)) - 6)};
        const auto light = makeLight(desc, frame);
        const LightRow row = lightRow(desc, frame);
        const Vec3 p = toFloat(random.inBox(3));
        const LightSample expected = light->centre(p);
        const light_kit::Sample s = light_kit::plain(centreOf(row, p));
        const float scale = max(expected.irradiance.r, s.irradiance.r);
        // Near the border of a cone smoothstep magnifies roundings of the cosine.
        const float slack = desc.kind == LightDesc::Kind::Spot ? 1e-3f : 1e-5f;
        CHECK_INFO(std::fabs(s.irradiance.r - expected.irradiance.r) <= slack * scale + 1e-12f,
                   "seed " << kSeed << " case " << i << " kind " << static_cast<int>(desc.kind)
                           << ": " << s.irradiance.r << ", today " << expected.irradiance.r);
        if (scale > 0) ++lit;
        const LightBounds bounds = boundsOf(row);
        CHECK(!bounds.isDark() && bounds.isDark() == light->isDark());
        CHECK(bounds.isDistant || !bounds.box.isEmpty());
    }
    CHECK_INFO(lit > 1500, lit);
}

TEST(light_rows_of_dark_lamps) {
    Random random(5181);
    for (int i = 0; i < 200; ++i) {
        LightDesc desc = someLight(random);
        const SceneFrame frame{{}, 1};
        if (i % 2 == 0)
            desc.color = {0, 0, 0};
        else if (desc.kind == LightDesc::Kind::Sphere)
            desc.radius = 0;
        else if (desc.kind == LightDesc::Kind::Rectangle || desc.kind == LightDesc::Kind::Disk)
            desc.size.y = 0;
        else
            continue;
        CHECK(boundsOf(lightRow(desc, frame)).isDark());
    }
}

} // namespace test_light_rows
