// The formulas of shadeSurface() and of what takes its results, lane by lane and in their order.
#pragma once

#include "simd/vectors3.h"
#include "base/bounds.h"
#include "base/vec.h"
#include "render/point_block.h"
#include "render/waves/lamp_lanes.h"
#include "render/waves/point_lanes.h"
#include "render/waves/shade_lanes.h"
#include "simd/lanes.h"

#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <immintrin.h>
#include <limits>

LANES_BEGIN

inline Floats3 shadingNormal(const PointBlock& block, std::size_t first, const Floats3& ng) {
    const unsigned curved = block.curved >> first & kEvery;
    return curved == 0 ? ng : select(maskOf(curved), load(block.ns, first), ng);
}

unsigned seePoints(PointBlock& block, const Vec3* dirs, unsigned used, unsigned litOutside) {
    unsigned facingAway = 0;
    block.front = block.litApart = 0;
    for (std::size_t first = 0; first < SurfaceBlock::kPoints && used >> first != 0; first += W) {
        const Floats zero(0.0f);
        const Floats3 toEye = negated(normalize(loadRow(dirs, first)));
        const Floats3 ng = load(block.ng, first), ns = shadingNormal(block, first, ng);
        const unsigned lanes = used >> first & kEvery;
        const unsigned front = bits(dot(toEye, ng) >= zero) & lanes;
        block.front |= front << first;
        const Floats3 n = front == lanes ? ns : select(maskOf(front), ns, negated(ns));
        facingAway |= (bits(notGreater(dot(n, toEye), zero)) & lanes) << first;
        store(toEye, block.toEye, first), store(n, block.n, first);

        const unsigned apart = litOutside >> first & lanes & ~front;
        if (apart == 0) continue;
        block.litApart |= apart << first;
        store(ns, block.litN, first);
        if ((block.curved >> first & apart) != 0) { // the lift was for the side of the eye
            const Floats3 none{zero, zero, zero};
            store(select(maskOf(apart), none, load(block.lift, first)), block.lift, first);
        }
    }
    return facingAway;
}

void lightPoints(const PointBlock& block, const Rgb* weights, unsigned used, LitBlock& lit) {
    lit.used = used;
    lit.inside = used & ~(block.front | block.litApart);
    lit.lifted = 0;
    for (std::size_t first = 0; first < SurfaceBlock::kPoints && used >> first != 0; first += W) {
        const auto here = [&](unsigned points) { return points >> first & kEvery; };
        const unsigned apart = here(block.litApart), inside = here(lit.inside);
        const auto onLitSide = [&](const Floats3& n) {
            return inside == 0 ? n : select(maskOf(inside), negated(n), n);
        };
        const Floats zero(0.0f);
        const Floats3 ng = load(block.ng, first);
        Floats3 n = load(block.n, first), lift{zero, zero, zero};
        if (apart != 0) n = select(maskOf(apart), load(block.litN, first), n);
        if (const unsigned curved = here(block.curved); curved != 0) {
            lift = select(maskOf(curved), load(block.lift, first), lift);
            const unsigned level = bits((lift.x == zero) & (lift.y == zero) & (lift.z == zero));
            lit.lifted |= (here(used) & ~level) << first;
            store(onLitSide(shadingNormal(block, first, ng)), lit.ns, first);
        }
        store(load(block.p, first), lit.p, first), store(lift, lit.lift, first);
        store(n, lit.n, first), store(onLitSide(ng), lit.ng, first);
        store(loadRow(weights, first), lit.weight, first);
        store(load(block.toEye, first), lit.toEye, first);
        Floats::load(block.error + first).store(lit.error + first);
        Floats::load(block.rayError + first).store(lit.rayError + first);
    }
}

void paintPoints(const Material& material, LitBlock& lit) {
    const auto colour = [](Rgb c) { return Floats3{Floats(c.r), Floats(c.g), Floats(c.b)}; };
    for (unsigned& shiny : lit.shiny) shiny = 0;
    const bool isShiny = !isBlack(material.specular);
    for (std::size_t first = 0; first < SurfaceBlock::kPoints; first += W) {
        store(colour(material.diffuse), lit.diffuse, first);
        if (!isShiny) continue;
        store(colour(material.specular), lit.specular, first);
        Floats(material.exponent).store(lit.exponent + first);
    }
    if (isShiny) lit.shiny[static_cast<std::size_t>(material.specularModel)] = lit.used;
}

