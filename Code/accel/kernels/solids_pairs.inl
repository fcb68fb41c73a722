// Solids that rays of a packet enter one by one: pairs of a ray and a solid wait until there are W
// of them, pass the filters together, wait again for others of their formula, and are met together.
// In between, what a ray hits for certain, though not where exactly, hides what lies behind.
// Included by solids.inl.

class PacketPairs : public PacketSolids {
protected:
    using PacketSolids::PacketSolids;

    static constexpr auto kFormulas = static_cast<std::size_t>(SolidTree::Meets::Alone);

    // `solid` is its place times 4 and what the node adds; stores write W places at once.
    template <std::size_t Most> struct Pairs {
        alignas(64) std::uint32_t solid[Most + W];
        alignas(64) std::uint8_t lane[Most + W];
        std::uint32_t count = 0;

        void add(std::uint32_t solidOf, std::uint8_t laneOf) {
            solid[count] = solidOf, lane[count] = laneOf;
            ++count;
        }
        // The first ones; fewer than W are left.
        void drop(std::uint32_t done) {
            if (done == 0) return;
            std::memcpy(solid, solid + done, W * sizeof *solid);
            std::memcpy(lane, lane + done, W);
            count -= done;
        }
    };

    Pairs<std::size_t{W} * (W + 1)> waiting_; // for the filters: what is left, and of one step

    // The filter of tubes is long enough for it, that of balls is not.
    const bool areInPairs_ = kPairsPay && !tree_.tubes.empty();

    // Returns how many wait then, who were `count`.
    [[gnu::always_inline]] std::uint32_t wait(int ray, unsigned chosen, const WideRef* solids,
                                              std::uint32_t count) {
        storeChosen(chosen, solids, waiting_.solid + count);
        std::memset(waiting_.lane + count, ray, W);
        return count + static_cast<std::uint32_t>(std::popcount(chosen));
    }

    template <Answer A, class Result> void meetFull(Result* results) {
        std::uint32_t done = 0;
        for (; waiting_.count - done >= W; done += W) {
            filter<A>(done, W, results);
            if (A == Answer::Any && live_ == 0) return;
        }
        waiting_.drop(done);
    }

    template <Answer A, class Result> void meetAll(Result* results) {
        if (waiting_.count != 0) filter<A>(0, waiting_.count, results);
        waiting_.count = 0;
        for (std::size_t i = 0; i < kFormulas; ++i)
            if (passed_[i].count != 0 && (A == Answer::Closest || live_ != 0))
                meetPassed<A>(static_cast<SolidTree::Meets>(i), results);
    }

    void dropAll() {
        waiting_.count = 0;
        for (auto& list : passed_) list.count = 0;
    }

private:
    static RayColumns permuted(const RayColumns& c, Ints lane) {
        const auto at = [&](Floats a) { return permute(a, lane); };
        return {{at(c.org[0]), at(c.org[1]), at(c.org[2])},
                {at(c.dir[0]), at(c.dir[1]), at(c.dir[2])},
                at(c.tMin),
                at(c.tMax),
                false};
    }

