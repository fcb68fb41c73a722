// RectangleEmitter: a rectangle that shines to one side. Near it all directions in which it is seen
// are equally likely (Urena, Fajardo and King 2013), far away all places on it are.
#pragma once

#include "light/kinds/flat.h"
#include "simd/angle_lanes.h"
#include "simd/sine_lanes.h"

struct RectangleRow : FlatRow {};

LANES_BEGIN

// A rectangle from a point: z is against the normal of its bright side, h the height of the point
// above its plane; x and y are along its sides.
struct RectangleSeen {
    Doubles x0, x1, y0, y1, h;

    // The solid angle, of two triangles (Van Oosterom and Strackee 1983): no numbers of different
    // sign are added where it is small, so that it has its digits at every distance.
    Doubles solidAngle() const {
        const Doubles h2 = h * h;
        const auto length = [&](const Doubles& x, const Doubles& y) {
            return sqrt(x * x + y * y + h2);
        };
        const Doubles r00 = length(x0, y0), r10 = length(x1, y0), r11 = length(x1, y1),
                      r01 = length(x0, y1);
        const Doubles n = h * (x1 - x0) * (y1 - y0);
        const auto below = [&](const Doubles& a, const Doubles& b, const Doubles& c,
                               const Doubles& ab, const Doubles& bc,
                               const Doubles& ca) { return a * b * c + ab * c + bc * a + ca * b; };
        const Doubles diagonal = x0 * x1 + y0 * y1 + h2; // of corners 00 and 11
        const Doubles first =
            below(r00, r10, r11, x0 * x1 + y0 * y0 + h2, x1 * x1 + y0 * y1 + h2, diagonal);
        const Doubles second =
            below(r00, r11, r01, diagonal, x0 * x1 + y1 * y1 + h2, x0 * x0 + y0 * y1 + h2);
        // Twice the sum of the angles of (first, n) and (second, n). The corners are 1 apart in
        // size at most by 2^100, so that the products are in the range of double.
        return Doubles(2.0) * anglesOf(n * (first + second), first * second - n * n);
    }

    struct Place {
        Doubles x, y;
    };
    // The place whose x divides the solid angle as u does, and whose y divides that of the line at
    // x as v does.
    Place place(const Doubles& solidAngle, const Doubles& u, const Doubles& v) const {
        const Doubles zero(0.0), h2 = h * h;
        const auto over = [&](const Doubles& a) { return a / sqrt(a * a + h2); };
        const auto rest = [&](const Doubles& a) { return h2 / (a * a + h2); }; // 1 - over^2
        // Cosines of the planes through the point and the sides, and of the angles between them.
        const Doubles b0 = zero - over(y0), b1 = over(y1), left = zero - over(x0);
        const Doubles c2 = zero - b1 * left, c3 = zero - left * b0;
        const Doubles left2 = rest(x0);
        const Doubles s2 = sqrt(rest(y1) + b1 * b1 * left2), s3 = sqrt(rest(y0) + b0 * b0 * left2);
        // k = 2 pi - (angle 2 + angle 3); au = u S + k
        const Doubles cosK = c2 * c3 - s2 * s3, sinK = zero - (s2 * c3 + c2 * s3);
        const SinesCosines turn = sinesCosinesOf(u * solidAngle);
        const Doubles cosAu = turn.cos * cosK - turn.sin * sinK;
        const Doubles sinAu = turn.sin * cosK + turn.cos * sinK;
        const Doubles fu = (cosAu * b0 - b1) / sinAu;
        // cu = sign(fu) / sqrt(fu^2 + b0^2), and x = cu h / sqrt(1 - cu^2); 1 - b0^2 is rest(y0)
        const Doubles x = withSign(h / sqrt(max(fu * fu - rest(y0), zero)), fu);
        const Doubles inside = min(max(x, x0), x1);
        return {inside, placeOnLine(inside, y0, y1, v)};
    }
    // The place on the line from (x, from) to (x, to) that divides its solid angle as v does.
    Doubles placeOnLine(const Doubles& x, const Doubles& from, const Doubles& to,
                        const Doubles& v) const {
        const Doubles zero(0.0), one(1.0), d2 = x * x + h * h, d = sqrt(d2);
        const Doubles h0 = from / sqrt(d2 + from * from), h1 = to / sqrt(d2 + to * to);
        const Doubles at = h0 + v * (h1 - h0), rest = max(one - at * at, zero);
        return min(max(at * d / sqrt(rest), from), to);
    }
};

