// The point of a hit on a mesh: where rays leave it, its normals, its texture coordinates.
#include "shape/mesh.h"

#include <algorithm>

namespace {

Vec3d crossOfEdges(Vec3 v0, Vec3 v1, Vec3 v2) {
    return cross(toDouble(v1) - toDouble(v0), toDouble(v2) - toDouble(v0));
}

// A triangle without area faces the ray, wherever that comes from.
Vec3d unitNormal(Vec3 v0, Vec3 v1, Vec3 v2, Vec3d rayDir) {
    const Vec3d n = crossOfEdges(v0, v1, v2);
    return n == Vec3d{} ? -normalize(rayDir) : normalize(n);
}

template <class T> T interpolate(T a, T b, T c, float u, float v) {
    return a * (1 - u - v) + b * u + c * v;
}

// The vertex's part of the error of a hit: what Woop's test and the plane key lose to rounding,
// about 8 units of the largest coordinate difference, doubled. See RaySetup for the pads.
constexpr double kTriangleError = 0x1p-20;

// The ray's part of it: slopes and differences of the corners in float move what it meets by up to
// 4 units of its length to the side, its depth is rounded thrice.
constexpr float kRayError = 0x1p-21f;

// Rays leave a surface kTriangleError off its plane; this many times as far from its edges they are
// on the inner side of the neighbours as well, down to an angle of 30 degrees between both.
constexpr double kEdgeClearance = 2;

// Moves a point of a triangle towards the centre of its incircle until it keeps `clearance` from
// all edges. A point right on the edge of two walls would let light from outside in between them.
Vec3d awayFromEdges(Vec3d weights, Vec3 v0, Vec3 v1, Vec3 v2, double clearance) {
    const Vec3d a = toDouble(v0), b = toDouble(v1), c = toDouble(v2);
    // Mostly a point is far from them, and squares say so without a root; 1 % is for rounding.
    const Vec3d n = crossOfEdges(v0, v1, v2);
    const double far2 = 1.01 * clearance * clearance, area2 = dot(n, n);
    const auto isFar = [&](double weight, Vec3d side) {
        return weight > 0 && weight * weight * area2 > far2 * dot(side, side);
    };
    if (isFar(weights.x, c - b) && isFar(weights.y, a - c) && isFar(weights.z, b - a))
        return weights;
    const Vec3d sides{length(c - b), length(a - c), length(b - a)};
    const double twiceArea = std::sqrt(area2);
    const double perimeter = sides.x + sides.y + sides.z, inradius = twiceArea / perimeter;
    const double nearest =
        min(weights.x / sides.x, min(weights.y / sides.y, weights.z / sides.z)) * twiceArea;
    if (nearest >= clearance) return weights;
    const double s = inradius > clearance ? (clearance - nearest) / (inradius - nearest) : 1;
    return lerp(weights, sides / perimeter, s);
}

// Hanika 2021, "Hacking the shadow terminator": p projected onto the tangent planes of the corners
// it lies below, weighted with its barycentrics. `side` is 1 when the outside is seen, -1 for the
// inside, from where the surface is convex where it is concave from outside.
Vec3d liftToCurve(Vec3d p, const std::array<Vec3d, 3>& corners, const std::array<Vec3d, 3>& normals,
                  Vec3d weights, double side) {
    Vec3d lift;
    for (std::size_t i = 0; i < 3; ++i) {
        const double length2 = dot(normals[i], normals[i]);
        const double below = side * dot(p - corners[i], normals[i]);
        if (length2 > 0 && below < 0) lift -= normals[i] * (weights[i] * side * below / length2);
    }
    return lift;
}

} // namespace

bool Mesh::seesFront(const Ray& ray, const Hit& hit) const {
    const auto& c = geometry_.triangles[hit.prim];
    const Vec3d n =
        crossOfEdges(geometry_.points[c[0]], geometry_.points[c[1]], geometry_.points[c[2]]);
    const Vec3d dir = toDouble(ray.dir);
    const double facing = dot(n, dir);
    // The sign is asked of the surface's normal, which is rounded.
    const bool isSure = facing * facing > 0x1p-40 * dot(n, n) * dot(dir, dir);
    return identity_ && isSure ? facing < 0 : Shape::seesFront(ray, hit);
}

