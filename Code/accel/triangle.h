// The canonical hit of a ray and a triangle: one definition that every kernel has to reproduce to
// the last bit, so that no tree, width or order of traversal can change a picture.
// Edges: Woop, Benthin, Wald 2013 without FMA. Rounding is monotone, so the float sign of an edge
// function is never wrong, it can only be zero; zeros are decided in double, where the products of
// two floats are exact, and what is zero there by one rule for all triangles. Both triangles of an
// edge see the same bits: closed meshes do not leak.
// Depth: of the triangle's plane, clamped to the triangle's own depth range and to the entry of its
// own padded box, so that culling by boxes never removes the nearest hit.
#pragma once

#include "accel/ray_setup.h"

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

// 1/z where the ray meets the triangle's plane. In double: the cross product of long, nearly
// parallel edges cancels, and a float plane of a needle is met anywhere along the needle, by rays
// that leave it or that end on it. Double takes needles of 1e8. The direction as it is, not its
// rounded slopes: those move the hit of a triangle that is seen edge-on far along the ray.
inline float planeKey(const RaySetup& ray, Vec3 p0, Vec3 p1, Vec3 p2) {
    const auto relative = [&](Vec3 p) {
        const Vec3d q = toDouble(p) - toDouble(ray.org);
        return Vec3d{q[ray.kx], q[ray.ky], q[ray.k] * static_cast<double>(ray.sign)};
    };
    const Vec3d v0 = relative(p0);
    const Vec3d n = cross(relative(p1) - v0, relative(p2) - v0);
    const Vec3d dir{ray.dx, ray.dy, ray.dz};
    return static_cast<float>(dot(n, dir) / (dot(n, v0) * static_cast<double>(ray.dz)));
}

// Key of the hit, 1/z: the larger, the nearer. 0 when the ray misses the triangle.
inline float canonicalKey(const RaySetup& ray, Vec3 v0, Vec3 v1, Vec3 v2) {
    const ShearedTriangle s(ray, v0, v1, v2);
    if (!s.containsRay()) return 0;

    const Vec3(&v)[3] = s.v;
    const float zMin = min(v[0].z, min(v[1].z, v[2].z));
    const float zMax = max(v[0].z, max(v[1].z, v[2].z));
    if (!(zMax > 0)) return 0;

    const float plane = planeKey(ray, v0, v1, v2);
    if (!(zMin > 0) && !(plane > 0)) return 0; // straddles the origin and is met behind it
    const float nearest = zMin > 0 ? 1.0f / zMin : std::numeric_limits<float>::infinity();
    float key = min(max(plane, 1.0f / zMax), nearest);

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
