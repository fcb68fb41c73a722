// RectangleEmitter: a rectangle that shines to one side. Near it all directions in which it is seen
// are equally likely (Urena, Fajardo and King 2013), far away all places on it are.
#pragma once

#include "light/kinds/flat.h"

struct RectangleRow : FlatRow {};

LANES_BEGIN

// A rectangle from a point: z is against the normal of its bright side, h the height of the point
// above its plane; x and y are along its sides. The longest of them is about 1, so that products of
// six are in the range of floats.
struct RectangleSeen {
    Floats x0, x1, y0, y1, h;

    // The solid angle, of two triangles (Van Oosterom and Strackee 1983): no numbers of different
    // sign are added where it is small, so that it has its digits at every distance.
    Floats solidAngle() const {
        const Floats h2 = h * h;
        const auto length = [&](Floats x, Floats y) { return sqrt(x * x + y * y + h2); };
        const Floats r00 = length(x0, y0), r10 = length(x1, y0), r11 = length(x1, y1),
                     r01 = length(x0, y1);
        const Floats n = h * (x1 - x0) * (y1 - y0);
        const auto below = [&](Floats a, Floats b, Floats c, Floats ab, Floats bc, Floats ca) {
            return a * b * c + ab * c + bc * a + ca * b;
        };
        const Floats diagonal = x0 * x1 + y0 * y1 + h2; // of corners 00 and 11
        const Floats first =
            below(r00, r10, r11, x0 * x1 + y0 * y0 + h2, x1 * x1 + y0 * y1 + h2, diagonal);
        const Floats second =
            below(r00, r11, r01, diagonal, x0 * x1 + y1 * y1 + h2, x0 * x0 + y0 * y1 + h2);
        // Twice the sum of the angles of (first, n) and (second, n).
        return Floats(2.0f) * angleInHalfTurn(n * (first + second), first * second - n * n);
    }

    struct Place {
        Floats x, y;
    };
    // The place whose x divides the solid angle as u does, and whose y divides that of the line at
    // x as v does.
    Place place(Floats solidAngle, Floats u, Floats v) const {
        const Floats zero(0.0f), h2 = h * h;
        const auto over = [&](Floats a) { return a / sqrt(a * a + h2); };
        const auto rest = [&](Floats a) { return h2 / (a * a + h2); }; // 1 - over^2
        // Cosines of the planes through the point and the sides, and of the angles between them.
        const Floats b0 = zero - over(y0), b1 = over(y1), left = zero - over(x0);
        const Floats c2 = zero - b1 * left, c3 = zero - left * b0;
        const Floats left2 = rest(x0);
        const Floats s2 = sqrt(rest(y1) + b1 * b1 * left2), s3 = sqrt(rest(y0) + b0 * b0 * left2);
        // k = 2 pi - (angle 2 + angle 3); au = u S + k
        const Floats cosK = c2 * c3 - s2 * s3, sinK = zero - (s2 * c3 + c2 * s3);
        const SineCosine turn =
            sinCosOfTurns(u * solidAngle * Floats(static_cast<float>(kInvTwoPi)));
        const Floats cosAu = turn.cos * cosK - turn.sin * sinK;
        const Floats sinAu = turn.sin * cosK + turn.cos * sinK;
        const Floats fu = (cosAu * b0 - b1) / sinAu;
        // cu = sign(fu) / sqrt(fu^2 + b0^2), and x = cu h / sqrt(1 - cu^2); 1 - b0^2 is rest(y0)
        const Floats x = withSign(h / sqrt(max(fu * fu - rest(y0), zero)), fu);
        const Floats inside = min(max(x, x0), x1);
        return {inside, placeOnLine(inside, y0, y1, v)};
    }
    // The place on the line from (x, from) to (x, to) that divides its solid angle as v does.
    Floats placeOnLine(Floats x, Floats from, Floats to, Floats v) const {
        const Floats zero(0.0f), one(1.0f), d2 = x * x + h * h, d = sqrt(d2);
        const Floats h0 = from / sqrt(d2 + from * from), h1 = to / sqrt(d2 + to * to);
        const Floats at = h0 + v * (h1 - h0), rest = max(one - at * at, zero);
        return min(max(at * d / sqrt(rest), from), to);
    }
};

// Half axes from which on a point is far: places and directions are equally good then (the variance
// of a sample is 0.01 of its square at most), and places cost less.
inline constexpr float kFarHalfAxes2 = 16.0f * 16.0f;
// Solid angles below these are not divided by angles: errors of some 2^-50 (triangles, in doubles)
// and 2^-22 (rectangles) of a right angle would show.
inline constexpr double kLeastSolidAngle = 1e-7;
inline constexpr float kLeastRectangle = 0.001f;

