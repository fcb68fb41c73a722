// T15a: rays that come in at 1e-1 to 1e-7 radians over flat surfaces and along the sides of round
// ones. Whether they hit is known to the last bit; where they hit must be as close to the surface
// as the surface's own bound says, from which the next rays start.
#include "base/text.h"
#include "shape/mesh.h"
#include "verify/groups.h"
#include "verify/specimens.h"

namespace battery {

namespace {

using meshes::Random;

// A ray at that angle over the plane of the point and the normal, which it aims at.
Ray rayOver(Random& random, Vec3d point, Vec3d normal, double angle) {
    const Vec3d along = normalize(cross(normal, random.direction()));
    const Vec3d dir = along * exact::cos(angle) - normal * exact::sin(angle);
    Ray ray;
    ray.org = toFloat(point - dir * random.uniform(0.1, 2));
    ray.dir = toFloat(point - toDouble(ray.org));
    return ray;
}

bool isFinite(const Surface& s) {
    return maxAbs(s.p) < kInfinityF && std::fabs(length(toDouble(s.ng)) - 1) < 1e-6 &&
           maxAbs(s.ns) <= 1.000001f && s.error > 0 && s.error < 1e-3f && s.uv.x == s.uv.x &&
           s.uv.y == s.uv.y;
}

// How far from the plane of the exact hit the found one is, in units of its own bound.
double offSurface(const Ray& ray, const Surface& found, const ExactHit& exact) {
    const Vec3w p = toWide(ray.org) + toWide(ray.dir) * exact.t;
    const Vec3w n = exact.normal / squareRoot(dot(exact.normal, exact.normal));
    return static_cast<double>(magnitude(dot(n, toWide(found.p) - p))) /
           static_cast<double>(found.error);
}

bool isFlat(const ObjectDesc& object) {
    return object.kind != ObjectDesc::Kind::Sphere && object.kind != ObjectDesc::Kind::Cylinder &&
           object.kind != ObjectDesc::Kind::Cone;
}

void tryShape(Random& random, Tally& tally) {
    const ObjectDesc object = someShape(random);
    const Vec3d centre = random.inBox(0.5);
    const Specimen specimen(object, somePlace(random, random.logUniform(0.05, 0.5), centre));
    for (int i = 0; i < 100; ++i) {
        // The normal of the place comes from a ray that looks at it from anywhere.
        const Vec3d target = specimen.surfacePoint(random, 1e-2);
        const Vec3 from = toFloat(target + random.direction() * 2.0);
        const auto seen = specimen.exact.hits({from, toFloat(target - toDouble(from))});
        if (seen.empty()) continue;
        const Vec3d normal = normalize(toDouble(seen[0].normal));
        const Vec3d point =
            toDouble(from) + (target - toDouble(from)) * static_cast<double>(seen[0].t);
        const double angle = random.logUniform(1e-7, 1e-1);
        const Ray ray = rayOver(random, point, random.chance(0.5) ? normal : -normal, angle);
        const auto exact = specimen.exact.hits(ray);
        const auto text = [&] {
            return cat(specimen.text(), ", ray ", textOf(ray), " at ", angle, " radians");
        };
        Hit hit;
        const bool isHit = specimen.shape->intersect(ray, hit);
        ++tally.cases;
        if (isHit == exact.empty()) {
            tally.fail(text);
            continue;
        }
        if (!isHit) continue;
        const Surface found = specimen.shape->surface(ray, hit);
        if (!isFinite(found)) tally.fail(text);
        if (isFlat(object)) tally.measure(offSurface(ray, found, exact[0]), text);
    }
}

// A square of 2 n^2 triangles in a plane of an axis: its place is exact in float.
struct Sheet {
    std::size_t axis = 2;
    float level = 0;
    MeshGeometry geometry;

    explicit Sheet(Random& random)
        : axis(random.below(3)), level(static_cast<float>(random.uniform(-1, 1))) {
        const std::uint32_t n = 1 + random.below(20);
        for (std::uint32_t y = 0; y <= n; ++y)
            for (std::uint32_t x = 0; x <= n; ++x) {
                Vec3 p;
                p[axis] = level;
                p[(axis + 1) % 3] = 2.0f * static_cast<float>(x) / static_cast<float>(n) - 1;
                p[(axis + 2) % 3] = 2.0f * static_cast<float>(y) / static_cast<float>(n) - 1;
                geometry.points.push_back(p);
            }
        for (std::uint32_t y = 0; y < n; ++y)
            for (std::uint32_t x = 0; x < n; ++x) {
                const std::uint32_t a = y * (n + 1) + x, b = a + n + 1;
                geometry.triangles.push_back({a, a + 1, b + 1});
                geometry.triangles.push_back({a, b + 1, b});
            }
        geometry.finish(true);
    }
};

void trySheet(Random& random, Tally& tally) {
    const Sheet sheet(random);
    const Mesh mesh(sheet.geometry, {0}, {{0, 0}});
    const std::size_t axis = sheet.axis, u = (axis + 1) % 3, v = (axis + 2) % 3;
    for (int i = 0; i < 100; ++i) {
        Vec3d target = random.inBox(1), normal;
        target[axis] = sheet.level;
        normal[axis] = random.chance(0.5) ? 1 : -1;
        const double angle = random.logUniform(1e-7, 1e-1);
        const Ray ray = rayOver(random, target, normal, angle);
        const Wide slope = ray.dir[axis];
        if (slope == 0) continue; // in the plane: hits nothing
        const ExactHit exact{(static_cast<Wide>(sheet.level) - ray.org[axis]) / slope,
                             toWide(normal)};
        const Vec3d p = toDouble(toWide(ray.org) + toWide(ray.dir) * exact.t);
        // The direction's slopes are rounded: beside the border nothing is certain.
        const double inside = 1 - max(std::fabs(p[u]), std::fabs(p[v]));
        if (!(exact.t > 0) || std::fabs(inside) < 1e-5) continue;
        const auto text = [&] {
            return cat("sheet of ", sheet.geometry.triangles.size(), " on axis ", axis, " at ",
                       shortest(sheet.level), ", ray ", textOf(ray), " at ", angle, " radians");
        };
        Hit hit;
        const bool isHit = mesh.intersect(ray, hit);
        ++tally.cases;
        if (isHit != (inside > 0)) {
            tally.fail(text);
            continue;
        }
        if (!isHit) continue;
        const Surface found = mesh.surface(ray, hit);
        if (!isFinite(found)) tally.fail(text);
        tally.measure(offSurface(ray, found, exact), text);
    }
}

Tally grazing(const Effort& effort) {
    return inBatches(effort, 150, 100, [](Random& random, Tally& tally) {
        tryShape(random, tally);
        trySheet(random, tally);
    });
}

constexpr Row kGrazingRows[] = {
    {"T15a", "rays at 1e-1 to 1e-7 radians: distance of the hit", "of its bound", 1, true, grazing},
};

} // namespace

std::span<const Row> grazingRows() { return kGrazingRows; }

} // namespace battery
