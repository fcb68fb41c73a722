// T23: paths against closed forms. In a closed room whose walls all have albedo a and radiance 1
// the radiance is 1 / (1 - a) everywhere, whatever roulette, depth limits and weights of samples
// do; and rough plates under lamps of many sizes (Veach and Guibas 1995) show the same light by
// samples of the lamps, by samples of the lobes, and by both.
#include "base/math.h"
#include "base/text.h"
#include "verify/groups.h"
#include "verify/lobe_kit.h"
#include "verify/scene_trials.h"

#include <array>
#include <cmath>
#include <vector>

namespace battery {

namespace {

// A camera that loses no light, with samples that do not depend on each other.
SceneDesc pathScene(int pixels, int samples, int depth, Vec3d eye, Vec3d target) {
    SceneDesc desc;
    SettingsDesc& settings = desc.settings;
    settings.width = settings.height = pixels;
    settings.samplesPerPixel = samples;
    settings.integrator = IntegratorKind::Path;
    settings.maxDepth = settings.diffuseDepth = settings.glossyDepth = depth;
    settings.cutoff = 0;
    settings.sampler = SettingsDesc::Sampler::Random;
    settings.filter = SettingsDesc::Filter::Box;
    settings.filterWidth = 1;
    CameraDesc& camera = desc.cameras.emplace_back();
    camera.worldFromCamera = {Transform::lookAt(eye, target, {0, 0, 1}).rows()};
    return desc;
}
void add(SceneDesc& desc, ObjectDesc::Kind kind, const Transform& place,
         const MaterialDesc& material) {
    desc.materials.push_back(material);
    ObjectDesc& object = desc.objects.emplace_back();
    object.kind = kind;
    object.worldFromObject = {place.rows()};
    object.materials = {static_cast<Handle>(desc.materials.size() - 1)};
}
LobeDesc lobe(const char* name, double weight, double roughness = 0) {
    const lobe_kit::Case white = lobe_kit::whiteCase(lobe_kit::kindOf(name));
    LobeDesc desc;
    desc.kind = white.kind, desc.weight = {weight, weight, weight};
    std::copy(white.numbers.begin(), white.numbers.end(), desc.numbers.begin());
    lobe_kit::Case rough = white;
    if (const float* const at = rough.number("roughness"))
        desc.numbers[static_cast<std::size_t>(at - rough.numbers.data())] = roughness;
    return desc;
}

// Holds mean and error of each pixel, from pictures of several seeds.
struct Pixels {
    std::vector<double> sum, squares;
    int seeds = 0;

