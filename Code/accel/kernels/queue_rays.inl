// W rays of the queue, by columns, and how they come from a batch.
// Included by the file of each instruction set inside its namespace, in front of queue.inl.

enum class Query { Closest, Any };

// What the steps of W rays read: RaySetup of accel/ray_setup.h by columns.
struct alignas(64) RayBlock {
    float r[3][W], nearOffset[3][W], farOffset[3][W]; // slabs of boxes by axis, in z
    std::uint32_t nearPlane[3][W];                    // where in a node, in bytes
    float zCut[W];
    // Triangles: origin and coordinates in the order lateral x, lateral y, depth.
    float origin[3][W];
    std::uint32_t axis[3][W];   // where in a leaf, in bytes
    float shearX[W], shearY[W]; // the slopes, for depths without the sign of the direction
    float sign[W];              // of the direction along z
    float lateralError[W];      // of a vertex in the ray's frame, 4 units of the space's size
    float dirX[W], dirY[W], dz[W];
    float key[W], below[W], tMax[W]; // of the best hit; see KeyRange of shape/triangle_queries.h
    std::uint32_t at[W], stackTop[W], triangle[W], ray[W];
    std::uint32_t bestLeaf[W], bestLane[W]; // where the triangle is
    std::uint32_t count, live;              // rays at the start and now
    bool inARow;                            // W rays that follow each other in the batch
};

// Bits 0 to W - 1 as bytes 0 or 1.
inline void storeFlags(unsigned flags, std::uint8_t* to) {
    for (int i = 0; i < W; i += 8) {
        const std::uint64_t each = (flags >> i & 0xff) * 0x0101010101010101u;
        const std::uint64_t bit = each & 0x8040201008040201u; // bit i of byte i
        const std::uint64_t bytes = (bit + 0x7f7f7f7f7f7f7f7fu) >> 7 & 0x0101010101010101u;
        std::memcpy(to + i, &bytes, 8);
    }
}

struct RayColumns {
    Floats ox, oy, oz, dx, dy, dz, tMin, tMax;
};

// The rays order[0 .. count - 1]; lanes behind them repeat the first.
inline RayColumns loadRays(const RaySpan& rays, const std::uint32_t* order, std::size_t count,
                           RayBlock& b) {
    bool inARow = count == W;
    for (std::uint32_t i = 0; i < W; ++i) {
        b.ray[i] = order[i < count ? i : 0];
        inARow &= b.ray[i] == order[0] + i;
    }
    b.inARow = inARow;
    RayColumns c;
    if (inARow) {
        loadVectors(&rays.org[order[0]].x, c.ox, c.oy, c.oz);
        loadVectors(&rays.dir[order[0]].x, c.dx, c.dy, c.dz);
        c.tMin = Floats::unaligned(&rays.tMin[order[0]]);
        c.tMax = Floats::unaligned(&rays.tMax[order[0]]);
        return c;
    }
    alignas(64) float o[3][W], d[3][W], tMin[W], tMax[W];
    for (std::size_t i = 0; i < W; ++i) {
        const Vec3 org = rays.org[b.ray[i]], dir = rays.dir[b.ray[i]];
        o[0][i] = org.x, o[1][i] = org.y, o[2][i] = org.z;
        d[0][i] = dir.x, d[1][i] = dir.y, d[2][i] = dir.z;
        tMin[i] = rays.tMin[b.ray[i]], tMax[i] = rays.tMax[b.ray[i]];
    }
    c.ox = Floats::load(o[0]), c.oy = Floats::load(o[1]), c.oz = Floats::load(o[2]);
    c.dx = Floats::load(d[0]), c.dy = Floats::load(d[1]), c.dz = Floats::load(d[2]);
    c.tMin = Floats::load(tMin), c.tMax = Floats::load(tMax);
    return c;
}

