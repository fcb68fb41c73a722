// Means of pictures over ellipses, in lanes: up to sixteen looks along the longer axis, each
// between two mip levels; Texture::color() with a footprint is the one lane of it.
#pragma once

#include "sample/equirectangular.h"
#include "simd/lanes.h"
#include "simd/vectors3.h"
#include "texture/mip_levels.h"
#include "texture/texels_in_lanes.h"
#include "texture/texture.h"

#include <bit>
#include <cstddef>
#include <cstdint>

LANES_BEGIN

// Two conjugate axes of an ellipse in it, from side to side.
struct PictureAxes {
    PicturePlaces along, across;
};
// Returns the axes of footprints whose axes are these in texture coordinates.
inline PictureAxes axesOf(const TextureMap& map, Floats alongU, Floats alongV, Floats acrossU,
                          Floats acrossV) {
    const auto mapped = [&](Floats u, Floats v) -> PicturePlaces {
        return {Doubles(map.sFromU) * Doubles(u) + Doubles(map.sFromV) * Doubles(v),
                Doubles(map.tFromU) * Doubles(u) + Doubles(map.tFromV) * Doubles(v)};
    };
    return {mapped(alongU, alongV), mapped(acrossU, acrossV)};
}

// Probes say where W lanes look, and how finely.
struct Probes {
    static constexpr double kMost = 16;
    PicturePlaces way; // from end to end, in parts of the picture's sides
    Doubles count;      // at least 1
    Doubles width;      // of what each is the mean over, in texels; at least 1
};
// The ellipse's own axes are those of the sum of the squares of both (the eigenvectors of a
// symmetric matrix).
inline Probes probesOf(const PictureAxes& axes, double width, double height) {
    const Doubles zero(0.0), one(1.0), half(0.5);
    const Doubles ax = axes.along.s * Doubles(width), ay = axes.along.t * Doubles(height);
    const Doubles bx = axes.across.s * Doubles(width), by = axes.across.t * Doubles(height);
    const Doubles xx = ax * ax + bx * bx, xy = ax * ay + bx * by, yy = ay * ay + by * by;
    const Doubles middle = (xx + yy) * half, off = (xx - yy) * half;
    const Doubles root = sqrt(off * off + xy * xy);
    const Mask isSane = maskOf(less(middle, Doubles(1e24))); // not NaN
    const Doubles longest = select(isSane, sqrt(middle + root), zero);
    const Doubles narrow = select(isSane, sqrt(max(middle - root, zero)), zero);
    const Doubles wide = max(max(narrow, longest / Doubles(Probes::kMost)), one);
    const Doubles ratio = longest / wide, whole = floor(ratio);
    const Doubles count =
        min(max(select(whole < ratio, whole + one, whole), one), Doubles(Probes::kMost));
    // Both rows of the matrix less the eigenvalue give the direction; the longer one is exact.
    const Doubles large = middle + root;
    const Mask isFlat = maskOf(atMost(yy, xx));
    const Doubles x = select(isFlat, large - yy, xy), y = select(isFlat, xy, large - xx);
    const Doubles length2 = x * x + y * y;
    const Mask hasWay = maskOf(less(zero, length2) & less(one, count));
    const Doubles scale = longest / sqrt(select(hasWay, length2, one));
    return {{select(hasWay, x * scale / Doubles(width), zero),
             select(hasWay, y * scale / Doubles(height), zero)},
            count,
            wide};
}

// Where a picture's edge goes on outside of it, nothing changes across the edge: takes only the
// part of a footprint that is inside.
inline void holdInside(Doubles& middle, Doubles& along, Doubles& across) {
    const Doubles zero(0.0), one(1.0), half(0.5);
    const Doubles reach = half * sqrt(along * along + across * across);
    const auto held = [&](const Doubles& x) { return min(max(x, zero), one); };
    const Doubles low = held(middle - reach), high = held(middle + reach);
    const Mask goesOut = maskOf(less(middle - reach, zero) | less(one, middle + reach));
    const Mask isWide = maskOf(less(zero, reach)) & goesOut;
    const Doubles part = select(isWide, (high - low) * half / select(isWide, reach, one), one);
    middle = select(isWide, (low + high) * half, middle);
    along = along * part, across = across * part;
}

// Which two levels a mean over so many texels is taken from, and what part of it from the coarser
// one. The logarithm is taken as straight between powers of two.
struct LevelPlace {
    int finer;
    float coarser;
};
inline LevelPlace levelOf(double width, int levels) {
    const auto bits = std::bit_cast<std::uint64_t>(width);
    const int power = static_cast<int>(bits >> 52) - 1023; // is positive or 0
    if (power >= levels - 1) return {levels - 1, 0};
    const double mantissa = std::bit_cast<double>((bits & 0x000fffffffffffffu) | (1023ull << 52));
    return {power, static_cast<float>(mantissa - 1)};
}

