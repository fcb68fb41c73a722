// Meshes of a few triangles, one triangle at a time for all rays of a packet, with the bits of
// shape/mesh.cpp and shape/one_sided.cpp.
#pragma once

#include "accel/kernels/chord.h"
#include "accel/kernels/solids.h"
#include "accel/kernels/solids_rays.h"
#include "base/math.h"
#include "base/vec.h"
#include "simd/lanes.h"

#include <cstddef>

LANES_BEGIN

class PacketFacets : public PacketRays {
protected:
    using PacketRays::PacketRays;

    // canonicalKey() of accel/triangle.h and barycentrics(), operation by operation.
    struct FacetHit {
        Floats x[3], y[3]; // as in ShearedTriangle
        Floats key;        // 0: missed
        unsigned undecided =
            0; // lanes that meet an edge, see it edge-on, or that the lateral clamp may change
    };

    FacetHit meet(const SolidTree::Facet& facet, float extent) const {
        const Floats zero(0.0f), one(1.0f);
        const Floats ox = lanes_.lateralX(columns_.org), oy = lanes_.lateralY(columns_.org),
                     oz = lanes_.dominant(columns_.org);
        Floats px[3], py[3], pz[3], vx[3], vy[3], vz[3];
        FacetHit hit;
        for (std::size_t c = 0; c < 3; ++c) {
            const Vec3 corner = facet.corner[c];
            const Floats p[3] = {Floats(corner.x), Floats(corner.y), Floats(corner.z)};
            px[c] = lanes_.lateralX(p), py[c] = lanes_.lateralY(p), pz[c] = lanes_.dominant(p);
            vx[c] = px[c] - ox, vy[c] = py[c] - oy, vz[c] = (pz[c] - oz) * lanes_.sign;
            hit.x[c] = vx[c] - lanes_.Sx * vz[c], hit.y[c] = vy[c] - lanes_.Sy * vz[c];
        }
        const Floats U = hit.x[2] * hit.y[1] - hit.y[2] * hit.x[1],
                     V = hit.x[0] * hit.y[2] - hit.y[0] * hit.x[2],
                     R = hit.x[1] * hit.y[0] - hit.y[1] * hit.x[0];
        const Mask inside =
            ((U >= zero) & (V >= zero) & (R >= zero)) | ((U <= zero) & (V <= zero) & (R <= zero));
        hit.key = zero;
        if (bits(inside) == 0) return hit;
        const auto least = [](const Floats(&v)[3]) { return min(v[0], min(v[1], v[2])); };
        const auto most = [](const Floats(&v)[3]) { return max(v[0], max(v[1], v[2])); };
        const Floats zMin = least(vz), zMax = most(vz);

        // TrianglePlane
        const Doubles sign(lanes_.sign), dz(lanes_.dz);
        const auto from = [](Floats p, Floats o) { return Doubles(p) - Doubles(o); };
        const Doubles x0 = from(px[0], ox), y0 = from(py[0], oy), z0 = from(pz[0], oz) * sign;
        const Doubles ax = from(px[1], ox) - x0, ay = from(py[1], oy) - y0,
                      az = from(pz[1], oz) * sign - z0;
        const Doubles bx = from(px[2], ox) - x0, by = from(py[2], oy) - y0,
                      bz = from(pz[2], oz) * sign - z0;
        const Doubles nx = ay * bz - az * by, ny = az * bx - ax * bz, nz = ax * by - ay * bx;
        const Doubles dx(lanes_.lateralX(columns_.dir)), dy(lanes_.lateralY(columns_.dir));
        const Doubles along = (nx * dx + ny * dy) + nz * dz;
        const Floats plane = (along / (((nx * x0 + ny * y0) + nz * z0) * dz)).toFloats();

        const Mask met = inside & (zMax > zero) & ((zMin > zero) | (plane > zero));
        const Floats nearest = select(zMin > zero, one / zMin, Floats(kInfinityF));
        const Floats key = min(max(plane, one / zMax), nearest);
        // A quarter of the canonical pad.
        const Floats pad = max(Floats(extent), lanes_.oMax) * Floats(0x1p-21f);
        const Mask inBox =
            ((least(vx) - pad) * key <= lanes_.Sx) & (lanes_.Sx <= (most(vx) + pad) * key) &
            ((least(vy) - pad) * key <= lanes_.Sy) & (lanes_.Sy <= (most(vy) + pad) * key);
        const unsigned zeros = bits((U == zero) | (V == zero) | (R == zero));
        const unsigned edgeOn = edgeOnLanes(along, edgeOnBound(nx, ny, nz), lanes_.dz);
        hit.undecided = bits(met) & (zeros | edgeOn | ~bits(inBox));
        hit.key = select(met, key, zero);
        return hit;
    }

    // Lanes that see the side for certain; Mesh::seesFront().
    unsigned seesSide(Vec3d n, ::Facets::Side side) const {
        const Doubles x(columns_.dir[0]), y(columns_.dir[1]), z(columns_.dir[2]), zero(0.0);
        const Doubles facing = (Doubles(n.x) * x + Doubles(n.y) * y) + Doubles(n.z) * z;
        const Doubles least = Doubles(0x1p-40 * dot(n, n)) * ((x * x + y * y) + z * z);
        const unsigned sure = ~atMost(facing * facing, least);
        return sure &
               (side == ::Facets::Side::Front ? ~atMost(zero, facing) : ~atMost(facing, zero));
    }
};

LANES_END
