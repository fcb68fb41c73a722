// Numbers of mip levels, read between their texels, in lanes, each of which has a level of its own.
// What is looked up here is the mean over more than a texel: single precision is enough.
#pragma once

#include "sample/equirectangular.h"
#include "simd/lanes.h"
#include "simd/vectors3.h"
#include "texture/texels_in_lanes.h"
#include "texture/texture.h"

#include <cstddef>
#include <span>

LANES_BEGIN

struct SeenTexels {
    Floats3 color;
    Floats alpha; // how much of it is there
};

class LevelLanes {
public:
    // Grids are of floats in linear light, and have as many channels. They stay as long as this.
    LevelLanes(const TexelGrid* const (&grids)[W], Extension extension)
        : extension_(extension), channels_(grids[0]->image().channels), rows_(numbersOf(grids)),
          width_(0.0f), height_(0.0f), rowLength_(0.0) {
        alignas(64) float width[W], height[W];
        for (std::size_t i = 0; i < W; ++i) {
            width[i] = static_cast<float>(grids[i]->width());
            height[i] = static_cast<float>(grids[i]->height());
        }
        width_ = Floats::load(width), height_ = Floats::load(height);
        rowLength_ = Doubles(width_) * Doubles(channels_);
    }

    // Between texels of different alpha each counts as much as it covers.
    SeenTexels at(const PicturePlaces& place) const {
        const Floats zero(0.0f), one(1.0f);
        const Taps x = taps(place.s, width_), y = taps(place.t, height_);
        // Rows of the file come from the top, y from the bottom.
        const auto rowAt = [&](Floats of) {
            return wholeOf(Doubles(height_ - one - of) * rowLength_);
        };
        const auto columnAt = [&](Floats of) { return wholeOf(Doubles(of) * Doubles(channels_)); };
        const Ints rows[] = {rowAt(y.lo), rowAt(y.hi)},
                   columns[] = {columnAt(x.lo), columnAt(x.hi)};
        const Floats across[] = {one - x.weight, x.weight}, up[] = {one - y.weight, y.weight};
        const bool isClipped = extension_ == Extension::Clip, hasAlpha = channels_ % 2 == 0;
        Floats3 plain{zero, zero, zero}, covering = plain;
        Floats covered = zero;
        for (std::size_t i = 0; i < 2; ++i)
            for (std::size_t k = 0; k < 2; ++k) {
                Floats number[4];
                rows_.load(rows[i] + columns[k], number);
                const Floats weight = across[k] * up[i];
                const Floats3 color{number[0], number[1], number[2]};
                if (!isClipped && !hasAlpha) {
                    plain = plain + color * weight;
                    continue;
                }
                const Floats isThere = isClipped ? x.inside[k] * y.inside[i] : one;
                const Floats alpha = hasAlpha ? number[channels_ - 1] * isThere : isThere;
                plain = plain + color * (weight * isThere);
                covering = covering + color * (weight * alpha);
                covered = covered + weight * alpha;
            }
        SeenTexels seen{plain, one};
        if (isClipped || hasAlpha)
            seen = {select(covered > zero, covering / covered, plain), covered};
        if (channels_ < 3) seen.color = {seen.color.x, seen.color.x, seen.color.x};
        return seen;
    }

private:
    // Texels that coordinates fall between, as whole numbers.
    struct Taps {
        Floats lo, hi, weight; // of hi
        Floats inside[2];      // 1 or 0
    };
    Taps taps(const Doubles& place, Floats size) const {
        const Floats half(0.5f), zero(0.0f), one(1.0f);
        // Limits keep the conversion to whole numbers safe; NaN becomes 0, or the limit of Clip.
        Floats s = zero;
        switch (extension_) {
        case Extension::Repeat:
            s = (place - floor(place)).toFloats();
            s = select(s <= one, s, zero); // infinite or NaN
            break;
        case Extension::Extend: s = min(max(place.toFloats(), zero), one); break;
        case Extension::Clip: s = min(max(place.toFloats(), Floats(-2.0f)), Floats(2.0f)); break;
        }
        const Floats x = s * size - half, below = floor(x), above = below + one;
        const auto insideOf = [&](Floats i) { return select((i < size) & (zero <= i), one, zero); };
        if (extension_ == Extension::Repeat)
            return {select(below < zero, below + size, below),
                    select(above < size, above, above - size), x - below, {one, one}};
        const auto held = [&](Floats i) { return min(max(i, zero), size - one); };
        return {held(below), held(above), x - below, {insideOf(below), insideOf(above)}};
    }
    static FloatRows numbersOf(const TexelGrid* const (&grids)[W]) {
        std::span<const float> numbers[W];
        for (std::size_t i = 0; i < W; ++i) numbers[i] = grids[i]->image().floats;
        return FloatRows(numbers);
    }

    Extension extension_;
    int channels_;
    FloatRows rows_;
    Floats width_, height_;
    Doubles rowLength_; // in numbers
};

LANES_END
