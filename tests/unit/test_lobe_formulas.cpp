// The formulas of lobes against values known from elsewhere: GGX, highlights, diffuse light,
// layers. Laws of boundaries: test_lobe_boundaries.cpp; eye and light exchanged: raytracer verify
// T20.
#include "check.h"
#include "verify/lobe_kit.h"

#include <cmath>
#include <random>

namespace test_lobe_formulas {

namespace {

using namespace lobe_kit;
using namespace kernels::one;

constexpr unsigned kSeed = 52;

class Draw {
public:
    float unit() { return static_cast<float>(random_() >> 40) * 0x1p-24f; }
    Floats3 above() {
        const double z = 1e-3 + 0.999 * static_cast<double>(unit());
        return direction(z, 2 * kPi * static_cast<double>(unit()));
    }

private:
    std::mt19937_64 random_{kSeed};
};

bool isNear(double a, double b, double relative) {
    return std::fabs(a - b) <= relative * std::max(std::fabs(a), std::fabs(b));
}
Vec3d wide(const Floats3& v) { return {v.x.v, v.y.v, v.z.v}; }
Floats3 below(const Floats3& v) { return {v.x, v.y, -v.z.v}; }

} // namespace

// The projected area of all facets is the surface's, for any alpha.
TEST(lobe_formulas_of_facets_sum_up) {
    for (const float roughness : {0.04f, 0.1f, 0.3f, 0.6f, 1.0f})
        for (const float anisotropy : {0.0f, 0.9f, -0.9f}) {
            const Ggx facets(roughness, anisotropy, 0.0f);
            const double width = static_cast<double>(std::min(facets.x.v, facets.y.v));
            const std::vector<Peak> peaks{{1, 0, width}};
            const auto f = [&](double z, double phi) {
                return static_cast<double>(facets.density(direction(z, phi)).v) * z;
            };
            CHECK_NEAR(2 * Integral(f, 1e-6, peaks).over(0, 1, 0, kPi), 1, 3e-4);
            const float aspect = facets.x.v / facets.y.v;
            if (roughness < 0.5f)
                CHECK_NEAR(aspect, anisotropy > 0 ? 1 / 0.19 : anisotropy < 0 ? 0.19 : 1, 1e-4);
        }
    CHECK(Ggx(1e-3f).smooth.v && !Ggx(1.1e-3f).smooth.v);
    CHECK(Ggx(1e-3f, 1.0f, 0.0f).smooth.v);
    // A quarter of a turn changes the axes.
    const Floats3 turned = Ggx(0.5f, 0.5f, 0.25f).inward({0.6f, 0.0f, 0.8f});
    CHECK_NEAR(turned.x.v, 0, 1e-7);
    CHECK_NEAR(turned.y.v, -0.6, 1e-6);
}

// What facets send from one to the other: F Emean / (1 - F (1 - Emean)) of what they lose. The
// tables say what one bounce is, by the integral of the same facets, and its mean over the
// hemisphere.
TEST(lobe_formulas_of_energy) {
    for (const float roughness : {0.3f, 0.6f, 1.0f}) {
        const Ggx facets(roughness);
        const auto energyAt = [&](double z) {
            return FacetEnergy(facets, direction(z, 0), roughness);
        };
        for (const double z : {0.05, 0.4, 1.0}) {
            const Floats3 toEye = direction(z, 0);
            const std::vector<Peak> peaks{{z, kPi, double{facets.x.v}}};
            const auto f = [&](double height, double phi) {
                const FacetPair pair = facets.pairOf(toEye, direction(height, phi), 1.0f);
                return height > 0 ? static_cast<double>(pair.pdf.v * pair.ratio.v) : 0;
            };
            CHECK_NEAR(energyAt(z).all().v, overHeights(f, 1e-6, peaks, {0, 0.01, 0.06, 0.3, 1}),
                       0.005);
        }
        constexpr int kSteps = 200;
        double mean = 0;
        for (int i = 0; i < kSteps; ++i)
            mean += static_cast<double>(energyAt(std::sqrt((i + 0.5) / kSteps)).all().v) / kSteps;
        const FacetEnergy energy = energyAt(0.4);
        CHECK_NEAR(energy.mean().v, mean, 0.003);
        const double e = static_cast<double>(energy.all().v);
        const Floats3 scale = energy.scale({1.0f, 0.5f, 0.0f});
        CHECK_NEAR(scale.x.v, 1 / e, 1e-5);
        CHECK_NEAR(scale.y.v, 1 + 0.5 * mean / (1 - 0.5 * (1 - mean)) * (1 - e) / e, 0.01);
        CHECK_EQUAL(scale.z.v, 1.0f);
    }
}

// What pairs of directions scatter by, against the textbook's formulas in double, also near the
// horizon. The half vector of floats is off by 1e-7, which is 1e-7 / alpha of the width.
TEST(lobe_formulas_of_facets_in_double) {
    Draw draw;
    int pairs = 0;
    for (int i = 0; i < check::scaled(20000); ++i) {
        const float roughness = 0.032f + 0.968f * draw.unit();
        const Ggx facets(roughness, 2 * draw.unit() - 1, 0.0f);
        const float eta = draw.unit() < 0.5f ? 1.5f : 0.6f;
        Floats3 v = draw.above();
        if (i % 2 == 0)
            v = direction(1e-4 + 1e-2 * static_cast<double>(draw.unit()),
                          6 * static_cast<double>(draw.unit()));
        const Floats3 h = facets.visibleNormal(v, draw.unit(), draw.unit());
        const Floats cosIn = dot(v, h);
        const Boundary boundary = boundaryAt(cosIn, eta);
        const bool transmits = draw.unit() < 0.5f && boundary.reflected.v < 1;
        const Floats3 l = normalize(transmits ? refractedBy(h, v, cosIn, boundary.cosOut, eta)
                                              : mirroredBy(h, v, cosIn));
        const FacetPair pair = facets.pairOf(v, l, eta);
        if ((l.z.v < 0) != transmits) continue;
        ++pairs;

        const double ax = double{facets.x.v}, ay = double{facets.y.v}, e = double{eta};
        struct V {
            double x, y, z;
        };
        const auto wide = [](const Floats3& a) { return V{a.x.v, a.y.v, a.z.v}; };
        const V a = wide(v), b = wide(l);
        const double s = transmits ? e : 1;
        V half{s * a.x + b.x, s * a.y + b.y, s * a.z + b.z};
        const double length = std::sqrt(half.x * half.x + half.y * half.y + half.z * half.z);
        const double scale = (half.z < 0 ? -1 : 1) / length;
        half = {half.x * scale, half.y * scale, half.z * scale};
        const double in = a.x * half.x + a.y * half.y + a.z * half.z;
        const double out = std::fabs(b.x * half.x + b.y * half.y + b.z * half.z);
        const auto lambda = [&](const V& w) {
            return 0.5 *
                   (std::sqrt(1 + (ax * ax * w.x * w.x + ay * ay * w.y * w.y) / (w.z * w.z)) - 1);
        };
        const double q =
            half.x * half.x / (ax * ax) + half.y * half.y / (ay * ay) + half.z * half.z;
        const double d = 1 / (kPi * ax * ay * q * q), one = 1 / (1 + lambda(a));
        const double both = 1 / (1 + lambda(a) + lambda(b));
        const double seen = one * in * d / a.z; // the density of visible normals
        const double spread = transmits ? out / (length * length) : 1 / (4 * in);
        const double bound = 1e-4 + 3e-6 / std::min(ax, ay);
        CHECK_INFO(isNear(pair.pdf.v, seen * spread, bound),
                   pair.pdf.v << " " << seen * spread << " alpha " << ax << " " << ay);
        CHECK_INFO(isNear(pair.ratio.v, both / one, 1e-4), pair.ratio.v << " " << both / one);
        CHECK_NEAR(pair.cosIn.v, in, 1e-5);
    }
    CHECK(pairs > 12000);
}

// Highlights in double, without what is behind the surface. Cosines of floats are off by 2e-7, and
// powers multiply that by their exponent.
TEST(lobe_formulas_of_highlights) {
    Draw draw;
    struct Power {
        double cosine, scale;
    };
    const std::pair<const char*, Power (*)(Vec3d, Vec3d, double)> models[] = {
        {"blinn",
         [](Vec3d v, Vec3d l, double) -> Power {
             return {normalize(v + l).z, 1};
         }},
        {"phong",
         [](Vec3d v, Vec3d l, double) -> Power {
             return {2 * v.z * l.z - dot(v, l), 1};
         }},
        {"ashikhmin", [](Vec3d v, Vec3d l, double exponent) -> Power {
             const Vec3d h = normalize(v + l);
             return {h.z, (exponent + 1) / (8 * kPi) * l.z / (dot(h, l) * std::max(v.z, l.z))};
         }}};
    for (const auto& [name, power] : models)
        for (Case& c : casesOf(kindOf(name))) {
            const double exponent = static_cast<double>(c.numbers[0]);
            for (int i = 0; i < check::scaled(300); ++i) {
                const Floats3 v = draw.above();
                Floats3 l = draw.above();
                if (i % 3 == 0) l = normalize(mirroredAtZ(v) + l * 0.1f);
                const Power of = power(normalize(wide(v)), normalize(wide(l)), exponent);
                if (std::fabs(of.cosine) < 1e-6) continue;
                const double base = std::max(of.cosine, 0.0);
                const double expected = base > 0 ? of.scale * std::pow(base, exponent) : 0;
                const double slack = base > 0 ? 1e-5 + 3e-7 * exponent / base : 0;
                with(c, [&](const auto& lobe) {
                    const double here = largest(lobe.eval(v, l));
                    CHECK_INFO(std::fabs(here - expected) <= slack * expected + 1e-12,
                               shown(c) << ": " << here << ", expected " << expected);
                    CHECK(largest(lobe.eval(v, below(l))) == 0);
                });
            }
            if (exponent > 0) { // straight into the mirrored direction
                const Floats3 v = direction(0.7, 1);
                with(c, [&](const auto& lobe) {
                    const double most = c.is("ashikhmin") ? (exponent + 1) / (8 * kPi * 0.7) : 1;
                    CHECK_NEAR(largest(lobe.eval(v, mirroredAtZ(v))) / most, 1,
                               1e-5 + 3e-7 * exponent);
                });
            }
        }
}

// Lambert: 1 / pi times the cosine, and nothing from behind.
TEST(lobe_formulas_of_diffuse_light) {
    Draw draw;
    with(whiteCase(kindOf("diffuse")), [&](const auto& lobe) {
        for (int i = 0; i < 200; ++i) {
            const Floats3 v = draw.above(), l = draw.above();
            CHECK_NEAR(largest(lobe.eval(v, l)), static_cast<double>(l.z.v) * kInvPi, 1e-7);
            CHECK_EQUAL(largest(lobe.eval(v, below(l))), 0.0);
        }
        CHECK_EQUAL(largest(lobe.eval({0.0f, 0.0f, 1.0f}, {1.0f, 0.0f, 0.0f})), 0.0);
    });
}

// Rough diffuse: Fujii's integral in closed form, as Cycles has it, which the lobe has as a fit.
TEST(lobe_formulas_of_rough_diffuse) {
    for (const float sigma : {0.0f, 0.3f, 1.0f})
        for (const double z : {0.01, 0.2, 0.5, 0.9, 1.0}) {
            Case c = whiteCase(kindOf("oren_nayar"));
            *c.number("roughness") = sigma;
            const double sine = std::sqrt(1 - z * z), s = double{sigma};
            const double g = sine * (std::acos(z) - 2.0 / 3 - sine * z) +
                             2.0 / 3 * (sine / z) * (1 - sine * sine * sine);
            const double a = 1 / (kPi + s * (kPi / 2 - 2.0 / 3)), b = s * a;
            const double once = a * kPi + b * g, mean = a * kPi + (2 * kPi - 5.6) / 3 * b;
            for (const double color : {0.2, 1.0}) {
                c.numbers[0] = c.numbers[1] = c.numbers[2] = static_cast<float>(color);
                const double later = color * color * mean * (1 - once) / (1 - color * (1 - mean));
                with(c, [&](const auto& lobe) {
                    CHECK_NEAR(largest(lobe.albedo(direction(z, 0))), color * once + later, 1.5e-3);
                });
            }
        }
    // Without roughness it is Lambert's.
    Case c = whiteCase(kindOf("oren_nayar"));
    with(c, [&](const auto& lobe) {
        CHECK_NEAR(largest(lobe.eval(direction(0.3, 0), direction(0.7, 2))), 0.7 * kInvPi, 1e-7);
    });
}

// The levels of Principled's specular: 0.5 is the index itself, 0 nothing, and F0 is in proportion.
TEST(lobe_formulas_of_layers) {
    Case c = whiteCase(kindOf("glossy_dielectric"));
    *c.number("roughness") = 0;
    const auto at = [&](double cosine) {
        Floats3 f{};
        with(c, [&](const auto& lobe) { f = lobe.albedo(direction(cosine, 0)); });
        return f;
    };
    CHECK_NEAR(at(1).x.v, 0.04, 1e-6);
    CHECK_NEAR(at(0.3).x.v, boundaryAt(0.3f, 1 / 1.5f).reflected.v, 1e-6);
    *c.number("specular") = 0.25f;
    CHECK_NEAR(at(1).x.v, 0.02, 1e-6);
    *c.number("specular") = 0;
    CHECK_EQUAL(at(0.3).x.v, 0.0f);
    *c.number("specular") = 0.5f;
    c.number("tint")[1] = 0.5f;
    CHECK_NEAR(at(1).y.v, 0.02, 1e-6);
    CHECK_NEAR(at(1e-4).y.v, 1, 1e-3); // grazing light stays white
    // A schlick_mirror of that colour is near it.
    Case schlick = whiteCase(kindOf("schlick_mirror"));
    schlick.numbers[0] = schlick.numbers[1] = schlick.numbers[2] = 0.04f;
    with(schlick, [&](const auto& lobe) {
        CHECK_NEAR(lobe.albedo(direction(1, 0)).x.v, 0.04, 1e-7);
        CHECK_NEAR(lobe.albedo(direction(0.3, 0)).x.v, 0.04 + 0.96 * std::pow(0.7, 5), 1e-6);
    });
}

// Cloth shines at the edge, and more of it the rougher it is, as in the figures of Zeltner et al.
TEST(lobe_formulas_of_sheen) {
    Case c = whiteCase(kindOf("sheen"));
    for (const float roughness : {0.0f, 0.1f, 0.3f, 0.5f, 0.8f, 1.0f}) {
        *c.number("roughness") = roughness;
        with(c, [&](const auto& lobe) {
            double before = 1;
            for (const double z : {0.05, 0.2, 0.4, 0.6, 0.8, 1.0}) {
                const double albedo = largest(lobe.albedo(direction(z, 0)));
                CHECK(albedo >= 0 && albedo <= before + 0.01);
                before = albedo;
            }
            if (roughness == 0.5f) {
                // Back to where the light comes from rather than across.
                const Floats3 v = direction(0.5, 0);
                CHECK(largest(lobe.eval(v, v)) > 1.2 * largest(lobe.eval(v, direction(0.5, kPi))));
            }
        });
    }
}

// An eye behind the surface, as points have it that are lit on the other side, and equal media: no
// lobe answers with what is no number, so that the others beside it keep their light.
TEST(lobe_formulas_are_numbers_from_behind) {
    using namespace kernels::one;
    for (std::uint32_t kind = 0; kind < lobeTypes().size(); ++kind)
        for (const float rough : {0.0f, 0.2f, 1.0f})
            for (const float eta : {0.6f, 1.0f, 1.6f})
                for (const float z : {-1.0f, -0.3f, 0.0f, 0.3f}) {
                    alignas(64) float numbers[kLobeNumbers] = {};
                    std::size_t at = 0;
                    for (const LobeField& field : lobeTypes()[kind].fields)
                        for (int c = 0; c < field.count; ++c)
                            numbers[at++] = field.name == std::string_view("roughness")
                                                ? rough
                                                : field.start[c];
                    const Floats3 eye{std::sqrt(1 - z * z), 0.0f, z}, light{0.0f, 0.6f, 0.8f};
                    forLobe(static_cast<std::uint8_t>(kind), [&]<class L> {
                        const Floats3 f = L(LobeNumbers{numbers, 1, Floats(eta)}).eval(eye, light);
                        CHECK_INFO(std::isfinite(f.x.v + f.y.v + f.z.v),
                                   lobeTypes()[kind].name << " roughness " << rough << " eta "
                                                          << eta << " eye " << z);
                    });
                }
}

} // namespace test_lobe_formulas
