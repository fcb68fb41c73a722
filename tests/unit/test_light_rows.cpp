// Lights of a description as numbers in lanes: in any frame they give what the description says.
#include "base/math.h"
#include "base/transform.h"
#include "check.h"
#include "light/tree/light_tree.h"
#include "scene/light_rows.h"
#include "verify/light_kit.h"

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
    if (random.chance(0.3)) desc.spreadDeg = random.uniform(20, 170);
    return desc;
}

// What a surface that faces the lamp's centre gets of it, in the units of the description: its part
// of what it gives straight ahead, and that.
struct Light {
    double part, most;
};
Light lightAt(const LightDesc& desc, Vec3d p) {
    const Transform place = Transform::fromRows(desc.worldFromLight);
    const Vec3d d = place.point({}) - p, axis = normalize(place.vector({0, 0, -1}));
    const double far = length(d), cosine = -dot(d, axis) / far;
    const auto flat = [&](double shape) -> Light {
        const double area = shape * length(place.vector({desc.size.x, 0, 0})) *
                            length(place.vector({0, desc.size.y, 0}));
        const double most = desc.color.r * area / (far * far), half = radians(desc.spreadDeg / 2);
        if (cosine <= 0) return {0, most};
        if (desc.spreadDeg == 180) return {cosine, most};
        // Cycles: it falls with the tangent of the angle, and the power stays.
        const double tangent = std::sqrt(1 - cosine * cosine) / cosine;
        return {cosine * max(1 - tangent / std::tan(half), 0.0),
                most * std::tan(half) / (std::tan(half) - half)};
    };
    const Vec3d fade = desc.attenuation;
    const double round = desc.color.r / (fade.x * far * far + fade.y * far + fade.z);
    switch (desc.kind) {
    case LightDesc::Kind::Point: return {1, round};
    case LightDesc::Kind::Spot: {
        const double edge = std::cos(radians(desc.coneAngleDeg / 2));
        const double x = clamp((cosine - edge) / ((1 - edge) * desc.blend), 0.0, 1.0);
        return {x * x * (3 - 2 * x) * (desc.cosineFalloff ? max(cosine, 0.0) : 1), round};
    }
    case LightDesc::Kind::Sun: return {1, desc.color.r};
    case LightDesc::Kind::Rectangle: return flat(1);
    case LightDesc::Kind::Disk: return flat(kPi / 4);
    case LightDesc::Kind::Sphere: break;
    }
    const double ratio2 = sqr(desc.radius * length(place.vector({1, 0, 0})) / far);
    return {1, desc.color.r * kPi * (ratio2 < 1 ? ratio2 : 4)}; // inside it is all around
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
        const LightRow row = lightRow(desc, frame);
        const Vec3 p = toFloat(random.inBox(3));
        const Vec3d from = toDouble(p) - frame.placed(desc.worldFromLight).point({});
        const Light expected = lightAt(desc, frame.worldPoint(toDouble(p)));
        const light_kit::Sample s = light_kit::plain(centreOf(row, p));
        // A rounding of the lamp's place is a part of its distance, and twice as much of the light;
        // smoothstep magnifies those of the cosine by 3 / 2 of what the soft part of the cone is.
        const double reach = length(from), place = max(reach, 200.0) * 0x1p-24 / reach;
        const double slack = desc.kind == LightDesc::Kind::Spot ? 1000 : 10;
        CHECK_INFO(std::fabs(static_cast<double>(s.irradiance.r) - expected.part * expected.most) <=
                       slack * place * expected.most,
                   "seed " << kSeed << " case " << i << " kind " << static_cast<int>(desc.kind)
                           << ": " << s.irradiance.r << ", expected "
                           << expected.part * expected.most);
        if (expected.part > 0.01) ++lit;
        const LightBounds bounds = boundsOf(row);
        CHECK(!bounds.isDark());
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