// Half axes from which on a point is far: places and directions are equally good then (the variance
// of a sample is 2e-3 of its square at most), and places cost less.
inline constexpr double kFarHalfAxes2 = 32.0 * 32.0;
// Solid angles of rectangles, triangles and the like below it are not divided by angles, whose
// errors of some 2^-50 would show.
inline constexpr double kLeastSolidAngle = 1e-7;

class RectangleEmitter : FlatNumbers {
public:
    using Row = RectangleRow;
    static constexpr const char* kName = "rectangle";
    explicit RectangleEmitter(const LightNumbers& n)
        : FlatNumbers(n), lengthX_(sqrt(x2)), lengthY_(sqrt(y2)) {}

    SampledLight sample(const Floats3& p, Floats u, Floats v) const {
        const Seen seen = seenFrom(p);
        const unsigned byAngle = bits(seen.byAngle);
        const Floats two(2.0f), one(1.0f);
        if (byAngle == 0)
            return from(p, centre_() + halfX * (two * u - one) + halfY * (two * v - one), area(),
                        noLanes());
        const auto at = seen.from.place(seen.solidAngle, Doubles(u), Doubles(v));
        const Doubles3 d = seen.x * at.x + seen.y * at.y - seen.normal * seen.from.h;
        const Doubles distance = sqrt(dot(d, d));
        const Floats solidAngle = seen.solidAngle.toFloats();
        const Floats cosAtLight = (seen.from.h / distance).toFloats();
        const SampledLight near =
            where(seen.byAngle, Floats3::of(d / distance), distance.toFloats(),
                  radiance * (spreadAt(cosAtLight) * solidAngle), one / solidAngle, noLanes());
        if (byAngle == kAllLanes) return near;
        return select(seen.byAngle, near,
                      from(p, centre_() + halfX * (two * u - one) + halfY * (two * v - one), area(),
                           noLanes()));
    }
    SampledLight centre(const Floats3& p) const {
        return from(p, centre_(), area(), maskOf(kAllLanes));
    }
    Floats pdf(const Floats3& p, const Floats3& toLight) const {
        const Place at = placeOn(p, toLight);
        const Mask isMet = isOn(at);
        if (bits(isMet) == 0) return 0.0f;
        const Seen seen = seenFrom(p);
        const Floats distance = at.distance.toFloats();
        const Floats ofPlaces = distance * distance / (area() * at.cosAtLight);
        const Floats pdf =
            select(seen.byAngle, Floats(1.0f) / seen.solidAngle.toFloats(), ofPlaces);
        return select(isMet & (pdf < Floats(kInfinityF)), pdf, Floats(0.0f));
    }
    LightMeeting meet(const Floats3& org, const Floats3& dir) const {
        const Place at = placeOn(org, dir);
        return meetingWhere(isOn(at), at.distance.toFloats(), radiance * spreadAt(at.cosAtLight));
    }

private:
    struct Seen {
        Doubles3 x, y, normal; // unit vectors
        RectangleSeen from;
        Doubles solidAngle;
        Mask byAngle; // all directions are equally likely
    };
    Seen seenFrom(const Floats3& p) const {
        const Doubles zero(0.0);
        const Doubles3 d = differenceOf(centre_(), p), n = doublesOf(normal);
        const Doubles lengthX(lengthX_), lengthY(lengthY_);
        const Doubles3 x = doublesOf(halfX) / lengthX, y = doublesOf(halfY) / lengthY;
        const Doubles atX = dot(d, x), atY = dot(d, y), h = zero - dot(d, n);
        const RectangleSeen from{atX - lengthX, atX + lengthX, atY - lengthY, atY + lengthY, h};
        const Doubles size2 = Doubles(x2) + Doubles(y2);
        // Sides that are not perpendicular have places only.
        const Floats skew = abs(dot(halfX, halfY));
        const Mask isNear = (dot(d, d) < Doubles(kFarHalfAxes2) * size2) & (zero < h) &
                            (skew <= Floats(1e-5f) * lengthX_ * lengthY_) & (x2 > Floats(0.0f)) &
                            (y2 > Floats(0.0f));
        if (bits(isNear) == 0) return {x, y, n, from, zero, isNear};
        const Doubles solidAngle = from.solidAngle();
        return {x, y, n, from, solidAngle, isNear & (Doubles(kLeastSolidAngle) < solidAngle)};
    }
    static Mask isOn(const Place& at) {
        const Doubles one(1.0);
        return at.isAhead & maskOf(atMost(abs(at.x), one) & atMost(abs(at.y), one));
    }
    Floats area() const { return Floats(4.0f) * lengthX_ * lengthY_; }
    const Floats3& centre_() const { return FlatNumbers::centre; }

    Floats lengthX_, lengthY_;
};

LANES_END
