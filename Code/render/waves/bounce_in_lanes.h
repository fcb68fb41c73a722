// The rays that leave mirrors and glass: the formulas of bounces(), in their order. Where those
// return early, lanes go on with numbers that are not used.
#pragma once

#include "simd/vectors3.h"
#include "base/vec.h"
#include "render/point_block.h"
#include "render/waves/bounce_lanes.h"
#include "render/waves/disk_lanes.h"
#include "render/waves/fresnel_lanes.h"
#include "render/waves/lobe_lanes.h"
#include "render/waves/shade_lanes.h"
#include "simd/lanes.h"

#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>

LANES_BEGIN

inline Floats3 mirroredAbout(const Floats3& n, const Floats3& toEye) {
    return normalize(n * (Floats(2.0f) * dot(n, toEye)) - toEye);
}

// refractThrough()
struct RefractedLanes {
    Floats3 dir;
    unsigned passes;
};
inline RefractedLanes refracted(const Floats3& toEye, const Floats3& n, Floats eta) {
    const Floats cosIn = dot(n, toEye), cos2Out = cos2Refracted(cosIn, eta);
    return {normalize(n * (eta * cosIn - sqrt(cos2Out)) - toEye * eta),
            bits(cos2Out > Floats(0.0f))};
}

// What W points send into one direction each; lanes: those that send something to be traced.
struct LeavingLanes {
    Floats3 org, dir, weight;
    unsigned lanes = 0;

    void write(const RayPlaces& out, std::size_t to) const {
        storeChosen(lanes, org, out.org + to), storeChosen(lanes, dir, out.dir + to);
        storeChosen(lanes, weight, out.weight + to);
    }
};

// The lanes of two registers in turn.
template <class Fn>
LeavingLanes inTurn(const LeavingLanes& a, const LeavingLanes& b, const Fn& fn) {
    const auto both = [&](const Floats3& x, const Floats3& y) {
        return Floats3{fn(x.x, y.x), fn(x.y, y.y), fn(x.z, y.z)};
    };
    return {both(a.org, b.org), both(a.dir, b.dir), both(a.weight, b.weight)};
}

// W points of a block, from `first` on.
class BouncingPoints {
public:
    BouncingPoints(const PointBlock& block, const Rgb* weights, float cutoff, std::size_t first)
        : first_(first), toEye_(load(block.toEye, first)), n_(load(block.n, first)),
          ng_(load(block.ng, first)), p_(load(block.p, first)),
          error_(Floats::load(block.error + first)), cutoff_(cutoff) {
        const unsigned front = block.front >> first & kEvery;
        const Floats sign = select(maskOf(front), Floats(0.0f), Floats(-0.0f));
        ng_ = {flipSign(ng_.x, sign), flipSign(ng_.y, sign), flipSign(ng_.z, sign)};
        loadVectors(reinterpret_cast<const float*>(weights + first), weight_.x, weight_.y,
                    weight_.z);
    }

    void bounce(std::span<const AlikePoints> alike, const BouncePairs* pairs, const RayPlaces& to,
                LeavingRays& out) const {
        const Floats zero(0.0f);
        unsigned lanes = 0, plain = 0, rough = 0;
        Floats3 mirror{zero, zero, zero};
        for (const AlikePoints& some : alike) {
            const unsigned here = some.points >> first_ & kEvery;
            if (here == 0) continue;
            lanes |= here, plain |= isPlainMirror(*some.material) ? here : 0;
            rough |= some.material->roughness > 0 ? here : 0;
            mirror = select(maskOf(here), all(some.material->mirror), mirror);
        }
        if (lanes == 0) return;
        const Floats3 h = rough != 0 ? microNormals(alike, *pairs, rough) : n_;
        lanes &= ~(rough & ~bits(dot(h, toEye_) > zero));
        LeavingLanes refracted;
        if ((lanes & ~plain) != 0) refracted = refract(alike, h, lanes, rough, mirror, out);
        write(reflect(h, mirror, lanes, rough), refracted, to, out);
    }

