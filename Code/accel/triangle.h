// The canonical hit of a ray and a triangle: one definition that every kernel has to reproduce to
// the last bit, so that no tree, width or order of traversal can change a picture.
// Edges: Woop, Benthin, Wald 2013 without FMA. Rounding is monotone, so the float sign of an edge
// function is never wrong, it can only be zero; zeros are decided in double, where the products of
// two floats are exact, and what is zero there by one rule for all triangles. Both triangles of an
// edge see the same bits: closed meshes do not leak.
// Depth: of the triangle's plane, where that is seen edge-on no farther from the ray than the
// triangle is, clamped to the triangle's own depth range and to the entry of its own padded box, so
// that culling by boxes never removes the nearest hit.
#pragma once

#include "accel/ray_setup.h"

#include <initializer_list>

// A triangle relative to the ray's origin with the axes permuted so that z is the dominant one.
struct ShearedTriangle {
    Vec3 v[3];        // (lateral x, lateral y, depth z)
    float x[3], y[3]; // lateral distance of each vertex from the ray

    ShearedTriangle(const RaySetup& ray, Vec3 v0, Vec3 v1, Vec3 v2) {
        const Vec3 p[3] = {v0, v1, v2};
        for (int i = 0; i < 3; ++i) {
            v[i] = {p[i][ray.kx] - ray.org[ray.kx], p[i][ray.ky] - ray.org[ray.ky],
                    (p[i][ray.k] - ray.org[ray.k]) * ray.sign};
            x[i] = v[i].x - ray.Sx * v[i].z;
            y[i] = v[i].y - ray.Sy * v[i].z;
        }
    }

    // Edge functions in double: exact, hence the weights of the three vertices.
    Vec3d edgesExact() const {
        const auto edge = [this](int a, int b) {
            return static_cast<double>(x[a]) * y[b] - static_cast<double>(y[a]) * x[b];
        };
        return {edge(2, 1), edge(0, 2), edge(1, 0)};
    }

    // Does the ray meet the triangle? Of those that share the edge or corner that it meets and face
    // the same way exactly one says yes: the one that contains the ray when it is moved by
    // (e, e^2), e infinitely small (Edelsbrunner and Muecke 1990). So a ray crosses a closed mesh
    // as often inwards as outwards, also when it goes on where it met something.
    bool containsRay() const {
        const float U = x[2] * y[1] - y[2] * x[1];
        const float V = x[0] * y[2] - y[0] * x[2];
        const float W = x[1] * y[0] - y[1] * x[0];
        if (!(U >= 0 && V >= 0 && W >= 0) && !(U <= 0 && V <= 0 && W <= 0)) return false;
        return (U != 0 && V != 0 && W != 0) || ownsRay();
    }

private:
    bool ownsRay() const {
        const Vec3d e = edgesExact();
        const auto side = [this](double edge, int a, int b) {
            if (edge != 0) return edge > 0 ? 1 : -1;
            if (y[a] != y[b]) return y[a] > y[b] ? 1 : -1;
            return x[b] > x[a] ? 1 : x[b] < x[a] ? -1 : 0; // 0: seen edge-on, not met
        };
        const int u = side(e.x, 2, 1);
        return u != 0 && u == side(e.y, 0, 2) && u == side(e.z, 1, 0);
    }
};

// Where a ray meets the triangle's plane. In double: the cross product of long, nearly parallel
// edges cancels, and a float plane of a needle is met anywhere along the needle, by rays that leave
// it or that end on it. Double takes needles of 1e8. The direction as it is, not its rounded
// slopes: those move the hit of a triangle that is seen edge-on far along the ray.
class TrianglePlane {
public:
    TrianglePlane(const RaySetup& ray, Vec3 p0, Vec3 p1, Vec3 p2)
        : dir_{ray.dx, ray.dy, ray.dz}, v_{relative(ray, p0), relative(ray, p1), relative(ray, p2)},
          n_(cross(v_[1] - v_[0], v_[2] - v_[0])), along_(dot(n_, dir_)) {}

    float key() const { return static_cast<float>(along_ / (dot(n_, v_[0]) * dir_.z)); } // 1/z

