// T21: lamps with an area against closed forms. What a lamp's samples bring to a point of a plane,
// and the solid angle that it fills, are integrals with known values: Lambert's sum over the edges
// of a polygon (1760), the solid angle of a triangle (Van Oosterom and Strackee 1983), the sphere
// cut by the horizon.
#include "base/math.h"
#include "base/text.h"
#include "sample/dimensions.h"
#include "sample/sampler.h"
#include "sample/warp.h"
#include "verify/groups.h"
#include "verify/light_kit.h"

#include <algorithm>
#include <array>

namespace battery {

namespace {

constexpr std::array kKinds = {"rectangle", "disk", "ellipse", "sphere"};

// A lamp of radiance 1 over the plane z = 0, whose origin receives.
struct Case {
    std::size_t kind = 0;
    LightRow light;
    std::vector<Vec3d> outline; // flat lamps: an ellipse is a polygon of many corners
    Vec3d centre;
    double radius = 0; // sphere
    std::string text() const {
        return cat(kKinds[kind], " at ", centre.x, " ", centre.y, " ", centre.z);
    }
};

// What of a polygon is above z = 0 (Sutherland and Hodgman 1974).
std::vector<Vec3d> aboveHorizon(const std::vector<Vec3d>& corners) {
    std::vector<Vec3d> out;
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const Vec3d a = corners[i], b = corners[(i + 1) % corners.size()];
        if (a.z >= 0) out.push_back(a);
        if ((a.z >= 0) != (b.z >= 0)) out.push_back(a + (b - a) * (a.z / (a.z - b.z)));
    }
    return out;
}

double angleBetween(Vec3d a, Vec3d b) { return std::atan2(length(cross(a, b)), dot(a, b)); }

double polygonIrradiance(const std::vector<Vec3d>& corners) {
    double sum = 0;
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const Vec3d a = corners[i], b = corners[(i + 1) % corners.size()];
        const Vec3d normal = cross(a, b);
        if (length(normal) > 0) sum += angleBetween(a, b) * normal.z / length(normal);
    }
    return std::fabs(sum) / 2;
}

double polygonSolidAngle(const std::vector<Vec3d>& corners) {
    double sum = 0;
    const Vec3d a = normalize(corners[0]);
    for (std::size_t i = 1; i + 1 < corners.size(); ++i) {
        const Vec3d b = normalize(corners[i]), c = normalize(corners[i + 1]);
        sum += 2 * std::atan2(dot(a, cross(b, c)), 1 + dot(a, b) + dot(b, c) + dot(c, a));
    }
    return std::fabs(sum);
}

// Lagarde and de Rousiers 2014, "Moving Frostbite to PBR" 4.7.2, from Snyder 1996.
double sphereIrradiance(double cosine, double sin2) {
    if (cosine * cosine >= sin2) return cosine > 0 ? kPi * sin2 * cosine : 0;
    const double sine = std::sqrt(1 - cosine * cosine), x = std::sqrt(1 / sin2 - 1);
    const double y = -x * (cosine / sine), edge = sine * std::sqrt(1 - y * y);
    return (cosine * std::acos(y) - x * edge) * sin2 + std::atan(edge / x);
}

double trueIrradiance(const Case& c) {
    if (c.outline.empty())
        return sphereIrradiance(normalize(c.centre).z, sqr(c.radius) / dot(c.centre, c.centre));
    return polygonIrradiance(aboveHorizon(c.outline));
}
double trueSolidAngle(const Case& c) {
    if (!c.outline.empty()) return polygonSolidAngle(c.outline);
    const double sin2 = sqr(c.radius) / dot(c.centre, c.centre);
    return kTwoPi * sin2 / (1 + std::sqrt(1 - sin2));
}

bool isWhole(const Case& c) { // above the horizon
    if (c.outline.empty()) return c.centre.z > 1.01 * c.radius;
    return std::all_of(c.outline.begin(), c.outline.end(), [](Vec3d p) { return p.z > 0.01; });
}

// The numbers that the program sees are floats; the truth is about the same ones.
Vec3d asFloat(Vec3d v) { return toDouble(toFloat(v)); }

Case randomCase(meshes::Random& random, std::size_t kind) {
    for (;;) {
        Case c;
        c.kind = kind;
        c.centre = asFloat(random.direction() * random.logUniform(0.8, 8));
        if (kKinds[kind] == std::string_view("sphere")) {
            c.radius = static_cast<double>(static_cast<float>(random.logUniform(0.05, 0.7)));
            if (c.centre.z < -0.5 * c.radius) continue;
            c.light =
                lightRow(SphereRow{toFloat(c.centre), static_cast<float>(c.radius), Rgb{1, 1, 1}});
            return c;
        }
        const bool rectangle = kind == 0;
        const Vec3 normal = toFloat(random.direction());
        const Frame frame = frameAround(normal);
        const float a = static_cast<float>(random.logUniform(0.1, 1));
        const float b = kKinds[kind] == std::string_view("disk")
                            ? a
                            : static_cast<float>(random.logUniform(0.1, 1));
        const Vec3 halfX = frame.x * a, halfY = frame.y * b;
        // In front of the lamp, and not so near that a few samples bring nearly all of the light.
        if (-dot(toDouble(normal), c.centre) < 0.3 * length(c.centre)) continue;
        if (length(c.centre) < 2 * static_cast<double>(max(a, b))) continue;
        const int corners = rectangle ? 4 : 8192;
        for (int i = 0; i < corners; ++i) {
            const double turn = kTwoPi * (i + 0.5) / corners, size = rectangle ? std::sqrt(2.0) : 1;
            c.outline.push_back(c.centre + toDouble(halfX) * (size * std::cos(turn)) +
                                toDouble(halfY) * (size * std::sin(turn)));
        }
        if (aboveHorizon(c.outline).size() < 3) continue;
        const FlatRow row{toFloat(c.centre), halfX, halfY, normal, Rgb{1, 1, 1}};
        c.light = rectangle ? lightRow(RectangleRow{row}) : lightRow(DiskRow{row});
        return c;
    }
}

