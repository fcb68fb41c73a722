// The points of a block, W at a time, on the map of a lamp. Filters decide as those of the tree do,
// by the same functions: no hit passes by, and what is certain is one.
// Included by the file of each instruction set inside its namespace.

enum class Answer { Closest, Any };

#include "accel/kernels/solids_hulls.inl"

namespace {

class RaysOnMap {
public:
    RaysOnMap(const LampMap& map, const LitBlock& block, const LitByLamp& by, std::size_t first)
        : map_(map), block_(block), first_(first), shape_(Ints::load(block.shape + first)) {
        const Floats one(1.0f);
        const Floats lamp[3] = {map.lamp.x, map.lamp.y, map.lamp.z};
        for (std::size_t axis = 0; axis < 3; ++axis) {
            lines_.org[axis] = lamp[axis];
            lines_.dir[axis] = Floats::load(by.dir[axis] + first);
        }
        const auto& d = lines_.dir;
        length2_ = fma(d[0], d[0], fma(d[1], d[1], d[2] * d[2]));
        lines_.length = sqrt(length2_);
        lines_.perLength = one / lines_.length, lines_.perLength2 = one / length2_;
        lines_.slack = map.slack, lines_.tMin = 0.0f;
        lines_.best = Floats::load(by.tMax + first);
        reach_ = fma(lines_.best, lines_.length, lines_.slack);
    }

    HiddenByMap ask(unsigned lanes) const {
        HiddenByMap answer;
        answer.unsure = lanes & ~sane();
        lanes &= ~answer.unsure;
        answer.unsure |= lanes & besideOthers(lanes);
        const Ints inside = insideOf(lanes, answer);
        if (lanes != 0) walk(inside, lanes, answer);
        answer.unsure &= ~answer.hidden;
        return answer;
    }

private:
    // Neither empty, nor without end, nor of NaN.
    unsigned sane() const {
        const Floats zero(0.0f), one(1.0f);
        return bits((length2_ > Floats(0x1p-80f)) & (length2_ < Floats(0x1p80f)) &
                    (lines_.best > zero) & (lines_.best <= one));
    }

    unsigned othersThan(std::uint32_t shape, bool hidesOutside, bool hidesInside) const {
        const unsigned inside = block_.inside >> first_;
        return ~bits(shape_ == Ints(shape)) | (inside & (hidesInside ? ~0u : 0)) |
               (~inside & (hidesOutside ? ~0u : 0));
    }

    // Lanes that other shapes may hide.
    unsigned besideOthers(unsigned lanes) const {
        unsigned met = 0;
        const Floats slack(lines_.slack);
        for (const Occluder& other : map_.others) {
            unsigned asked =
                lanes & ~met & othersThan(other.shape, other.hidesOutside, other.hidesInside);
            if (asked == 0) continue;
            Mask apart = maskOf(0);
            for (std::size_t axis = 0; axis < 3; ++axis) {
                const Floats end = fma(lines_.dir[axis], lines_.best, lines_.org[axis]);
                apart = apart |
                        (min(end, lines_.org[axis]) > Floats(other.box.hi[axis]) + slack) |
                        (max(end, lines_.org[axis]) < Floats(other.box.lo[axis]) - slack);
            }
            if (other.plane) {
                const Vec3 n = other.plane->n;
                const float lamp = dot(n, map_.lamp) + other.plane->offset;
                const Floats rise = fma(Floats(n.x), lines_.dir[0],
                                        fma(Floats(n.y), lines_.dir[1], Floats(n.z) * lines_.dir[2]));
                const Floats end = fma(rise, lines_.best, Floats(lamp));
                if (lamp > 2 * map_.slack) apart = apart | (end > slack + slack);
                if (lamp < -2 * map_.slack) apart = apart | (end < Floats(-2 * map_.slack));
            }
            met |= asked & ~bits(apart);
        }
        return met;
    }

    Floats along(Vec3 axis) const {
        return fma(Floats(axis.x), lines_.dir[0],
                   fma(Floats(axis.y), lines_.dir[1], Floats(axis.z) * lines_.dir[2]));
    }

    // The cells of the lanes that are in the picture; the others are taken away: nothing is there.
    Ints insideOf(unsigned& lanes, HiddenByMap& answer) const {
        const Floats depth = along(map_.ahead), zero(0.0f);
        const unsigned isBehind = bits(depth <= Floats(map_.leastCosine) * lines_.length);
        const Floats perDepth = Floats(1.0f) / depth, end(static_cast<float>(map_.cells()));
        const Floats x = fma(along(map_.right) * perDepth, Floats(map_.scale[0]),
                             Floats(map_.offset[0])),
                     y = fma(along(map_.up) * perDepth, Floats(map_.scale[1]),
                             Floats(map_.offset[1]));
        const unsigned isIn = bits((x >= zero) & (x < end) & (y >= zero) & (y < end));
        const unsigned isOut = bits(x < zero) | bits(x >= end) | bits(y < zero) | bits(y >= end);
        lanes &= ~isBehind;
        answer.unsure |= lanes & ~isIn & ~isOut; // NaN
        lanes &= isIn;
        const Mask on = maskOf(lanes);
        return truncated(select(on, x, zero)) +
               shiftedUp(truncated(select(on, y, zero)), map_.logCells);
    }