    template <Answer A, class Result>
    [[gnu::noinline]] void filter(std::uint32_t first, std::uint32_t count, Result* results) {
        std::uint32_t* const solids = waiting_.solid + first;
        std::uint8_t* const lanes = waiting_.lane + first;
        for (std::uint32_t i = count; i < W; ++i) solids[i] = solids[0], lanes[i] = lanes[0];
        const Ints lane = Ints::bytes(lanes);
        unsigned on = (1u << count) - 1;
        if constexpr (A == Answer::Any)
            on &= bits(permute(select(maskOf(live_), Floats(1.0f), Floats(0.0f)), lane) >
                       Floats(0.0f));

        const float* row[W];
        const auto* const base = reinterpret_cast<const std::byte*>(tree_.solids.data());
        for (int i = 0; i < W; ++i)
            row[i] = reinterpret_cast<const float*>(base + byteOffset(solids[i]) +
                                                    offsetof(SolidTree::Solid, centre));
        Floats a[4], b[4], c[4]; // centre, axis; radii; length
        loadRows(row, a);
        for (const float*& from : row) from += 4;
        loadRows(row, b);
        for (const float*& from : row) from += 2;
        loadRows(row, c);
        const BallLanes ball{{a[0], a[1], a[2]}, b[2], b[3]};
        const TubeLanes tube{{a[3], b[0], b[1]}, c[2]};

        const auto at = [&](Floats x) { return permute(x, lane); };
        const RayColumns rays = permuted(columns_, lane);
        const Lines lines{{rays.org[0], rays.org[1], rays.org[2]},
                          {rays.dir[0], rays.dir[1], rays.dir[2]},
                          at(length_),
                          at(perLength_),
                          at(perLength2_),
                          at(slack_),
                          rays.tMin,
                          at(bound_)};
        const unsigned isTube =
            bits(maxAbs(maxAbs(tube.axis[0], tube.axis[1]), tube.axis[2]) > Floats(0.0f));
        Nearness near;
        if ((on & isTube) == 0) {
            near = nearBall<A>(lines, ball);
        } else {
            near = nearTube<A, true>(lines, ball, tube, on);
            // Where they leave it, they see it from inside.
            if constexpr (A == Answer::Closest)
                near.may &= ~(near.behind & bits(c[3] > Floats(0.0f)));
        }
        on &= near.may;
        alignas(64) float bound[W];
        if constexpr (A == Answer::Closest) {
            alignas(64) float farthest[W];
            near.farthest.store(farthest), bound_.store(bound);
            unsigned certain = near.certain & on;
            for (unsigned rest = certain; rest != 0; rest &= rest - 1) {
                const int i = std::countr_zero(rest);
                if (solidOf(solids[i]).meets == SolidTree::Meets::Alone) continue;
                bound[lanes[i]] = ::min(farthest[i], bound[lanes[i]]);
            }
            if (certain != 0) bindTo(min(Floats::load(bound), bound_));
            on &= bits(notGreater(near.nearest, permute(bound_, lane)));
        } else {
            unsigned hidden = 0;
            for (unsigned rest = near.certain & on; rest != 0; rest &= rest - 1) {
                const int i = std::countr_zero(rest);
                if (!solidOf(solids[i]).hides) continue;
                hidden |= 1u << lanes[i];
                asked_ = solids[i] >> 2;
            }
            if (hidden != 0) hide(hidden, results);
        }
        unsigned full = 0;
        for (; on != 0; on &= on - 1) {
            const int i = std::countr_zero(on);
            if (A == Answer::Any && (live_ >> lanes[i] & 1) == 0) continue;
            const SolidTree::Solid& solid = solidOf(solids[i]);
            if (A == Answer::Any && !solid.hides) continue;
            const auto formula = static_cast<std::size_t>(solid.meets);
            auto& list = passed_[formula];
            list.add(solids[i], lanes[i]);
            prefetch(solid);
            __builtin_prefetch(&tree_.boxes[solids[i] >> 2]);
            full |= unsigned{list.count >= W} << formula;
        }
        if (passed_[kFormulas].count != 0) meetAlone<A>(results);
        for (full &= (1u << kFormulas) - 1; full != 0; full &= full - 1) {
            if (A == Answer::Any && live_ == 0) return;
            meetPassed<A>(static_cast<SolidTree::Meets>(std::countr_zero(full)), results);
        }
    }

    const SolidTree::Solid& solidOf(std::uint32_t ref) const { return tree_.solids[ref >> 2]; }