    void mirror(const Material* const* materials, unsigned lanes, const RayPlaces& to,
                LeavingRays& out) const {
        const float* row[W];
        const Material* const some = materials[std::countr_zero(lanes)];
        for (int i = 0; i < W; ++i)
            row[i] = &((lanes >> i & 1) != 0 ? materials[i] : some)->mirror.r;
        Floats mirror[4]; // and something else
        loadRows(row, mirror);
        write(reflect(n_, {mirror[0], mirror[1], mirror[2]}, lanes, 0), {}, to, out);
    }

private:
    // microNormal() of the rough ones, the normals of the others.
    Floats3 microNormals(std::span<const AlikePoints> alike, const BouncePairs& pairs,
                         unsigned rough) const {
        FacetRow row;
        Floats exponent(1.0f);
        for (const AlikePoints& some : alike)
            if (const unsigned here = some.points >> first_ & rough; here != 0)
                exponent =
                    select(maskOf(here), Floats(lobeExponent(some.material->roughness)), exponent);
        exponent.store(row.exponent);
        drawPairs(pairs, first_, row);
        placeInLobe(row, rough);
        return select(maskOf(rough), halfVectors(row, n_), n_);
    }

    // What is not reflected but refracted by the surfaces that h stands on. `mirror` becomes what
    // is reflected.
    LeavingLanes refract(std::span<const AlikePoints> alike, const Floats3& h, unsigned lanes,
                         unsigned rough, Floats3& mirror, LeavingRays& out) const {
        const Floats zero(0.0f), one(1.0f);
        Floats eta(one);
        Floats3 transmission{zero, zero, zero};
        unsigned dielectric = 0, schlick = 0;
        for (const AlikePoints& some : alike) {
            const unsigned here = some.points >> first_ & kEvery;
            if (here == 0) continue;
            dielectric |= some.material->fresnel == FresnelModel::Dielectric ? here : 0;
            schlick |= some.material->fresnel == FresnelModel::Schlick ? here : 0;
            eta = select(maskOf(here), Floats(some.eta), eta);
            transmission = select(maskOf(here), all(some.material->transmission), transmission);
            for (unsigned rest = here; rest != 0; rest &= rest - 1)
                out.beyond[first_ + static_cast<std::size_t>(std::countr_zero(rest))] = some.beyond;
        }
        const Floats cosIn = dot(h, toEye_);
        // totallyReflected()
        Floats3 whenTotal = mirror + transmission, part = mirror;
        Floats through(one);
        if (dielectric != 0) {
            const Mask here = maskOf(dielectric);
            const Floats f = fresnelDielectric(cosIn, eta);
            part = select(here, mirror * f, part), through = select(here, one - f, through);
            const Floats3 total = select(maskOf(black(mirror)), transmission, mirror);
            whenTotal = select(here, total, whenTotal);
        }
        if (schlick != 0) {
            const Mask here = maskOf(schlick);
            const Floats3 white{one, one, one};
            const Floats rise = schlickRise(cosIn);
            part = select(here, mirror + (white - mirror) * rise, part);
            through = select(here, one - rise, through);
            whenTotal = select(here, white, whenTotal);
        }
        mirror = part;
        const unsigned transmits = lanes & ~black(transmission);
        if (transmits == 0) return {};
        auto [dir, passes] = refracted(toEye_, h, eta);
        unsigned total = transmits & ~passes, leaves = bits(dot(dir, ng_) < zero);
        // A bent normal may refract to the side of the eye: fall back to the true surface.
        if (const unsigned bent = transmits & passes & ~leaves & ~rough; bent != 0) {
            const RefractedLanes straight = refracted(toEye_, ng_, eta);
            dir = select(maskOf(bent), straight.dir, dir);
            total |= bent & ~straight.passes;
            leaves |= bent & bits(dot(dir, ng_) < zero);
        }
        mirror = select(maskOf(total), whenTotal, mirror);
        // What nothing takes away from keeps its bits: one is a factor that changes none.
        return rays(p_ - ng_ * error_, dir, transmission * through, transmits & ~total & leaves);
    }

