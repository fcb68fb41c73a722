// TriangleEmitter: a triangle of a mesh that shines, to its front or to both sides. Near it all
// directions in which it is seen are equally likely (after Arvo 1995), far away all places on it.
#pragma once

#include "light/kinds/rectangle.h"
#include "light/light_lanes.h"
#include "simd/double_double_lanes.h"
#include "simd/sine_lanes.h"

struct TriangleRow {
    Vec3 a, b, c; // its front is where they go round counter-clockwise
    Rgb radiance;
    float isTwoSided = 0; // 1: the back shines as the front does
};

LANES_BEGIN

class TriangleEmitter {
public:
    using Row = TriangleRow;
    static constexpr const char* kName = "triangle";
    explicit TriangleEmitter(const LightNumbers& n)
        : a_(n.vector(0)), edgeB_(differenceOf(n.vector(3), a_)),
          edgeC_(differenceOf(n.vector(6), a_)), across_(cross(edgeB_, edgeC_)),
          radiance_(n.vector(9)), isTwoSided_(n[12] > Floats(0.0f)) {}

    SampledLight sample(const Floats3& p, Floats u, Floats v) const {
        const Seen seen = seenFrom(p);
        const unsigned byAngle = bits(seen.byAngle);
        if (byAngle == 0) return fromPlace(seen, u, v);
        const Floats solidAngle = seen.solidAngle.toFloats();
        const Doubles3 way = direction(seen, Doubles(u), Doubles(v));
        const Doubles distance = dot(seen.a, across_) / dot(way, across_);
        const SampledLight near =
            where(seen.byAngle, Floats3::of(way), distance.toFloats(), radiance_ * solidAngle,
                  Floats(1.0f) / solidAngle, noLanes());
        return byAngle == kAllLanes ? near : select(seen.byAngle, near, fromPlace(seen, u, v));
    }
    SampledLight centre(const Floats3& p) const {
        const Doubles third(1.0 / 3);
        SampledLight at = from(seenFrom(p), third, third);
        at.pdf = 0.0f, at.single = maskOf(kAllLanes);
        return at;
    }
    // Not 0 a little beside the triangle, up to an angle of 2^-21: a ray that some test of
    // triangles lets meet it has a density.
    Floats pdf(const Floats3& p, const Floats3& toLight) const {
        const Seen seen = seenFrom(p);
        const Doubles3 way = doublesOf(toLight);
        const Mask isMet = seen.shines & seen.isOn(way, 0x1p-21);
        const Doubles along = dot(way, across_), height = dot(seen.a, across_);
        const Doubles distance = height / along, area2 = sqrt(dot(across_, across_));
        // distance^2 / (area cos)
        const Doubles ofPlaces = distance * distance * Doubles(2.0) / abs(along);
        const Floats pdf =
            select(seen.byAngle, Doubles(1.0) / seen.solidAngle, ofPlaces).toFloats();
        const Mask isSound = (Doubles(0.0) < area2) & (Doubles(0.0) < distance);
        return select(isMet & isSound & (pdf < Floats(kInfinityF)), pdf, Floats(0.0f));
    }
    LightMeeting meet(const Floats3& org, const Floats3& dir) const {
        const Seen seen = seenFrom(org);
        const Doubles3 way = doublesOf(dir);
        const Doubles distance = dot(seen.a, across_) / dot(way, across_);
        return meetingWhere(seen.shines & seen.isOn(way, 0) & (Doubles(0.0) < distance),
                            distance.toFloats(), radiance_);
    }

private:
    struct Seen {
        Doubles3 a, b, c; // from the point to the corners
        Doubles side;     // 1 or -1: the corners go round one way or the other
        Mask shines;      // the point is where light goes
        Doubles solidAngle;
        Mask byAngle;
        // Edge functions; beside one, by an angle of `slack` at most.
        Mask isOn(const Doubles3& way, double slack) const {
            const auto inside = [&](const Doubles3& from, const Doubles3& to) {
                const Doubles3 n = cross(from, to);
                const Doubles room = Doubles(slack) * sqrt(dot(n, n));
                return atMost(Doubles(0.0), dot(way, n) * side + room);
            };
            return maskOf(inside(a, b) & inside(b, c) & inside(c, a));
        }
    };
    Seen seenFrom(const Floats3& p) const {
        const Doubles zero(0.0), one(1.0), third(1.0 / 3);
        const Doubles3 a = differenceOf(a_, p), b = a + edgeB_, c = a + edgeC_;
        // The volume of the corners has the sign of the distance behind the front.
        const Doubles volume = dot(a, across_);
        const Mask isFront = volume < zero;
        const Doubles side = select(isFront, Doubles(-1.0), one);
        const Doubles shown = select(isFront, one, select(isTwoSided_, volume, zero));
        const Mask shines = zero < shown;
        const Doubles3 middle = a + (edgeB_ + edgeC_) * third;
        const Doubles size2 = max(dot(edgeB_, edgeB_), dot(edgeC_, edgeC_));
        const Mask isNear = shines & (dot(middle, middle) < Doubles(double{kFarHalfAxes2}) * size2);
        Seen seen{a, b, c, side, shines, zero, isNear};
        if (bits(isNear) == 0) return seen;
        // Van Oosterom and Strackee 1983.
        const Doubles la = sqrt(dot(a, a)), lb = sqrt(dot(b, b)), lc = sqrt(dot(c, c));
        const Doubles below = la * lb * lc + dot(a, b) * lc + dot(b, c) * la + dot(c, a) * lb;
        seen.solidAngle = Doubles(2.0) * anglesOf(abs(volume), below);
        seen.byAngle = isNear & (Doubles(kLeastSolidAngle) < seen.solidAngle);
        return seen;
    }