    // The rays of each at once.
    template <Answer A, class Result> [[gnu::noinline]] void meetAlone(Result* results) {
        auto& list = passed_[kFormulas];
        while (list.count != 0) {
            const std::uint32_t ref = list.solid[0];
            unsigned lanes = 0;
            std::uint32_t kept = 0;
            for (std::uint32_t i = 0; i < list.count; ++i) {
                if (list.solid[i] == ref) {
                    lanes |= 1u << list.lane[i];
                } else {
                    list.solid[kept] = list.solid[i], list.lane[kept] = list.lane[i];
                    ++kept;
                }
            }
            list.count = kept;
            if constexpr (A == Answer::Any) lanes &= live_;
            if (lanes != 0) this->template meetOne<A>(ref >> 2, lanes, results);
        }
    }

    // The first W that passed.
    template <Answer A, class Result> void meetPassed(SolidTree::Meets formula, Result* results) {
        auto& list = passed_[static_cast<std::size_t>(formula)];
        const std::uint32_t count = std::min<std::uint32_t>(list.count, W);
        for (std::uint32_t i = count; i < W; ++i)
            list.solid[i] = list.solid[0], list.lane[i] = list.lane[0];
        meet<A>(formula, list.solid, list.lane, (1u << count) - 1, results);
        list.count -= count;
        if (list.count != 0) {
            list.count += count;
            list.drop(count);
        }
    }

    template <Answer A, class Result>
    [[gnu::noinline]] void meet(SolidTree::Meets formula, const std::uint32_t* solids,
                                const std::uint8_t* lanes, unsigned on, Result* results) {
        const Ints lane = Ints::bytes(lanes);
        const auto at = [&](Floats x) { return permute(x, lane); };
        Floats entry;
        on &= enteringEach(solids, lane, entry);
        if (on == 0) return;
        const RayColumns rays = permuted(columns_, lane);
        const RayRanges ranges{rays.tMin, at(best_)};
        const bool isSphere = formula == SolidTree::Meets::Sphere;
        alignas(64) double map[12][W], radius[W], slope[W], narrowZ[W], wallStretch[W],
            endStretch[W];
        unsigned front = 0;
        const double* rows[W];
        bool turned = !isSphere;
        for (int i = 0; i < W; ++i) {
            const SolidTree::Solid& solid = solidOf(solids[i]);
            rows[i] = solid.shape->objectFromWorld().data();
            if (isSphere) {
                turned |= solid.turned;
                radius[i] = solid.shape->radius;
            } else {
                const SolidTree::Tube& tube = tree_.tubes[solid.part];
                const StillTube& exact = tube.exact;
                radius[i] = exact.radius;
                wallStretch[i] = tube.wallStretch, endStretch[i] = tube.endStretch;
                front |= unsigned{exact.side == ::Facets::Side::Front} << i;
                if (exact.cone) slope[i] = exact.cone->slope, narrowZ[i] = exact.cone->narrowZ;
            }
        }
        for (std::size_t axis = 0; axis < 3; ++axis) {
            storeRows(rows, map + 4 * axis);
            for (const double*& from : rows) from += 4;
        }
        FoundLanes found{.t = Floats(0.0f), .lost = Floats(0.0f)};
        if (isSphere) {
            const SphereRoots roots =
                PacketSpheres::meet(rays, MapLanes{map}, turned, Doubles::load(radius), on);
            if constexpr (A == Answer::Any)
                found.met = PacketSpheres::hides(roots, ranges);
            else
                found = PacketSpheres::firstOf(roots, ranges);
        } else {
            const bool isCone =
                formula == SolidTree::Meets::Cone || formula == SolidTree::Meets::CappedCone;
            const bool caps =
                formula == SolidTree::Meets::CappedTube || formula == SolidTree::Meets::CappedCone;
            const Doubles zero(0.0);
            const Tubes<MapLanes> tubes{caps,
                                        isCone,
                                        front,
                                        0,
                                        {map},
                                        Doubles::load(radius),
                                        isCone ? Doubles::load(slope) : zero,
                                        isCone ? Doubles::load(narrowZ) : zero,
                                        Doubles::load(wallStretch),
                                        Doubles::load(endStretch)};
            const TubeRoots roots = PacketTubes::meet(rays, tubes);
            if constexpr (A == Answer::Any) {
                found.met = PacketTubes::hides(roots, ranges);
                found.undecided = roots.undecided;
            } else {
                found = PacketTubes::firstOf(rays, tubes, roots, ranges, on);
            }
        }
        const Floats tEntry = entry / at(lanes_.dz);
        takeEach(solids, lanes, on, found, tEntry, ranges, results);
    }

