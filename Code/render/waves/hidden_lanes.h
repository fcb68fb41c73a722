// The questions of Occluders::mayHide(), asked for every point of a block by itself.
#pragma once

#include "base/bounds.h"
#include "base/math.h"
#include "base/vec.h"
#include "render/occluders.h"
#include "render/waves/lamp_lanes.h"
#include "render/waves/three_lanes.h"
#include "simd/lanes.h"

#include <cstddef>
#include <cstdint>

LANES_BEGIN

// How a linear function a + t b changes, for all a: where it is positive is asked of many shapes.
struct SlopeInLanes {
    SlopeInLanes() = default;
    explicit SlopeInLanes(Floats b)
        : crossing(Floats(-1.0f) / b), rises(b > Floats(0.0f)), falls(b < Floats(0.0f)) {}
    Floats crossing; // t / a
    Mask rises, falls;
};

// The part of [0,1] where linear functions are not negative, after some of them. What two roundings
// do to an end of it is small against what meet() adds.
struct TimesInLanes {
    Floats lo{0.0f}, hi{1.0f};
    void keepPositive(Floats a, const SlopeInLanes& b) {
        const Floats crossing = a * b.crossing;
        lo = select(b.rises, max(crossing, lo), lo);
        hi = select(b.falls, min(crossing, hi), hi);
        const unsigned level = ~(bits(b.rises) | bits(b.falls));
        lo = select(maskOf(level & bits(a < Floats(0.0f))), Floats(2.0f), lo);
    }
};

class PointsToLamp {
public:
    PointsToLamp(const LitBlock& block, std::size_t first, const LampBall& lamp)
        : lamp_(Bounds{lamp.centre, lamp.centre}.padded(lamp.radius)), lampRadius_(lamp.radius),
          p_(Three::load(block.p, first)) {
        const Three way = Three::all(lamp.centre.x, lamp.centre.y, lamp.centre.z) - p_;
        distance_ = sqrt(dot(way, way));
        unit_ = way / distance_;
        const Three lift = Three::load(block.lift, first);
        lift_ = abs(lift.x) + abs(lift.y) + abs(lift.z);
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const Floats p = Floats::load(block.p[axis] + first);
            const Floats lifted = p + Floats::load(block.lift[axis] + first);
            lo_[axis] = min(p, lifted), hi_[axis] = max(p, lifted);
            fromHi_[axis] = SlopeInLanes(Floats(lamp_.hi[axis]) - hi_[axis]);
            fromLo_[axis] = SlopeInLanes(lo_[axis] - Floats(lamp_.lo[axis]));
        }
        sine_ = Floats(lamp.radius) / distance_;
        cosine_ = sqrt(Floats(1.0f) - sine_ * sine_); // NaN in the lamp: then nothing is known
    }

    // Of each point and the lamp, but `least` at least.
    Floats extent(float least) const {
        Floats most(::max(::max(maxAbs(lamp_.lo), maxAbs(lamp_.hi)), least));
        for (std::size_t axis = 0; axis < 3; ++axis)
            most = max(max(abs(lo_[axis]), abs(hi_[axis])), most);
        return most;
    }

    unsigned meet(const Bounds& box, Floats slack) const {
        TimesInLanes times;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            times.keepPositive(hi_[axis] - (Floats(box.lo[axis]) - slack), fromHi_[axis]);
            times.keepPositive((Floats(box.hi[axis]) + slack) - lo_[axis], fromLo_[axis]);
        }
        return ~bits(times.lo > times.hi * Floats(1 + 0x1p-18f));
    }

    // The hull of the point and of a ball around the lamp is a cone of the angle whose sine is
    // lampRadius / distance. A ball is `height` over its axis and `along` it. How far from the
    // cone's sides is the centre, outwards, and the same across the axis?
    struct BallSeen {
        Floats along, height, distance2, out;
    };
    BallSeen look(const Occluder& ball) const {
        const Three d = Three::all(ball.centre.x, ball.centre.y, ball.centre.z) - p_;
        const Floats along = dot(d, unit_);
        const Three across = d - unit_ * along;
        const Floats height = sqrt(dot(across, across));
        return {along, height, dot(d, d), height * cosine_ - along * sine_};
    }

    // Is the ball off the cone?
    unsigned passBy(const Occluder& ball, const BallSeen& seen, Floats slack) const {
        const Floats room = (Floats(ball.radius) + slack) + lift_;
        const Mask isBehind = seen.along * cosine_ + seen.height * sine_ < Floats(0.0f);
        return bits(seen.out > room) | bits(isBehind & (seen.distance2 > room * room));
    }

    // Does all of the cone go through the ball in front of the lamp? The line that is farthest from
    // the centre is on the other side of the axis.
    unsigned areBehind(const Occluder& ball, const BallSeen& seen, Floats slack) const {
        const Floats around = slack + lift_, core(ball.core);
        const Floats outside = Floats(ball.radius) + around; // rays have to come in
        const Floats farthest = seen.height * cosine_ + seen.along * sine_;
        const Mask isAhead = seen.along * cosine_ > seen.height * sine_;
        const Mask isNearer = seen.along + seen.height + around < distance_ - Floats(lampRadius_);
        return bits((farthest + around < core) & isAhead & isNearer &
                    (seen.distance2 > outside * outside));
    }

    Floats room(Floats slack) const { return slack + lift_; }

    unsigned areBeside(const Occluder::Sides& plane, Floats slack) const {
        float lampLo = plane.offset, lampHi = plane.offset;
        Floats lo(plane.offset), hi(plane.offset);
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const float n = plane.n[axis];
            const bool up = n > 0;
            lampLo += n * (up ? lamp_.lo : lamp_.hi)[axis];
            lampHi += n * (up ? lamp_.hi : lamp_.lo)[axis];
            lo = lo + Floats(n) * (up ? lo_ : hi_)[axis];
            hi = hi + Floats(n) * (up ? hi_ : lo_)[axis];
        }
        const Floats below = Floats(0.0f) - slack;
        return bits((Floats(lampLo) > slack) & (lo > slack)) |
               bits((Floats(lampHi) < below) & (hi < below));
    }

