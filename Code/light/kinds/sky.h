// SkyEmitter: all of the sky as a lamp, sampled by the table of its brightness. There is one for
// all lanes.
#pragma once

#include "light/light_lanes.h"
#include "light/sky/sky_table.h"
#include "sample/equirectangular.h"
#include "texture/pictures_in_lanes.h"

LANES_BEGIN

class SkyEmitter {
public:
    explicit SkyEmitter(const SkyView& sky) : sky_(sky) {}

    SampledLight sample(const Floats3&, Floats u, Floats v) const {
        const Ints row = lastNotAbove(sky_.rows, Ints(0), sky_.height, v);
        const Ints first = firstOf(row);
        const Ints column = lastNotAbove(sky_.columns, first, sky_.width, u);
        const Part inRow = partOf(sky_.rows, row),
                   inColumn = partOf(sky_.columns, sum(first, column));
        const Doubles across = Doubles((u - inColumn.from) / inColumn.size);
        const Doubles along = Doubles((v - inRow.from) / inRow.size);
        const Belt belt = beltOf(row);
        const Doubles s = (doublesOf(column) + across) * Doubles(1.0 / sky_.width);
        const Floats3 toLight =
            directionAt(sky_.place, s, belt.from + along * (belt.to - belt.from));
        const Floats pdf = density(inRow, inColumn, belt);
        return where(pdf > Floats(0.0f), toLight, kInfinityF, radianceOf(toLight) / pdf, pdf,
                     noLanes());
    }
    SampledLight centre(const Floats3& p) const {
        SampledLight at = sample(p, 0.5f, 0.5f);
        at.pdf = 0.0f, at.single = maskOf(kAllLanes);
        return at;
    }
    Floats pdf(const Floats3&, const Floats3& dir) const {
        const auto [s, t] = placesOf(sky_.place, dir);
        const Ints column = cellOf(s - floor(s), sky_.width), row = cellOf(t, sky_.height);
        return density(partOf(sky_.rows, row), partOf(sky_.columns, sum(firstOf(row), column)),
                       beltOf(row));
    }
    LightMeeting meet(const Floats3&, const Floats3& dir) const {
        return meetingWhere(maskOf(kAllLanes), kInfinityF, radianceOf(dir));
    }

private:
    struct Part {
        Floats from, size;
    };
    struct Belt {
        Doubles from, to; // sines of latitude
    };

    static Ints sum(Ints a, Ints b) { return a + b; }
    static Floats numbersAt(const float* table, Ints i) {
        return fromBits(elementsAt(reinterpret_cast<const std::uint32_t*>(table), i, kAllLanes));
    }
    // The last i below count whose number, from `first` on, is at most x; that of 0 is 0.
    static Ints lastNotAbove(const float* table, Ints first, std::uint32_t count, Floats x) {
        Ints low(0);
        for (std::uint32_t step = std::bit_floor(count); step > 0; step /= 2) {
            const Ints next = plus(low, step);
            const Mask isIn = next < Ints(count);
            const Floats number = numbersAt(table, sum(first, select(isIn, next, low)));
            low = select(isIn & (number <= x), next, low);
        }
        return low;
    }
    static Ints cellOf(const Doubles& place, std::uint32_t count) {
        const Doubles last(static_cast<double>(count - 1));
        return wholeOf(
            min(max(floor(place * Doubles(static_cast<double>(count))), Doubles(0.0)), last));
    }
    Ints firstOf(Ints row) const {
        return wholeOf(doublesOf(row) * Doubles(static_cast<double>(sky_.pitch)));
    }
    static Part partOf(const float* table, Ints i) {
        const Floats from = numbersAt(table, i);
        return {from, numbersAt(table, plus(i, 1)) - from};
    }
    Belt beltOf(Ints row) const {
        Belt belt{0.0, 0.0};
        pairsAt<1>(sky_.borders, row, belt.from, belt.to);
        return belt;
    }
    Floats density(const Part& row, const Part& column, const Belt& belt) const {
        const Floats solidAngle = ((belt.to - belt.from) * Doubles(kTwoPi / sky_.width)).toFloats();
        return row.size * column.size / solidAngle;
    }
    Floats3 radianceOf(const Floats3& dir) const {
        const Rgb& factor = sky_.radiance.factor;
        const Floats3 even{factor.r, factor.g, factor.b};
        if (sky_.radiance.picture == nullptr) return even;
        return even * environmentColor(*sky_.radiance.picture, dir);
    }

    SkyView sky_;
};

LANES_END
