// Samples of branches of lobes, and of smooth glass. That samples have their density, and weights
// of eval() over it: raytracer verify T22.
#include "check.h"
#include "verify/lobe_kit.h"

#include <cmath>

namespace test_lobe_sampling {

namespace {

using namespace lobe_kit;

bool isNear(const Floats3& a, const Floats3& b, float relative) {
    const auto near = [&](float x, float y) {
        return std::fabs(x - y) <= relative * std::max(std::fabs(x), std::fabs(y));
    };
    return near(a.x.v, b.x.v) && near(a.y.v, b.y.v) && near(a.z.v, b.z.v);
}
} // namespace

// branch() is sample() without the choice: together they send what all samples of one facet do.
TEST(lobe_sampling_branches) {
    meshes::Random random(51);
    const auto unit = [&] { return Floats(random.square().x); };
    const std::uint32_t kind = kindOf("dielectric");
    for (int round = 0; round < check::scaled(5000); ++round) {
        const Case c = anyCase(kind, random);
        const Floats3 toEye = direction(random.uniform(1e-3, 1), random.uniform(0, kTwoPi));
        const Floats pick = unit(), u = unit(), v = unit();
        const kernels::one::Dielectric lobe(LobeNumbers{c.numbers.data(), 1, Floats(c.eta)});
        const LobeSample s = lobe.sample(toEye, pick, u, v);
        const LobeSample both[] = {lobe.branch(toEye, false, u, v), lobe.branch(toEye, true, u, v)};
        for (const bool transmits : {false, true})
            if (both[transmits].pdf.v > 0) CHECK((both[transmits].toLight.z.v < 0) == transmits);
        if (s.pdf.v > 0) {
            const LobeSample& same = both[s.toLight.z.v < 0];
            CHECK(isNear(s.toLight, same.toLight, 0));
            CHECK_EQUAL(s.single.v, same.single.v);
            // The chance of the choice is in the pdf of one, not of the other.
            CHECK(isNear(s.weight * s.pdf, same.weight * same.pdf, 1e-5f));
            CHECK(s.pdf.v <= same.pdf.v * 1.00001f);
        }
    }
}

// Smooth glass: what is reflected and what is transmitted, where, and what is chosen how often.
TEST(lobe_sampling_of_smooth_glass) {
    Case c = whiteCase(kindOf("dielectric"));
    c.number("reflect_tint")[1] = 0.5f, c.number("transmit_tint")[2] = 0.25f;
    for (const float eta : {1 / 1.5f, 1.5f, 1.0f})
        for (const double cosEye : {0.1, 0.5, 0.9, 1.0}) {
            c.eta = eta;
            const kernels::one::Dielectric lobe(LobeNumbers{c.numbers.data(), 1, Floats(eta)});
            const Floats3 toEye = direction(cosEye, 1);
            const double cos2 = 1 - double{eta} * double{eta} * (1 - cosEye * cosEye);
            double f = 1;
            if (cos2 > 0) {
                const double e = double{eta}, out = std::sqrt(cos2);
                const double p = (cosEye - e * out) / (cosEye + e * out);
                const double s = (e * cosEye - out) / (e * cosEye + out);
                f = 0.5 * (p * p + s * s);
            }
            const LobeSample reflected = lobe.branch(toEye, false, 0.5f, 0.5f);
            CHECK(reflected.single.v);
            CHECK(isNear(reflected.toLight, Floats3{-toEye.x.v, -toEye.y.v, toEye.z.v}, 0));
            CHECK_NEAR(reflected.weight.x.v, f, 2e-6);
            // Total reflection keeps what would have gone through, too.
            CHECK_NEAR(reflected.weight.y.v, cos2 > 0 ? f / 2 : 1, 1e-6);
            const LobeSample sent = lobe.branch(toEye, true, 0.5f, 0.5f);
            CHECK_EQUAL(sent.pdf.v > 0, cos2 > 0);
            if (cos2 > 0) {
                CHECK_NEAR(sent.weight.x.v, 1 - f, 2e-6);
                CHECK_NEAR(sent.weight.z.v, (1 - f) / 4, 1e-6);
                CHECK_NEAR(sent.toLight.x.v, -eta * toEye.x.v, 1e-6);
                CHECK_NEAR(sent.toLight.z.v, -std::sqrt(cos2), 1e-6);
            }
            if (eta == 1)
                CHECK(isNear(sent.toLight, Floats3{-toEye.x.v, -toEye.y.v, -toEye.z.v}, 0));
            const LobeSample first = lobe.sample(toEye, 0.0f, 0.5f, 0.5f);
            const LobeSample last = lobe.sample(toEye, 0.9999999f, 0.5f, 0.5f);
            if (f > 1e-6) CHECK_NEAR(first.pdf.v, f, 2e-6);
            CHECK_NEAR(last.pdf.v, cos2 > 0 ? 1 - f : 1, 2e-6);
        }
}

} // namespace test_lobe_sampling
