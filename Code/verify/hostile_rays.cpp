#include "verify/hostile_rays.h"

namespace battery {

namespace {

using meshes::Random;

// The triangle's corners.
std::array<Vec3d, 3> someTriangle(Random& random, const MeshGeometry& mesh) {
    const auto& c = mesh.triangles[random.below(mesh.triangles.size())];
    return {toDouble(mesh.points[c[0]]), toDouble(mesh.points[c[1]]), toDouble(mesh.points[c[2]])};
}

Vec3 someOrigin(Random& random, const MeshGeometry& mesh) {
    switch (random.below(6)) {
    case 0: return toFloat(random.direction() * 3.0);
    case 1: return toFloat(random.inBox(1));
    case 2: return toFloat(targetOn(random, mesh));
    case 3: return toFloat(targetOn(random, mesh) + random.direction() * 1e-6);
    case 4: return toFloat(random.direction() * random.logUniform(10, 1e6));
    default: {
        const auto [a, b, c] = someTriangle(random, mesh);
        return toFloat(lerp(a, b, random.uniform(-1, 2)));
    }
    }
}

Ray someRay(Random& random, const MeshGeometry& mesh, Vec3 org) {
    Ray ray{org, toFloat(targetOn(random, mesh)) - org};
    if (random.chance(0.1)) ray.dir = toFloat(random.direction());
    if (random.chance(0.1)) ray.dir[random.below(3)] = 0;
    if (random.chance(0.05))
        ray.dir = Vec3{}, ray.dir[random.below(3)] = random.chance(0.5) ? 1.0f : -1.0f;
    if (random.chance(0.2)) ray.dir = ray.dir * static_cast<float>(random.logUniform(1e-3, 1e3));
    if (random.chance(0.3)) ray.tMax = static_cast<float>(random.logUniform(1e-2, 10));
    if (random.chance(0.2)) ray.tMax = 1;
    if (random.chance(0.2)) ray.tMin = static_cast<float>(random.logUniform(1e-4, 2));
    return ray;
}

} // namespace

void RayList::push(const Ray& ray) {
    org.push_back(ray.org), dir.push_back(ray.dir);
    tMin.push_back(ray.tMin), tMax.push_back(ray.tMax), time.push_back(ray.time);
}

Vec3d targetOn(Random& random, const MeshGeometry& mesh) {
    const auto [a, b, c] = someTriangle(random, mesh);
    Vec3d p = a;
    switch (random.below(4)) {
    case 0: break;
    case 1: p = lerp(a, b, random.unit()); break;
    case 2: p = (a + b + c) * (1.0 / 3); break;
    default: {
        const double u = random.unit(), v = random.unit() * (1 - u);
        p = a + (b - a) * u + (c - a) * v;
    }
    }
    return random.chance(0.2) ? p + random.direction() * 1e-6 : p;
}

RayList looseRays(Random& random, const MeshGeometry& mesh, std::size_t count) {
    RayList rays;
    while (rays.size() < count) rays.push(someRay(random, mesh, someOrigin(random, mesh)));
    return rays;
}

RayList raysFromPoints(Random& random, const MeshGeometry& mesh, std::size_t count) {
    RayList rays;
    while (rays.size() < count) {
        const Vec3 org = someOrigin(random, mesh);
        const bool pencil = random.chance(0.6);
        const Vec3d axis = targetOn(random, mesh) - toDouble(org);
        const double spread = random.logUniform(1e-3, 0.3) * length(axis);
        const std::size_t size = 33 + random.below(600);
        for (std::size_t i = 0; i < size; ++i) {
            Ray ray = someRay(random, mesh, org);
            if (pencil && random.chance(0.95)) ray.dir = toFloat(axis + random.inBox(spread));
            rays.push(ray);
        }
    }
    return rays;
}

RayList raysInBeams(Random& random, const MeshGeometry& mesh, std::size_t count) {
    RayList rays;
    while (rays.size() < count) {
        const Vec3d from = toDouble(someOrigin(random, mesh)), to = targetOn(random, mesh);
        const double far = length(to - from);
        const double start = random.chance(0.2) ? 0 : far * random.logUniform(1e-7, 0.1);
        const double end = random.chance(0.2) ? 0 : far * random.logUniform(1e-7, 0.3);
        const Ray alike = someRay(random, mesh, {});
        const bool hasStrangers = random.chance(0.2), isFlat = random.chance(0.3);
        for (int i = 0; i < 16; ++i) {
            Vec3d org = from + random.inBox(start);
            if (isFlat) org = toDouble(toFloat(from)), org.x += random.uniform(-start, start);
            const Vec3d dir = isFlat ? to - from : to + random.inBox(end) - org;
            Ray ray{toFloat(org), toFloat(dir), alike.tMin, alike.tMax};
            if (hasStrangers && random.chance(0.2))
                ray = someRay(random, mesh, someOrigin(random, mesh));
            rays.push(ray);
        }
    }
    return rays;
}

RayList raysInPlanes(Random& random, const MeshGeometry& mesh, std::size_t count) {
    constexpr int kFromOnePoint = 40; // enough for a bundle
    RayList rays;
    while (rays.size() < count) {
        const auto [a, b, c] = someTriangle(random, mesh);
        const auto inPlane = [&, p = a, e = b - a, f = c - a](double lo, double hi) {
            return p + e * random.uniform(lo, hi) + f * random.uniform(lo, hi);
        };
        const Vec3 org = toFloat(inPlane(-2, 2));
        for (int i = 0; i < kFromOnePoint; ++i) {
            const Vec3d noise = random.direction() * random.logUniform(1e-9, 1e-6);
            rays.push({org, toFloat(inPlane(0, 0.5) + noise) - org});
        }
    }
    return rays;
}

RayList beamsInPlanes(Random& random, const MeshGeometry& mesh, std::size_t count) {
    RayList rays;
    while (rays.size() < count) {
        const auto [a, b, c] = someTriangle(random, mesh);
        const Vec3d e = b - a, f = c - a;
        const double size = ::max(length(e), length(f));
        const Vec3d from = a + e * random.uniform(-0.5, 1) + f * random.uniform(-0.5, 1);
        const Vec3d way = e * random.uniform(-1, 1) + f * random.uniform(-1, 1);
        const double far = random.logUniform(1e-2, 2);
        const double start = far * random.logUniform(1e-4, 0.3);
        const double end = far * random.logUniform(1e-4, 0.3);
        const double off = size * random.logUniform(1e-9, 1e-5);
        for (int i = 0; i < 16; ++i) {
            const auto beside = [&](double by) {
                return (e * random.uniform(-1, 1) + f * random.uniform(-1, 1)) * by +
                       random.direction() * off;
            };
            const Vec3 org = toFloat(from + beside(start));
            rays.push({org, toFloat(from + way * far + beside(end)) - org, 0, 1});
        }
    }
    return rays;
}

RayList raysOnLattice(Random& random, std::uint32_t half, std::size_t count) {
    RayList rays;
    while (rays.size() < count) {
        const Vec3 shared = meshes::latticePoint(random, half);
        const bool fromOnePoint = random.chance(0.6), isNarrow = random.chance(0.5);
        const Vec3 axis = meshes::latticePoint(random, half);
        const std::size_t size = 33 + random.below(200);
        for (std::size_t i = 0; i < size; ++i) {
            const Vec3 org = fromOnePoint ? shared : meshes::latticePoint(random, half);
            Ray ray{org, isNarrow ? axis * 8.0f + meshes::latticePoint(random, 3)
                                  : meshes::latticePoint(random, 1 + random.below(half))};
            if (random.chance(0.2)) ray.dir = ray.dir * 0.125f;
            if (random.chance(0.2)) ray.tMax = static_cast<float>(1 + random.below(8)) * 0.25f;
            if (random.chance(0.2)) ray.tMin = static_cast<float>(random.below(8)) * 0.125f;
            rays.push(ray);
        }
    }
    return rays;
}

} // namespace battery
