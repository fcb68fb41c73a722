// Meshes of a few triangles, one triangle at a time for all rays of a packet, with the bits of
// shape/mesh.cpp and shape/one_sided.cpp.
// Included by solids.inl.

class PacketFacets : public PacketHulls {
protected:
    using PacketHulls::PacketHulls;

    // canonicalKey() of accel/triangle.h and barycentrics(), operation by operation.
    struct FacetHit {
        Floats x[3], y[3];      // as in ShearedTriangle
        Floats key;             // 0: missed
        unsigned undecided = 0; // lanes that meet an edge, or that the lateral clamp may change
    };

    // In the order (lateral x, lateral y, depth) of each ray's own axes.
    Floats lateralX(Floats x, Floats y, Floats z) const {
        return select(alongZ_, x, select(alongY_, z, y));
    }
    Floats lateralY(Floats x, Floats y, Floats z) const {
        return select(alongZ_, y, select(alongY_, x, z));
    }
    Floats dominant(Floats x, Floats y, Floats z) const {
        return select(alongZ_, z, select(alongY_, y, x));
    }

    FacetHit meet(const SolidTree::Facet& facet, float extent) const {
        const Floats zero(0.0f), one(1.0f);
        const Floats ox = lateralX(o_[0], o_[1], o_[2]), oy = lateralY(o_[0], o_[1], o_[2]),
                     oz = dominant(o_[0], o_[1], o_[2]);
        Floats px[3], py[3], pz[3], vx[3], vy[3], vz[3];
        FacetHit hit;
        for (std::size_t c = 0; c < 3; ++c) {
            const Floats x(facet.corner[c].x), y(facet.corner[c].y), z(facet.corner[c].z);
            px[c] = lateralX(x, y, z), py[c] = lateralY(x, y, z), pz[c] = dominant(x, y, z);
            vx[c] = px[c] - ox, vy[c] = py[c] - oy, vz[c] = (pz[c] - oz) * sign_;
            hit.x[c] = vx[c] - Sx_ * vz[c], hit.y[c] = vy[c] - Sy_ * vz[c];
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

        // planeKey()
        const Doubles sign(sign_), dz(dz_);
        const auto from = [](Floats p, Floats o) { return Doubles(p) - Doubles(o); };
        const Doubles x0 = from(px[0], ox), y0 = from(py[0], oy), z0 = from(pz[0], oz) * sign;
        const Doubles ax = from(px[1], ox) - x0, ay = from(py[1], oy) - y0,
                      az = from(pz[1], oz) * sign - z0;
        const Doubles bx = from(px[2], ox) - x0, by = from(py[2], oy) - y0,
                      bz = from(pz[2], oz) * sign - z0;
        const Doubles nx = ay * bz - az * by, ny = az * bx - ax * bz, nz = ax * by - ay * bx;
        const Doubles dx(lateralX(d_[0], d_[1], d_[2])), dy(lateralY(d_[0], d_[1], d_[2]));
        const Doubles along = (nx * dx + ny * dy) + nz * dz;
        const Floats plane = (along / (((nx * x0 + ny * y0) + nz * z0) * dz)).toFloats();

        const Mask met = inside & (zMax > zero) & ((zMin > zero) | (plane > zero));
        const Floats nearest = select(zMin > zero, one / zMin, Floats(kInfinityF));
        const Floats key = min(max(plane, one / zMax), nearest);
        // A quarter of the canonical pad.
        const Floats pad = max(Floats(extent), oMax_) * Floats(0x1p-21f);
        const Mask inBox = ((least(vx) - pad) * key <= Sx_) & (Sx_ <= (most(vx) + pad) * key) &
                           ((least(vy) - pad) * key <= Sy_) & (Sy_ <= (most(vy) + pad) * key);
        const unsigned zeros = bits((U == zero) | (V == zero) | (R == zero));
        hit.undecided = bits(met) & (zeros | ~bits(inBox));
        hit.key = select(met, key, zero);
        return hit;
    }

    // Lanes that see the side for certain; Mesh::seesFront().
    unsigned seesSide(Vec3d n, ::Facets::Side side) const {
        const Doubles x(d_[0]), y(d_[1]), z(d_[2]), zero(0.0);
        const Doubles facing = (Doubles(n.x) * x + Doubles(n.y) * y) + Doubles(n.z) * z;
        const Doubles least = Doubles(0x1p-40 * dot(n, n)) * ((x * x + y * y) + z * z);
        const unsigned sure = ~atMost(facing * facing, least);
        return sure &
               (side == ::Facets::Side::Front ? ~atMost(zero, facing) : ~atMost(facing, zero));
    }
};
