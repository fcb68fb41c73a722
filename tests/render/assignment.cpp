#include "assignment.h"

#include "assignment_scene.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

namespace assignment {

namespace {

struct Ray {
    Vec3d origin, dir; // dir of any length: distances along it stay when both are placed
    Vec3d at(double t) const { return origin + dir * t; }
};
// Where a ray goes on when it starts on a surface: far above the rounding of coordinates up to
// 1000, far below what a pixel shows.
constexpr double kNear = 1e-7;

struct Hit {
    double t;
    Vec3d normal; // outward, of any length, in the space of the ray
};

std::optional<Hit> intersect(const Sphere& sphere, const Ray& ray, double tMin) {
    const Vec3d from = ray.origin - sphere.centre;
    const double a = dot(ray.dir, ray.dir), halfB = dot(ray.dir, from);
    const double root = halfB * halfB - a * (dot(from, from) - sphere.radius * sphere.radius);
    if (root < 0) return {};
    for (const double t : {(-halfB - std::sqrt(root)) / a, (-halfB + std::sqrt(root)) / a})
        if (t > tMin) return Hit{t, ray.at(t) - sphere.centre};
    return {};
}

std::optional<Hit> intersect(const Plane& plane, const Ray& ray, double tMin) {
    const double t = dot(plane.point - ray.origin, plane.normal) / dot(ray.dir, plane.normal);
    if (!(t > tMin && std::isfinite(t))) return {};
    return Hit{t, plane.normal};
}

std::optional<Hit> intersect(const Box& box, const Ray& ray, double tMin) {
    Hit in{-std::numeric_limits<double>::infinity(), {}};
    Hit out{std::numeric_limits<double>::infinity(), {}};
    for (std::size_t axis = 0; axis < 3; ++axis) {
        for (const bool high : {false, true}) {
            Vec3d normal;
            normal[axis] = high ? 1 : -1;
            const double gap = (high ? box.high : box.low)[axis] - ray.origin[axis];
            const double away = dot(normal, ray.dir);
            if (away == 0) {
                if (gap * normal[axis] < 0) return {}; // outside, alongside
                continue;
            }
            const double t = gap / ray.dir[axis];
            if (away < 0 && t > in.t) in = {t, normal};
            if (away > 0 && t < out.t) out = {t, normal};
        }
    }
    if (!(in.t <= out.t)) return {};
    if (in.t > tMin) return in;
    if (out.t > tMin) return out;
    return {};
}

std::optional<Hit> intersect(const Mesh& mesh, const Ray& ray, double tMin) {
    std::optional<Hit> nearest;
    for (const auto& [a, b, c] : mesh.triangles) {
        // Möller and Trumbore 1997.
        const Vec3d ab = b - a, ac = c - a, p = cross(ray.dir, ac), from = ray.origin - a;
        const double det = dot(ab, p);
        if (det == 0) continue;
        const Vec3d q = cross(from, ab);
        const double u = dot(from, p) / det, v = dot(ray.dir, q) / det, t = dot(ac, q) / det;
        if (u < 0 || v < 0 || u + v > 1 || t <= tMin || (nearest && t >= nearest->t)) continue;
        nearest = Hit{t, cross(ab, ac)};
    }
    return nearest;
}

struct SurfacePoint {
    double t = std::numeric_limits<double>::infinity();
    Vec3d p, normal; // in the world; normal of length 1
    const Material* material = nullptr;
};

std::optional<Hit> intersectObject(const Object& object, const Ray& ray, double tMin) {
    const Ray local{object.objectFromWorld.point(ray.origin),
                    object.objectFromWorld.vector(ray.dir)};
    return std::visit([&](const auto& shape) { return intersect(shape, local, tMin); },
                      object.shape);
}

const Material& materialAt(const Object& object, Vec3d p) {
    if (object.materials.size() < 2 || !std::holds_alternative<Plane>(object.shape))
        return object.materials[0];
    const Vec3d local = object.objectFromWorld.point(p);
    const double squares = std::floor(local.x) + std::floor(local.z);
    return object.materials[std::fmod(squares, 2) == 0 ? 0 : 1];
}

SurfacePoint closest(const SceneData& scene, const Ray& ray) {
    SurfacePoint best;
    for (const Object& object : scene.objects) {
        const auto hit = intersectObject(object, ray, kNear);
        if (!hit || hit->t >= best.t) continue;
        best.t = hit->t;
        best.p = ray.at(hit->t);
        best.normal = normalize(object.objectFromWorld.transposed(hit->normal));
        best.material = &materialAt(object, best.p);
    }
    return best;
}

// ray.dir reaches to a point light, is of length 1 for a directional one.
bool isShadowed(const SceneData& scene, const Ray& ray, bool isPoint) {
    const double tMin = kNear / length(ray.dir);
    return std::any_of(scene.objects.begin(), scene.objects.end(), [&](const Object& object) {
        const auto hit = intersectObject(object, ray, tMin);
        return hit && (!isPoint || hit->t < 1);
    });
}

Vec3d times(Vec3d a, Vec3d b) { return {a.x * b.x, a.y * b.y, a.z * b.z}; }

Vec3d shade(const SceneData& scene, const SurfacePoint& at, Vec3d toEye) {
    Vec3d sum = times(scene.ambient, at.material->diffuse);
    for (const Light& light : scene.lights) {
        const Vec3d path = light.isPoint ? light.place - at.p : light.place;
        const double d = length(path);
        const Vec3d toLight = path / d;
        const double cosLight = dot(at.normal, toLight);
        if (cosLight <= 0 || isShadowed(scene, {at.p, path}, light.isPoint)) continue;
        const double fall =
            light.attenuation.x * d * d + light.attenuation.y * d + light.attenuation.z;
        const double cosHalf = std::max(dot(at.normal, normalize(toLight + toEye)), 0.0);
        const Vec3d reflected = at.material->diffuse * cosLight +
                                at.material->specular * std::pow(cosHalf, at.material->exponent);
        sum += times(light.colour / fall, reflected);
    }
    return sum;
}

std::uint8_t byteOf(double c) {
    return static_cast<std::uint8_t>(std::lround(std::clamp(c, 0.0, 1.0) * 255));
}

} // namespace

Picture render(const JsonValue& json, const std::string& folder) {
    const SceneData scene = interpret(json, folder);
    const Vec3d w = normalize(scene.eye - scene.lookAt);
    const Vec3d u = normalize(cross(scene.up, w)), v = cross(w, u);
    const double top = std::tan(scene.fovDeg * std::numbers::pi / 360);
    const double right = top * scene.width / scene.height;
    Picture picture{scene.width, scene.height, {}};
    const int n = scene.samples;
    for (int y = 0; y < scene.height; ++y) {
        for (int x = 0; x < scene.width; ++x) {
            Vec3d sum;
            for (int j = 0; j < n; ++j) {
                for (int i = 0; i < n; ++i) {
                    const double across = 2 * (x + (i + 0.5) / n) / scene.width - 1;
                    const double down = 2 * (y + (j + 0.5) / n) / scene.height - 1;
                    const Vec3d dir = normalize(u * (right * across) - v * (top * down) - w);
                    const SurfacePoint at = closest(scene, {scene.eye, dir});
                    if (at.material) sum += shade(scene, at, -dir);
                }
            }
            const Vec3d mean = sum / (double{1} * n * n);
            picture.pixels.push_back({byteOf(mean.x), byteOf(mean.y), byteOf(mean.z)});
        }
    }
    return picture;
}

} // namespace assignment
