#include "shape/mesh_surface.h"

#include <algorithm>
#include <cstring>

namespace {

template <class T> T interpolate(const std::array<T, 3>& at, float u, float v) {
    return at[0] * (1 - u - v) + at[1] * u + at[2] * v;
}

// The ray's part of it: slopes and differences of the corners in float move what it meets by up to
// 4 units of its length to the side, its depth is rounded thrice.
constexpr float kRayError = 0x1p-21f;

using Corners = std::array<Vec3d, 3>;

// Moves a point of a triangle towards the centre of its incircle until it keeps `clearance` from
// all edges. A point right on the edge of two walls would let light from outside in between them.
Vec3d awayFromEdges(Vec3d weights, const Corners& v, double twiceArea, double clearance) {
    // Mostly a point is far from them, and squares say so without a root; 1 % is for rounding.
    const double far2 = 1.01 * clearance * clearance, area2 = twiceArea * twiceArea;
    const auto isFar = [&](double weight, Vec3d side) {
        return weight > 0 && weight * weight * area2 > far2 * dot(side, side);
    };
    if (isFar(weights.x, v[2] - v[1]) && isFar(weights.y, v[0] - v[2]) &&
        isFar(weights.z, v[1] - v[0]))
        return weights;
    const Vec3d sides{length(v[2] - v[1]), length(v[0] - v[2]), length(v[1] - v[0])};
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
Vec3d liftToCurve(Vec3d p, const Corners& corners, const std::array<Vec3, 3>& normals,
                  Vec3d weights, double side) {
    Vec3d lift;
    for (std::size_t i = 0; i < 3; ++i) {
        const Vec3d normal = toDouble(normals[i]);
        const double length2 = dot(normal, normal);
        const double below = side * dot(p - corners[i], normal);
        if (length2 > 0 && below < 0) lift -= normal * (weights[i] * side * below / length2);
    }
    return lift;
}

void setLane(TrianglesMet::Lane (&to)[3], std::size_t lane, Vec3 v) {
    to[0][lane] = v.x, to[1][lane] = v.y, to[2][lane] = v.z;
}

Vec2 coordinates(const SurfaceTriangle& triangle, const Hit& hit) {
    return triangle.hasUvs ? interpolate(triangle.uvs, hit.u, hit.v) : Vec2{hit.u, hit.v};
}

} // namespace

void SurfaceTriangle::takeRest(const MeshGeometry& geometry, std::uint32_t triangle,
                               SurfaceNeeds needs) {
    if (!geometry.normalTriangles.empty()) {
        const auto& k = geometry.normalTriangles[triangle];
        hasNormals = k != MeshGeometry::kWithout;
        if (hasNormals)
            normals = {geometry.normals[k[0]], geometry.normals[k[1]], geometry.normals[k[2]]};
    }
    if (needs.uv && !geometry.uvTriangles.empty()) {
        const auto& k = geometry.uvTriangles[triangle];
        hasUvs = k != MeshGeometry::kWithout;
        if (hasUvs) uvs = {geometry.uvs[k[0]], geometry.uvs[k[1]], geometry.uvs[k[2]]};
    }
}

Surface surfaceOf(const SurfaceTriangle& triangle, const Ray& ray, const Hit& hit,
                  SurfaceNeeds needs) {
    const auto& [v0, v1, v2] = triangle.corners;
    const Corners v{toDouble(v0), toDouble(v1), toDouble(v2)};
    const Vec3d across = cross(v[1] - v[0], v[2] - v[0]);
    const double twiceArea = length(across);
    // A triangle without area faces the ray, wherever that comes from.
    const Vec3d n = across == Vec3d{} ? -normalize(toDouble(ray.dir)) : normalize(across);
    const double error = kTriangleError * max(maxAbs(v0), max(maxAbs(v1), maxAbs(v2)));
    const Vec3d weights{1 - static_cast<double>(hit.u) - hit.v, hit.u, hit.v};
    const Vec3d b = awayFromEdges(weights, v, twiceArea, kEdgeClearance * error);

    Surface s;
    s.p = toFloat(v[0] * b.x + v[1] * b.y + v[2] * b.z);
    s.ng = toFloat(n);
    s.error = static_cast<float>(error);
    s.rayError = kRayError;
    s.ns = s.ng;
    if (triangle.hasNormals) {
        const Vec3d ns = toDouble(interpolate(triangle.normals, hit.u, hit.v));
        const double length2 = dot(ns, ns);
        const Vec3 smooth = length2 > 0 ? toFloat(ns / std::sqrt(length2)) : s.ng;
        if (dot(smooth, s.ng) > 0) s.ns = smooth;
        if (needs.lift)
            s.lift = toFloat(liftToCurve(toDouble(s.p), v, triangle.normals, weights,
                                         dot(s.ng, ray.dir) <= 0 ? 1 : -1));
    }
    s.uv = coordinates(triangle, hit);
    return s;
}

void TriangleSurfaceBatch::putTriangle(std::size_t lane, const SurfaceTriangle& triangle) {
    for (std::size_t i = 0; i < 3; ++i) setLane(met_.corner[i], lane, triangle.corners[i]);
    if (triangle.hasNormals)
        for (std::size_t i = 0; i < 3; ++i) setLane(met_.normal[i], lane, triangle.normals[i]);
}

void TriangleSurfaceBatch::put(std::size_t lane, const SurfaceTriangle& triangle, const Hit& hit,
                               Vec3 dir) {
    const unsigned bit = 1u << lane;
    putTriangle(lane, triangle);
    if (triangle.hasNormals) setLane(met_.dir, lane, dir), met_.smooth |= bit;
    met_.u[lane] = hit.u, met_.v[lane] = hit.v;
    met_.used |= bit;
    const Vec2 uv = coordinates(triangle, hit);
    uv_[0][lane] = uv.x, uv_[1][lane] = uv.y;
}

void TriangleSurfaceBatch::putAll(const SurfaceTriangle& triangle, std::span<const Hit> hits,
                                  const RaySpan& rays, std::span<const std::uint32_t> which) {
    met_.onOne = true;
    met_.used = (1u << which.size()) - 1;
    putTriangle(0, triangle);
    for (std::size_t i = 0; i < which.size(); ++i) {
        const Hit& hit = hits[which[i]];
        met_.u[i] = hit.u, met_.v[i] = hit.v;
        const Vec2 uv = coordinates(triangle, hit);
        uv_[0][i] = uv.x, uv_[1][i] = uv.y;
    }
    if (!triangle.hasNormals) return;
    met_.smooth = met_.used;
    for (std::size_t i = 0; i < which.size(); ++i) setLane(met_.dir, i, rays.dir[which[i]]);
}

void TriangleSurfaceBatch::take(std::size_t lane, SurfaceBlock& to, std::size_t place) const {
    const auto vector = [&](const TrianglesMet::Lane(&from)[3], SurfaceBlock::Lane(&into)[3]) {
        for (std::size_t axis = 0; axis < 3; ++axis) into[axis][place] = from[axis][lane];
    };
    vector(found_.p, to.p), vector(found_.ng, to.ng);
    to.uv[0][place] = uv_[0][lane], to.uv[1][place] = uv_[1][lane];
    to.error[place] = found_.error[lane], to.rayError[place] = kRayError;
    const unsigned bit = 1u << place;
    to.curved &= ~bit;
    if ((met_.smooth >> lane & 1) == 0) return;
    vector(found_.ns, to.ns), vector(found_.lift, to.lift);
    to.curved |= bit;
}

void TriangleSurfaceBatch::takeAll(SurfaceBlock& to) const {
    static_assert(kHits == SurfaceBlock::kPoints);
    std::memcpy(to.p, found_.p, sizeof(to.p));
    std::memcpy(to.ng, found_.ng, sizeof(to.ng));
    std::memcpy(to.uv, uv_, sizeof(to.uv));
    std::memcpy(to.error, found_.error, sizeof(to.error));
    std::fill_n(to.rayError, kHits, kRayError);
    to.curved = met_.smooth;
    if (met_.smooth == 0) return;
    std::memcpy(to.ns, found_.ns, sizeof(to.ns));
    std::memcpy(to.lift, found_.lift, sizeof(to.lift));
}

SurfaceDerivatives derivativesOf(const SurfaceTriangle& triangle) {
    const Vec3d v0 = toDouble(triangle.corners[0]);
    const Vec3d e1 = toDouble(triangle.corners[1]) - v0;
    const Vec3d e2 = toDouble(triangle.corners[2]) - v0;
    Vec3d dpdu = e1, dpdv = e2; // of the barycentrics, when there are no texture coordinates
    if (triangle.hasUvs) {
        const Vec2 d1 = triangle.uvs[1] - triangle.uvs[0], d2 = triangle.uvs[2] - triangle.uvs[0];
        const double det = static_cast<double>(d1.x) * d2.y - static_cast<double>(d1.y) * d2.x;
        if (det != 0) {
            dpdu = (e1 * static_cast<double>(d2.y) - e2 * static_cast<double>(d1.y)) / det;
            dpdv = (e2 * static_cast<double>(d1.x) - e1 * static_cast<double>(d2.x)) / det;
        }
    }
    return {toFloat(dpdu), toFloat(dpdv), true};
}