private:
    Bounds lamp_;
    float lampRadius_;
    Three p_, unit_;
    Floats distance_, sine_, cosine_, lift_; // of the cone
    Floats lo_[3], hi_[3];
    SlopeInLanes fromLo_[3], fromHi_[3]; // of the sides, on the way to the lamp
};

// What is known of single lines from W points of a block to places on the lamp.
class LinesToLamp {
public:
    LinesToLamp(const LitBlock& block, const Occluders& occluders, const HiddenPoints& hidden,
                std::size_t first)
        : block_(block), occluders_(occluders), hidden_(hidden), first_(first) {}

    // Lines that something hides, and others of which only a ray can tell.
    struct Answer {
        unsigned hidden = 0, unsure = 0;
    };
    Answer ask(const Three& toLight, Floats distance, unsigned lanes) const {
        Answer answer;
        if (!hidden_.areShapesKnown) return {0, lanes};
        const Three p = Three::load(block_.p, first_);
        const Floats room = Floats::load(hidden_.room + first_);
        for (std::size_t i = 0; i < occluders_.all().size(); ++i) {
            const unsigned asked = hidden_.byShape[i] >> first_ & lanes & ~answer.hidden;
            if (asked == 0) continue;
            const Occluder& caster = occluders_.all()[i];
            const Answer by = caster.radius < kInfinityF
                                  ? askBall(caster, p, room, toLight, distance)
                                  : askBox(caster, p, room, toLight, distance);
            answer.hidden |= asked & by.hidden, answer.unsure |= asked & by.unsure;
        }
        answer.unsure &= ~answer.hidden;
        return answer;
    }

private:
    static Answer askBall(const Occluder& ball, const Three& p, Floats room, const Three& toLight,
                          Floats distance) {
        const Three d = Three::all(ball.centre.x, ball.centre.y, ball.centre.z) - p;
        const Floats along = dot(d, toLight), zero(0.0f);
        const Three across = d - toLight * along;
        const Floats height2 = dot(across, across);
        const Floats outer = Floats(ball.radius) + room, inner = Floats(ball.core) - room;
        const Mask isOff =
            (height2 > outer * outer) | (along + outer < zero) | (along - outer > distance);
        // From outside of the ball through its core, the middle of which is in front of the lamp.
        const Mask goesIn = (inner > zero) & (height2 < inner * inner) & (along > zero) &
                            (along + room < distance) & (dot(d, d) > outer * outer);
        return {bits(goesIn), ~bits(isOff)};
    }

