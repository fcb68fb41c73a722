// Packets of W rays that walk the tree of the solids together, each child with the rays that enter
// it. Rays into one octant (most camera rays, shadow rays of a lamp) see a node as one interval of
// rays that looks at W children at once; of rays that go apart each looks at them for
// itself, as in queue.inl, but the node is fetched once and the steps overlap.
// What decides is exact: entries into a solid's own box as RaySetup::enters() rounds them, spheres
// as AnalyticShape and Sphere compute them, operation by operation in double. Everything before
// that only leaves out: the boxes' pads are 64 roundings of the coordinates wide, and what a ray
// meets lies inside of the box without the pad.
// Included by the file of each instruction set inside its namespace.

enum class Answer { Closest, Any };

template <Answer A> class SolidPackets {
public:
    SolidPackets(const SolidTree& tree, const SolidCalls& calls, const RaySpan& rays)
        : tree_(tree), calls_(calls), rays_(rays) {}

    template <class Result> void run(std::span<const std::uint32_t> order, Result* results) {
        for (; !order.empty(); order = order.subspan(std::min<std::size_t>(W, order.size()))) {
            live_ = setUp(order, results);
            if (live_ != 0) traverse(results);
        }
    }

private:
    static constexpr unsigned kAll = (1u << W) - 1;
    // Fewer rays than this look at a node one by one.
    static constexpr int kFewestForInterval = 6;

    // ---- rays

    // RaySetup for W rays; the formulas are its own, lane by lane. Returns the lanes to be traced.
    template <class Result>
    unsigned setUp(std::span<const std::uint32_t> order, const Result* results) {
        const std::size_t count = std::min<std::size_t>(W, order.size());
        for (std::size_t i = 0; i < W; ++i) ray_[i] = order[i < count ? i : 0];
        Floats o[3], d[3], tMax;
        if (const std::size_t first = ray_[0]; count == W && ray_[W - 1] == first + (W - 1)) {
            loadVectors(&rays_.org[first].x, o[0], o[1], o[2]);
            loadVectors(&rays_.dir[first].x, d[0], d[1], d[2]);
            tMin_ = Floats::unaligned(&rays_.tMin[first]);
            tMax = Floats::unaligned(&rays_.tMax[first]);
        } else {
            alignas(64) float org[3][W], dir[3][W], lo[W], hi[W];
            for (std::size_t i = 0; i < W; ++i) {
                const Vec3 from = rays_.org[ray_[i]], along = rays_.dir[ray_[i]];
                org[0][i] = from.x, org[1][i] = from.y, org[2][i] = from.z;
                dir[0][i] = along.x, dir[1][i] = along.y, dir[2][i] = along.z;
                lo[i] = rays_.tMin[ray_[i]], hi[i] = rays_.tMax[ray_[i]];
            }
            for (int axis = 0; axis < 3; ++axis)
                o[axis] = Floats::load(org[axis]), d[axis] = Floats::load(dir[axis]);
            tMin_ = Floats::load(lo), tMax = Floats::load(hi);
        }
        unsigned lanes = (1u << count) - 1;
        if constexpr (A == Answer::Any) {
            best_ = tMax;
        } else {
            alignas(64) float t[W];
            for (std::size_t i = 0; i < W; ++i) {
                const Hit& hit = results[ray_[i]];
                t[i] = hit.t, number_[i] = hit.shape;
            }
            best_ = Floats::load(t);
        }

        const Floats one(1.0f), zero(0.0f);
        const Floats ax = abs(d[0]), ay = abs(d[1]), az = abs(d[2]);
        const Mask alongZ = (az >= ax) & (az >= ay), alongY = ay >= ax;
        const auto pick = [&](Floats x, Floats y, Floats z) {
            return select(alongZ, z, select(alongY, y, x));
        };
        alongZ_ = alongZ, alongY_ = alongY;
        const Floats depth = pick(d[0], d[1], d[2]);
        dz_ = abs(depth);
        const Floats sign = select(depth < zero, Floats(-1.0f), one);
        const Floats Sx = pick(d[1], d[2], d[0]) / dz_, Sy = pick(d[2], d[0], d[1]) / dz_;
        sign_ = sign, Sx_ = Sx, Sy_ = Sy;
        const Floats smallestSlope(RaySetup::kSmallestSlope);
        const Floats rx = one / withSign(max(abs(Sx), smallestSlope), Sx);
        const Floats ry = one / withSign(max(abs(Sy), smallestSlope), Sy);
        const Floats oMax = max(max(abs(o[0]), abs(o[1])), abs(o[2]));
        const Floats e = max(Floats(tree_.extent), oMax) * Floats(0x1p-19f);
        const Floats px = e * abs(rx), py = e * abs(ry);
        const auto slab = [&](int axis, Floats r, Floats pad) {
            const Floats at = (zero - o[axis]) * r, twice = pad + pad;
            r_[axis] = r;
            near_[axis] = at - twice;
            far_[axis] = at + twice;
            pad_[axis] = twice;
            o_[axis] = o[axis];
            d_[axis] = d[axis];
        };
        slab(0, pick(sign, ry, rx), pick(e, py, px));
        slab(1, pick(rx, sign, ry), pick(px, e, py));
        slab(2, pick(ry, rx, sign), pick(py, px, e));
        zCut_ = cutOf(best_);
        const Floats length2 = fma(d[0], d[0], fma(d[1], d[1], d[2] * d[2]));
        length_ = sqrt(length2);
        perLength_ = one / length_;
        perLength2_ = one / length2;
        slack_ = max(Floats(tree_.extent), oMax) * Floats(0x1p-18f);
        oMax_ = oMax;

        // isTraceable(), and a range to be hit in.
        const Floats sum = ((d[0] + d[1]) + d[2]) + ((o[0] + o[1]) + o[2]);
        const Floats longest = max(max(ax, ay), az);
        lanes &= bits((longest > Floats(1e-30f)) & (longest < Floats(1e30f)) &
                      (oMax < Floats(1e30f)) & (sum - sum == zero) & (tMin_ < best_));
        if (lanes != 0) findInterval(lanes);
        return lanes;
    }

    // depthCut(1 / (t dz))
    Floats cutOf(Floats t) const {
        const Floats one(1.0f), zero(0.0f), key = one / (t * dz_);
        return select(key > zero, (one / key) * Floats(1.0000005f),
                      Floats(std::numeric_limits<float>::max()));
    }

    // The ranges of origins and r, for packets into one octant.
    void findInterval(unsigned lanes) {
        const Mask on = maskOf(lanes);

        together_ = std::popcount(lanes) >= kFewestForInterval;
        for (int axis = 0; axis < 3; ++axis) {
            r_[axis].store(rays1_.r[axis]);
            near_[axis].store(rays1_.nearOffset[axis]);
            far_[axis].store(rays1_.farOffset[axis]);
            const unsigned backwards = bits(r_[axis] < Floats(0.0f));
            backwards_[axis] = backwards;
            if (!together_) continue;
            together_ = (backwards & lanes) == 0 || (backwards & lanes) == lanes;
            oLo_[axis] = smallest(select(on, o_[axis], Floats(kInfinityF)));
            oHi_[axis] = largest(select(on, o_[axis], Floats(-kInfinityF)));
            rLo_[axis] = smallest(select(on, r_[axis], Floats(kInfinityF)));
            rHi_[axis] = largest(select(on, r_[axis], Floats(-kInfinityF)));
            mostPad_[axis] = largest(select(on, pad_[axis], Floats(0.0f)));
        }
        zCut_.store(rays1_.zCut);
        zTop_ = largest(select(on, zCut_, Floats(-1.0f)));
    }

    // ---- the tree

    struct Entry {
        float z;
        WideRef ref;
        unsigned lanes;
    };

    template <class Result> void traverse(Result* results) {
        std::array<Entry, (kMaxBvhDepth + 1) * W> stack;
        std::size_t size = 0;
        WideRef at = wideRef(0, WideKind::Node);
        unsigned lanes = live_;
        for (;;) {
            if (kindOf(at) == WideKind::Leaf) {
                solid(at >> 2, lanes, results);
            } else if (together_ && std::popcount(lanes) >= kFewestForInterval) {
                size = stepTogether(tree_.node<W>(at), lanes, stack.data(), size, results);
            } else {
                size = stepApart(tree_.node<W>(at), lanes, stack.data(), size, results);
            }
            if (A == Answer::Any && live_ == 0) return;
            do {
                if (size == 0) return;
                --size;
                lanes = stack[size].lanes & live_;
                if constexpr (A == Answer::Closest)
                    if (stack[size].z > zTop_) lanes = 0;
            } while (lanes == 0);
            at = stack[size].ref;
        }
    }

    std::size_t push(Entry* stack, std::size_t bottom, std::size_t size, Entry entry) const {
        std::size_t place = size;
        if constexpr (A == Answer::Closest) // the nearest on top
            for (; place > bottom && stack[place - 1].z < entry.z; --place)
                stack[place] = stack[place - 1];
        stack[place] = entry;
        return size + 1;
    }

    // Over all r of the interval, a child is entered not before `entry` and left not after `exit`.
    template <class Result>
    std::size_t stepTogether(const WideNode<W>& node, unsigned lanes, Entry* stack,
                             std::size_t size, Result* results) {
        Floats entry(0.0f), exit(zTop_);
        for (int axis = 0; axis < 3; ++axis) {
            const Floats lo(rLo_[axis]), hi(rHi_[axis]), pad(mostPad_[axis]);
            const int back = backwards_[axis] & live_ ? 1 : 0;
            const Floats first(back ? oLo_[axis] : oHi_[axis]),
                last(back ? oHi_[axis] : oLo_[axis]);
            const Floats front = Floats::load(node.plane[axis][back]) - first;
            const Floats behind = Floats::load(node.plane[axis][1 - back]) - last;
            entry = max(min(front * lo, front * hi) - pad, entry);
            exit = min(max(behind * lo, behind * hi) + pad, exit);
        }
        alignas(64) float z[W];
        entry.store(z);
        const std::size_t bottom = size;
        for (unsigned hit = bits(entry <= exit); hit != 0; hit &= hit - 1) {
            const int i = std::countr_zero(hit);
            const WideRef ref = node.child[i];
            unsigned inside = lanes;
            if (A == Answer::Any && kindOf(ref) == WideKind::Leaf) {
                solid(ref >> 2, inside, results);
                lanes &= live_;
                if (lanes == 0) return size;
                continue;
            }
            if (kindOf(ref) == WideKind::Node) {
                Floats from(0.0f), to = zCut_;
                for (int axis = 0; axis < 3; ++axis) {
                    const int back = backwards_[axis] & live_ ? 1 : 0;
                    from = max(fma(Floats(node.plane[axis][back][i]), r_[axis], near_[axis]), from);
                    to = min(fma(Floats(node.plane[axis][1 - back][i]), r_[axis], far_[axis]), to);
                }
                inside &= bits(from <= to);
                if (inside == 0) continue;
            }
            size = push(stack, bottom, size, {z[i], ref, inside});
        }
        return size;
    }

    template <class Result>
    std::size_t stepApart(const WideNode<W>& node, unsigned lanes, Entry* stack, std::size_t size,
                          Result* results) {
        LaneMatrix entered; // rows are rays, columns children
        unsigned any = 0;
        Floats nearest(kInfinityF);
        for (; lanes != 0; lanes &= lanes - 1) {
            const int ray = std::countr_zero(lanes);
            Floats entry(0.0f), exit(rays1_.zCut[ray]);
            for (int axis = 0; axis < 3; ++axis) {
                const unsigned back = backwards_[axis] >> ray & 1;
                const Floats r(rays1_.r[axis][ray]);
                entry = max(fma(Floats::load(node.plane[axis][back]), r,
                                Floats(rays1_.nearOffset[axis][ray])),
                            entry);
                exit = min(fma(Floats::load(node.plane[axis][1 - back]), r,
                               Floats(rays1_.farOffset[axis][ray])),
                           exit);
            }
            const Mask hit = entry <= exit;
            if constexpr (A == Answer::Closest) nearest = min(nearest, select(hit, entry, nearest));
            entered.set(ray, bits(hit));
            any |= bits(hit);
        }
        alignas(64) float z[W];
        if constexpr (A == Answer::Closest) nearest.store(z);
        const std::size_t bottom = size;
        for (; any != 0; any &= any - 1) {
            const int i = std::countr_zero(any);
            const WideRef ref = node.child[i];
            if (kindOf(ref) == WideKind::Leaf) {
                if (const unsigned asking = entered.column(i) & live_; asking != 0)
                    solid(ref >> 2, asking, results);
                continue;
            }
            const float from = A == Answer::Closest ? z[i] : 0;
            size = push(stack, bottom, size, {from, ref, entered.column(i)});
        }
        return size;
    }

    // ---- solids

    template <class Result> void solid(std::uint32_t place, unsigned lanes, Result* results) {
        const SolidTree::Solid& solid = tree_.solids[place];
        if (A == Answer::Any && !solid.hides) return;
        unsigned certain = 0;
        lanes &= solid.isTube ? nearAxis(solid, lanes, certain) : nearCentre(solid, certain);
        if constexpr (A == Answer::Any) {
            certain &= lanes;
            if (certain != 0) hide(certain, results);
            lanes &= ~certain;
        }
        if (lanes == 0) return;
        const Bounds& box = tree_.boxes[place];
        Floats entry(0.0f), exit = zCut_;
        for (int axis = 0; axis < 3; ++axis) {
            const auto a = static_cast<std::size_t>(axis);
            const Mask back = maskOf(backwards_[axis]);
            const Floats lo(box.lo[a]), hi(box.hi[a]);
            entry = max(select(back, hi, lo) * r_[axis] + near_[axis], entry);
            exit = min(select(back, lo, hi) * r_[axis] + far_[axis], exit);
        }
        lanes &= bits(entry <= exit);
        if (lanes == 0) return;
        if (solid.kind == SolidTree::Kind::Sphere)
            sphere(solid, tree_.spheres[solid.part], entry, lanes, results);
        else if (solid.kind == SolidTree::Kind::Facets)
            facets(solid, tree_.facets[solid.part], entry, lanes, results);
        else
            ask(solid, entry, lanes, results);
    }

    void hide(unsigned lanes, std::uint8_t* hidden) {
        live_ &= ~lanes;
        for (; lanes != 0; lanes &= lanes - 1) hidden[ray_[std::countr_zero(lanes)]] = 1;
    }

    // Lines that come near enough to the solid's round hull: a ball, or a tube without ends. With u
    // the unit of rounding and s the largest coordinate, the way to the centre is off by 4 u s, the
    // foot of the perpendicular by some 16 u s more, and `slack` is 64 u s.
    // certain: rays that enter a ball within a sphere, and so the sphere, inside of their range.
    unsigned nearCentre(const SolidTree::Solid& solid, unsigned& certain) const {
        const Floats x = Floats(solid.centre.x) - o_[0], y = Floats(solid.centre.y) - o_[1],
                     z = Floats(solid.centre.z) - o_[2];
        const Floats foot = fma(x, d_[0], fma(y, d_[1], z * d_[2])) * perLength2_;
        const Floats px = fnma(foot, d_[0], x), py = fnma(foot, d_[1], y),
                     pz = fnma(foot, d_[2], z);
        const Floats distance2 = fma(px, px, fma(py, py, pz * pz));
        const Floats reach = Floats(solid.radius) + slack_;
        if constexpr (A == Answer::Any) {
            const Floats inner = max(Floats(solid.innerRadius) - slack_, Floats(0.0f));
            certain = bits((distance2 < inner * inner) & (foot - reach * perLength_ > tMin_) &
                           (foot + slack_ * perLength_ < best_));
        }
        return bits(notGreater(distance2, reach * reach));
    }
    // n = d x axis: the distance of the lines is |w n| / |n|, and w n is off by 41 u s |d|. The ray
    // is in the endless tube from `middle` - `half` to `middle` + `half`. n is off by 7 u |d|, with
    // FMA or without, so n n, for rays at 1/16 to the axis at least, by 227 u of it, and both by
    // 16.5 slack |d| / n n together. Rays along the axis are asked whatever its ends are.
    // certain: rays that meet the side of a round tube at 30 degrees to its axis at least and not
    // flat, which keeps these errors below 20 times the slack, by 64 within their range and the
    // tube's length.
    unsigned nearAxis(const SolidTree::Solid& solid, unsigned lanes, unsigned& certain) const {
        const Floats x = Floats(solid.centre.x) - o_[0], y = Floats(solid.centre.y) - o_[1],
                     z = Floats(solid.centre.z) - o_[2];
        const Floats ax(solid.axis.x), ay(solid.axis.y), az(solid.axis.z);
        const Floats nx = fms(d_[1], az, d_[2] * ay), ny = fms(d_[2], ax, d_[0] * az),
                     nz = fms(d_[0], ay, d_[1] * ax);
        const Floats across = fma(x, nx, fma(y, ny, z * nz));
        const Floats n2 = fma(nx, nx, fma(ny, ny, nz * nz));
        const Floats n = sqrt(n2), slack = slack_ * length_;
        const Floats reach = fma(Floats(solid.radius), n, slack);
        lanes &= bits(notGreater(abs(across), reach));
        if (lanes == 0) return 0;

        const Floats zero(0.0f), perN2 = Floats(1.0f) / n2;
        const Floats da = fma(d_[0], ax, fma(d_[1], ay, d_[2] * az));
        const Floats xa = fma(x, ax, fma(y, ay, z * az));
        const Floats xd = fma(x, d_[0], fma(y, d_[1], z * d_[2]));
        const Floats middle = fnma(xa, da, xd) * perN2, height = fms(middle, da, xa);
        const auto halfIn = [&](Floats r) { return sqrt(max(fnma(across, across, r * r), zero)); };
        const Floats half = fma(Floats(24.0f), slack, halfIn(reach)) * perN2;
        const Floats up = abs(da);
        lanes &= bits(n < Floats(0.0625f) * length_) |
                 (bits(notGreater(fnma(half, up, abs(height)), Floats(solid.halfLength) + slack_)) &
                  bits(notGreater(tMin_, middle + half)) & bits(notGreater(middle - half, best_)));
        if constexpr (A == Answer::Any) {
            if (lanes == 0 || !(solid.innerRadius > 0)) return lanes;
            const Floats inner = Floats(solid.innerRadius) * n, margin = Floats(64.0f) * slack_;
            const Floats inside = halfIn(inner) * perN2, early = margin * perLength_;
            const Floats tallest = Floats(solid.halfLength * (1 - 0x1p-18f)) - margin;
            const auto meets = [&](Floats t) {
                return (t - early > tMin_) & (t + early < best_) & (abs(fms(t, da, xa)) < tallest);
            };
            certain = bits((meets(middle - inside) | meets(middle + inside)) &
                           (abs(across) < Floats(0.9f) * inner) & (n > Floats(0.5f) * length_));
        }
        return lanes;
    }

    [[gnu::noinline]] void ask(const SolidTree::Solid& solid, Floats entry, unsigned lanes,
                               Hit* hits) {
        alignas(64) float z[W], dz[W], best[W];
        entry.store(z), dz_.store(dz), best_.store(best);
        bool improved = false;
        for (; lanes != 0; lanes &= lanes - 1) {
            const int i = std::countr_zero(lanes);
            Hit& hit = hits[ray_[i]];
            if (!calls_.nearer(calls_.set, rays_[ray_[i]], solid.number, z[i] / dz[i], hit))
                continue;
            best[i] = hit.t;
            number_[i] = hit.shape;
            improved = true;
        }
        if (improved) limit(Floats::load(best));
    }
    [[gnu::noinline]] void ask(const SolidTree::Solid& solid, Floats, unsigned lanes,
                               std::uint8_t* hidden) {
        for (; lanes != 0; lanes &= lanes - 1) {
            const int i = std::countr_zero(lanes);
            if (!calls_.hides(calls_.set, rays_[ray_[i]], solid.number)) continue;
            hidden[ray_[i]] = 1;
            live_ &= ~(1u << i);
        }
    }

    void limit(Floats best) {
        best_ = best;
        zCut_ = min(cutOf(best), zCut_);
        zCut_.store(rays1_.zCut);
        zTop_ = largest(select(maskOf(live_), zCut_, Floats(-1.0f)));
    }

#include "accel/kernels/solids_facets.inl"

    // Sphere::roots() and insideRound().
    template <class Result>
    void sphere(const SolidTree::Solid& solid, const SolidTree::Sphere& sphere, Floats entry,
                unsigned lanes, Result* results) {
        const auto& m = sphere.exact.objectFromWorld;
        const Doubles X(o_[0]), Y(o_[1]), Z(o_[2]), U(d_[0]), V(d_[1]), T(d_[2]);
        const auto times = [&](std::size_t i, const Doubles& x) { return Doubles(m[i]) * x; };
        // A zero of the map adds a zero, which changes no number.
        const auto point = [&](std::size_t i, const Doubles& along) {
            if (!sphere.turned) return along + Doubles(m[i + 3]);
            return ((times(i, X) + times(i + 1, Y)) + times(i + 2, Z)) + Doubles(m[i + 3]);
        };
        const auto direction = [&](std::size_t i, const Doubles& along) {
            if (!sphere.turned) return along;
            return (times(i, U) + times(i + 1, V)) + times(i + 2, T);
        };
        const Doubles ox = point(0, times(0, X)), oy = point(4, times(5, Y)),
                      oz = point(8, times(10, Z));
        const Doubles dx = direction(0, times(0, U)), dy = direction(4, times(5, V)),
                      dz = direction(8, times(10, T));
        const Doubles dd = (dx * dx + dy * dy) + dz * dz, od = (ox * dx + oy * dy) + oz * dz;
        const Doubles along = od / dd;
        const Doubles px = ox - dx * along, py = oy - dy * along, pz = oz - dz * along;
        const Doubles ll = (px * px + py * py) + pz * pz;
        const double radius = sphere.exact.radius;
        const Doubles rr(radius * radius);
        lanes &= atMost(ll, rr);
        if (lanes == 0 || !(radius > 0)) return;

        const Doubles most(std::numeric_limits<double>::max());
        const Doubles oo = (ox * ox + oy * oy) + oz * oz;
        lanes &= atMost(dd, most) & atMost(oo, most);
        const Doubles middle = Doubles(0.0) - along, half = sqrt((rr - ll) / dd);
        const Doubles enter = middle - half, exit = middle + half;
        const Floats t0 = enter.toFloats(), t1 = exit.toFloats();
        if constexpr (A == Answer::Any) {
            lanes &= bits(((t0 > tMin_) & (t0 < best_)) | ((t1 > tMin_) & (t1 < best_)));
            hide(lanes, results);
        } else {
            const Mask first = t0 > tMin_;
            const Floats t = select(first, t0, t1);
            lanes &= bits((t > tMin_) & (t <= best_) & (t < Floats(kInfinityF)));
            if (lanes == 0) return;
            const Floats nearest = max(entry / dz_, t);
            const Mask equal = nearest == best_;
            unsigned better = bits(nearest < best_) | lowerNumbers(bits(equal) & lanes, solid);
            better &= lanes;
            if (better == 0) return;
            const Doubles lost0 = enter - Doubles(t0), lost1 = exit - Doubles(t1);
            alignas(64) float ts[W], us[W];
            nearest.store(ts);
            select(first, lost0.toFloats(), lost1.toFloats()).store(us);
            for (unsigned rest = better; rest != 0; rest &= rest - 1) {
                const int i = std::countr_zero(rest);
                results[ray_[i]] = {.t = ts[i], .u = us[i], .shape = solid.number};
                number_[i] = solid.number;
            }
            limit(select(maskOf(better), nearest, best_));
        }
    }

    unsigned lowerNumbers(unsigned lanes, const SolidTree::Solid& solid) const {
        unsigned lower = 0;
        for (; lanes != 0; lanes &= lanes - 1) {
            const int i = std::countr_zero(lanes);
            if (solid.number < number_[i]) lower |= 1u << i;
        }
        return lower;
    }

    const SolidTree& tree_;
    const SolidCalls& calls_;
    const RaySpan& rays_;
    std::uint32_t ray_[W]; // of the lane
    unsigned live_ = 0;    // lanes that still ask
    Floats o_[3], d_[3], r_[3], near_[3], far_[3], pad_[3], dz_, tMin_;
    Floats length_, perLength_, perLength2_, slack_; // of the directions; see nearCentre()
    // What a facet asks: the dominant axis, and RaySetup's numbers for it.
    Mask alongZ_, alongY_;
    Floats sign_, Sx_, Sy_, oMax_;
    Floats best_, zCut_; // t up to which hits count, and the depth behind which none is
    std::uint32_t number_[W];
    unsigned backwards_[3]; // lanes with r < 0
    // The same by ray.
    struct alignas(64) {
        float r[3][W], nearOffset[3][W], farOffset[3][W], zCut[W];
    } rays1_;
    bool together_ = false;
    float oLo_[3], oHi_[3], rLo_[3], rHi_[3], mostPad_[3], zTop_ = 0;
};

void closestSolids(const SolidTree& tree, const SolidCalls& calls, const RaySpan& rays,
                   std::span<const std::uint32_t> order, Hit* hits) {
    SolidPackets<Answer::Closest>(tree, calls, rays).run(order, hits);
}
void anySolids(const SolidTree& tree, const SolidCalls& calls, const RaySpan& rays,
               std::span<const std::uint32_t> order, std::uint8_t* hidden) {
    SolidPackets<Answer::Any>(tree, calls, rays).run(order, hidden);
}
