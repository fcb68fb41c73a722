// Solids that rays of a packet may meet: which formula each is asked by, with the bits of asking
// each shape for each ray.
#pragma once

#include "accel/kernels/solids.h"
#include "accel/kernels/solids_answers.h"
#include "accel/kernels/solids_cubes.h"
#include "accel/kernels/solids_flats.h"
#include "accel/kernels/solids_hulls.h"
#include "accel/kernels/solids_objects.h"
#include "accel/kernels/solids_tubes.h"
#include "accel/kernels/solids_turning.h"
#include "base/math.h"
#include "base/cpu.h"
#include "simd/lanes.h"

#include <bit>
#include <cstdint>

LANES_BEGIN

class PacketSolids : public PacketAnswers {
protected:
    using PacketAnswers::PacketAnswers;

    template <Answer A, class Result>
    void solid(std::uint32_t place, unsigned lanes, Result* results) {
        const SolidTree::Solid& solid = tree_.solids[place];
        if (A == Answer::Any && !solid.hides) return;
        asked_ = place;
        const BallLanes ball{
            {solid.centre.x, solid.centre.y, solid.centre.z}, solid.radius, solid.innerRadius};
        const Nearness near =
            solid.isTube
                ? nearTube<A>(lines(), ball,
                              {{solid.axis.x, solid.axis.y, solid.axis.z}, solid.halfLength}, lanes)
                : nearBall<A>(lines(), ball);
        lanes &= near.may;
        if constexpr (A == Answer::Any) {
            const unsigned certain = near.certain & lanes;
            if (certain != 0) hide(certain, results);
            lanes &= ~certain;
        }
        if (lanes != 0) meetOne<A>(place, lanes, results);
    }

    // Without the filters.
    template <Answer A, class Result>
    void meetOne(std::uint32_t place, unsigned lanes, Result* results) {
        const SolidTree::Solid& solid = tree_.solids[place];
        asked_ = place;
        prefetch(solid);
        Floats entry;
        lanes &= lanes_.entering(tree_.boxes[place], zCut_, entry);
        if (lanes == 0) return;
        if (solid.moves)
            moving<A>(solid, entry, lanes, results);
        else if (solid.kind == SolidTree::Kind::Sphere)
            sphere<A>(solid, SameMap{solid.shape->objectFromWorld()}, entry, lanes, results);
        else if (solid.kind == SolidTree::Kind::Facets)
            facets(solid, tree_.facets[solid.part], entry, lanes, results);
        else if (solid.kind == SolidTree::Kind::Tube)
            tube(solid, tree_.tubes[solid.part], entry, lanes, results);
        else if (solid.kind != SolidTree::Kind::Other)
            faces<A>(solid, entry, lanes, results);
        else
            ask(solid, entry, lanes, results);
    }

    // What no box keeps rays from.
    template <Answer A, class Result> void meetEndless(Result* results) {
        const Floats entry(0.0f);
        for (const SolidTree::Solid& solid : tree_.endless) {
            if (live_ == 0) return;
            if (A == Answer::Any && !solid.hides) continue;
            asked_ = lastHider_; // asked anyway, it takes nobody's place
            if (solid.moves)
                moving<A>(solid, entry, live_, results);
            else
                faces<A>(solid, entry, live_, results);
        }
    }

    // What it will be met by, while its box is entered: shapes lie anywhere in the memory.
    void prefetch(const SolidTree::Solid& solid) const {
        if (solid.shape == nullptr) return;
        ::prefetch(solid.shape->objectFromWorld());
        __builtin_prefetch(&solid.shape->radius);
        if (solid.moves)
            __builtin_prefetch(&tree_.movements[solid.part]);
        else if (solid.kind == SolidTree::Kind::Tube)
            __builtin_prefetch(&tree_.tubes[solid.part]);
    }

private:
    template <Answer A, class Map, class Result>
    void sphere(const SolidTree::Solid& solid, const Map& map, Floats entry, unsigned lanes,
                Result* results) {
        const SphereRoots roots = meet(lanes, columns_, map, solid.turned, solid.shape->radius);
        if (roots.met == 0) return;
        if constexpr (A == Answer::Any)
            hide(hides(roots, ranges()), results);
        else if (solid.side == ::Facets::Side::Both)
            take(solid, firstOf(roots, ranges()), entry, lanes, results);
        else
            take(solid, firstOf(roots, ranges(), solid.side, columns_, map), entry, lanes, results);
    }

    template <Answer A, class Result>
    [[gnu::noinline]] void faces(const SolidTree::Solid& solid, Floats entry, unsigned lanes,
                                 Result* results) {
        facesBy<A>(solid, SameMap{solid.shape->objectFromWorld()}, entry, lanes, results);
    }
    template <Answer A, class Map, class Result>
    void facesBy(const SolidTree::Solid& solid, const Map& map, Floats entry, unsigned lanes,
                 Result* results) {
        take(solid,
             solid.kind == SolidTree::Kind::Cube ? meetCube<A>(columns_, ranges(), solid, map)
                                                 : meetFlat<A>(columns_, ranges(), solid, map),
             entry, lanes, results);
    }