// The rectangle about a flat lamp, seen from a point.
struct FlatSeen {
    Floats3 x, y, normal; // unit vectors
    RectangleSeen from;
    Floats scale; // of its lengths
    Floats solidAngle;
    Mask byAngle; // directions are sampled, not places

    FlatSeen(const FlatNumbers& lamp, Floats lengthX, Floats lengthY, const Floats3& p)
        : x(lamp.halfX / lengthX), y(lamp.halfY / lengthY), normal(lamp.normal), from{},
          scale(0.0f), solidAngle(0.0f), byAngle(noLanes()) {
        const Floats zero(0.0f);
        const Floats height = lamp.heightOver(p);
        const Floats3 d = lamp.centre - p;
        const Floats distance2 = dot(d, d);
        // Sides that are not perpendicular have places only.
        const Mask isNear =
            (distance2 < Floats(kFarHalfAxes2) * (lamp.x2 + lamp.y2)) & (height > zero) &
            (abs(dot(lamp.halfX, lamp.halfY)) <= Floats(1e-5f) * lengthX * lengthY) &
            (lamp.x2 > zero) & (lamp.y2 > zero);
        if (bits(isNear) == 0) return;
        scale = sqrt(distance2) + (lengthX + lengthY);
        const Floats atX = dot(d, x), atY = dot(d, y);
        from = {(atX - lengthX) / scale, (atX + lengthX) / scale, (atY - lengthY) / scale,
                (atY + lengthY) / scale, height / scale};
        solidAngle = from.solidAngle();
        byAngle = isNear & (solidAngle > Floats(kLeastRectangle));
    }
    // From the point to a place of the rectangle, in its lengths.
    Floats3 wayTo(Floats atX, Floats atY) const { return x * atX + y * atY - normal * from.h; }
};

class RectangleEmitter : FlatNumbers {
public:
    using Row = RectangleRow;
    static constexpr const char* kName = "rectangle";
    explicit RectangleEmitter(const LightNumbers& n)
        : FlatNumbers(n), lengthX_(sqrt(x2)), lengthY_(sqrt(y2)) {}

    SampledLight sample(const Floats3& p, Floats u, Floats v) const {
        const FlatSeen seen(*this, lengthX_, lengthY_, p);
        const unsigned byAngle = bits(seen.byAngle);
        const Floats two(2.0f), one(1.0f);
        const auto far = [&] {
            return from(p, centre_() + halfX * (two * u - one) + halfY * (two * v - one), area(),
                        noLanes());
        };
        if (byAngle == 0) return far();
        const auto at = seen.from.place(seen.solidAngle, u, v);
        const Floats3 d = seen.wayTo(at.x, at.y);
        const Floats distance = sqrt(dot(d, d));
        const SampledLight near =
            where(seen.byAngle, d / distance, distance * seen.scale,
                  radiance * (spreadAt(seen.from.h / distance) * seen.solidAngle),
                  one / seen.solidAngle, noLanes());
        return byAngle == kAllLanes ? near : select(seen.byAngle, near, far());
    }
    SampledLight centre(const Floats3& p) const {
        return from(p, centre_(), area(), maskOf(kAllLanes));
    }
    Floats pdf(const Floats3& p, const Floats3& toLight) const {
        const Place at = placeOn(p, toLight);
        const Mask isMet = isOn(at);
        if (bits(isMet) == 0) return 0.0f;
        const FlatSeen seen(*this, lengthX_, lengthY_, p);
        const Floats distance = at.distance.toFloats();
        const Floats ofPlaces = distance * distance / (area() * at.cosAtLight);
        const Floats pdf = select(seen.byAngle, Floats(1.0f) / seen.solidAngle, ofPlaces);
        return select(isMet & (pdf < Floats(kInfinityF)), pdf, Floats(0.0f));
    }
    LightMeeting meet(const Floats3& org, const Floats3& dir) const {
        const Place at = placeOn(org, dir);
        return meetingWhere(isOn(at), at.distance.toFloats(), radiance * spreadAt(at.cosAtLight));
    }

private:
    static Mask isOn(const Place& at) {
        const Doubles one(1.0);
        return at.isAhead & maskOf(atMost(abs(at.x), one) & atMost(abs(at.y), one));
    }
    Floats area() const { return Floats(4.0f) * lengthX_ * lengthY_; }
    const Floats3& centre_() const { return FlatNumbers::centre; }

    Floats lengthX_, lengthY_;
};

LANES_END
