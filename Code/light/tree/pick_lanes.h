// The choice of a light for W points at once: see LightPicker. At each group one child is chosen in
// proportion to what it may give to the point at most and at least, the mean of both parts, as
// Cycles does: the most alone is no good guide near large groups. One choice of ten is made by
// intensity alone, so that bounds which deceive never leave a light to luck. The numbers are doubles
// where probabilities are multiplied: the light that is chosen, and its probability, are those of the
// same interval of [0,1).
#pragma once

#include "light/light_lanes.h"
#include "light/tree/light_nodes.h"

#include <cstddef>
#include <cstdint>

LANES_BEGIN

struct PickedLight {
    Ints light;
    Floats probability; // 0 if there is none
    Doubles u;          // what is left of the random number, in [0,1)
};

// The 32 bits of a random number as one in [0,1): with 24 a light that is chosen once in a million
// times would be off by 6 %.
inline Doubles unitDoubles(Ints bits) {
    const Doubles zero(0.0), whole = doublesOf(bits);
    return (whole + select(whole < zero, Doubles(0x1p32), zero)) * Doubles(0x1p-32);
}

class LightChoice {
public:
    explicit LightChoice(const LightTreeView& tree) : tree_(tree) {}

    // For points p with unit normals n that see light on the side of n; n is 0 where both sides do.
    PickedLight pick(const Floats3& p, const Floats3& n, const Doubles& u) const {
        const Doubles zero(0.0);
        if (tree_.lit < 2) return {Ints(tree_.only), tree_.lit == 1 ? 1.0f : 0.0f, u};
        const Mask byPower = u < Doubles(kByPower);
        Way way = start();
        Doubles lo = select(byPower, zero, Doubles(kByPower));
        Doubles width = select(byPower, Doubles(kByPower), Doubles(1 - kByPower));
        Ints light(0);
        for (Mask walking = maskOf(kAllLanes); bits(walking) != 0;) {
            const Step step = stepAt(way.pair, p, n);
            const Doubles first =
                width * select(byPower, Doubles(step.byPower), Doubles(step.byLight));
            const Mask isFirst = u < lo + first;
            const Doubles nextLo = select(isFirst, lo, lo + first);
            const Doubles nextWidth = select(isFirst, first, width - first);
            lo = select(walking, nextLo, lo), width = select(walking, nextWidth, width);
            walking = follow(way, step, isFirst, walking, light);
        }
        // Rounding keeps nothing below 0 or at 1.
        const Doubles rest = max((u - lo) / width, zero);
        return {light, way.probability(), min(rest, Doubles(1 - 0x1p-53))};
    }

    // With which pick() gives these lights; 0 of dark ones.
    Floats probability(const Floats3& p, const Floats3& n, Ints light) const {
        const Floats one(1.0f), zero(0.0f);
        if (tree_.lit < 2)
            return tree_.lit == 1 ? select(light == Ints(tree_.only), one, zero) : zero;
        const Ints trail = elementsAt(tree_.trails, light, kAllLanes);
        Way way = start();
        Ints found(0), bit(1);
        for (Mask walking = maskOf(kAllLanes); bits(walking) != 0; bit = bit + bit) {
            const Step step = stepAt(way.pair, p, n);
            walking = follow(way, step, (trail & bit) == Ints(0), walking, found);
        }
        // A dark light has no trail: that of another one ends elsewhere.
        return select(found == light, way.probability(), zero);
    }

private:
    static constexpr double kByPower = 0.1;

    // Where a lane is, and how likely it came there in either way to choose.
    struct Way {
        Ints pair;
        Doubles byLight, byPower;
        Floats probability() const {
            return (byLight * Doubles(1 - kByPower) + byPower * Doubles(kByPower)).toFloats();
        }
    };
    static Way start() { return {Ints(0), Doubles(1.0), Doubles(1.0)}; }

    // The probabilities of the first child of a pair.
    struct Step {
        Ints child[2];
        Floats byLight, byPower;
    };

    // Goes on to the chosen child; returns which lanes still walk, the others are at `light`.
    static Mask follow(Way& way, const Step& step, Mask isFirst, Mask walking, Ints& light) {
        const auto times = [&](Doubles& part, Floats first) {
            const Doubles here(first), other = Doubles(1.0) - here;
            part = select(walking, part * select(isFirst, here, other), part);
        };
        times(way.byLight, step.byLight), times(way.byPower, step.byPower);
        const Ints child = select(isFirst, step.child[0], step.child[1]);
        light = select(walking, masked(child, ~kLightLeaf), light);
        walking = walking & (child < Ints(kLightLeaf));
        way.pair = select(walking, child, way.pair);
        return walking;
    }

    // What a node may give to a point at most, and at least; an irradiance.
    struct Range {
        Floats most, least, power;
        Ints child;
    };

    Step stepAt(Ints pair, const Floats3& p, const Floats3& n) const {
        alignas(64) std::uint32_t at[W];
        pair.store(at);
        const Range a = rangeOf(at, 0, p, n), b = rangeOf(at, 1, p, n);
        const Floats zero(0.0f), half(0.5f), one(1.0f);
        const Floats most = a.most + b.most, least = a.least + b.least;
        const Floats byPower = a.power / (a.power + b.power);
        const Floats byMost = a.most / most;
        const Floats known = select(a.most > zero, one, zero), other = select(b.most > zero, zero, one);
        const Floats byLeast = select(least > zero, a.least / least, half * (known + other));
        return {{a.child, b.child},
                select(most > zero, half * (byMost + byLeast), byPower),
                byPower};
    }