struct Sums {
    double irradiance = 0, irradiance2 = 0, solidAngle = 0, solidAngle2 = 0;
    void add(const LightRow& light, Vec2 u) {
        const light_kit::Sample s = light_kit::OneLight(light).sample({}, u); // at the origin
        const double whole = static_cast<double>(s.irradiance.g);
        const double received = whole * max(static_cast<double>(s.toLight.z), 0.0);
        irradiance += received, irradiance2 += received * received;
        solidAngle += whole, solidAngle2 += whole * whole;
    }
};

// How many standard errors the mean is away from the truth. Samples are floats: where they do not
// scatter (the solid angle of a sphere), what is left is their rounding.
double zScore(double sum, double sum2, double count, double truth) {
    const double mean = sum / count;
    const double sigma = std::sqrt(max(sum2 / count - mean * mean, 0.0) / count);
    return std::fabs(mean - truth) / (sigma + 3e-7 * truth);
}

// Always the same lamps; the effort is in the samples, which are a million each at effort 100.
Tally formFactors(const Effort& effort) {
    const int samples = static_cast<int>(clamp(1e4 * effort.factor, 1e3, 1e6));
    const Effort once{.factor = 1, .threads = effort.threads, .batch = effort.batch};
    return inBatches(once, 211, 60, [&](meshes::Random& random, Tally& tally) {
        const Case c = randomCase(random, random.below(kKinds.size()));
        Sums sums;
        for (int i = 0; i < samples; ++i) sums.add(c.light, random.square());
        const auto text = [&] { return cat(c.text(), ", ", samples, " samples"); };
        tally.cases += 2;
        tally.measure(zScore(sums.irradiance, sums.irradiance2, samples, trueIrradiance(c)),
                      [&] { return "irradiance of " + text(); });
        tally.measure(zScore(sums.solidAngle, sums.solidAngle2, samples, trueSolidAngle(c)),
                      [&] { return "solid angle of " + text(); });
    });
}

// The error of Sobol points over their number, as the slope of the line that fits best in double
// logarithmic scale. Root of the mean square over independent scramblings.
double slopeOf(const Case& c, meshes::Random& random) {
    constexpr int kFirst = 4, kLast = 11, kSeeds = 24; // powers of two of the numbers of samples
    const double truth = trueIrradiance(c);
    double n = 0, sx = 0, sy = 0, sxx = 0, sxy = 0;
    for (int power = kFirst; power <= kLast; ++power) {
        const int count = 1 << power;
        double squares = 0;
        for (int seed = 0; seed < kSeeds; ++seed) {
            const Sampler sampler(SamplerKind::Sobol, count, random.below(1u << 31));
            Sums sums;
            for (int i = 0; i < count; ++i)
                sums.add(c.light, sampler.get2D(1, static_cast<std::uint32_t>(i),
                                                dimension(0, BounceSlot::LightUv)));
            squares += sqr(sums.irradiance / count / truth - 1);
        }
        const double x = power, y = 0.5 * std::log2(squares / kSeeds);
        n += 1, sx += x, sy += y, sxx += x * x, sxy += x * y;
    }
    return (n * sxy - sx * sy) / (n * sxx - sx * sx);
}

Tally convergence(const Effort& effort) {
    return inBatches(effort, 212, 8, [](meshes::Random& random, Tally& tally) {
        const std::size_t kind = random.below(kKinds.size());
        Case c = randomCase(random, kind);
        while (!isWhole(c)) c = randomCase(random, kind);
        const double slope = slopeOf(c, random);
        ++tally.cases;
        tally.measure(std::exp2(slope), [&] { return cat("slope ", slope, ", ", c.text()); });
    });
}

constexpr double kHalvedEnough = 0.5358867312681466; // 2^-0.9

constexpr Row kLightsRows[] = {
    {"T21a", "lamps over a plane: irradiance and solid angle by formula", "sigma", 4, true,
     formFactors},
    {"T21b", "error left by twice the Sobol samples (slope -0.9: 0.536)", "of the error",
     kHalvedEnough, true, convergence},
};

} // namespace

std::span<const Row> lightRows() { return kLightsRows; }

} // namespace battery