void paintEachPoint(const Material* const* materials, LitBlock& lit) {
    static_assert(offsetof(Material, specular) == 3 * sizeof(float) &&
                  offsetof(Material, specularModel) == 6 * sizeof(float) &&
                  offsetof(Material, exponent) == 7 * sizeof(float));
    for (unsigned& shiny : lit.shiny) shiny = 0;
    for (std::size_t first = 0; first < SurfaceBlock::kPoints; first += W) {
        const float* row[W];
        for (std::size_t i = 0; i < W; ++i) row[i] = &materials[first + i]->diffuse.r;
        Floats a[4], b[4]; // the columns of the first eight numbers
        loadRows(row, a);
        for (const float*& from : row) from += 4;
        loadRows(row, b);
        const Floats3 specular{a[3], b[0], b[1]};
        store({a[0], a[1], a[2]}, lit.diffuse, first), store(specular, lit.specular, first);
        b[3].store(lit.exponent + first);
        const Floats zero(0.0f);
        const unsigned shiny =
            ~bits((specular.x == zero) & (specular.y == zero) & (specular.z == zero)) &
            lit.used >> first & kEvery;
        alignas(64) float model[W];
        b[2].store(model);
        const Ints models = Ints::load(reinterpret_cast<const std::uint32_t*>(model));
        for (std::uint32_t m = 0; m < std::size(lit.shiny); ++m)
            lit.shiny[m] |= (bits(models == Ints(m)) & shiny) << first;
    }
}

void addGlowInARow(const Rgb* weights, const Rgb* glow, Rgb* radiance) {
    constexpr std::size_t kNumbers = 3 * SurfaceBlock::kPoints;
    const auto numbers = [](const Rgb* of) { return reinterpret_cast<const float*>(of); };
    alignas(64) float sum[kNumbers];
    for (std::size_t i = 0; i < kNumbers; i += W)
        (Floats::unaligned(numbers(radiance) + i) +
         Floats::unaligned(numbers(weights) + i) * Floats::unaligned(numbers(glow) + i))
            .store(sum + i);
    std::memcpy(radiance, sum, sizeof sum);
}

Bounds boundsOfPoints(const PointBlock& block, unsigned used) {
    Bounds box;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        Floats lo(std::numeric_limits<float>::infinity()), hi = Floats(0.0f) - lo;
        for (std::size_t first = 0; first < SurfaceBlock::kPoints; first += W) {
            const unsigned lanes = used >> first & kEvery, curved = block.curved >> first & lanes;
            const Floats p = Floats::load(block.p[axis] + first);
            const auto extend = [&](Floats to, unsigned of) {
                lo = select(maskOf(of), min(to, lo), lo), hi = select(maskOf(of), max(to, hi), hi);
            };
            extend(p, lanes);
            if (curved != 0) extend(p + Floats::load(block.lift[axis] + first), curved);
        }
        box.lo[axis] = smallest(lo), box.hi[axis] = largest(hi);
    }
    return box;
}

void aimAtPoints(const LitByLamp& by, unsigned points, const RayPlaces& out) {
    std::size_t to = 0;
    for (std::size_t first = 0; first < SurfaceBlock::kPoints && points >> first != 0; first += W) {
        const unsigned lanes = points >> first & kEvery;
        storeChosen(lanes, load(by.dir, first), out.dir + to);
        storeChosenFloats(lanes, Floats::load(by.tMax + first), out.tMax + to);
        to += static_cast<std::size_t>(std::popcount(lanes));
    }
}

void takeRow(const Rgb* radiance, LightSums& sums) {
    for (std::size_t first = 0; first < SurfaceBlock::kPoints; first += W)
        store(loadRow(radiance, first), sums.sum, first);
}
void giveRow(const LightSums& sums, Rgb* radiance) {
    for (std::size_t first = 0; first < SurfaceBlock::kPoints; first += W) {
        const Floats3 sum = load(sums.sum, first);
        storeChosenVectors(kEvery, sum.x, sum.y, sum.z, &radiance[first].r);
    }
}

void addRow(const LightSums& sums, Rgb* radiance) {
    for (std::size_t first = 0; first < SurfaceBlock::kPoints; first += W) {
        const Floats3 before = loadRow(radiance, first), sum = load(sums.sum, first);
        storeChosenVectors(kEvery, before.x + sum.x, before.y + sum.y, before.z + sum.z,
                           &radiance[first].r);
    }
}

void addLight(const LitByLamp& by, unsigned shadowed, const std::uint8_t* hidden, LightSums& sums) {
    unsigned points = by.lit & ~shadowed;
    if (shadowed != 0) {
        const __m128i bytes = _mm_loadu_si128(reinterpret_cast<const __m128i*>(hidden));
        const __m128i isSeen = _mm_cmpeq_epi8(bytes, _mm_setzero_si128());
        points |= spread(static_cast<unsigned>(_mm_movemask_epi8(isSeen)), shadowed);
    }
    if (points == 0) return;
    for (std::size_t first = 0; first < SurfaceBlock::kPoints; first += W) {
        const Floats zero(0.0f);
        const Floats3 none{zero, zero, zero};
        const Floats3 light = select(maskOf(points >> first & kEvery), load(by.light, first), none);
        store(load(sums.sum, first) + light, sums.sum, first);
    }
}

LANES_END