    // cos(max(a - b, 0)), of angles from 0 to pi.
    static Floats cosOfRest(Floats cosA, Floats sinA, Floats cosB, Floats sinB) {
        return select(cosA >= cosB, Floats(1.0f), cosA * cosB + sinA * sinB);
    }
    static Floats sineOf(Floats cosine) {
        return sqrt(max(Floats(1.0f) - cosine * cosine, Floats(0.0f)));
    }
    // Bits as a number from 0 to 2^16.
    static Floats numberOf(Ints bits) {
        return fromBits(plus(bits, 0x4b000000u)) - Floats(0x1p23f);
    }
    static Floats lowerCosine(Ints bits) {
        return numberOf(masked(bits, 0xffff)) * Floats(1 / LightNode::kCosineSteps) -
               Floats(1.0f);
    }
    static Floats upperCosine(Ints bits) { return lowerCosine(shiftedRight<16>(bits)); }

    Range rangeOf(const std::uint32_t* pairs, int side, const Floats3& p, const Floats3& n) const {
        const float* row[W];
        const float* more[W];
        for (int i = 0; i < W; ++i) {
            const LightNode& node = tree_.pairs[2 * std::size_t{pairs[i]} +
                                                static_cast<std::size_t>(side)];
            row[i] = node.centre, more[i] = node.centre + 4;
        }
        Floats numbers[4], words[4];
        loadRows(row, numbers), loadRows(more, words);
        const Ints radiusAndX = bitsOf(words[0]), yAndZ = bitsOf(words[1]),
                   spreadAndReach = bitsOf(words[2]), child = bitsOf(words[3]);
        const Floats zero(0.0f), one(1.0f), intensity = numbers[3];
        const Floats radius = fromBits(masked(radiusAndX, 0xffff0000u));
        const Floats3 axis{lowerCosine(radiusAndX), upperCosine(yAndZ), lowerCosine(yAndZ)};
        const Floats cosO = upperCosine(spreadAndReach), sinO = sineOf(cosO);
        const Floats cosE = numberOf(masked(shiftedRight<2>(spreadAndReach), 0x3fff)) *
                                Floats(1 / LightNode::kReachSteps) -
                            one;
        const Mask isTwoSided = masked(spreadAndReach, LightNode::kTwoSided) == Ints(LightNode::kTwoSided);
        const Mask isDistant = masked(spreadAndReach, LightNode::kDistant) == Ints(LightNode::kDistant);

        // The ball around the group fills directions up to the angle u around the way to its middle;
        // from within all.
        const Floats3 d = Floats3{numbers[0], numbers[1], numbers[2]} - p;
        const Floats far2 = max(dot(d, d), Floats(1e-37f)), far = sqrt(far2);
        const Floats radius2 = radius * radius;
        const Mask isOutside = far2 > radius2;
        const Floats3 way = select(isDistant, axis, d / far);
        const Floats cosBall = select(isOutside, sqrt(max(one - radius2 / far2, zero)), Floats(-1.0f));
        const Floats cosU = select(isDistant, cosO, cosBall);
        const Floats sinU = select(isDistant, sinO, select(isOutside, radius / far, zero));

        // The angle i to the surface's normal, u less or more.
        const Floats cosI = dot(way, n), sinI = sineOf(cosI);
        const Mask hasNormal = dot(n, n) > zero;
        const Floats facing =
            select(hasNormal, max(cosOfRest(cosI, sinI, cosU, sinU), zero), one);
        const Floats facingLeast = select(
            hasNormal, select(cosU >= zero, max(cosI * cosU - sinI * sinU, zero), zero), one);

        // The angle t to the axis of the group's normals, less u and the spread o, or more.
        const Floats along = zero - dot(axis, way), cosT = select(isTwoSided, abs(along), along);
        const Floats sinT = sineOf(cosT);
        const Floats cosTu = cosOfRest(cosT, sinT, cosU, sinU);
        const Floats shown = cosOfRest(cosTu, sineOf(cosTu), cosO, sinO);
        const Floats most = select(isDistant, one, select(shown > cosE, max(shown, zero), zero));
        const Floats moreT = cosT * cosU - sinT * sinU; // t + u is at most a half turn where used
        const Floats lessShown = moreT * cosO - sineOf(moreT) * sinO;
        const Mask isSure = (cosU >= zero) & (cosT >= zero) & (moreT >= zero) & (cosO >= zero) &
                            (lessShown > max(cosE, zero));
        const Floats least = select(isDistant, one, select(isSure, lessShown, zero));

        const Floats nearest2 = select(isDistant, one, max(far2, radius2)), end = far + radius;
        const Floats farthest2 = select(isDistant, one, end * end);
        const Floats limit(1e30f);
        return {min(intensity * facing * most / nearest2, limit),
                min(intensity * facingLeast * least / farthest2, limit),
                select(isDistant, intensity * numbers[0], intensity), child};
    }

    LightTreeView tree_;
};

LANES_END