    void add(SceneDesc desc, std::uint32_t seed) {
        desc.settings.seed = seed;
        const Image image =
            scenes::render(desc, [](RenderSettings& settings) { settings.isa = &bestIsa(); }).color;
        sum.resize(image.pixels().size()), squares.resize(sum.size()), ++seeds;
        for (std::size_t i = 0; i < sum.size(); ++i) {
            const double value = static_cast<double>(image.pixels()[i].g);
            sum[i] += value, squares[i] += value * value;
        }
    }
    double mean(std::size_t i) const { return sum[i] / seeds; }
    // Returns the variance of a pixel between pictures of one seed each.
    double variance(std::size_t i) const {
        return max(squares[i] - sqr(sum[i]) / seeds, 0.0) / (seeds - 1);
    }
};

// Rooms of one material: a ball, whose wall is a lamp to be sampled, and a box, which is found by
// chance alone; with so few bounces that roulette has no say, and with all. Pixels have one mean,
// and, but for rooms of a box, about one variance.
Tally rooms(const Effort& effort) {
    return inBatches(effort, 231, 12, [](meshes::Random& random, Tally& tally) {
        constexpr std::array kAlbedos = {0.0, 0.5, 0.8};
        constexpr int kSeeds = 2, kPixels = 4;
        const double albedo = kAlbedos[random.below(kAlbedos.size())];
        // Single directions have no last ray, which others have for the light that their lamps are
        // weighted against.
        const bool isShort = random.chance(0.3), isMixed = !isShort && random.chance(0.5);
        const bool isBall = random.chance(0.5);
        MaterialDesc wall;
        wall.emission = {1, 1, 1};
        const double metal = isMixed ? albedo * random.uniform(0.1, 0.4) : 0;
        const double mirror = isMixed ? albedo * random.uniform(0.1, 0.4) : 0;
        const double rest = albedo - metal - mirror;
        wall.diffuse = {rest, rest, rest};
        if (isMixed)
            wall.lobes = {lobe("conductor", metal, random.uniform(0.2, 1)), lobe("mirror", mirror)};
        const int depth = isShort ? 2 : 200;
        const Vec3d eye = random.inBox(0.4);
        SceneDesc desc = pathScene(kPixels, 256, depth, eye, eye + random.direction());
        add(desc, isBall ? ObjectDesc::Kind::Sphere : ObjectDesc::Kind::Cube, {}, wall);
        Pixels found;
        for (int seed = 0; seed < kSeeds; ++seed) found.add(desc, random.below(1u << 31));
        const double wanted = (1 - (isShort ? std::pow(albedo, depth + 2) : 0)) / (1 - albedo);
        // Tables of white metal are right to 1 %.
        const double slack = 1e-5 * wanted + 0.01 * metal * wanted / (1 - albedo);
        double variance = 0, whole = 0;
        const auto count = static_cast<double>(found.sum.size());
        for (std::size_t i = 0; i < found.sum.size(); ++i)
            variance += found.variance(i) / count, whole += found.mean(i) / count;
        const auto compare = [&](double mean, double sigma, const char* what) {
            ++tally.cases;
            tally.measure(max(std::fabs(mean - wanted) - slack, 0.0) / (sigma + 1e-12), [&] {
                return cat(what, " of a ", isBall ? "ball" : "box", " of albedo ", albedo,
                           isMixed ? ", mixed" : "", isShort ? ", short" : "", ": ", mean,
                           ", wanted ", wanted, ", sigma ", sigma);
            });
        };
        compare(whole, std::sqrt(variance / kSeeds / count), "mean");
        for (std::size_t i = 0; i < found.sum.size(); ++i)
            compare(found.mean(i), std::sqrt(variance / kSeeds), "pixel");
    });
}

// A plate of rough metal that mirrors three balls to the camera. Lamps that cast no shadows are
// found by samples of lamps alone, shining balls of one side by lobes alone; nothing stands in
// between.
enum class By { Both, Whitted, Lamps, Lobes };
SceneDesc plate(double roughness, const std::array<double, 3>& radius, By by) {
    SceneDesc desc = pathScene(12, 16, 1, {0, -4, 2}, {0, 0, 0});
    if (by == By::Whitted) desc.settings.integrator = IntegratorKind::Whitted;
    desc.cameras[0].lensMm = 80;
    MaterialDesc metal;
    metal.diffuse = {}, metal.lobes = {lobe("conductor", 0.9, roughness)};
    add(desc, ObjectDesc::Kind::Plane, Transform::scale({20, 20, 1}), metal);
    for (std::size_t i = 0; i < radius.size(); ++i) {
        const double power = 0.5 / sqr(radius[i]);
        const Transform place = Transform::translate({1.2 * static_cast<double>(i) - 1.2, 3, 1.5});
        if (by == By::Lobes) {
            MaterialDesc shines;
            shines.diffuse = {}, shines.emission = {power, power, power};
            add(desc, ObjectDesc::Kind::Sphere, place * Transform::scale(radius[i]), shines);
            desc.objects.back().sides = ObjectDesc::Sides::Front;
            continue;
        }
        LightDesc& lamp = desc.lights.emplace_back();
        lamp.kind = LightDesc::Kind::Sphere, lamp.worldFromLight = place.rows();
        lamp.radius = radius[i], lamp.color = {power, power, power};
        lamp.shadows = by != By::Lamps;
    }
    return desc;
}

// Means of the four ways; the variance of paths that take both kinds of samples is at most twice
// that of the better kind alone, and less in most plates: six seeds know the variance of rare
// bright samples badly.
Tally lampsInPlates(const Effort& effort) {
    return inBatches(effort, 232, 5, [](meshes::Random& random, Tally& tally) {
        constexpr int kSeeds = 6;
        const double roughness = random.uniform(0.1, 0.45);
        std::array<double, 3> radius;
        for (double& r : radius) r = random.logUniform(0.1, 0.7);
        struct Way {
            double mean = 0, sigma2 = 0, variance = 0;
        };
        std::array<Way, 4> ways;
        for (const By by : {By::Both, By::Whitted, By::Lamps, By::Lobes}) {
            Pixels found;
            for (int seed = 0; seed < kSeeds; ++seed)
                found.add(plate(roughness, radius, by), random.below(1u << 31));
            Way& way = ways[static_cast<std::size_t>(by)];
            const auto count = static_cast<double>(found.sum.size());
            for (std::size_t i = 0; i < found.sum.size(); ++i)
                way.mean += found.mean(i) / count, way.variance += found.variance(i) / count;
            way.sigma2 = way.variance / kSeeds / count;
        }
        const auto text = [&](std::size_t i) {
            return cat("roughness ", roughness, ", radii ", radius[0], " ", radius[1], " ",
                       radius[2], ", way ", i, ": ", ways[i].mean, " +- ",
                       std::sqrt(ways[i].sigma2), ", both ", ways[0].mean, " +- ",
                       std::sqrt(ways[0].sigma2));
        };
        for (std::size_t i = 1; i < ways.size(); ++i) {
            ++tally.cases;
            tally.measure(std::fabs(ways[i].mean - ways[0].mean) /
                              std::sqrt(ways[i].sigma2 + ways[0].sigma2),
                          [&] { return text(i); });
            if (i >= 2 && !(ways[0].variance <= 2 * ways[i].variance))
                tally.fail([&] { return text(i); });
        }
    });
}

constexpr Row kPathRows[] = {
    {"T23a", "closed rooms that shine: radiance 1 / (1 - albedo), each pixel", "sigma", 6, true,
     rooms},
    {"T23b", "lamps in rough metal: samples of lamps, of lobes, and of both", "sigma", 5, true,
     lampsInPlates},
};

} // namespace

std::span<const Row> pathRows() { return kPathRows; }

} // namespace battery