    // Beyond the last step all numbers are, behind NaN none.
    Ints endOfReach() const {
        const Floats step = (reach_ - Floats(map_.firstStep)) * Floats(map_.perStep);
        constexpr auto kMost = static_cast<float>((1u << (32 - LampMap::kHullBits)) - 2);
        const Floats next = max(step + Floats(1.0f), Floats(0.0f));
        return select(next < Floats(kMost), shiftedUp(truncated(min(next, Floats(kMost))), LampMap::kHullBits),
                      Ints(~0u));
    }

    void walk(Ints cell, unsigned live, HiddenByMap& answer) const {
        const Ints one(1u), reach = endOfReach();
        const unsigned inside = block_.inside >> first_;
        Ints at = intsAt(map_.starts.data(), shiftedUp(cell, 2));
        const Ints end = intsAt(map_.starts.data() + 1, shiftedUp(cell, 2));
        for (;; at = select(maskOf(live), at + one, at)) {
            live &= bits(at < end);
            if (live == 0) return;
            const Ints entry = intsAt(map_.lists.data(), shiftedUp(at, 2));
            live &= bits(entry < reach);
            if (live == 0) return;
            const Ints hull = shiftedDown(shiftedUp(entry, 32 - LampMap::kHullBits),
                                          32 - LampMap::kHullBits - 6);
            const Ints shape = intsAt(&map_.hulls.data()->shape, hull);
            const unsigned asked = live & (~bits(shape == shape_) | inside);
            if (asked == 0) continue;
            const HiddenByMap by = meet(hull, asked);
            answer.hidden |= by.hidden, answer.unsure |= by.unsure;
            live &= ~by.hidden;
        }
    }

    Floats number(float LampMap::Hull::*member, Ints hull) const {
        return floatsAt(&(map_.hulls.data()->*member), hull);
    }
    void vector(Vec3 LampMap::Hull::*member, Ints hull, Floats (&to)[3]) const {
        const Vec3& first = map_.hulls.data()->*member;
        to[0] = floatsAt(&first.x, hull), to[1] = floatsAt(&first.y, hull),
        to[2] = floatsAt(&first.z, hull);
    }

    HiddenByMap meet(Ints hull, unsigned lanes) const {
        BallLanes ball;
        vector(&LampMap::Hull::centre, hull, ball.centre);
        ball.radius = number(&LampMap::Hull::radius, hull);
        ball.innerRadius = number(&LampMap::Hull::innerRadius, hull);
        TubeLanes tube;
        tube.halfLength = number(&LampMap::Hull::halfLength, hull);
        const unsigned tubes = lanes & ~bits(tube.halfLength == Floats(0.0f)),
                       balls = lanes & ~tubes;
        HiddenByMap by;
        if (balls != 0) {
            const Nearness near = nearBall<Answer::Any>(lines_, ball);
            const auto& d = lines_.dir;
            const Floats foot = fma(ball.centre[0] - lines_.org[0], d[0],
                                    fma(ball.centre[1] - lines_.org[1], d[1],
                                        (ball.centre[2] - lines_.org[2]) * d[2])) *
                                lines_.perLength2;
            const Floats early = fnma(ball.radius + lines_.slack, lines_.perLength, foot);
            by.hidden |= balls & near.may & near.certain;
            by.unsure |= balls & near.may & bits(notGreater(early, lines_.best));
        }
        if (tubes != 0) {
            vector(&LampMap::Hull::axis, hull, tube.axis);
            const Nearness near = nearTube<Answer::Any>(lines_, ball, tube, tubes);
            by.hidden |= tubes & near.may & near.certain;
            by.unsure |= tubes & near.may;
        }
        return by;
    }

    const LampMap& map_;
    const LitBlock& block_;
    std::size_t first_;
    Ints shape_;
    Lines lines_;
    Floats length2_, reach_;
};

} // namespace

HiddenByMap askLampMap(const LampMap& map, const LitBlock& block, const LitByLamp& by,
                       unsigned asked) {
    HiddenByMap all;
    for (std::size_t first = 0; first < LitBlock::kPoints; first += W) {
        const unsigned lanes = asked >> first & ((1u << W) - 1);
        if (lanes == 0) continue;
        const HiddenByMap some = RaysOnMap(map, block, by, first).ask(lanes);
        all.hidden |= some.hidden << first, all.unsure |= some.unsure << first;
    }
    return all;
}