    // The corners of the spherical triangle are A, B, C. u divides it by an arc from B to C', which
    // is on the arc from A to C; v divides the arc. Of a triangle with the angle alpha between
    // sides of c and b', half the area E is found by tan(b'/2) tan(c/2) = sin(E/2) / sin(alpha -
    // E/2). Vectors along the edges keep the digits of small triangles.
    Doubles3 direction(const Seen& seen, const Doubles& u, const Doubles& v) const {
        const Doubles one(1.0), two(2.0), half(0.5);
        const auto unit = [](const Doubles3& a) { return a / sqrt(dot(a, a)); };
        const auto across = [](const Doubles3& a, const Doubles3& axis) {
            return a - axis * dot(a, axis);
        };
        const Doubles la = sqrt(dot(seen.a, seen.a)), lb = sqrt(dot(seen.b, seen.b));
        const Doubles3 A = seen.a / la, B = seen.b / lb;
        const Doubles3 toB = unit(across(edgeB_, A)), toC = unit(across(edgeC_, A));
        const Doubles cosAlpha = dot(toB, toC), sinAlpha = abs(dot(A, cross(toB, toC)));
        const Doubles3 ab = cross(seen.a, edgeB_);
        const Doubles tanHalfC = sqrt(dot(ab, ab)) / (la * lb + dot(seen.a, seen.b));
        const SinesCosines e = sinesCosinesOf(u * seen.solidAngle * half);
        const Doubles t = e.sin / (tanHalfC * (sinAlpha * e.cos - cosAlpha * e.sin));
        const Doubles t2 = t * t, over = one / (one + t2);
        const Doubles3 C = A * ((one - t2) * over) + toC * (two * t * over);
        const Doubles3 chord = C - B;
        const Doubles h = v * half * dot(chord, chord); // 1 - cos of the angle from B
        const Doubles3 toEnd = across(chord, B);
        const Doubles far = sqrt(dot(toEnd, toEnd));
        const Doubles sine = sqrt(max(h * (two - h), Doubles(0.0)));
        // Nothing is left of an arc whose ends are one point.
        const Doubles step = select(Doubles(0.0) < far, sine / far, Doubles(0.0));
        return unit(B * (one - h) + toEnd * step);
    }

    SampledLight fromPlace(const Seen& seen, Floats u, Floats v) const {
        const Floats root = sqrt(u);
        return from(seen, Doubles(root) * (Doubles(1.0) - Doubles(v)), Doubles(root * v));
    }
    // The light from the place a + b edgeB + c edgeC.
    SampledLight from(const Seen& seen, const Doubles& b, const Doubles& c) const {
        const Doubles3 d = seen.a + edgeB_ * b + edgeC_ * c;
        const Doubles distance2 = dot(d, d), distance = sqrt(distance2);
        // area times cos: half the projection of the cross product of the edges
        const Doubles shown = abs(dot(d, across_)) / distance * Doubles(0.5);
        return where(seen.shines, Floats3::of(d / distance), distance.toFloats(),
                     radiance_ * (shown / distance2).toFloats(), (distance2 / shown).toFloats(),
                     noLanes());
    }

    Floats3 a_;
    Doubles3 edgeB_, edgeC_, across_;
    Floats3 radiance_;
    Mask isTwoSided_;
};

LANES_END