    // AnalyticShape::intersect(), OneSided::intersect() and the choice between their hit and the
    // best one. Who can't be sure here asks the shape.
    [[gnu::noinline]] void tube(const SolidTree::Solid& solid, const SolidTree::Tube& tube,
                                Floats entry, unsigned lanes, Hit* hits) {
        tubeBy(solid, sameTube(tube, SameMap{solid.shape->objectFromWorld()}), entry, lanes, hits);
    }

    [[gnu::noinline]] void tube(const SolidTree::Solid& solid, const SolidTree::Tube& tube,
                                Floats entry, unsigned lanes, std::uint8_t* hidden) {
        tubeBy(solid, sameTube(tube, SameMap{solid.shape->objectFromWorld()}), entry, lanes,
               hidden);
    }
    template <class Map>
    void tubeBy(const SolidTree::Solid& solid, const Tubes<Map>& tubes, Floats entry,
                unsigned lanes, Hit* hits) {
        const TubeRoots roots = meet(columns_, tubes);
        take(solid, firstOf(columns_, tubes, roots, ranges(), lanes), entry, lanes, hits);
    }
    template <class Map>
    void tubeBy(const SolidTree::Solid& solid, const Tubes<Map>& tubes, Floats entry,
                unsigned lanes, std::uint8_t* hidden) {
        const TubeRoots roots = meet(columns_, tubes);
        FoundLanes found{.t = Floats(0.0f), .lost = Floats(0.0f), .undecided = roots.undecided};
        found.met = hides(roots, ranges());
        take(solid, found, entry, lanes, hidden);
    }

    // By the maps at the times of the rays.
    template <Answer A, class Result>
    [[gnu::noinline]] void moving(const SolidTree::Solid& solid, Floats entry, unsigned lanes,
                                  Result* results) {
        const SolidTree::Movement& movement = tree_.movements[solid.part];
        if (const auto& drift = movement.motion.drift) {
            const DriftLanes map(solid.shape->objectFromWorld(), *drift, rays_, ray_, lanes);
            return movingBy<A>(solid, movement.tube, map, entry, lanes, results);
        }
        TurningMaps maps(movement, rays_, ray_);
        lanes = maps.make(lines(), lanes);
        if (lanes == 0) return;
        movingBy<A>(solid, movement.tube, maps.objectFromWorld(), entry, lanes, results);
    }
    template <Answer A, class Map, class Result>
    void movingBy(const SolidTree::Solid& solid, const SolidTree::Tube& tube, const Map& map,
                  Floats entry, unsigned lanes, Result* results) {
        if (solid.kind == SolidTree::Kind::Sphere)
            return sphere<A>(solid, map, entry, lanes, results);
        if (solid.kind != SolidTree::Kind::Tube)
            return facesBy<A>(solid, map, entry, lanes, results);
        Tubes<Map> tubes = sameTube(tube, map);
        if (tubes.front | tubes.back) tubes.wallStretch = tubes.endStretch = normalStretch(map);
        tubeBy(solid, tubes, entry, lanes, results);
    }

    // Mesh::intersect(), OneSided::intersect() and the choice between their hit and the best one.
    // Who can't be sure here asks the shape.
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
            const Floats t = one / (hit.key * lanes_.dz);
            const unsigned better =
                lanes & bits((hit.key > bestKey) & (t > columns_.tMin) & (t < endless));
            if (better == 0) continue;
            bestKey = select(maskOf(better), hit.key, bestKey);
            const auto edge = [&](int a, int b) {
                return Doubles(hit.x[a]) * Doubles(hit.y[b]) -
                       Doubles(hit.y[a]) * Doubles(hit.x[b]);
            };
            const Doubles e0 = edge(2, 1), e1 = edge(0, 2), e2 = edge(1, 0), sum = (e0 + e1) + e2;
            u = select(maskOf(better), (e1 / sum).toFloats(), u);
            v = select(maskOf(better), (e2 / sum).toFloats(), v);
            for (unsigned rest = better; rest != 0; rest &= rest - 1)
                prim[std::countr_zero(rest)] = f;
            if (group.side != ::Facets::Side::Both)
                unseen = (unseen & ~better) | (better & ~seesSide(facet.n, group.side));
        }
        const Floats t = one / (bestKey * lanes_.dz);
        unsigned better = lanes & bits((bestKey > zero) & (t <= best_)) & ~asking;
        asking = (asking & lanes) | (better & unseen);
        const Floats nearest = max(entry / lanes_.dz, t);
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

    [[gnu::noinline]] void facets(const SolidTree::Solid& solid, const SolidTree::FacetGroup& group,
                                  Floats entry, unsigned lanes, std::uint8_t* hidden) {
        const Floats one(1.0f);
        for (std::uint32_t f = 0; f < group.count; ++f) {
            const FacetHit hit = meet(group.facet[f], group.extent);
            const Floats t = one / (hit.key * lanes_.dz);
            const unsigned met = lanes & ~hit.undecided &
                                 bits((hit.key > Floats(0.0f)) & (t > columns_.tMin) & (t < best_));
            hide(met, hidden);
            lanes &= ~met;
            if (const unsigned asking = lanes & hit.undecided; asking != 0) {
                ask(solid, entry, asking, hidden);
                lanes &= ~asking;
            }
            if (lanes == 0) return;
        }
    }
};

LANES_END
