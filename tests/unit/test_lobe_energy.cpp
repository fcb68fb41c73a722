// What lobes do with the light of a white sky: no more than all of it, and as much as they say.
#include "check.h"
#include "unit/lobe_kit.h"

#include <cstdio>
#include <cstdlib>

namespace test_lobe_energy {

namespace {

using namespace lobe_kit;

constexpr double kCosines[] = {0.02, 0.15, 0.5, 0.8, 1.0};

// The mean of the weights of samples at the places of a lattice, which is the same integral.
double sampled(const Case& c, double cosEye) {
    constexpr int kCount = 3000;
    double sum = 0;
    with(c, [&](const auto& lobe) {
        if constexpr (requires { lobe.sample(Floats3{}, Floats{}, Floats{}, Floats{}); })
            for (int i = 0; i < kCount; ++i) {
                // Multiples of the powers of the inverse of 1.2207..., whose fourth power is 1 more.
                const auto place = [&](double step) {
                    const double at = 0.5 + i * step;
                    return Floats(static_cast<float>(at - std::floor(at)));
                };
                const LobeSample s =
                    lobe.sample(direction(cosEye, 0.3), place(0.5497004779), place(0.8191725134),
                                place(0.6710436067));
                if (s.pdf.v > 0) sum += largest(s.weight) / kCount;
            }
    });
    return sum;
}

} // namespace

TEST(lobe_zz) {
    const char* only = std::getenv("LOBE");
    for (std::uint32_t kind = 0; kind < lobeTypes().size(); ++kind)
        for (const Case& c : casesOf(kind, 4)) {
            if (only && !c.is(only)) continue;
            for (const double cosEye : kCosines) {
                double sum = 0, albedo = 0, below = 0; int n = 0;
                const auto peaks = peaksOf(c, cosEye);
                with(c, [&](const auto& lobe) {
                    const Floats3 v = direction(cosEye, 0);
                    const auto f = [&](double z, double phi) { ++n;
                        return largest(lobe.eval(v, direction(z, phi)));
                    };
                    sum = overSphere(f, 4e-6, peaks);
                    albedo = largest(lobe.albedo(v));
                    below = largest(lobe.below(v));
                });
                std::printf("%s: cos %g quad %.5f sampled %.5f albedo %.5f below %.5f n %d\n", shown(c).c_str(), cosEye, sum, sampled(c, cosEye), albedo, below, n);
            }
        }
}

} // namespace test_lobe_energy