    static Answer askBox(const Occluder& caster, const Three& p, Floats room, const Three& toLight,
                         Floats distance) {
        const Bounds& box = caster.box;
        if (!box.isFinite()) return {0, ~0u};
        const Vec3 centre = (box.lo + box.hi) * 0.5f, half = (box.hi - box.lo) * 0.5f;
        const Three h = toLight * (distance * Floats(0.5f));
        const Three d = p - Three::all(centre.x, centre.y, centre.z), m = d + h;
        const auto sizeWith = [&](Floats more) {
            return Three{Floats(half.x) + more, Floats(half.y) + more, Floats(half.z) + more};
        };
        const Three outer = sizeWith(room);
        const unsigned met = ~bits(areApart(m, h, outer));
        if (!caster.fillsBox || met == 0) return {0, met};
        // From one side of its faces to the other: between an end outside of the box and a place in
        // one that is smaller by more than what the ray may lack of the line.
        const Floats zero(0.0f);
        const Three inner = sizeWith(Floats(-2.0f) * room), end = m + h;
        const auto isOutside = [&](const Three& at) {
            return (abs(at.x) > outer.x) | (abs(at.y) > outer.y) | (abs(at.z) > outer.z);
        };
        const Mask leaves = isOutside(d) | isOutside(end);
        const Mask isThick = (inner.x > zero) & (inner.y > zero) & (inner.z > zero);
        return {met & bits(leaves & isThick) & ~bits(areApart(m, h, inner)), met};
    }

    // Is a line of the halves +-h about m off a box of the halves e about the origin? By the axes
    // that may separate them: three of the box, and three across both.
    static Mask areApart(const Three& m, const Three& h, const Three& e) {
        const Three size{abs(h.x), abs(h.y), abs(h.z)};
        const auto across = [&](Floats mA, Floats mB, Floats hA, Floats hB, Floats eA, Floats eB,
                                Floats sizeA, Floats sizeB) {
            return abs(mA * hB - mB * hA) > eA * sizeB + eB * sizeA;
        };
        return (abs(m.x) > e.x + size.x) | (abs(m.y) > e.y + size.y) | (abs(m.z) > e.z + size.z) |
               across(m.x, m.y, h.x, h.y, e.x, e.y, size.x, size.y) |
               across(m.y, m.z, h.y, h.z, e.y, e.z, size.y, size.z) |
               across(m.z, m.x, h.z, h.x, e.z, e.x, size.z, size.x);
    }

    const LitBlock& block_;
    const Occluders& occluders_;
    const HiddenPoints& hidden_;
    std::size_t first_;
};

inline HiddenPoints hiddenPoints(const Occluders& occluders, const LitBlock& block,
                                 const LampBall& lamp) {
    static_assert(HiddenPoints::kMostShapes >= Occluders::kMost);
    HiddenPoints hidden;
    hidden.areShapesKnown = true;
    hidden.byShape.fill(0);
    for (std::size_t first = 0; first < LitBlock::kPoints; first += W) {
        const unsigned all = block.used >> first & ((1u << W) - 1);
        if (all == 0) continue;
        const PointsToLamp points(block, first, lamp);
        const Floats slack = Floats(Occluders::kSlack) * points.extent(occluders.extent());
        points.room(slack).store(hidden.room + first);
        const Ints shapes = Ints::load(block.shape + first);
        for (std::size_t i = 0; i < occluders.all().size(); ++i) {
            const Occluder& caster = occluders.all()[i];
            const unsigned inside = block.inside >> first;
            const unsigned others = ~bits(shapes == Ints(caster.shape)) |
                                    (inside & (caster.hidesInside ? ~0u : 0)) |
                                    (~inside & (caster.hidesOutside ? ~0u : 0));
            unsigned met = all & ~(hidden.surely >> first) & others;
            if (met != 0 && caster.plane) met &= ~points.areBeside(*caster.plane, slack);
            if (met != 0 && caster.radius < kInfinityF) {
                const auto seen = points.look(caster);
                met &= ~points.passBy(caster, seen, slack);
                hidden.surely |= (met & points.areBehind(caster, seen, slack)) << first;
            }
            if (met != 0) met &= points.meet(caster.box, slack);
            hidden.byShape[i] |= static_cast<std::uint16_t>(met << first);
            hidden.maybe |= met << first;
            if ((hidden.surely >> first) == all) break;
        }
    }
    hidden.maybe |= hidden.surely;
    return hidden;
}

LANES_END
