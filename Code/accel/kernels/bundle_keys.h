// Canonical keys for the rays of a bundle, W at a time: accel/triangle.h in vectors, operation by
// operation, with what is seldom asked left to its own code.
#pragma once

#include "accel/kernels/bundle_rays.h"
#include "accel/kernels/chord.h"
#include "accel/kernels/kernels.h"
#include "accel/kernels/queue_rays.h"
#include "simd/vectors3.h"
#include "accel/kernels/wide_tree.h"
#include "base/math.h"
#include "base/vec.h"
#include "simd/lanes.h"

#include <bit>
#include <cstddef>
#include <cstdint>

LANES_BEGIN

// TrianglePlane up to the ray, and the bounds of canonicalKey(), for W triangles. The padded box is
// a quarter of the canonical pad wide of the triangle: a key that is inside it on both lateral axes
// is not changed by the canonical clamp to the box. Along the dominant axis a plane counts as the
// world does: where rays go backwards, that turns signs in pairs and changes no bit of a key.
struct BundlePlanes {
    Doubles nx, ny, nz, n0;                // normal, and its product with a corner
    Doubles edgeOn;                        // see edgeOnLanes()
    Floats zMin, zMax, xLo, xHi, yLo, yHi; // depths of the corners; the padded box
};

// The same in memory, a column per triangle.
struct alignas(64) BundlePlaneList {
    double nx[W], ny[W], nz[W], n0[W], edgeOn[W];
    float zMin[W], zMax[W], xLo[W], xHi[W], yLo[W], yHi[W];

    void store(const BundlePlanes& p) {
        p.nx.store(nx), p.ny.store(ny), p.nz.store(nz), p.n0.store(n0);
        p.edgeOn.store(edgeOn), p.zMin.store(zMin), p.zMax.store(zMax);
        p.xLo.store(xLo), p.xHi.store(xHi), p.yLo.store(yLo), p.yHi.store(yHi);
    }
    // That of triangle j in every lane.
    BundlePlanes operator[](unsigned j) const {
        return {nx[j],   ny[j],  nz[j],  n0[j],  edgeOn[j], zMin[j],
                zMax[j], xLo[j], xHi[j], yLo[j], yHi[j]};
    }
};

