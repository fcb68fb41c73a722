// Filters in float, with bounds of their errors: which of W lines may meet a solid, or which of W
// solids one line may meet, and which do for certain. Whatever is the same for all lanes is in all
// of them.
#pragma once

#include "base/math.h"
#include "simd/lanes.h"

LANES_BEGIN

enum class Answer { Closest, Any };

struct Lines {
    Floats org[3], dir[3], length, perLength, perLength2; // of the directions
    Floats slack, tMin, best;                             // best: the end of their ranges
};
struct BallLanes {
    Floats centre[3], radius, innerRadius;
};
struct TubeLanes {
    Floats axis[3], halfLength;
};
struct Nearness {
    unsigned may, certain; // lanes
    Floats nearest;        // t before which there is no hit
    Floats farthest;       // of certain ones: t by which they are hit
    unsigned behind;       // lanes that entered a round tube before their range, for certain
};

// Lines that come near enough to a solid's round hull: a ball, or a tube without ends. With u the
// unit of rounding and s the largest coordinate, the way to the centre is off by 4 u s, the foot of
// the perpendicular by some 16 u s more, and `slack` is 64 u s.
// certain: rays that enter a ball within a sphere, and so the sphere, inside of their range.
template <Answer A>
[[gnu::always_inline]] inline Nearness nearBall(const Lines& l, const BallLanes& ball) {
    const Floats x = ball.centre[0] - l.org[0], y = ball.centre[1] - l.org[1],
                 z = ball.centre[2] - l.org[2];
    const Floats foot = fma(x, l.dir[0], fma(y, l.dir[1], z * l.dir[2])) * l.perLength2;
    const Floats px = fnma(foot, l.dir[0], x), py = fnma(foot, l.dir[1], y),
                 pz = fnma(foot, l.dir[2], z);
    const Floats distance2 = fma(px, px, fma(py, py, pz * pz));
    const Floats reach = ball.radius + l.slack, zero(0.0f);
    Nearness out;
    out.may = bits(notGreater(distance2, reach * reach));
    const Floats inner = max(ball.innerRadius - l.slack, zero);
    if constexpr (A == Answer::Any) {
        out.certain = bits((distance2 < inner * inner) & (foot - reach * l.perLength > l.tMin) &
                           (foot + l.slack * l.perLength < l.best));
    } else {
        // The slack is more than what half a chord can be off by, too: from where the root is of
        // a number by 64 u s times the radius too large, or too small.
        const Floats early = l.slack * l.perLength;
        const auto half = [&](Floats r) {
            return sqrt(max(fma(r, r, zero - distance2), zero)) * l.perLength;
        };
        out.nearest = (foot - half(reach)) - early;
        out.farthest = (foot - half(inner)) + early;
        out.certain = bits((distance2 < inner * inner) & (out.nearest > l.tMin));
    }
    return out;
}