// Fills the block; the formulas are RaySetup's, lane by lane. Returns the lanes of the rays that
// isTraceable().
template <Query Q>
unsigned setUpRays(const RaySpan& rays, const std::uint32_t* order, std::size_t count, float extent,
                   RayBlock& b) {
    const auto [ox, oy, oz, dx, dy, dz, tMin, tMax] = loadRays(rays, order, count, b);
    const Floats one(1.0f), zero(0.0f);
    const Floats ax = abs(dx), ay = abs(dy), az = abs(dz);
    const Mask alongZ = (az >= ax) & (az >= ay), alongY = ay >= ax;
    const auto pick = [&](Floats x, Floats y, Floats z) {
        return select(alongZ, z, select(alongY, y, x));
    };
    const Floats depth = pick(dx, dy, dz), dMax = abs(depth);
    const Floats lateralX = pick(dy, dz, dx), lateralY = pick(dz, dx, dy);
    const Floats sign = select(depth < zero, Floats(-1.0f), one);
    const Floats Sx = lateralX / dMax, Sy = lateralY / dMax;
    const Floats smallest(RaySetup::kSmallestSlope);
    const Floats rx = one / withSign(max(abs(Sx), smallest), Sx);
    const Floats ry = one / withSign(max(abs(Sy), smallest), Sy);
    const Floats oMax = max(max(abs(ox), abs(oy)), abs(oz));
    const Floats e = max(Floats(extent), oMax) * Floats(0x1p-19f);
    const Floats px = e * abs(rx), py = e * abs(ry);
    const auto slab = [&](std::size_t axis, Floats org, Floats r, Floats pad) {
        const Floats at = (zero - org) * r, twice = pad + pad;
        r.store(b.r[axis]);
        (at - twice).store(b.nearOffset[axis]);
        (at + twice).store(b.farOffset[axis]);
        const auto plane = [&](std::uint32_t upper) {
            return Ints(static_cast<std::uint32_t>(axis * 2 + upper) * W * 4);
        };
        select(r < zero, plane(1), plane(0)).store(b.nearPlane[axis]);
    };
    slab(0, ox, pick(sign, ry, rx), pick(e, py, px));
    slab(1, oy, pick(rx, sign, ry), pick(px, e, py));
    slab(2, oz, pick(ry, rx, sign), pick(py, px, e));

    pick(oy, oz, ox).store(b.origin[0]);
    pick(oz, ox, oy).store(b.origin[1]);
    pick(ox, oy, oz).store(b.origin[2]);
    const auto place = [&](std::uint32_t x, std::uint32_t y, std::uint32_t z) {
        constexpr std::uint32_t row = W * 4;
        return select(alongZ, Ints(z * row), select(alongY, Ints(y * row), Ints(x * row)));
    };
    place(1, 2, 0).store(b.axis[0]);
    place(2, 0, 1).store(b.axis[1]);
    place(0, 1, 2).store(b.axis[2]);
    (Sx * sign).store(b.shearX);
    (Sy * sign).store(b.shearY);
    sign.store(b.sign);
    (e * Floats(0.125f)).store(b.lateralError);
    lateralX.store(b.dirX), lateralY.store(b.dirY);
    dMax.store(b.dz);
    tMax.store(b.tMax);
    // Keys that count are in (above, below); see KeyRange of shape/triangle_queries.h.
    const Floats above = keyAbove(tMax, dMax);
    const Floats zCut = select(above > zero, (one / above) * Floats(1.0000005f),
                               Floats(std::numeric_limits<float>::max()));
    (Q == Query::Any ? above : zero).store(b.key);
    keyBelow(tMin, dMax).store(b.below);
    zCut.store(b.zCut);
    Ints(TriangleHit::kNone).store(b.triangle);
    b.count = static_cast<std::uint32_t>(count);

    const Floats sum = ((dx + dy) + dz) + ((ox + oy) + oz);
    const Floats dLargest = max(max(ax, ay), az);
    const Mask traceable = (dLargest > Floats(1e-30f)) & (dLargest < Floats(1e30f)) &
                           (oMax < Floats(1e30f)) & (sum - sum == zero);
    return bits(traceable) & ((1u << count) - 1);
}

// Lanes whose rays enter a box; RaySetup::enters().
inline unsigned raysEntering(const RayBlock& b, const Bounds& box) {
    Floats entry(0.0f), exit = Floats::load(b.zCut);
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const Floats r = Floats::load(b.r[axis]), lo(box.lo[axis]), hi(box.hi[axis]);
        const Mask backwards = r < Floats(0.0f);
        entry = max(fma(select(backwards, hi, lo), r, Floats::load(b.nearOffset[axis])), entry);
        exit = min(fma(select(backwards, lo, hi), r, Floats::load(b.farOffset[axis])), exit);
    }
    return bits(entry <= exit);
}