    // A ray that passes the triangle by a rounding, which ShearedTriangle can't know, meets the
    // plane of one that it sees within 1/kSteep of edge-on far from it.
    static constexpr double kSteep = 32;
    static constexpr double kChordRoom = 9 * 0x1p-24; // of the largest coordinate
    bool isEdgeOn() const {
        return !(kSteep * kSteep * (along_ * along_) >= dot(n_, n_) * dot(dir_, dir_));
    }
    // The key where the plane is met no nearer and no farther than the triangle's points are that
    // lie in one plane with the ray and the normal: what moves a ray by a rounding along the normal
    // leaves them as they are, and changes only which of them is met. All with room for where the
    // ray meets the triangle by ShearedTriangle: that is 2^-24 (4 M + 2 b) beside it at most (M, b
    // as in kernels/queue_exact.h) on either lateral axis, within 9 roundings of the largest
    // coordinate. 0 if these points are behind the origin.
    float keyInChord(float key) const {
        const Vec3d across = normalize(cross(dir_, n_));
        const double zPerDot = dir_.z / dot(dir_, dir_);
        double z[3], beside[3], size = 0;
        for (int i = 0; i < 3; ++i) {
            z[i] = dot(v_[i], dir_) * zPerDot, beside[i] = dot(v_[i], across);
            size = max(size, maxAbs(v_[i]));
        }
        const double room = kChordRoom * size;
        double nearest = std::numeric_limits<double>::infinity(), farthest = -nearest;
        const auto extend = [&](double depth) {
            nearest = min(nearest, depth - room), farthest = max(farthest, depth + room);
        };
        for (int i = 0; i < 3; ++i) {
            if (std::fabs(beside[i]) <= room) extend(z[i]);
            const int j = (i + 1) % 3;
            for (const double border : {-room, room})
                if ((beside[i] < border) != (beside[j] < border))
                    extend(z[i] + (z[j] - z[i]) * ((border - beside[i]) / (beside[j] - beside[i])));
        }
        if (!(farthest > 0)) return 0;
        key = max(key, static_cast<float>(1 / farthest));
        return nearest > 0 ? min(key, static_cast<float>(1 / nearest)) : key;
    }

private:
    static Vec3d relative(const RaySetup& ray, Vec3 p) {
        const Vec3d q = toDouble(p) - toDouble(ray.org);
        return {q[ray.kx], q[ray.ky], q[ray.k] * static_cast<double>(ray.sign)};
    }

    Vec3d dir_, v_[3], n_; // lateral x, lateral y, depth
    double along_;
};

// Key of the hit, 1/z: the larger, the nearer. 0 when the ray misses the triangle.
inline float canonicalKey(const RaySetup& ray, Vec3 v0, Vec3 v1, Vec3 v2) {
    const ShearedTriangle s(ray, v0, v1, v2);
    if (!s.containsRay()) return 0;

    const Vec3(&v)[3] = s.v;
    const float zMin = min(v[0].z, min(v[1].z, v[2].z));
    const float zMax = max(v[0].z, max(v[1].z, v[2].z));
    if (!(zMax > 0)) return 0;

    const TrianglePlane plane(ray, v0, v1, v2);
    float key = plane.key();
    const auto isMetBehind = [&] { return !(zMin > 0) && !(key > 0); }; // straddles the origin
    if (isMetBehind()) return 0;
    if (plane.isEdgeOn()) key = plane.keyInChord(key);
    if (isMetBehind()) return 0;
    const float nearest = zMin > 0 ? 1.0f / zMin : std::numeric_limits<float>::infinity();
    key = min(max(key, 1.0f / zMax), nearest);

    // Entry into and exit from the triangle's own box on the two lateral axes.
    const float xLo = min(v[0].x, min(v[1].x, v[2].x));
    const float xHi = max(v[0].x, max(v[1].x, v[2].x));
    const float yLo = min(v[0].y, min(v[1].y, v[2].y));
    const float yHi = max(v[0].y, max(v[1].y, v[2].y));
    const bool leftwards = ray.rx < 0, downwards = ray.ry < 0;
    const float xEntry = (leftwards ? xHi : xLo) * ray.rx - ray.px;
    const float yEntry = (downwards ? yHi : yLo) * ray.ry - ray.py;
    const float xExit = (leftwards ? xLo : xHi) * ray.rx + ray.px;
    const float yExit = (downwards ? yLo : yHi) * ray.ry + ray.py;
    if (xExit < 0 || yExit < 0) return 0;
    const float entry = max(xEntry, yEntry);
    if (entry > 0) key = min(key, 1.0f / entry);
    return key;
}
