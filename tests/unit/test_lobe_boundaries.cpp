// The laws of boundaries against values known from elsewhere, and lobes that are nothing else:
// mirrors and smooth glass.
#include "check.h"
#include "material/energy.h"
#include "verify/lobe_kit.h"
#include "verify/meshes.h"

#include <cmath>

namespace test_lobe_boundaries {

namespace {

using namespace lobe_kit;
using namespace kernels::one;
using meshes::Random;

Floats3 above(Random& random) {
    const Vec3 d = toFloat(random.direction());
    return {d.x, d.y, std::fabs(d.z)};
}
Vec3d wide(const Floats3& v) { return {v.x.v, v.y.v, v.z.v}; }

} // namespace

TEST(lobe_boundaries_reflect_by_fresnel) {
    for (const float n : {1.1f, 1.33f, 1.5f, 2.4f}) {
        const double atNormal = std::pow((double{n} - 1) / (double{n} + 1), 2);
        CHECK_NEAR(boundaryAt(1.0f, 1 / n).reflected.v, atNormal, 1e-6);
        CHECK_NEAR(boundaryAt(1.0f, n).reflected.v, atNormal, 1e-6);
        CHECK_EQUAL(boundaryAt(0.0f, 1 / n).reflected.v, 1.0f);
        // Brewster's angle, tan = n, reflects none of the light polarised in the plane: half of
        // ((n^2 - 1) / (n^2 + 1))^2 is left.
        const double n2 = double{n} * double{n}, brewster = 1 / std::sqrt(1 + n2);
        const double across = (n2 - 1) / (n2 + 1);
        CHECK_NEAR(boundaryAt(static_cast<float>(brewster), 1 / n).reflected.v, across * across / 2,
                   1e-6);
        // Total internal reflection begins where sin = 1/n.
        const double critical = std::sqrt(1 - 1 / n2);
        const Boundary in = boundaryAt(static_cast<float>(critical * 0.999), n);
        CHECK_EQUAL(in.reflected.v, 1.0f);
        CHECK_EQUAL(in.cosOut.v, 0.0f);
        CHECK(boundaryAt(static_cast<float>(critical * 1.001), n).reflected.v < 1);
        // Reversible: the same part comes back along the refracted way.
        for (double angle = 0; angle < 1.55; angle += 0.05) {
            const double inside = std::asin(std::sin(angle) / static_cast<double>(n));
            CHECK_NEAR(boundaryAt(static_cast<float>(std::cos(angle)), 1 / n).reflected.v,
                       boundaryAt(static_cast<float>(std::cos(inside)), n).reflected.v, 5e-5);
        }
    }
    for (const float cosine : {1.0f, 0.3f, 1e-30f}) {
        CHECK_EQUAL(boundaryAt(cosine, 1.0f).reflected.v, 0.0f);
        CHECK_EQUAL(boundaryAt(cosine, 1.0f).cosOut.v, cosine);
    }
    // Schlick 1994, within 0 and 1 beyond both ends.
    CHECK(schlickPart(1.0f).v == 0 && schlickPart(0.0f).v == 1 && schlickPart(-0.1f).v == 1 &&
          schlickPart(1.1f).v == 0);
    CHECK_NEAR(schlickPart(0.5f).v, 1 / 32.0, 1e-8);
    // Over the hemisphere glass of 1.5 reflects 0.0918 from outside, 0.5964 from inside (Egan and
    // Hilgeman 1979).
    CHECK_NEAR(BoundarySlices(1 / 1.5f).mean().v, 0.0918, 4e-4);
    CHECK_NEAR(BoundarySlices(1.5f).mean().v, 0.5964, 2e-3);
}

// Mirrored and refracted directions, and the way back.
TEST(lobe_boundaries_send_by_snell) {
    Random random(93);
    for (int i = 0; i < check::scaled(2000); ++i) {
        const Floats3 v = above(random), h = normalize(above(random) + v);
        const Floats cosIn = dot(v, h);
        const Floats3 mirrored = mirroredBy(h, v, cosIn);
        CHECK_NEAR(dot(mirrored, h).v, cosIn.v, 1e-6);
        CHECK_NEAR(dot(mirrored, mirrored).v, 1, 2e-6);
        const float eta = i % 7 == 0 ? 1.0f : static_cast<float>(random.uniform(0.4, 2.4));
        const Boundary boundary = boundaryAt(cosIn, eta);
        // Snell: sines are as 1 to eta, and where that would be above 1 all is reflected.
        const Vec3d toEye = normalize(wide(v)), normal = normalize(wide(h));
        const Vec3d across = cross(toEye, normal);
        const double sine = static_cast<double>(eta) * length(across);
        if (std::fabs(sine - 1) > 1e-5) CHECK_EQUAL(boundary.reflected.v < 1, sine < 1);
        if (!(boundary.reflected.v < 1)) continue;
        const Floats3 sent = refractedBy(h, v, cosIn, boundary.cosOut, eta);
        CHECK_NEAR(dot(sent, sent).v, 1, 2e-5);
        CHECK_NEAR(dot(sent, h).v, -boundary.cosOut.v, 2e-6);
        const Vec3d dir = wide(sent);
        CHECK_NEAR(length(cross(dir, normal)), sine, 2e-6);
        CHECK_NEAR(dot(dir, across), 0, 1e-6); // in one plane, on the other side
        CHECK(dot(dir - normal * dot(dir, normal), toEye) <= 1e-6);
        if (eta == 1.0f) CHECK(length(dir + toEye) < 1e-6); // straight on
        // The same part is reflected on the way back.
        CHECK_NEAR(boundaryAt(boundary.cosOut, 1 / eta).reflected.v, boundary.reflected.v, 2e-4);
    }
}

TEST(lobe_boundaries_of_metal) {
    const Floats3 gold{0.9f, 0.6f, 0.3f}, tint{0.8f, 0.5f, 1.0f};
    const MetalFresnel metal(gold, tint);
    const auto schlick = [](double f0, double cosine) {
        return f0 + (1 - f0) * std::pow(1 - cosine, 5);
    };
    for (const double cosine : {1.0, 1.0 / 7, 0.0}) {
        const Floats3 f = metal.at(static_cast<float>(cosine));
        const double part = cosine == 1.0 / 7 ? 1 : 0; // the tint, at 82 degrees alone
        CHECK_NEAR(f.x.v, schlick(0.9, cosine) * (part != 0 ? 0.8 : 1), 1e-6);
        CHECK_NEAR(f.y.v, schlick(0.6, cosine) * (part != 0 ? 0.5 : 1), 1e-6);
        CHECK_NEAR(f.z.v, schlick(0.3, cosine), 1e-6);
    }
    double sum = 0;
    for (int i = 0; i < 1000; ++i)
        sum += static_cast<double>(metal.at(static_cast<float>(std::sqrt((i + 0.5) / 1000))).y.v);
    CHECK_NEAR(metal.mean().y.v, sum / 1000, 1e-4);
}

// Smooth lobes send light in one direction each: what goes there is all of it, or what Schlick's
// formula says.
TEST(lobe_boundaries_of_mirrors) {
    Case schlick = whiteCase(kindOf("schlick_mirror"));
    schlick.numbers[0] = 0.5f, schlick.numbers[1] = 0.25f, schlick.numbers[2] = 0;
    for (const double z : {1.0, 0.6, 1e-4}) {
        const Floats3 v = direction(z, 1);
        const auto isMirrored = [&](const LobeSample& s) {
            return s.single.v && s.pdf.v == 1 && s.toLight.x.v == -v.x.v &&
                   s.toLight.y.v == -v.y.v && s.toLight.z.v == v.z.v;
        };
        with(whiteCase(kindOf("mirror")), [&](const auto& lobe) {
            if constexpr (requires { lobe.sample(v, 0.5f, 0.5f, 0.5f); }) {
                const LobeSample s = lobe.sample(v, 0.5f, 0.3f, 0.7f);
                CHECK(isMirrored(s));
                CHECK(s.weight.x.v == 1 && s.weight.y.v == 1 && s.weight.z.v == 1);
            }
        });
        with(schlick, [&](const auto& lobe) {
            if constexpr (requires { lobe.sample(v, 0.5f, 0.5f, 0.5f); }) {
                const LobeSample s = lobe.sample(v, 0.5f, 0.3f, 0.7f);
                const double rise = std::pow(1 - z, 5); // grazing: white, whatever its colour
                CHECK(isMirrored(s));
                CHECK_NEAR(s.weight.x.v, 0.5 + 0.5 * rise, 1e-6);
                CHECK_NEAR(s.weight.y.v, 0.25 + 0.75 * rise, 1e-6);
                CHECK_NEAR(s.weight.z.v, rise, 1e-6);
            }
        });
    }
}

// All light goes through but for total internal reflection, which keeps all of it.
TEST(lobe_boundaries_of_refraction) {
    const Case c = whiteCase(kindOf("refraction"));
    const double critical = std::asin(1 / 1.5);
    for (const float eta : {1 / 1.5f, 1.5f, 1.0f})
        for (const double angle : {0.0, 0.3, critical - 1e-4, critical + 1e-4, 1.0, 1.5}) {
            const Refraction lobe(LobeNumbers{c.numbers.data(), 1, Floats(eta)});
            const Floats3 v = direction(std::cos(angle), 2);
            const double sine = static_cast<double>(eta) * std::sin(angle);
            const bool isTotal = sine > 1;
            const LobeSample through = lobe.branch(v, true, 0.5f, 0.5f),
                             back = lobe.branch(v, false, 0.5f, 0.5f);
            CHECK_EQUAL(through.pdf.v > 0, !isTotal);
            CHECK_EQUAL(largest(back.weight), isTotal ? 1.0 : 0.0);
            for (const float pick : {0.0f, 0.5f, 0.9999999f}) {
                const LobeSample s = lobe.sample(v, pick, 0.5f, 0.5f);
                CHECK(s.single.v && s.pdf.v == 1 && s.weight.y.v == 1);
                CHECK_EQUAL(s.toLight.z.v < 0, !isTotal);
                if (isTotal)
                    CHECK(length(wide(s.toLight) - Vec3d{-v.x.v, -v.y.v, v.z.v}) < 1e-6);
                else
                    CHECK_NEAR(std::hypot(s.toLight.x.v, s.toLight.y.v), sine, 1e-6);
                if (eta == 1.0f) CHECK(length(wide(s.toLight) + wide(v)) < 1e-6);
            }
        }
}

} // namespace test_lobe_boundaries
