// The triangles of a leaf against the rays of a bundle. Triangles are set up W at a time and culled
// against the rectangles of the packets; then every pair (triangle, packet) that is left is tested,
// W rays at a time. The tests in front of the canonical hit are certain or exact:
//   edges: as affine functions of S, with a bound of their and the canonical ones' rounding; where
//     the sign is not certain, the canonical edge functions decide;
//   depth: the key of a hit is between those of the triangle's nearest and farthest corner. As long
//     as that tells which of two hits is nearer, neither key is computed: for fine meshes that is
//     nearly always, and one key per ray is enough, at its end.
// Included like queue.inl, behind bundle_rays.inl.

template <Query Q> class BundleLeaf {
public:
    BundleLeaf(const WideMesh& mesh, const BundleRays<Q>& rays)
        : mesh_(mesh), rays_(rays), pad_(::max(mesh.extent, maxAbs(rays.origin)) * 0x1p-21f) {}

    // Behind BundleRays::nextRound().
    void start() {
        open_ = static_cast<std::uint32_t>((std::uint64_t{1} << rays_.packets) - 1);
        zTop_ = 0;
        unmet_ = 0;
        for (int q = 0; q < rays_.packets; ++q) {
            const Floats above = Floats::load(rays_.above[q]);
            above.store(keyLo_[q]), above.store(keyHi_[q]);
            Ints(kNowhere).store(place_[q]);
            if constexpr (Q == Query::Any) missing_[q] = rays_.active[q];
            zTop_ = ::max(rays_.zFar[q], zTop_);
        }
        limitDepth();
    }

    // Nothing behind it can be better for any ray; below 0: all rays are done.
    float zCut() const { return zCut_; }

    void test(WideRef ref) {
        const auto& l = mesh_.tree.at<WideLeaf<W>>(ref);
        Block& b = block_;
        if (!setUp(l, b)) return;
        b.leaf = &l;
        b.firstPlace = placeOf(ref);
        if (!testPairs(b)) return;
        if constexpr (Q == Query::Any) closePackets();
        limitDepth();
    }

    void finish(const HitLists& hits) {
        const Ints none(TriangleHit::kNone), noShape(Hit::kNoShape);
        const Floats zero(0.0f), never(kInfinityF);
        for (int q = 0; q < rays_.packets; ++q) {
            const Floats tMax = Floats::load(rays_.tMax[q]);
            const unsigned found = bits(Ints::load(place_[q]) < Ints(kNowhere)) & rays_.active[q];
            if (found == 0) {
                if (hits.whole != nullptr)
                    rays_.write(q, tMax, {zero, zero}, Ints(0u), noShape, hits.whole);
                else
                    rays_.write(q, never, none, hits.brief);
                continue;
            }
            const Winners winners = winnersOf(static_cast<unsigned>(q), found);
            settle(static_cast<unsigned>(q), found, winners);
            const Floats t = Floats(1.0f) / (Floats::load(keyLo_[q]) * Floats::load(rays_.dz[q]));
            const Mask hit = maskOf(found) & (t <= tMax);
            if (hits.whole != nullptr) {
                const Weights w = weightsOf(winners, static_cast<unsigned>(q));
                rays_.write(q, select(hit, t, tMax),
                            {select(hit, w.u, zero), select(hit, w.v, zero)},
                            select(hit, winners.id, Ints(0u)),
                            select(hit, Ints(hits.shape), noShape), hits.whole);
            } else {
                rays_.write(q, select(hit, t, never), select(hit, winners.id, none), hits.brief);
            }
        }
    }
    void finish(std::uint8_t* hidden) const {
        for (int q = 0; q < rays_.packets; ++q) rays_.write(q, ~missing_[q], hidden);
    }

private:
    static constexpr int kPackets = BundleRays<Q>::kPackets;
    static constexpr float kUnit = 0x1p-24f; // of rounding

    // Where a triangle is: the line of its leaf times 16, plus its number in it.
    static constexpr std::uint32_t kNowhere = 0xffffffffu;
    static std::uint32_t placeOf(WideRef leaf) { return (leaf >> 2) << 4; }
    const WideLeaf<W>& leafOf(std::uint32_t place) const {
        return mesh_.tree.at<WideLeaf<W>>(wideRef(place >> 4, WideKind::Leaf));
    }
    std::uint32_t triangleAt(std::uint32_t place) const {
        return mesh_.tree.triangleIds[leafOf(place).first + (place & 15)];
    }

    struct Corners {
        Floats x[3], y[3], z[3]; // ShearedTriangle::v
    };

    // What the rays need of the W triangles of a leaf, one column per triangle.
    struct alignas(64) Block {
        float edge[3][3][W];               // edge e at S: edge[e][0] + x edge[e][1] + y edge[e][2]
        float noise[W];                    // the sign of an edge is certain beyond this
        float keyLo[W], keyHi[W];          // bounds of the key of any hit
        double nx[W], ny[W], nz[W], n0[W]; // normal, and its product with a corner
        float xLo[W], xHi[W], yLo[W], yHi[W]; // of the triangle's box, padded
        float nearest[W], farthest[W];        // keys of the corners' depths
        unsigned uncertain;  // triangles that may be seen from their edge: the edges are no help
        unsigned straddling; // in part behind the origin
        unsigned wide;       // whose key is better computed at once
        bool hasPlanes;      // nx to farthest are filled
        const WideLeaf<W>* leaf;
        std::uint32_t firstPlace;
        int pairs;
        alignas(64) std::uint32_t pair[kPackets * W + W]; // packet * 16 + triangle
    };

    Corners cornersOf(const WideLeaf<W>& l) const {
        const auto relative = [&](std::size_t axis) {
            return Floats::load(l.point[axis]) - Floats(rays_.origin[axis]);
        };
        const Floats x = relative(rays_.kx), y = relative(rays_.ky),
                     z = relative(rays_.k) * Floats(rays_.sign);
        Corners c;
        for (int i = 0; i < 3; ++i) {
            const Ints at = Ints::bytes(l.corner[i]);
            c.x[i] = permute(x, at), c.y[i] = permute(y, at), c.z[i] = permute(z, at);
        }
        return c;
    }

    // Fills the block and its list of pairs; false when there are none.
    [[gnu::always_inline]] bool setUp(const WideLeaf<W>& l, Block& b) const {
        const Floats zero(0.0f), one(1.0f);
        const Corners v = cornersOf(l);
        const Floats zMin = min(min(v.z[0], v.z[1]), v.z[2]);
        const Floats zMax = max(max(v.z[0], v.z[1]), v.z[2]);
        unsigned live = bits((zMax > zero) & (zMin <= Floats(zCut_))) & ((1u << l.count) - 1);
        const unsigned close = bits(zMin <= Floats(kTooNear));

        // Where the corners are seen from the origin, about the centre of the rectangle.
        Floats x[3], y[3], seenX[3], seenY[3];
        for (int i = 0; i < 3; ++i) {
            x[i] = fnma(Floats(rays_.centreX), v.z[i], v.x[i]);
            y[i] = fnma(Floats(rays_.centreY), v.z[i], v.y[i]);
            const Floats inverse = roughInverse(v.z[i]);
            seenX[i] = x[i] * inverse, seenY[i] = y[i] * inverse;
        }
        const Floats xLo = min(min(seenX[0], seenX[1]), seenX[2]);
        const Floats xHi = max(max(seenX[0], seenX[1]), seenX[2]);
        const Floats yLo = min(min(seenY[0], seenY[1]), seenY[2]);
        const Floats yHi = max(max(seenY[0], seenY[1]), seenY[2]);
        const auto overlap = [&](const typename BundleRays<Q>::Rect& r) {
            return close | (bits((xLo <= Floats(r.x.hi)) & (xHi >= Floats(r.x.lo))) &
                            bits((yLo <= Floats(r.y.hi)) & (yHi >= Floats(r.y.lo))));
        };
        live &= overlap(rays_.all);
        if (live == 0) return false;

        // Edge functions as affine functions of S - centre, turned so that inside is positive.
        // noise: Woop's vertices differ from exact ones by u (|S| z + 3 R) each, R the size of the
        // triangle about the rectangle, which moves an edge by u R (2 z |S| + 12 R); evaluation of
        // the affine form adds 27 u R^2 at most, without FMA.
        const Floats zSize = max(zMax, zero - zMin);
        Floats reach = zSize, size(0.0f);
        for (int i = 0; i < 3; ++i) {
            reach = max(reach, max(abs(v.x[i]), abs(v.y[i])));
            size = max(size, max(abs(x[i]), abs(y[i])));
        }
        size = fma(zSize, Floats(::max(rays_.halfX, rays_.halfY)), size);
        const Floats noise =
            size * fma(zSize, Floats(2.2f * kUnit * rays_.slopeSum), size * Floats(44 * kUnit));

        const Floats e1x = v.x[1] - v.x[0], e1y = v.y[1] - v.y[0], e1z = v.z[1] - v.z[0];
        const Floats e2x = v.x[2] - v.x[0], e2y = v.y[2] - v.y[0], e2z = v.z[2] - v.z[0];
        const Floats nx = e1y * e2z - e1z * e2y, ny = e1z * e2x - e1x * e2z,
                     nz = e1x * e2y - e1y * e2x;
        const Floats side = (nx * v.x[0] + ny * v.y[0]) + nz * v.z[0];
        const Floats longest =
            max(max(max(abs(e1x), abs(e1y)), max(abs(e1z), abs(e2x))), max(abs(e2y), abs(e2z)));
        const unsigned uncertain =
            bits(notGreater(abs(side), longest * longest * reach * Floats(48 * kUnit)));
        const Floats turn = zero - side;
        Floats at[3], alongX[3], alongY[3];
        for (int e = 0; e < 3; ++e) {
            const int i = (e + 1) % 3, k = (e + 2) % 3;
            at[e] = flipSign(fms(x[k], y[i], y[k] * x[i]), turn);
            alongX[e] = flipSign(fms(y[k], v.z[i], y[i] * v.z[k]), turn);
            alongY[e] = flipSign(fms(x[i], v.z[k], x[k] * v.z[i]), turn);
        }

        // Which packets overlap which triangles and are outside none of its edges.
        const Floats least = zero - noise;
        int pairs = 0;
        std::uint32_t packets = open_;
        if ((live & close) == 0) {
            const Mask on = maskOf(live);
            const auto range = [&](Floats lo, Floats hi) {
                return typename BundleRays<Q>::Range{smallest(select(on, lo, Floats(kInfinityF))),
                                                     largest(select(on, hi, Floats(-kInfinityF)))};
            };
            packets &= rays_.overlapping(range(xLo, xHi), range(yLo, yHi));
        }
        for (; packets != 0; packets &= packets - 1) {
            const auto q = static_cast<std::size_t>(std::countr_zero(packets));
            const auto& r = rays_.rect[q];
            unsigned wanted = live & overlap(r);
            const Floats cx(r.centreX), cy(r.centreY), hx(r.halfX), hy(r.halfY);
            const auto most = [&](int e) {
                return fma(hx, abs(alongX[e]),
                           fma(hy, abs(alongY[e]), fma(cx, alongX[e], fma(cy, alongY[e], at[e]))));
            };
            wanted &= uncertain | bits(notGreater(least, min(min(most(0), most(1)), most(2))));
            if constexpr (Q == Query::Any) wanted &= bits(zMin <= Floats(rays_.zFar[q]));
            storeChosen(wanted, kPair[q].data(), b.pair + pairs);
            pairs += std::popcount(wanted);
        }
        if (pairs == 0) return false;

        b.pairs = pairs;
        noise.store(b.noise);
        for (int e = 0; e < 3; ++e) {
            at[e].store(b.edge[e][0]);
            alongX[e].store(b.edge[e][1]), alongY[e].store(b.edge[e][2]);
        }
        // A ray that containsRay() meets the triangle, up to 4 units of rounding across, between
        // its least and its largest depth, and so in front of the exit of its padded box: its key
        // is in [1/zMax (1 - 4u), 1/zMin].
        const Floats lo = (one / zMax) * Floats(0.999999f);
        const Floats hi = select(zMin > Floats(kTooNear), one / zMin, Floats(kInfinityF));
        lo.store(b.keyLo), hi.store(b.keyHi);
        b.uncertain = uncertain;
        b.straddling = bits(zMin <= zero);
        b.wide = ~bits(hi < min(lo * Floats(kWide), Floats(rays_.leastBelow)));
        b.hasPlanes = false;
        return true;
    }

    // Tests the pairs of the list; true when a ray has got a better hit.
    [[gnu::always_inline]] bool testPairs(Block& b) {
        bool better = false;
        for (int i = 0; i < b.pairs; ++i) {
            const unsigned q = b.pair[i] >> 4, j = b.pair[i] & 15;
            const Floats x = Floats::load(rays_.relX[q]), y = Floats::load(rays_.relY[q]);
            const auto edge = [&](int e) {
                return fma(x, Floats(b.edge[e][1][j]),
                           fma(y, Floats(b.edge[e][2][j]), Floats(b.edge[e][0][j])));
            };
            const Floats least = min(min(edge(0), edge(1)), edge(2));
            const float noise = b.noise[j];
            Mask inside = least >= Floats(-noise);
            const unsigned doubt = bits(inside) & bits(least <= Floats(noise)) & rays_.active[q];
            if ((doubt | (b.uncertain >> j & 1)) != 0) [[unlikely]]
                inside = containsRays(b, q, j);

            const Floats lo = Floats::load(keyLo_[q]), hi = Floats::load(keyHi_[q]);
            const Mask front = inside & (Floats(b.keyLo[j]) > hi);
            const unsigned may = bits(inside & (Floats(b.keyHi[j]) >= lo));
            const unsigned wide = (b.wide >> j & 1) != 0 ? ~0u : 0u;
            if ((may & (~bits(front) | wide)) != 0) [[unlikely]] {
                better |= compare(b, q, j, may);
                continue;
            }
            better |= bits(front) != 0;
            accept(q, b.firstPlace + j, front, Floats(b.keyLo[j]), Floats(b.keyHi[j]));
        }
        return better;
    }

    [[gnu::always_inline]] void accept(unsigned q, std::uint32_t place, Mask lanes, Floats keyLo,
                                       Floats keyHi) {
        if constexpr (Q == Query::Any) {
            missing_[q] &= ~bits(lanes);
        } else {
            select(lanes, keyLo, Floats::load(keyLo_[q])).store(keyLo_[q]);
            select(lanes, keyHi, Floats::load(keyHi_[q])).store(keyHi_[q]);
            select(lanes, Ints(place), Ints::load(place_[q])).store(place_[q]);
        }
    }

    // ShearedTriangle::containsRay() for the rays of a packet; what it has to decide in double is
    // asked ray by ray.
    [[gnu::noinline]] Mask containsRays(const Block& b, unsigned q, unsigned j) const {
        const Floats Sx = Floats::load(rays_.Sx[q]), Sy = Floats::load(rays_.Sy[q]), zero(0.0f);
        Floats x[3], y[3];
        for (int i = 0; i < 3; ++i) {
            const auto at = [&](std::size_t axis) {
                return b.leaf->point[axis][b.leaf->corner[i][j]] - rays_.origin[axis];
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
            if (exactKeyOf(b.firstPlace + j, q, i) == 0) inside &= ~(1u << i);
        }
        return maskOf(inside);
    }

    float exactKeyOf(std::uint32_t place, unsigned q, int lane) const {
        return exactKey(mesh_, rays_.origin, rays_.direction(static_cast<int>(q), lane),
                        leafOf(place), place & 15);
    }

    // ---- keys

    // planeKey() of accel/triangle.h up to the ray, and the bounds of canonicalKey(), for W
    // triangles. The padded box is a quarter of the canonical pad wide of the triangle: a key that
    // is inside it on both lateral axes is not changed by the canonical clamp.
    struct Planes {
        Doubles nx, ny, nz, n0;
        Floats farthest, nearest, xLo, xHi, yLo, yHi;
        Mask straddling;
    };

    // Of the triangles with these corners; point(i, axis): the axis of corner i.
    template <class PointFn> [[gnu::always_inline]] Planes planesOf(PointFn&& point) const {
        const auto exact = [&](int i, std::size_t axis) { // in double, as planeKey() has it
            return Doubles(point(i, axis)) - Doubles(static_cast<double>(rays_.origin[axis]));
        };
        const auto rounded = [&](int i, std::size_t axis) {
            return point(i, axis) - Floats(rays_.origin[axis]);
        };
        const Doubles sign(static_cast<double>(rays_.sign));
        const std::size_t k = rays_.k, kx = rays_.kx, ky = rays_.ky;
        const Doubles x0 = exact(0, kx), y0 = exact(0, ky), z0 = exact(0, k) * sign;
        const Doubles ax = exact(1, kx) - x0, ay = exact(1, ky) - y0, az = exact(1, k) * sign - z0;
        const Doubles bx = exact(2, kx) - x0, by = exact(2, ky) - y0, bz = exact(2, k) * sign - z0;
        const Doubles nx = ay * bz - az * by, ny = az * bx - ax * bz, nz = ax * by - ay * bx;
        const auto least = [&](Floats a, Floats b, Floats c) { return min(min(a, b), c); };
        const auto most = [&](Floats a, Floats b, Floats c) { return max(max(a, b), c); };
        const Floats one(1.0f), zero(0.0f), pad(pad_), s(rays_.sign);
        const Floats vx[3] = {rounded(0, kx), rounded(1, kx), rounded(2, kx)};
        const Floats vy[3] = {rounded(0, ky), rounded(1, ky), rounded(2, ky)};
        const Floats vz[3] = {rounded(0, k) * s, rounded(1, k) * s, rounded(2, k) * s};
        const Floats zMin = least(vz[0], vz[1], vz[2]), zMax = most(vz[0], vz[1], vz[2]);
        return {nx,
                ny,
                nz,
                nx * x0 + ny * y0 + nz * z0,
                one / zMax,
                select(zMin > zero, one / zMin, Floats(kInfinityF)),
                least(vx[0], vx[1], vx[2]) - pad,
                most(vx[0], vx[1], vx[2]) + pad,
                least(vy[0], vy[1], vy[2]) - pad,
                most(vy[0], vy[1], vy[2]) + pad,
                zMin <= zero};
    }

    // Keys of the rays of packet q, as long as the canonical lateral clamp leaves them alone;
    // `clamped` gets the other ones of the lanes.
    [[gnu::always_inline]] Floats keysOf(const Planes& p, unsigned q, Mask& inside,
                                         unsigned& clamped) const {
        const Floats Sx = Floats::load(rays_.Sx[q]), Sy = Floats::load(rays_.Sy[q]);
        const Doubles dz(Floats::load(rays_.dz[q]));
        const Doubles along = p.nx * Doubles(Floats::load(rays_.dirX[q])) +
                              p.ny * Doubles(Floats::load(rays_.dirY[q])) + p.nz * dz;
        const Floats plane = (along / (p.n0 * dz)).toFloats();
        const unsigned behind = bits(p.straddling) & ~bits(plane > Floats(0.0f));
        inside = maskOf(bits(inside) & ~behind);
        const Floats key = min(max(plane, p.farthest), p.nearest);
        const Mask inBox =
            (p.xLo * key <= Sx) & (Sx <= p.xHi * key) & (p.yLo * key <= Sy) & (Sy <= p.yHi * key);
        clamped = bits(inside) & ~bits(inBox) & rays_.active[q];
        return key;
    }

    [[gnu::noinline]] void fillPlanes(Block& b) const {
        const Planes p = planesOf([&](int i, std::size_t axis) {
            return permute(Floats::load(b.leaf->point[axis]), Ints::bytes(b.leaf->corner[i]));
        });
        p.nx.store(b.nx), p.ny.store(b.ny), p.nz.store(b.nz), p.n0.store(b.n0);
        p.xLo.store(b.xLo), p.xHi.store(b.xHi), p.yLo.store(b.yLo), p.yHi.store(b.yHi);
        p.nearest.store(b.nearest), p.farthest.store(b.farthest);
        b.hasPlanes = true;
    }

    // Rays that are inside and whose order of hits the bounds of the keys don't tell.
    [[gnu::noinline]] bool compare(Block& b, unsigned q, unsigned j, unsigned lanes) {
        lanes &= Q == Query::Any ? missing_[q] : rays_.active[q];
        if (lanes == 0) return false;
        if (!b.hasPlanes) fillPlanes(b);
        const Planes p{b.nx[j],
                       b.ny[j],
                       b.nz[j],
                       b.n0[j],
                       b.farthest[j],
                       b.nearest[j],
                       b.xLo[j],
                       b.xHi[j],
                       b.yLo[j],
                       b.yHi[j],
                       maskOf((b.straddling >> j & 1) != 0 ? ~0u : 0u)};
        Mask inside = maskOf(lanes);
        unsigned clamped = 0;
        Floats key = keysOf(p, q, inside, clamped);
        const std::uint32_t place = b.firstPlace + j;
        if (clamped != 0) [[unlikely]]
            key = clampedKeys(Ints(place), q, clamped, key);
        inside = inside & (key < Floats::load(rays_.below[q]));
        if constexpr (Q == Query::Any) {
            const Mask better = inside & (key > Floats::load(keyHi_[q]));
            accept(q, place, better, key, key);
            return bits(better) != 0;
        } else {
            // Keys of hits that were left open, where they matter.
            const Floats lo = Floats::load(keyLo_[q]), hi = Floats::load(keyHi_[q]);
            const unsigned open = bits(inside & (lo < hi) & (key >= lo) & (key <= hi));
            if (open != 0) settle(q, open, winnersOf(q, open));
            const Floats best = Floats::load(keyHi_[q]);
            Mask better = inside & (key > best);
            const unsigned equal = bits(inside & (key == best));
            if (equal != 0) [[unlikely]]
                better = better | maskOf(lowerIds(q, place, equal));
            accept(q, place, better, key, key);
            return bits(better) != 0;
        }
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

    // Those of the lanes for which the triangle is in front of the best one by its number.
    unsigned lowerIds(unsigned q, std::uint32_t place, unsigned lanes) const {
        unsigned lower = 0;
        const std::uint32_t id = triangleAt(place);
        for (; lanes != 0; lanes &= lanes - 1) {
            const int i = std::countr_zero(lanes);
            if (place_[q][i] != kNowhere && id < triangleAt(place_[q][i])) lower |= 1u << i;
        }
        return lower;
    }

    // The triangles of the best hits of a packet, lane by lane; zeros for the others.
    struct Winners {
        Floats point[3][3]; // corner, axis
        Ints id{0u};
    };
    // Neighbours mostly meet the same few triangles: each is fetched once.
    [[gnu::always_inline]] Winners winnersOf(unsigned q, unsigned lanes) const {
        Winners w;
        for (auto& corner : w.point)
            for (Floats& p : corner) p = Floats(0.0f);
        const Ints places = Ints::load(place_[q]);
        while (lanes != 0) {
            const std::uint32_t place = place_[q][std::countr_zero(lanes)];
            const Mask same = places == Ints(place);
            lanes &= ~bits(same);
            const WideLeaf<W>& l = leafOf(place);
            const std::uint32_t j = place & 15;
            w.id = select(same, Ints(mesh_.tree.triangleIds[l.first + j]), w.id);
            for (std::size_t c = 0; c < 3; ++c)
                for (std::size_t axis = 0; axis < 3; ++axis)
                    w.point[c][axis] =
                        select(same, Floats(l.point[axis][l.corner[c][j]]), w.point[c][axis]);
        }
        return w;
    }

    // Computes the keys of these hits that were left open.
    [[gnu::noinline]] void settle(unsigned q, unsigned lanes, const Winners& winners) {
        const Floats lo = Floats::load(keyLo_[q]), hi = Floats::load(keyHi_[q]);
        const unsigned open = bits(lo < hi) & lanes;
        if (open == 0) return;
        const Planes p = planesOf([&](int i, std::size_t axis) { return winners.point[i][axis]; });
        Mask inside = maskOf(open);
        unsigned clamped = 0;
        Floats key = keysOf(p, q, inside, clamped);
        if (clamped != 0) [[unlikely]]
            key = clampedKeys(Ints::load(place_[q]), q, clamped, key);
        select(maskOf(open), key, lo).store(keyLo_[q]);
        select(maskOf(open), key, hi).store(keyHi_[q]);
    }

    Weights weightsOf(const Winners& winners, unsigned q) const {
        Floats x[3], y[3];
        for (int i = 0; i < 3; ++i) {
            const auto relative = [&](std::size_t axis) {
                return winners.point[i][axis] - Floats(rays_.origin[axis]);
            };
            const Floats z = relative(rays_.k) * Floats(rays_.sign);
            x[i] = relative(rays_.kx) - Floats::load(rays_.Sx[q]) * z;
            y[i] = relative(rays_.ky) - Floats::load(rays_.Sy[q]) * z;
        }
        return barycentrics(x, y);
    }

    void closePackets() {
        for (std::uint32_t left = open_; left != 0; left &= left - 1)
            if (missing_[std::countr_zero(left)] == 0) open_ ^= left & -left;
    }

    void limitDepth() {
        if constexpr (Q == Query::Any) {
            zCut_ = -1;
            for (std::uint32_t left = open_; left != 0; left &= left - 1)
                zCut_ = ::max(rays_.zFar[std::countr_zero(left)], zCut_);
        } else {
            // Nothing is hidden as long as a ray has met nothing.
            const auto met = [&](int q) {
                return bits(Floats::load(keyLo_[q]) <= Floats(0.0f)) == 0;
            };
            while (unmet_ < rays_.packets && met(unmet_)) ++unmet_;
            if (unmet_ < rays_.packets) {
                zCut_ = zTop_;
                return;
            }
            Floats least = Floats::load(keyLo_[0]);
            for (int q = 1; q < rays_.packets; ++q) least = min(least, Floats::load(keyLo_[q]));
            zCut_ = ::min(depthCut(smallest(least)), zTop_);
        }
    }

    // The numbers of pairs, for storeChosen().
    alignas(64) static constexpr auto kPair = [] {
        std::array<std::array<std::uint32_t, W>, kPackets> pairs{};
        for (std::uint32_t q = 0; q < kPackets; ++q)
            for (std::uint32_t j = 0; j < W; ++j) pairs[q][j] = q << 4 | j;
        return pairs;
    }();

    static constexpr float kTooNear = 1e-30f; // for a quotient that is sure to be finite
    // Keys of triangles that are deeper than this are computed at once.
    static constexpr float kWide = 1.02f;

    const WideMesh& mesh_;
    const BundleRays<Q>& rays_;
    float pad_;
    float zTop_ = 0, zCut_ = 0;
    std::uint32_t open_ = 0;     // packets that still ask, a bit each
    int unmet_ = 0;              // the first packet with a ray that has met nothing
    unsigned missing_[kPackets]; // rays that are not hidden yet
    // Of the best hit: bounds of its key, which are equal when it is known, and where it is.
    alignas(64) float keyLo_[kPackets][W], keyHi_[kPackets][W];
    std::uint32_t place_[kPackets][W];
    Block block_;
};