    // RayLanes::entering() for a box each.
    unsigned enteringEach(const std::uint32_t* solids, Ints lane, Floats& entry) const {
        const float* row[W];
        for (int i = 0; i < W; ++i) row[i] = &tree_.boxes[solids[i] >> 2].lo.x;
        Floats a[4], b[4];
        loadRows(row, a);
        for (const float*& from : row) from += 2;
        loadRows(row, b);
        const Floats lo[3] = {a[0], a[1], a[2]}, hi[3] = {b[1], b[2], b[3]};
        Floats exit = permute(zCut_, lane);
        entry = Floats(0.0f);
        for (int axis = 0; axis < 3; ++axis) {
            const Floats r = permute(lanes_.r[axis], lane);
            const Mask back = r < Floats(0.0f);
            entry =
                max(select(back, hi[axis], lo[axis]) * r + permute(lanes_.nearOffset[axis], lane),
                    entry);
            exit = min(select(back, lo[axis], hi[axis]) * r + permute(lanes_.farOffset[axis], lane),
                       exit);
        }
        return bits(entry <= exit);
    }

    void takeEach(const std::uint32_t* solids, const std::uint8_t* lanes, unsigned on,
                  const FoundLanes& found, Floats tEntry, const RayRanges& ranges, Hit* hits) {
        const Floats nearest = max(tEntry, found.t);
        alignas(64) float t[W], lost[W], entry[W], best[W];
        nearest.store(t), found.lost.store(lost), best_.store(best);
        bool improved = false;
        const unsigned met = on & found.met & ~found.undecided & bits(nearest <= ranges.best);
        for (unsigned rest = met; rest != 0; rest &= rest - 1) {
            const int i = std::countr_zero(rest);
            const std::uint8_t lane = lanes[i];
            const std::uint32_t number = solidOf(solids[i]).number;
            if (!(t[i] < best[lane] || (t[i] == best[lane] && number < number_[lane]))) continue;
            hits[ray_[lane]] = {.t = t[i], .u = lost[i], .prim = found.partOf(i), .shape = number};
            best[lane] = t[i], number_[lane] = number;
            improved = true;
        }
        if (improved) limit(Floats::load(best));
        if (const unsigned asking = on & found.undecided; asking != 0) {
            tEntry.store(entry);
            askEach(solids, lanes, asking, entry, hits);
        }
    }
    void takeEach(const std::uint32_t* solids, const std::uint8_t* lanes, unsigned on,
                  const FoundLanes& found, Floats tEntry, const RayRanges&, std::uint8_t* hidden) {
        unsigned met = 0;
        for (unsigned rest = on & found.met & ~found.undecided; rest != 0; rest &= rest - 1) {
            const int i = std::countr_zero(rest);
            met |= 1u << lanes[i];
            asked_ = solids[i] >> 2;
        }
        if (met != 0) hide(met, hidden);
        if (const unsigned asking = on & found.undecided; asking != 0) {
            alignas(64) float entry[W];
            tEntry.store(entry);
            askEach(solids, lanes, asking, entry, hidden);
        }
    }

    template <class Result>
    [[gnu::noinline]] void askEach(const std::uint32_t* solids, const std::uint8_t* lanes,
                                   unsigned asking, const float* tEntry, Result* results) {
        for (; asking != 0; asking &= asking - 1) {
            const int i = std::countr_zero(asking);
            asked_ = solids[i] >> 2;
            askFor(solidOf(solids[i]), lanes[i], tEntry[i], results);
        }
    }

    Pairs<std::size_t{2} * W> passed_[kFormulas + 1];
};