// n = d x axis: the distance of the lines is |w n| / |n|, and w n is off by 41 u s |d|. The ray is
// in the endless tube from `middle` - `half` to `middle` + `half`. n is off by 7 u |d|, with FMA or
// without, so n n, for rays at 1/16 to the axis at least, by 227 u of it, and both by
// 16.5 slack |d| / n n together. Rays along the axis are asked whatever its ends are. Squares are
// off by 4 u of them, and SolidTree keeps radii 16 u too large, or too small, of which squares
// make 32. certain: rays that meet the side of a round tube at 30 degrees to its axis at least and
// not flat, which keeps these errors below 20 times the slack, by 64 within their range and the
// tube's length. behind: rays that enter a round tube before their range, so that only its inside
// is left to them. WithBalls: where the axis is zero, it is a ball, which is met as a tube across
// the line is: with an n as long as d, and without ends. Its inner ball tells only that it is
// entered. WithCores: and so does the inner tube (RoundHull::coreRadius), certain are rays that
// come into it from outside of the outer one, between its ends all the way.
enum class HullMix { Tubes, WithBalls, WithCores };
template <Answer A, HullMix Mix = HullMix::Tubes>
[[gnu::always_inline]] inline Nearness nearTube(const Lines& l, const BallLanes& ball,
                                                const TubeLanes& tube, unsigned lanes) {
    const Floats x = ball.centre[0] - l.org[0], y = ball.centre[1] - l.org[1],
                 z = ball.centre[2] - l.org[2];
    const Floats ax = tube.axis[0], ay = tube.axis[1], az = tube.axis[2];
    const Floats nx = fms(l.dir[1], az, l.dir[2] * ay), ny = fms(l.dir[2], ax, l.dir[0] * az),
                 nz = fms(l.dir[0], ay, l.dir[1] * ax);
    const Floats across = fma(x, nx, fma(y, ny, z * nz));
    unsigned balls = 0;
    Floats across2 = across * across, n2 = fma(nx, nx, fma(ny, ny, nz * nz));
    if constexpr (Mix != HullMix::Tubes) {
        const Floats px = fms(y, l.dir[2], z * l.dir[1]), py = fms(z, l.dir[0], x * l.dir[2]),
                     pz = fms(x, l.dir[1], y * l.dir[0]);
        const Mask isBall = maxAbs(maxAbs(ax, ay), az) == Floats(0.0f);
        balls = bits(isBall);
        across2 = select(isBall, fma(px, px, fma(py, py, pz * pz)), across2);
        n2 = select(isBall, l.length * l.length, n2);
    }
    const Floats n = sqrt(n2), slack = l.slack * l.length;
    const Floats reach = fma(ball.radius, n, slack);
    Nearness out{};
    out.may = lanes & bits(notGreater(across2, reach * reach));
    if (out.may == 0) return out;

    const Floats zero(0.0f), perN2 = Floats(1.0f) / n2;
    const Floats da = fma(l.dir[0], ax, fma(l.dir[1], ay, l.dir[2] * az));
    const Floats xa = fma(x, ax, fma(y, ay, z * az));
    const Floats xd = fma(x, l.dir[0], fma(y, l.dir[1], z * l.dir[2]));
    const Floats middle = fnma(xa, da, xd) * perN2, height = fms(middle, da, xa);
    const auto halfIn = [&](Floats r) { return sqrt(max(fms(r, r, across2), zero)); };
    const Floats half = fma(Floats(24.0f), slack, halfIn(reach)) * perN2;
    const Floats up = abs(da);
    const Mask isAlong = n < Floats(0.0625f) * l.length;
    out.nearest = select(isAlong, Floats(-kInfinityF), middle - half);
    out.may &= bits(isAlong) |
               (bits(notGreater(fnma(half, up, abs(height)), tube.halfLength + l.slack)) &
                bits(notGreater(l.tMin, middle + half)) & bits(notGreater(out.nearest, l.best)));
    const Floats inner = ball.innerRadius * n, margin = Floats(64.0f) * l.slack;
    const Floats inside = halfIn(inner) * perN2, early = margin * l.perLength;
    const Floats tallest = tube.halfLength * Floats(1 - 0x1p-18f) - margin;
    const auto meets = [&](Floats t) {
        return bits((t - early > l.tMin) & (t + early < l.best) & (abs(fms(t, da, xa)) < tallest));
    };
    const Floats within = max(Floats(0.9f) * inner - slack, zero), in = middle - inside;
    const unsigned isSure = bits((across2 < within * within) & (n > Floats(0.5f) * l.length));
    if constexpr (Mix == HullMix::WithCores) {
        static_assert(A == Answer::Any);
        out.certain = isSure & meets(in) & meets(middle - half);
        return out;
    }
    const unsigned enters = meets(in) & (~balls | bits(out.nearest > l.tMin));
    if constexpr (A == Answer::Any) {
        out.certain = isSure & (enters | (meets(middle + inside) & ~balls));
    } else {
        out.certain = isSure & enters;
        out.farthest = in + early;
        out.behind = isSure & ~balls & bits(out.farthest < l.tMin);
    }
    return out;
}

LANES_END