template <Query Q> class BundleKeys {
public:
    BundleKeys(const WideMesh& mesh, const BundleRays<Q>& rays)
        : mesh_(mesh), rays_(rays), pad_(::max(mesh.extent, maxAbs(rays.origin)) * 0x1p-21f) {}

    // Where a triangle is: the line of its leaf times 16, plus its number in it.
    static constexpr std::uint32_t kNowhere = 0xffffffffu;
    static std::uint32_t placeOf(WideRef leaf) { return (leaf >> 2) << 4; }
    static unsigned laneOf(std::uint32_t place) { return place & 15; }
    const WideLeaf<W>& leafOf(std::uint32_t place) const {
        return mesh_.tree.at<WideLeaf<W>>(wideRef(place >> 4, WideKind::Leaf));
    }
    std::uint32_t triangleAt(std::uint32_t place) const {
        return mesh_.tree.triangleIds[leafOf(place).first + laneOf(place)];
    }

    // ShearedTriangle::containsRay() for the rays of packet q; what it has to decide in double is
    // asked ray by ray.
    [[gnu::noinline]] Mask containsRays(std::uint32_t place, unsigned q) const {
        const WideLeaf<W>& leaf = leafOf(place);
        const Floats Sx = Floats::load(rays_.Sx[q]), Sy = Floats::load(rays_.Sy[q]), zero(0.0f);
        Floats x[3], y[3];
        for (int i = 0; i < 3; ++i) {
            const auto at = [&](std::size_t axis) {
                return leaf.point[axis][leaf.corner[i][laneOf(place)]] - rays_.origin[axis];
            };
            const Floats z(at(rays_.k) * rays_.sign);
            x[i] = Floats(at(rays_.kx)) - Sx * z;
            y[i] = Floats(at(rays_.ky)) - Sy * z;
        }
        const Floats U = x[2] * y[1] - y[2] * x[1], V = x[0] * y[2] - y[0] * x[2],
                     R = x[1] * y[0] - y[1] * x[0];
        const Mask positive = (U >= zero) & (V >= zero) & (R >= zero);
        const Mask negative = (U <= zero) & (V <= zero) & (R <= zero);
        unsigned inside = bits(positive | negative) & rays_.active[q];
        unsigned zeros = inside & bits((U == zero) | (V == zero) | (R == zero));
        for (; zeros != 0; zeros &= zeros - 1) {
            const int i = std::countr_zero(zeros);
            if (exactKeyOf(place, q, i) == 0) inside &= ~(1u << i);
        }
        return maskOf(inside);
    }

    // Of the triangles with these corners; point(i, axis): the axis of corner i.
    template <class PointFn> [[gnu::always_inline]] BundlePlanes planesOf(PointFn&& point) const {
        const auto exact = [&](int i, std::size_t axis) { // in double, as TrianglePlane has it
            return Doubles(point(i, axis)) - Doubles(static_cast<double>(rays_.origin[axis]));
        };
        const auto rounded = [&](int i, std::size_t axis) {
            return point(i, axis) - Floats(rays_.origin[axis]);
        };
        const std::size_t k = rays_.k, kx = rays_.kx, ky = rays_.ky;
        // With the direction's sign: a plane through the origin is at plus or minus infinity.
        const Doubles sign(static_cast<double>(rays_.sign));
        const auto depth = [&](int i) { return exact(i, k) * sign; };
        const Doubles x0 = exact(0, kx), y0 = exact(0, ky), z0 = depth(0);
        const Doubles ax = exact(1, kx) - x0, ay = exact(1, ky) - y0, az = depth(1) - z0;
        const Doubles bx = exact(2, kx) - x0, by = exact(2, ky) - y0, bz = depth(2) - z0;
        const Doubles nx = ay * bz - az * by, ny = az * bx - ax * bz, nz = ax * by - ay * bx;
        const auto least = [&](Floats a, Floats b, Floats c) { return min(min(a, b), c); };
        const auto most = [&](Floats a, Floats b, Floats c) { return max(max(a, b), c); };
        const Floats pad(pad_), s(rays_.sign);
        const Floats vx[3] = {rounded(0, kx), rounded(1, kx), rounded(2, kx)};
        const Floats vy[3] = {rounded(0, ky), rounded(1, ky), rounded(2, ky)};
        const Floats vz[3] = {rounded(0, k) * s, rounded(1, k) * s, rounded(2, k) * s};
        return {nx,
                ny,
                nz,
                nx * x0 + ny * y0 + nz * z0,
                edgeOnBound(nx, ny, nz),
                least(vz[0], vz[1], vz[2]),
                most(vz[0], vz[1], vz[2]),
                least(vx[0], vx[1], vx[2]) - pad,
                most(vx[0], vx[1], vx[2]) + pad,
                least(vy[0], vy[1], vy[2]) - pad,
                most(vy[0], vy[1], vy[2]) + pad};
    }

    // Keys of hits of packet q, and which of them are any.
    [[gnu::always_inline]] Floats keysOf(const BundlePlanes& p, Ints places, unsigned q,
                                         Mask& inside) const {
        const Floats Sx = Floats::load(rays_.Sx[q]), Sy = Floats::load(rays_.Sy[q]);
        const Doubles dz(rays_.depth(q));
        const Doubles along =
            p.nx * Doubles(rays_.lateralX(q)) + p.ny * Doubles(rays_.lateralY(q)) + p.nz * dz;
        const Floats plane = (along / (p.n0 * dz)).toFloats();
        Floats key = plane;
        unsigned asked = 0;
        const unsigned edgeOn =
            edgeOnLanes(along, p.edgeOn, rays_.depth(q)) & bits(inside) & rays_.active[q];
        if (edgeOn != 0) [[unlikely]]
            key = edgeOnKeys(places, q, edgeOn, plane, asked);
        // Most are farther from the depths of all corners than two roundings of the products.
        const Mask between =
            (key * p.zMax > Floats(1.000001f)) & (key * p.zMin < Floats(0.999999f));
        if ((bits(inside) & ~bits(between)) != 0) key = betweenDepths(p, key, inside);
        const Mask inBox =
            (p.xLo * key <= Sx) & (Sx <= p.xHi * key) & (p.yLo * key <= Sy) & (Sy <= p.yHi * key);
        const unsigned clamped = bits(inside) & (asked | ~bits(inBox)) & rays_.active[q];
        if (clamped != 0) [[unlikely]]
            return clampedKeys(places, q, clamped, key);
        return key;
    }

private:
    // The canonical clamp to the depths of the corners. Keys of planes that are behind the origin
    // are none, nor those of chords there, which is asked of triangles that are so in part.
    static Floats betweenDepths(const BundlePlanes& p, Floats key, Mask& inside) {
        const Floats one(1.0f), zero(0.0f);
        const unsigned behind = bits(p.zMin <= zero) & ~bits(key > zero);
        inside = maskOf(bits(inside) & ~behind);
        const Floats nearest = select(p.zMin > zero, one / p.zMin, Floats(kInfinityF));
        return min(max(key, one / p.zMax), nearest);
    }

    // Keys of lanes that may see their triangles edge-on, in these chords. Of more triangles than
    // one, and where the plane is behind the origin, their own code has to be `asked`.
    [[gnu::noinline]] Floats edgeOnKeys(Ints places, unsigned q, unsigned lanes, Floats plane,
                                        unsigned& asked) const {
        alignas(64) std::uint32_t place[W];
        places.store(place);
        const std::uint32_t one = place[std::countr_zero(lanes)];
        asked = lanes & ~bits((places == Ints(one)) & (plane > Floats(0.0f)));
        const WideLeaf<W>& leaf = leafOf(one);
        Vec3d v[3];
        for (int i = 0; i < 3; ++i) {
            const auto exact = [&](std::size_t axis) {
                return static_cast<double>(leaf.point[axis][leaf.corner[i][laneOf(one)]]) -
                       static_cast<double>(rays_.origin[axis]);
            };
            v[i] = {exact(rays_.kx), exact(rays_.ky),
                    exact(rays_.k) * static_cast<double>(rays_.sign)};
        }
        return select(
            maskOf(lanes & ~asked),
            keysInChord(v, Doubles3::of(rays_.lateralX(q), rays_.lateralY(q), rays_.depth(q)),
                        plane),
            plane);
    }

    float exactKeyOf(std::uint32_t place, unsigned q, int lane) const {
        return exactKey(mesh_, rays_.origin, rays_.direction(static_cast<int>(q), lane),
                        leafOf(place), place & 15);
    }

    [[gnu::noinline]] Floats clampedKeys(Ints places, unsigned q, unsigned lanes,
                                         Floats key) const {
        alignas(64) float keys[W];
        alignas(64) std::uint32_t place[W];
        key.store(keys), places.store(place);
        for (; lanes != 0; lanes &= lanes - 1) {
            const int i = std::countr_zero(lanes);
            keys[i] = exactKeyOf(place[i], q, i);
        }
        return Floats::load(keys);
    }

    const WideMesh& mesh_;
    const BundleRays<Q>& rays_;
    float pad_;
};

LANES_END
