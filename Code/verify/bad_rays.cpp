// T16: rays that are none, with NaN, infinities or no direction, into every query of every shape:
// they miss, and cost no more than others.
#include "base/text.h"
#include "integrate/shading.h"
#include "verify/groups.h"
#include "verify/specimens.h"
#include "verify/timing.h"

#include <limits>

namespace battery {

namespace {

using meshes::Random;

// One object of every kind, a mesh alone and a mesh twice, one of the copies moving.
SceneDesc everyKind(Random& random) {
    SceneDesc desc;
    desc.cameras.emplace_back();
    desc.meshes = {meshes::uvSphere(32, 16), meshes::torus(0.3, 24, 12)};
    const auto add = [&](ObjectDesc object) {
        const Vec3d centre = random.inBox(3);
        object.worldFromObject = {somePlace(random, 0.8, centre).rows()};
        desc.objects.push_back(std::move(object));
    };
    for (int i = 0; i < 12; ++i) add(someShape(random));
    for (const Handle mesh : {0, 1, 1}) {
        ObjectDesc object;
        object.kind = ObjectDesc::Kind::Mesh;
        object.mesh = mesh;
        add(object);
    }
    Keys& keys = desc.objects.back().worldFromObject;
    keys.push_back(keys[0]);
    keys.back()[3] += 0.5;
    return desc;
}

// A place inside of the scene's box, seen from about it.
Ray goodRay(Random& random) {
    const Vec3d from = random.inBox(2), to = random.inBox(1);
    Ray ray{toFloat(from), toFloat(to - from)};
    ray.time = static_cast<float>(random.unit());
    return ray;
}

Ray badRay(Random& random) {
    Ray ray = goodRay(random);
    const float nan = std::numeric_limits<float>::quiet_NaN();
    const float values[] = {nan, -nan, kInfinityF, -kInfinityF};
    const auto bad = [&] { return values[random.below(std::size(values))]; };
    const std::uint32_t axis = random.below(3);
    switch (random.below(7)) {
    case 0: ray.org[axis] = bad(); break;
    case 1: ray.dir[axis] = bad(); break;
    case 2: ray.dir = {bad(), bad(), bad()}; break;
    case 3: ray.org = {bad(), bad(), bad()}; break;
    case 4: ray.dir = random.chance(0.5) ? Vec3{0, 0, 0} : Vec3{-0.0f, 0, -0.0f}; break;
    // NOLINTNEXTLINE(bugprone-narrowing-conversions): float from float, clang-tidy 14 is wrong
    case 5: ray.tMin = random.chance(0.5) ? nan : kInfinityF; break;
    default: ray.tMax = random.chance(0.5) ? nan : -kInfinityF;
    }
    return ray;
}

std::string described(const Ray& ray) {
    return cat(textOf(ray), ", t from ", ray.tMin, " to ", ray.tMax);
}

Tally misses(const Effort& effort) {
    return inBatches(effort, 16, 12, [](Random& random, Tally& tally) {
        const SceneDesc desc = everyKind(random);
        RenderSettings settings;
        settings.picture = desc.settings;
        const Scene scene(desc, {}, settings);
        RayBatch batch;
        for (int i = 0; i < 1000; ++i) batch.push(badRay(random), 0, {1, 1, 1});
        std::vector<Hit> hits;
        std::vector<Rgb> light;
        closest(scene, batch, hits);
        transmitted(scene, batch, light);
        for (std::size_t i = 0; i < batch.size(); ++i) {
            const Ray ray = batch.ray(i);
            const auto failIf = [&](bool wrong, const char* query) {
                ++tally.cases;
                if (wrong) tally.fail([&] { return cat(query, " ", described(ray)); });
            };
            failIf(hits[i].isHit(), "closest");
            failIf(!(light[i] == Rgb{1, 1, 1}), "transmitted");
            std::vector<Hit> all;
            scene.shapes().seeThroughHits(ray, all);
            failIf(!all.empty(), "seeThroughHits");
            for (const auto& shape : scene.shapes().shapes) {
                all.clear();
                shape->collect(ray, all);
                failIf(!all.empty(), "collect");
                failIf(shape->occludes(ray), "occludes");
                Hit hit; // shapes take the end of the ray from it
                hit.t = ray.tMax;
                failIf(shape->intersect(ray, hit), "intersect");
            }
        }
    });
}

Tally times(const Effort& effort) {
    Random random(161);
    const SceneDesc desc = everyKind(random);
    RenderSettings settings;
    settings.picture = desc.settings;
    const Scene scene(desc, {}, settings);
    RayBatch good, bad;
    for (int i = 0; i < 20000; ++i) {
        good.push(goodRay(random), 0, {1, 1, 1});
        bad.push(badRay(random), 0, {1, 1, 1});
    }
    std::vector<Hit> hits;
    std::vector<Rgb> light;
    Tally tally;
    const int turns = static_cast<int>(clamp(5 * effort.factor, 5.0, 50.0));
    const auto measure = [&](const char* query, auto&& ask) {
        tally.cases += 2 * good.size();
        tally.measure(timeRatio(
                          turns, [&] { ask(bad); }, [&] { ask(good); }),
                      [&] { return query; });
    };
    measure("closest", [&](const RayBatch& rays) { closest(scene, rays, hits); });
    measure("transmitted", [&](const RayBatch& rays) { transmitted(scene, rays, light); });
    return tally;
}

constexpr Row kBadRaysRows[] = {
    {"T16a", "queries of NaN, infinite and zero rays that find something", "", 0, true, misses},
    timed({"T16b", "time of such rays", "of others", 1.5, false, times,
           "Embree's own test allows 2.5"}),
};

} // namespace

std::span<const Row> badRayRows() { return kBadRaysRows; }

} // namespace battery
