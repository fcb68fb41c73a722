// Part of SolidPackets: meshes of a few triangles, one triangle at a time for all rays.

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

// Mesh::intersect(), OneSided::intersect() and the choice between their hit and the best one. Who
// can't be sure here asks the shape.
[[gnu::noinline]] void facets(const SolidTree::Solid& solid, const SolidTree::FacetGroup& group,
                              Floats entry, unsigned lanes, Hit* hits) {
    const Floats zero(0.0f), one(1.0f), endless(kInfinityF);
    Floats bestKey(0.0f), u(0.0f), v(0.0f);
    std::uint32_t prim[W] = {};
    unsigned asking = 0, unseen = 0;
    for (std::uint32_t f = 0; f < group.count; ++f) {
        const SolidTree::Facet& facet = group.facet[f];
        const FacetHit hit = meet(facet, group.extent);
        asking |= hit.undecided;
        const Floats t = one / (hit.key * dz_);
        const unsigned better = lanes & bits((hit.key > bestKey) & (t > tMin_) & (t < endless));
        if (better == 0) continue;
        bestKey = select(maskOf(better), hit.key, bestKey);
        const auto edge = [&](int a, int b) {
            return Doubles(hit.x[a]) * Doubles(hit.y[b]) - Doubles(hit.y[a]) * Doubles(hit.x[b]);
        };
        const Doubles e0 = edge(2, 1), e1 = edge(0, 2), e2 = edge(1, 0), sum = (e0 + e1) + e2;
        u = select(maskOf(better), (e1 / sum).toFloats(), u);
        v = select(maskOf(better), (e2 / sum).toFloats(), v);
        for (unsigned rest = better; rest != 0; rest &= rest - 1) prim[std::countr_zero(rest)] = f;
        if (group.side != ::Facets::Side::Both)
            unseen = (unseen & ~better) | (better & ~seesSide(facet.n, group.side));
    }
    const Floats t = one / (bestKey * dz_);
    unsigned better = lanes & bits((bestKey > zero) & (t <= best_)) & ~asking;
    asking = (asking & lanes) | (better & unseen);
    const Floats nearest = max(entry / dz_, t);
    for (unsigned equal = better & bits(nearest == best_); equal != 0; equal &= equal - 1)
        if (number_[std::countr_zero(equal)] != Hit::kNoShape) asking |= equal & (~equal + 1);
    better &= bits(nearest <= best_) & ~asking;
    if (better != 0) {
        alignas(64) float ts[W], us[W], vs[W];
        nearest.store(ts), u.store(us), v.store(vs);
        for (unsigned rest = better; rest != 0; rest &= rest - 1) {
            const int i = std::countr_zero(rest);
            hits[ray_[i]] = {
                .t = ts[i], .u = us[i], .v = vs[i], .prim = prim[i], .shape = solid.number};
            number_[i] = solid.number;
        }
        limit(select(maskOf(better), nearest, best_));
    }
    if (asking != 0) ask(solid, entry, asking, hits);
}

// Lanes that see the side for certain; Mesh::seesFront().
unsigned seesSide(Vec3d n, ::Facets::Side side) const {
    const Doubles x(d_[0]), y(d_[1]), z(d_[2]), zero(0.0);
    const Doubles facing = (Doubles(n.x) * x + Doubles(n.y) * y) + Doubles(n.z) * z;
    const Doubles least = Doubles(0x1p-40 * dot(n, n)) * ((x * x + y * y) + z * z);
    const unsigned sure = ~atMost(facing * facing, least);
    return sure & (side == ::Facets::Side::Front ? ~atMost(zero, facing) : ~atMost(facing, zero));
}

[[gnu::noinline]] void facets(const SolidTree::Solid& solid, const SolidTree::FacetGroup& group,
                              Floats entry, unsigned lanes, std::uint8_t* hidden) {
    const Floats one(1.0f);
    for (std::uint32_t f = 0; f < group.count; ++f) {
        const FacetHit hit = meet(group.facet[f], group.extent);
        const Floats t = one / (hit.key * dz_);
        const unsigned met =
            lanes & ~hit.undecided & bits((hit.key > Floats(0.0f)) & (t > tMin_) & (t < best_));
        hide(met, hidden);
        lanes &= ~met;
        if (const unsigned asking = lanes & hit.undecided; asking != 0) {
            ask(solid, entry, asking, hidden);
            lanes &= ~asking;
        }
        if (lanes == 0) return;
    }
}
