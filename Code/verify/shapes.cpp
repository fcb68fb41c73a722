// T13: where rays meet the shapes with a formula, seen from as close as 1e-6 of their size to as
// far as 1e6 times of it.
#include "base/text.h"
#include "verify/groups.h"
#include "verify/specimens.h"

namespace battery {

namespace {

using meshes::Random;

constexpr int kRaysPerShape = 100;

// A shape of 1e-6 to 1e6 times the distance from which it is looked at; the larger of both is about
// the size of a scene.
struct View {
    double size = 1, distance = 1;
    explicit View(Random& random) {
        const double ratio = random.logUniform(1e-6, 1e6), largest = random.uniform(0.1, 1);
        size = ratio < 1 ? ratio * largest : largest;
        distance = ratio < 1 ? largest : largest / ratio;
    }
};

// Tips have no size: what is seen of one is as far from it, of the size of the shape.
double nearestTip(const View& view) { return 1e-6 * max(1.0, view.distance / view.size); }

Specimen someSpecimen(Random& random, const View& view) {
    const ObjectDesc object = someShape(random);
    const Vec3d centre = random.chance(0.5) ? Vec3d{} : random.inBox(1);
    return {object, somePlace(random, view.size, centre)};
}

// From near one point of the surface to that or another one. dir has any length about 1.
Ray someRay(Random& random, const Specimen& specimen, const View& view) {
    const double nearest = nearestTip(view);
    const Vec3d near = specimen.surfacePoint(random, nearest);
    const Vec3d other = specimen.surfacePoint(random, nearest);
    Ray ray;
    ray.org = toFloat(near + random.direction() * view.distance);
    const Vec3d way = (random.chance(0.5) ? near : other) - toDouble(ray.org);
    const double steps = random.logUniform(0.25, 4);
    if (length(way) > 0) ray.dir = toFloat(way * (steps / length(way)));
    return ray;
}

// In units of the last place of t or, if that is more, of the distance to the shape's origin.
double depthError(const Specimen& specimen, const Ray& ray, const Hit& hit, Wide t) {
    const double speed = length(toDouble(ray.dir)), exact = static_cast<double>(t);
    const double distance = length(specimen.place.translation() - toDouble(ray.org)) / speed;
    const double error = static_cast<double>(magnitude(static_cast<Wide>(hit.t) - t));
    return error / (0x1p-23 * max(exact, distance));
}

// T15 is about rays that are nearer to a plane than this, where the depth is all but undefined.
constexpr double kLeastAngle = 1e-7;

bool isGrazing(const Ray& ray, Vec3w normal) {
    const Vec3d n = toDouble(normal), d = toDouble(ray.dir);
    return std::fabs(dot(n, d)) < kLeastAngle * length(n) * length(d);
}

double normalError(const Specimen& specimen, const Ray& ray, const Hit& hit, Vec3w normal) {
    const Vec3w exact = normal / squareRoot(dot(normal, normal));
    return length(toDouble(toWide(specimen.shape->surface(ray, hit).ng) - exact));
}

enum class Measured { Depth, Normal };

Tally nearestHits(const Effort& effort, Measured what) {
    return inBatches(effort, 13, 200, [what](Random& random, Tally& tally) {
        const View view(random);
        const Specimen specimen = someSpecimen(random, view);
        for (int i = 0; i < kRaysPerShape; ++i) {
            const Ray ray = someRay(random, specimen, view);
            const std::vector<ExactHit> exact = specimen.exact.hits(ray);
            const auto text = [&] { return cat(specimen.text(), ", ray ", textOf(ray)); };
            Hit hit;
            const bool isHit = specimen.shape->intersect(ray, hit);
            if (!exact.empty() && isGrazing(ray, exact[0].normal)) continue;
            ++tally.cases;
            if (isHit == exact.empty())
                tally.fail(text);
            else if (isHit && what == Measured::Depth)
                tally.measure(depthError(specimen, ray, hit, exact[0].t), text);
            else if (isHit && !specimen.isNearTip(ray, exact[0].t, nearestTip(view)))
                tally.measure(normalError(specimen, ray, hit, exact[0].normal), text);
        }
    });
}
Tally depths(const Effort& effort) { return nearestHits(effort, Measured::Depth); }
Tally normals(const Effort& effort) { return nearestHits(effort, Measured::Normal); }

// The place between a ray that hits and one that does not, to the last bit of a float ray.
Vec3d outlinePoint(const Specimen& specimen, Vec3 org, Vec3d inside, Vec3d outside) {
    for (int i = 0; i < 30; ++i) {
        const Vec3d middle = lerp(inside, outside, 0.5);
        const Ray ray{org, toFloat(middle - toDouble(org))};
        (specimen.shape->occludes(ray) ? inside : outside) = middle;
    }
    return lerp(inside, outside, 0.5);
}

// Rays on both sides of the outline, from beside it to 1e-2 of the size away.
Tally outlines(const Effort& effort) {
    Tally tally = inBatches(effort, 131, 250, [](Random& random, Tally& found) {
        View view(random);
        const Specimen specimen = someSpecimen(random, view);
        for (int i = 0; i < 4; ++i) {
            const Vec3d inside = specimen.surfacePoint(random);
            const Vec3 org = toFloat(inside + random.direction() * view.distance);
            const Vec3d outside = inside + random.direction() * (20 * view.size);
            const Vec3d edge = outlinePoint(specimen, org, inside, outside);
            for (int k = 0; k < 24; ++k) {
                const double off = view.size * random.logUniform(1e-14, 1e-2);
                const Vec3d target = edge + random.direction() * off;
                const Ray ray{org, toFloat(target - toDouble(org))};
                if (!(dot(ray.dir, ray.dir) > 0)) continue;
                Hit hit;
                ++found.cases;
                if (specimen.shape->intersect(ray, hit) == specimen.exact.hits(ray).empty())
                    found.fail([&] { return cat(specimen.text(), ", ray ", textOf(ray)); });
            }
        }
    });
    tally.worst = static_cast<double>(tally.failures) / static_cast<double>(tally.cases);
    tally.worstCase = tally.failedCase;
    tally.failures = 0;
    return tally;
}

constexpr Row kShapesRows[] = {
    {"T13a", "depth of shapes from 1e-6 to 1e6 of their size away", "float ulp", 4, true, depths},
    {"T13b", "their normals, also next to the tips of cones", "of 1", 1e-6, true, normals},
    {"T13c", "rays at their outlines that hit or miss wrongly", "of all", 1e-6, true, outlines},
};

} // namespace

std::span<const Row> shapeRows() { return kShapesRows; }

} // namespace battery