    LeavingLanes reflect(const Floats3& h, const Floats3& mirror, unsigned lanes,
                         unsigned rough) const {
        Floats3 dir = mirroredAbout(h, toEye_), part = mirror;
        const unsigned leaves = bits(dot(dir, ng_) > Floats(0.0f));
        if ((lanes & ~leaves & ~rough) != 0)
            dir = select(maskOf(leaves | rough), dir, mirroredAbout(ng_, toEye_));
        if (rough != 0) {
            // See bounces().
            const Floats cosOut = dot(n_, dir), cosEye = dot(n_, toEye_);
            lanes &= ~(rough & ~(leaves & bits(cosOut > Floats(0.0f))));
            part = select(maskOf(rough) & (cosOut < cosEye), mirror * (cosOut / cosEye), mirror);
        }
        return rays(p_ + ng_ * error_, dir, part, lanes);
    }

    // Those of `lanes` that are worth tracing.
    LeavingLanes rays(const Floats3& org, const Floats3& dir, const Floats3& part,
                      unsigned lanes) const {
        const Floats3 weight = weight_ * part;
        const Floats most = max(max(weight.x, weight.y), weight.z);
        const Mask isWorth = (most > Floats(0.0f)) & (most >= Floats(cutoff_));
        return {org, dir, weight, lanes & bits(isWorth)};
    }

    void write(const LeavingLanes& reflected, const LeavingLanes& refracted, const RayPlaces& to,
               LeavingRays& out) const {
        std::size_t next = out.reflected + out.refracted;
        const unsigned rays =
            spread(reflected.lanes, 0x55555555u) | spread(refracted.lanes, 0xaaaaaaaau);
        if (refracted.lanes == 0) {
            reflected.write(to, next);
        } else {
            LeavingLanes half = inTurn(reflected, refracted, lowInTurn);
            half.lanes = rays & kEvery;
            half.write(to, next);
            next += static_cast<std::size_t>(std::popcount(half.lanes));
            half = inTurn(reflected, refracted, highInTurn);
            half.lanes = rays >> W;
            half.write(to, next);
        }
        out.rays |= rays << 2 * first_;
        out.reflected += static_cast<std::size_t>(std::popcount(reflected.lanes));
        out.refracted += static_cast<std::size_t>(std::popcount(refracted.lanes));
    }

    std::size_t first_;
    Floats3 toEye_, n_, ng_, p_, weight_; // normals on the side of the eye
    Floats error_;
    float cutoff_;
};

std::size_t dividePoints(const PointBlock& block, const std::uint32_t* media, unsigned used,
                         std::uint16_t* alike) {
    std::size_t count = 0;
    for (unsigned rest = used; rest != 0; rest &= ~unsigned{alike[count++]}) {
        const auto i = static_cast<std::size_t>(std::countr_zero(rest));
        const Ints material(block.material[i]), medium(media[i]);
        unsigned same = block.isFront(i) ? block.front : ~block.front;
        for (std::size_t first = 0; first < PointBlock::kPoints; first += W) {
            const unsigned here = bits((Ints::load(block.material + first) == material) &
                                       (Ints::unaligned(media + first) == medium));
            same &= here << first | ~(kEvery << first);
        }
        alike[count] = static_cast<std::uint16_t>(same & rest);
    }
    return count;
}

void bouncePoints(const PointBlock& block, const Rgb* weights, std::span<const AlikePoints> alike,
                  const BouncePairs* pairs, float cutoff, const RayPlaces& to, LeavingRays& out) {
    for (std::size_t first = 0; first < PointBlock::kPoints; first += W)
        BouncingPoints(block, weights, cutoff, first).bounce(alike, pairs, to, out);
}

void mirrorPoints(const PointBlock& block, const Rgb* weights, const Material* const* materials,
                  unsigned points, float cutoff, const RayPlaces& to, LeavingRays& out) {
    for (std::size_t first = 0; first < PointBlock::kPoints; first += W)
        if (const unsigned lanes = points >> first & kEvery; lanes != 0)
            BouncingPoints(block, weights, cutoff, first).mirror(materials + first, lanes, to, out);
}

LANES_END
