// T19: light through glass in water in ice. Along a ray through balls about one centre, ior *
// radius
// * sin(angle) stays the same (Bouguer 1729), so that every angle at every face is known, and with
// Fresnel's formulas all of the light that arrives. The eye stands in a ball of its own that the
// ray leaves last: a ray that has forgotten to leave one of the others is refracted and dimmed
// there by the wrong amount.
#include "base/math.h"
#include "base/text.h"
#include "verify/groups.h"
#include "verify/scene_trials.h"

#include <optional>

namespace battery {

namespace {

// Balls about one centre, each inside of the one before it. materials[k] fills ball k up to the
// next.
struct Nest {
    std::vector<double> iors; // of the materials
    std::vector<std::size_t> materials;
    std::vector<double> radii;
    double ior(std::size_t ball) const { return iors[materials[ball]]; }
};

// The first ball is of flint, which nothing else is made of: forgetting to leave what is inside of
// it shows as 2 % and more of the light.
Nest randomNest(meshes::Random& random, std::size_t balls, double thinnest, double thickest) {
    Nest nest{.iors = {2.0, 1.5, 1.33, 1.31, 1.0}, .materials = {0}, .radii = {1}};
    while (nest.radii.size() < balls) {
        nest.materials.push_back(1 + random.below(nest.iors.size() - 1));
        nest.radii.push_back(nest.radii.back() * (1 - random.uniform(thinnest, thickest)));
    }
    return nest;
}

double sqrtOneMinus(double sine) { return std::sqrt((1 - sine) * (1 + sine)); }

// Part of unpolarised light that gets through, from the amplitudes; sines of the two angles.
double throughFace(double sineIn, double sineOut, double iorIn, double iorOut) {
    const double a = sqrtOneMinus(sineIn), b = sqrtOneMinus(sineOut);
    const double s = (iorIn * a - iorOut * b) / (iorIn * a + iorOut * b);
    const double p = (iorIn * b - iorOut * a) / (iorIn * b + iorOut * a);
    return 1 - (s * s + p * p) / 2;
}

// What is left of the light of a white sky for an eye in ball `at` that looks along a ray with the
// given ior * radius * sine. Nothing for rays that stay inside for ever and for those that graze a
// face, where rounding decides which way they go and Fresnel's formula has no bound on its slope.
std::optional<double> light(const Nest& nest, std::size_t at, double constant, bool inward) {
    constexpr double kGrazing = 0.98;
    const auto grazes = [](double sine) { return sine > kGrazing && sine < 1 / kGrazing; };
    double left = 1;
    std::size_t ball = at;
    while (inward && ball + 1 < nest.radii.size()) {
        const double r = nest.radii[ball + 1];
        const double in = constant / (nest.ior(ball) * r),
                     out = constant / (nest.ior(ball + 1) * r);
        if (grazes(in) || grazes(out)) return {};
        if (in > 1 || out > 1) break; // passes by the ball, or is reflected by all of it
        left *= throughFace(in, out, nest.ior(ball), nest.ior(ball + 1));
        ++ball;
    }
    for (;; --ball) {
        const double iorOut = ball > 0 ? nest.ior(ball - 1) : 1;
        const double in = constant / (nest.ior(ball) * nest.radii[ball]);
        const double out = constant / (iorOut * nest.radii[ball]);
        if (grazes(in) || grazes(out) || in > 1 || out > 1) return {};
        left *= throughFace(in, out, nest.ior(ball), iorOut);
        if (ball == 0) return left;
    }
}

MaterialDesc clear(double ior) {
    MaterialDesc material;
    material.diffuse = {};
    material.transmission = {1, 1, 1};
    material.fresnel = MaterialDesc::Fresnel::Dielectric;
    material.ior = ior;
    return material;
}

ObjectDesc ball(Vec3d centre, double radius, Handle material) {
    ObjectDesc object;
    object.radius = radius;
    object.materials = {material};
    object.worldFromObject = {Transform::translate(centre).rows()};
    return object;
}

// A white sky, and a camera that loses no light by ending rays early.
SceneDesc underWhiteSky(int pixels, double lensMm, Vec3d eye, Vec3d target, Vec3d up) {
    SceneDesc desc;
    desc.world.background = {1, 1, 1};
    SettingsDesc& settings = desc.settings;
    settings.width = settings.height = pixels;
    settings.samplesPerPixel = 1;
    settings.jitter = false;
    settings.filter = SettingsDesc::Filter::Box;
    settings.filterWidth = 1;
    CameraDesc& camera = desc.cameras.emplace_back();
    camera.lensMm = lensMm;
    camera.worldFromCamera = {Transform::lookAt(eye, target, up).rows()};
    return desc;
}

void rayThrough(const Nest& nest, meshes::Random& random, Tally& tally) {
    const std::size_t at = random.below(nest.radii.size());
    const double inner = at + 1 < nest.radii.size() ? nest.radii[at + 1] : 0;
    const double height = inner + (nest.radii[at] - inner) * random.uniform(0.05, 0.95);
    const Vec3d place = random.direction() * height, dir = random.direction();
    const double constant = nest.ior(at) * length(cross(place, dir));
    const auto wanted = light(nest, at, constant, dot(place, dir) < 0);
    if (!wanted) return;

    const Vec3d centre = random.inBox(10), eye = centre + place;
    SceneDesc desc =
        underWhiteSky(1, 50, eye, eye + dir, normalize(cross(dir, random.direction())));
    desc.settings.maxDepth = static_cast<int>(4 * nest.radii.size());
    desc.settings.cutoff = 0;
    for (const double ior : nest.iors) desc.materials.push_back(clear(ior));
    for (std::size_t k = 0; k < nest.radii.size(); ++k)
        desc.objects.push_back(ball(centre, nest.radii[k], static_cast<Handle>(nest.materials[k])));
    const double found = static_cast<double>(scenes::render(desc).color.pixel(0, 0).g);
    const auto text = [&] {
        return cat("eye in ball ", at, " of ", nest.radii.size(), ", light ", found, ", wanted ",
                   *wanted);
    };
    ++tally.cases;
    if (found > 1 + 1e-5) tally.fail(text);
    tally.measure(std::fabs(found / *wanted - 1), text);
}

Tally fewBalls(const Effort& effort) {
    return inBatches(effort, 191, 40, [](meshes::Random& random, Tally& tally) {
        for (int i = 0; i < 100; ++i)
            rayThrough(randomNest(random, 1 + random.below(6), 0.05, 0.4), random, tally);
    });
}

Tally manyBalls(const Effort& effort) {
    return inBatches(effort, 192, 20, [](meshes::Random& random, Tally& tally) {
        for (int i = 0; i < 20; ++i) rayThrough(randomNest(random, 64, 0.02, 0.06), random, tally);
    });
}

// Ice in water in glass with all their reflections, seen from outside and from the water: white,
// since nothing absorbs. All of the water is nearer to the middle than 1 / 1.5 of the glass, so
// that no light is caught by total reflection for longer than a tree of rays can follow.
Tally furnace(const Effort& effort) {
    constexpr int kPixels = 12;
    return inBatches(effort, 193, 12, [](meshes::Random& random, Tally& tally) {
        const bool outside = random.chance(0.5);
        const Vec3d eye = random.direction() * (outside ? 3.0 : 0.45);
        const Vec3d target = random.inBox(0.2);
        SceneDesc desc = underWhiteSky(kPixels, outside ? 50 : 20, eye, target,
                                       normalize(cross(target - eye, random.direction())));
        // Each branch of the tree that ends early takes its weight off the mean.
        desc.settings.cutoff = 1e-5;
        desc.settings.maxDepth = 100;
        for (const double ior : {1.5, 1.33, 1.31}) {
            desc.materials.push_back(clear(ior));
            desc.materials.back().mirror = {1, 1, 1};
        }
        desc.objects = {ball({}, 1, 0), ball(random.inBox(0.03), 0.6, 1),
                        ball(random.inBox(0.05), random.uniform(0.1, 0.3), 2)};
        const Image image = scenes::render(desc).color;
        double sum = 0;
        for (const Rgb& pixel : image.pixels()) {
            const double value = static_cast<double>(pixel.g);
            sum += value;
            if (!(value <= 1 + 1e-5)) tally.fail([&] { return cat("a path brings ", value); });
        }
        constexpr std::uint64_t kCount = std::uint64_t{kPixels} * kPixels;
        const auto count = static_cast<double>(kCount);
        tally.cases += kCount;
        tally.measure(std::fabs(sum / count - 1), [&] {
            return cat("mean ", sum / count, ", eye ", outside ? "outside" : "in the water");
        });
    });
}

constexpr Row kMediaRows[] = {
    {"T19a", "light through nested balls, eye in any, against Fresnel", "of the light", 0.005, true,
     fewBalls},
    {"T19b", "the same through 64 balls inside of each other", "of the light", 0.005, true,
     manyBalls},
    {"T19c", "white sky through ice in water in glass: the mean is white", "off white", 0.005, true,
     furnace},
};

} // namespace

std::span<const Row> mediaRows() { return kMediaRows; }

} // namespace battery