Surface Mesh::surfaceFor(const Ray& worldRay, const Hit& hit, SurfaceNeeds needs) const {
    const auto& c = geometry_.triangles[hit.prim];
    const Vec3 v0 = geometry_.points[c[0]], v1 = geometry_.points[c[1]],
               v2 = geometry_.points[c[2]];
    const double u = hit.u, v = hit.v;
    const auto pointOff = [&](double error) { // in the mesh's space, this far from the edges
        const Vec3d b = awayFromEdges({1 - u - v, u, v}, v0, v1, v2, kEdgeClearance * error);
        return toDouble(v0) * b.x + toDouble(v1) * b.y + toDouble(v2) * b.z;
    };
    const Vec3d n = unitNormal(v0, v1, v2, toDouble(meshRay(worldRay).dir));
    const float scale = max(maxAbs(v0), max(maxAbs(v1), maxAbs(v2)));

    Surface s;
    Vec3d ns = n;
    if (!geometry_.normalTriangles.empty()) {
        const auto& k = geometry_.normalTriangles[hit.prim];
        ns = toDouble(interpolate(geometry_.normals[k[0]], geometry_.normals[k[1]],
                                  geometry_.normals[k[2]], hit.u, hit.v));
    }
    if (identity_) {
        s.p = toFloat(pointOff(kTriangleError * scale));
        s.ng = toFloat(n);
        s.error = static_cast<float>(kTriangleError * scale);
        s.rayError = kRayError;
    } else {
        const Transform worldFromMesh = worldFromMeshAt(worldRay.time);
        const Vec3d normal = worldFromMesh.normal(n);
        s.ng = toFloat(normalize(normal));
        ns = worldFromMesh.normal(ns);
        // A step h along the world normal moves the point by h times this off the mesh's plane.
        const Transform meshFromWorld = worldFromMesh.inverse();
        const double offPlane = dot(meshFromWorld.vector(normalize(normal)), n);
        const double lost = kTriangleError * scale + 0x1p-22 * maxAbs(meshFromWorld.point({}));
        const Vec3d p = worldFromMesh.point(pointOff(0));
        const double error = lost / std::fabs(offPlane) + 0x1p-22 * maxAbs(p);
        const double stretch =
            max(length(meshFromWorld.column(0)),
                max(length(meshFromWorld.column(1)), length(meshFromWorld.column(2))));
        s.p = toFloat(worldFromMesh.point(pointOff(error * stretch)));
        s.error = static_cast<float>(error);
        s.rayError = kRayError * static_cast<float>(stretch / std::fabs(offPlane));
    }
    if (needs.lift && !geometry_.normalTriangles.empty()) {
        const auto& k = geometry_.normalTriangles[hit.prim];
        const Transform worldFromMesh = identity_ ? Transform() : worldFromMeshAt(worldRay.time);
        const auto normal = [&](std::size_t i) {
            return worldFromMesh.normal(toDouble(geometry_.normals[k[i]]));
        };
        const auto corner = [&](Vec3 p) { return worldFromMesh.point(toDouble(p)); };
        s.lift = toFloat(liftToCurve(toDouble(s.p), {corner(v0), corner(v1), corner(v2)},
                                     {normal(0), normal(1), normal(2)}, {1 - u - v, u, v},
                                     dot(s.ng, worldRay.dir) <= 0 ? 1 : -1));
    }
    const double length2 = dot(ns, ns);
    s.ns = length2 > 0 ? toFloat(ns / std::sqrt(length2)) : s.ng;
    if (!(dot(s.ns, s.ng) > 0)) s.ns = s.ng;
    if (!geometry_.uvTriangles.empty()) {
        const auto& k = geometry_.uvTriangles[hit.prim];
        s.uv = interpolate(geometry_.uvs[k[0]], geometry_.uvs[k[1]], geometry_.uvs[k[2]], hit.u,
                           hit.v);
    } else {
        s.uv = {hit.u, hit.v};
    }
    s.material = materials_[geometry_.slots.empty() ? 0 : geometry_.slots[hit.prim]];
    const auto part = std::upper_bound(
        parts_.begin(), parts_.end(), hit.prim,
        [](std::uint32_t prim, const MeshPart& other) { return prim < other.firstTriangle; });
    s.object = std::prev(part)->object;
    return s;
}

SurfaceDerivatives Mesh::derivatives(const Ray& worldRay, const Hit& hit) const {
    const auto& c = geometry_.triangles[hit.prim];
    const Vec3d v0 = toDouble(geometry_.points[c[0]]);
    const Vec3d e1 = toDouble(geometry_.points[c[1]]) - v0;
    const Vec3d e2 = toDouble(geometry_.points[c[2]]) - v0;
    Vec3d dpdu = e1, dpdv = e2; // of the barycentrics, when there are no texture coordinates
    if (!geometry_.uvTriangles.empty()) {
        const auto& k = geometry_.uvTriangles[hit.prim];
        const Vec2 t0 = geometry_.uvs[k[0]];
        const Vec2 d1 = geometry_.uvs[k[1]] - t0, d2 = geometry_.uvs[k[2]] - t0;
        const double det = static_cast<double>(d1.x) * d2.y - static_cast<double>(d1.y) * d2.x;
        if (det != 0) {
            dpdu = (e1 * static_cast<double>(d2.y) - e2 * static_cast<double>(d1.y)) / det;
            dpdv = (e2 * static_cast<double>(d1.x) - e1 * static_cast<double>(d2.x)) / det;
        }
    }
    if (identity_) return {toFloat(dpdu), toFloat(dpdv)};
    const Transform worldFromMesh = worldFromMeshAt(worldRay.time);
    return {toFloat(worldFromMesh.vector(dpdu)), toFloat(worldFromMesh.vector(dpdv))};
}
