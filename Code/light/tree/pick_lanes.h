// The choice of a light for W points at once: see LightPicker. At each group one child is chosen in
// proportion to what it may give to the point at most and at least, the mean of both parts, after
// Cycles: where a bright light that may shine does not, a dim one that surely does is not left to
// luck. Where nothing is sure (near large groups) the most alone decides: with even parts, as
// Cycles has them there, 20,000 lights in a heap had three times the variance. One choice of ten is
// made by intensity alone, and one of twenty by chance at each group: a dim light may be all there
// is where bright ones could shine, but are behind a wall. The numbers are doubles where
// probabilities are multiplied: the light that is chosen, and its probability, are those of the
// same interval of [0,1).
#pragma once

#include "light/light_lanes.h"
#include "light/tree/light_tree.h"

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
        // [0, kByChance), [kByChance, kNotByLight), and the rest.
        const Mask byChance = u < Doubles(kByChance), notByLight = u < Doubles(kNotByLight);
        const auto one = [&](double chance, double power, double light) {
            return select(byChance, Doubles(chance),
                          select(notByLight, Doubles(power), Doubles(light)));
        };
        Way way = start();
        Doubles lo = one(0, kByChance, kNotByLight);
        Doubles width = one(kByChance, kNotByLight - kByChance, 1 - kNotByLight);
        Ints light(0);
        for (Mask walking = maskOf(kAllLanes); bits(walking) != 0;) {
            const Step step = stepAt(way.pair, p, n);
            const Floats part = select(notByLight, step.byPower, step.byLight);
            const Doubles first = width * select(byChance, Doubles(0.5), Doubles(part));
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
    static constexpr double kByChance = 0.05, kNotByLight = 0.15;

    // Where a lane is, and how likely it came there in each way to choose.
    struct Way {
        Ints pair;
        Doubles byLight, byPower, byChance;
        Floats probability() const { return ((byLight + byPower) + byChance).toFloats(); }
    };
    static Way start() {
        return {Ints(0), Doubles(1 - kNotByLight), Doubles(kNotByLight - kByChance),
                Doubles(kByChance)};
    }

    // The probabilities of the first child of a pair.
    struct Step {
        Ints child[2];
        Floats byLight, byPower;
    };

    // Goes on to the chosen child; returns which lanes still walk, the others are at `light`.
    static Mask follow(Way& way, const Step& step, Mask isFirst, Mask walking, Ints& light) {
        const auto times = [&](Doubles& part, const Doubles& first) {
            part = select(walking, part * select(isFirst, first, Doubles(1.0) - first), part);
        };
        times(way.byLight, Doubles(step.byLight)), times(way.byPower, Doubles(step.byPower));
        times(way.byChance, Doubles(0.5));
        const Ints child = select(isFirst, step.child[0], step.child[1]);
        light = select(walking, masked(child, ~kLightLeaf), light);
        walking = walking & (child < Ints(kLightLeaf));
        way.pair = select(walking, child, way.pair);
        return walking;
    }

    // What a node may give to a point, an irradiance; and what it counts where power alone decides.
    struct Weight {
        Floats most, least, power;
        Ints child;
    };

    Step stepAt(Ints pair, const Floats3& p, const Floats3& n) const {
        alignas(64) std::uint32_t at[W];
        pair.store(at);
        const Weight a = weightOf(at, 0, p, n), b = weightOf(at, 1, p, n);
        const Floats byPower = partOf(a.power, b.power);
        const Floats zero(0.0f), half(0.5f), byMost = partOf(a.most, b.most);
        const Floats byBoth = half * (byMost + partOf(a.least, b.least));
        const Floats byLight = select(a.least + b.least > zero, byBoth, byMost);
        return {{a.child, b.child}, select(a.most + b.most > zero, byLight, byPower), byPower};
    }
    // Rounding takes nothing away from a second part that is far smaller.
    static Floats partOf(Floats a, Floats b) {
        const Floats part = a / (a + b);
        return select(b > Floats(0.0f), min(part, Floats(kOneMinusUlp)), part);
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
        return numberOf(masked(bits, 0xffff)) * Floats(1 / LightNode::kCosineSteps) - Floats(1.0f);
    }
    static Floats upperCosine(Ints bits) { return lowerCosine(shiftedRight<16>(bits)); }

    Weight weightOf(const std::uint32_t* pairs, int side, const Floats3& p,
                    const Floats3& n) const {
        const float* row[W];
        const float* more[W];
        for (int i = 0; i < W; ++i) {
            const LightNode& node =
                tree_.pairs[2 * std::size_t{pairs[i]} + static_cast<std::size_t>(side)];
            row[i] = reinterpret_cast<const float*>(&node), more[i] = row[i] + 4;
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
        const auto has = [&](std::uint32_t flag) {
            return masked(spreadAndReach, flag) == Ints(flag);
        };
        const Mask isTwoSided = has(LightNode::kTwoSided), isDistant = has(LightNode::kDistant);

        // The ball around the group fills directions up to the angle u around the way to its
        // middle; from within all.
        const Floats3 d = Floats3{numbers[0], numbers[1], numbers[2]} - p;
        const Floats far2 = max(dot(d, d), Floats(1e-37f)), far = sqrt(far2);
        const Floats radius2 = radius * radius;
        const Mask isOutside = far2 > radius2;
        const Floats3 way = select(isDistant, axis, d / far);
        const Floats cosBall =
            select(isOutside, sqrt(max(one - radius2 / far2, zero)), Floats(-1.0f));
        const Floats cosU = select(isDistant, cosO, cosBall);
        const Floats sinU = select(isDistant, sinO, select(isOutside, radius / far, zero));

        // The angle i to the surface's normal, less u and more: sums of angles are at most a half
        // turn where u is at most a quarter.
        const Mask hasNormal = dot(n, n) > zero, isNarrow = cosU >= zero;
        const Floats cosI = dot(way, n), sinI = sineOf(cosI);
        const Floats facing = select(hasNormal, max(cosOfRest(cosI, sinI, cosU, sinU), zero), one);
        const Floats facingLeast = select(hasNormal, max(cosI * cosU - sinI * sinU, zero), one);

        // The angle t to the axis of the group's normals, less u and the spread o, and more.
        const Floats along = zero - dot(axis, way), cosT = select(isTwoSided, abs(along), along);
        const Floats sinT = sineOf(cosT), cosTu = cosOfRest(cosT, sinT, cosU, sinU);
        const Floats cosTuo = cosOfRest(cosTu, sineOf(cosTu), cosO, sinO);
        const Floats shown = select(cosTuo > cosE, max(cosTuo, zero), zero);
        const Floats moreTu = cosT * cosU - sinT * sinU;
        const Floats moreTuo = moreTu * cosO - sineOf(moreTu) * sinO;
        const Mask isSure = (cosT >= zero) & (moreTu >= zero) & (cosO >= zero) & (moreTuo > cosE);
        const Floats shownLeast = select(isSure, max(moreTuo, zero), zero);

        // The lights of a group lie about half its radius away from a point within it: with all of
        // the radius, groups of many lights had up to four times the variance.
        const Floats nearest2 = max(far2, Floats(0.25f) * radius2), farthest = far + radius;
        const Floats most = select(isDistant, one, shown / nearest2);
        const Floats least = select(isDistant, one, shownLeast / (farthest * farthest));
        const Floats limit(1e30f);
        return {min(intensity * facing * most, limit),
                select(isNarrow, min(intensity * facingLeast * least, limit), zero),
                select(isDistant, intensity * numbers[0], intensity), child};
    }

    LightTreeView tree_;
};

LANES_END