class FilteredTexels {
public:
    // The texture stays as long as this.
    explicit FilteredTexels(const Texture& texture)
        : texture_(texture), levels_(texture.mips().count()),
          weighsAlpha_(!texture.isAlpha() && texture.grid().image().channels % 2 == 0) {}

    Floats3 colors(PicturePlaces at, PictureAxes axes) const {
        if (texture_.extension() == Extension::Extend) {
            holdInside(at.s, axes.along.s, axes.across.s);
            holdInside(at.t, axes.along.t, axes.across.t);
        }
        const Probes probes =
            probesOf(axes, texture_.grid().width(), texture_.grid().height());
        alignas(64) double count[W], width[W];
        probes.count.store(count), probes.width.store(width);
        alignas(64) float coarser[W];
        int finer[W];
        unsigned used = 0; // levels, a bit for each
        for (std::size_t i = 0; i < W; ++i) {
            const LevelPlace place = levelOf(width[i], levels_);
            finer[i] = place.finer, coarser[i] = place.coarser;
            used |= (place.coarser > 0 ? 3u : 1u) << place.finer;
        }
        double most = 1;
        for (const double n : count) most = n > most ? n : most;
        Sums sums;
        for (double probe = 0; probe < most; ++probe) {
            const Doubles along =
                (Doubles(2 * probe + 1) / probes.count - Doubles(1.0)) * Doubles(0.5);
            const PicturePlaces place{at.s + along * probes.way.s, at.t + along * probes.way.t};
            for (unsigned rest = used; rest != 0; rest &= rest - 1) {
                const int level = std::countr_zero(rest);
                alignas(64) float weight[W];
                unsigned lanes = 0;
                for (std::size_t i = 0; i < W; ++i) {
                    weight[i] = level == finer[i]       ? 1 - coarser[i]
                                : level == finer[i] + 1 ? coarser[i]
                                                        : 0;
                    lanes |= unsigned{weight[i] > 0 && probe < count[i]} << i;
                }
                if (lanes != 0) add(level, place, maskOf(lanes), Floats::load(weight), sums);
            }
        }
        return sums.mean(weighsAlpha_);
    }

private:
    struct Sums {
        Floats3 plain{Floats(0.0f), Floats(0.0f), Floats(0.0f)}, seen = plain;
        Floats weight{0.0f}, covered{0.0f}, looks{0.0f};

        // Colours are weighted by alpha if more than one was looked at.
        Floats3 mean(bool weighsAlpha) const {
            const Floats3 all = plain / weight;
            if (!weighsAlpha) return all;
            const Mask isWeighted = (covered > Floats(0.0f)) & (looks > Floats(1.0f));
            return select(isWeighted, seen / covered, all);
        }
    };
    void add(int level, const PicturePlaces& at, Mask lanes, Floats weight, Sums& sums) const {
        const TexelGrid& grid =
            level == 0 ? texture_.grid() : texture_.mips().level(texture_.grid(), level);
        const Floats zero(0.0f), one(1.0f);
        Floats3 color = lookedUp(grid, at, texture_.isAlpha());
        // At the edge of a picture between black, as far as the picture is there.
        if (level > 0 && !weighsAlpha_ && texture_.extension() == Extension::Clip &&
            !texture_.isAlpha())
            color = color * lookedUp(grid, at, true).x;
        sums.plain = select(lanes, sums.plain + color * weight, sums.plain);
        sums.weight = select(lanes, sums.weight + weight, sums.weight);
        if (!weighsAlpha_) return;
        const Floats covers = weight * lookedUp(grid, at, true).x;
        sums.seen = select(lanes, sums.seen + color * covers, sums.seen);
        sums.covered = select(lanes, sums.covered + covers, sums.covered);
        sums.looks = sums.looks + select(lanes, one, zero);
    }
    Floats3 lookedUp(const TexelGrid& grid, const PicturePlaces& at, bool wantsAlpha) const {
        alignas(64) float r[W], g[W], b[W];
        TexelLanes(grid, texture_.extension(), texture_.extension(), wantsAlpha)
            .colors(at.s, at.t, r, g, b);
        return {Floats::load(r), Floats::load(g), Floats::load(b)};
    }

    const Texture& texture_;
    int levels_;
    bool weighsAlpha_;
};

LANES_END
