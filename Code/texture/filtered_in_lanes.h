// Means of pictures over ellipses, in lanes: up to sixteen looks along the longer axis, each
// between two mip levels; Texture::color() with a footprint is the one lane of it.
#pragma once

#include "sample/equirectangular.h"
#include "simd/lanes.h"
#include "simd/vectors3.h"
#include "texture/levels_in_lanes.h"
#include "texture/mip_levels.h"
#include "texture/texels_in_lanes.h"
#include "texture/texture.h"

#include <bit>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>

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

// LevelPlaces says from which two levels means over so many texels are taken, and what part of them
// from the coarser one. The logarithm is taken as straight between powers of two.
struct LevelPlaces {
    Ints finer;
    Floats coarser;
};
inline LevelPlaces levelsOf(const Doubles& width, int levels) {
    const Doubles one(1.0),
        held = min(width, powersOfTwo(Ints(static_cast<std::uint32_t>(levels - 1))));
    const Ints power = plus(shiftedRight<23>(bitsOf(held.toFloats())), ~126u);
    // What rounding has brought to the next power has nothing of the coarser one.
    return {power, max(held / powersOfTwo(power) - one, Doubles(0.0)).toFloats()};
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
        const Doubles one(1.0);
        if ((less(one, probes.count) | less(one, probes.width)) == 0)
            return lookedUp(at, texture_.isAlpha());
        const LevelPlaces levels = levelsOf(probes.width, levels_);
        const Floats coarser = levels.coarser, zero(0.0f);
        const unsigned inPicture = bits(levels.finer == Ints(0u)), finer = ~inPicture & kAllLanes,
                       between = bits(coarser > zero);
        const std::optional<LevelLanes> looks[] = {lookAt(levels.finer, finer),
                                                   lookAt(plus(levels.finer, 1), between)};
        Sums sums;
        for (double probe = 0; const unsigned lanes = less(Doubles(probe), probes.count); ++probe) {
            const Doubles along = (Doubles(2 * probe + 1) / probes.count - one) * Doubles(0.5);
            const PicturePlaces place{at.s + along * probes.way.s, at.t + along * probes.way.t};
            const auto add = [&](unsigned among, const auto& look, Floats weight) {
                if ((among & lanes) != 0)
                    sums.add(look(), maskOf(among & lanes), weight, weighsAlpha_);
            };
            add(inPicture, [&] { return inPictureAt(place); }, Floats(1.0f) - coarser);
            add(finer, [&] { return inLevels(*looks[0], place); }, Floats(1.0f) - coarser);
            add(between, [&] { return inLevels(*looks[1], place); }, coarser);
        }
        return sums.mean(weighsAlpha_);
    }

private:
    struct Sums {
        Floats3 plain{Floats(0.0f), Floats(0.0f), Floats(0.0f)}, seen = plain;
        Floats weight{0.0f}, covered{0.0f}, looks{0.0f};

        void add(const SeenTexels& texels, Mask lanes, Floats part, bool weighsAlpha) {
            plain = select(lanes, plain + texels.color * part, plain);
            weight = select(lanes, weight + part, weight);
            if (!weighsAlpha) return;
            const Floats covers = part * texels.alpha;
            seen = select(lanes, seen + texels.color * covers, seen);
            covered = select(lanes, covered + covers, covered);
            looks = looks + select(lanes, Floats(1.0f), Floats(0.0f));
        }
        // Colours are weighted by alpha if more than one was looked at.
        Floats3 mean(bool weighsAlpha) const {
            const Floats3 all = plain / weight;
            if (!weighsAlpha) return all;
            const Mask isWeighted = (covered > Floats(0.0f)) & (looks > Floats(1.0f));
            return select(isWeighted, seen / covered, all);
        }
    };
    static constexpr unsigned kAllLanes = (1u << W) - 1;
    // Returns the levels of some lanes; the others look into one of these.
    std::optional<LevelLanes> lookAt(Ints levels, unsigned lanes) const {
        if (lanes == 0) return {};
        alignas(64) std::uint32_t level[W];
        select(maskOf(lanes), levels, Ints(0u)).store(level);
        const std::uint32_t any = level[std::countr_zero(lanes)];
        const TexelGrid* grids[W];
        for (std::size_t i = 0; i < W; ++i) {
            if (level[i] == 0) level[i] = any;
            grids[i] = i > 0 && level[i] == level[i - 1]
                           ? grids[i - 1]
                           : &texture_.mips().level(texture_.grid(), static_cast<int>(level[i]));
        }
        return std::optional<LevelLanes>(std::in_place, grids, texture_.extension());
    }
    SeenTexels inLevels(const LevelLanes& levels, const PicturePlaces& at) const {
        SeenTexels seen = levels.at(at);
        if (texture_.isAlpha())
            seen.color = {seen.alpha, seen.alpha, seen.alpha};
        else if (!weighsAlpha_ && texture_.extension() == Extension::Clip)
            seen.color = seen.color * seen.alpha; // it is cut off from black
        return seen;
    }
    SeenTexels inPictureAt(const PicturePlaces& at) const {
        return {lookedUp(at, texture_.isAlpha()),
                weighsAlpha_ ? lookedUp(at, true).x : Floats(1.0f)};
    }
    Floats3 lookedUp(const PicturePlaces& at, bool wantsAlpha) const {
        alignas(64) float r[W], g[W], b[W];
        TexelLanes(texture_.grid(), texture_.extension(), texture_.extension(), wantsAlpha)
            .colors(at.s, at.t, r, g, b);
        return {Floats::load(r), Floats::load(g), Floats::load(b)};
    }

    const Texture& texture_;
    int levels_;
    bool weighsAlpha_;
};

LANES_END
