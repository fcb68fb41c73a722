// DiskEmitter: an ellipse that shines to one side. Near it slices across its x axis are taken about
// as the solid angles that they fill, and within a slice all directions are equally likely; far
// away all places on it are. Solid angles of ellipses themselves have no closed form.
#pragma once

#include "light/kinds/flat.h"
#include "light/kinds/rectangle.h"

struct DiskRow : FlatRow {};

LANES_BEGIN

class DiskEmitter : FlatNumbers {
public:
    using Row = DiskRow;
    static constexpr const char* kName = "disk";
    explicit DiskEmitter(const LightNumbers& n)
        : FlatNumbers(n), lengthX_(sqrt(x2)), lengthY_(sqrt(y2)) {}

    // A uniform place on the unit disk is a slice x, of a density as its chord's length, and a
    // uniform place on its chord. Slices become those of the rectangle around the ellipse, by solid
    // angle: far away the mean of the samples has no variance, near it less than 0.1.
    SampledLight sample(const Floats3& p, Floats u, Floats v) const {
        const Floats2 disk = diskFromSquare(u, v);
        const Seen seen = seenFrom(p);
        const unsigned near = bits(seen.byAngle);
        const auto far = [&] {
            return from(p, FlatNumbers::centre + halfX * disk.x + halfY * disk.y, area(),
                        noLanes());
        };
        if (near == 0) return far();
        const Doubles one(1.0), half(0.5), zero(0.0), t(disk.x);
        const Doubles chord = sqrt((one - t) * (one + t));
        const Doubles onChord = min(max(half + half * (Doubles(disk.y) / chord), zero), one);
        const Doubles x = seen.from.place(seen.solidAngle, half + half * t, half).x;
        const Slice slice = seen.sliceAt(x);
        const Doubles y = seen.from.placeOnLine(x, slice.y0, slice.y1, onChord);
        const Doubles3 d = seen.x * x + seen.y * y - seen.normal * seen.from.h;
        const Doubles distance = sqrt(dot(d, d));
        const Doubles pdf = seen.density(slice, chord);
        const Floats cosAtLight = (seen.from.h / distance).toFloats();
        const SampledLight sliced = where(
            seen.byAngle & (zero < pdf), Floats3::of(d / distance), distance.toFloats(),
            radiance * (spreadAt(cosAtLight) * (one / pdf).toFloats()), pdf.toFloats(), noLanes());
        if (near == kAllLanes) return sliced;
        return select(seen.byAngle, sliced, far());
    }
    SampledLight centre(const Floats3& p) const {
        return from(p, FlatNumbers::centre, area(), maskOf(kAllLanes));
    }
    Floats pdf(const Floats3& p, const Floats3& toLight) const {
        const Place at = placeOn(p, toLight);
        const Mask isMet = isOn(at);
        if (bits(isMet) == 0) return 0.0f;
        const Floats distance = at.distance.toFloats();
        Floats pdf = distance * distance / (area() * at.cosAtLight);
        const Seen seen = seenFrom(p);
        if (bits(seen.byAngle & isMet) != 0) {
            const Doubles zero(0.0), one(1.0), two(2.0);
            RectangleSeen left = seen.from;
            left.x1 = min(max(left.x0 + Doubles(lengthX_) * (one + at.x), left.x0), left.x1);
            const Doubles part = left.solidAngle() / seen.solidAngle; // (1 + t) / 2
            const Doubles chord = two * sqrt(max(part * (one - part), zero));
            const Doubles ofSlices = seen.density(seen.sliceAt(left.x1), chord);
            pdf = select(seen.byAngle, ofSlices.toFloats(), pdf);
        }
        return select(isMet & (pdf < Floats(kInfinityF)), pdf, Floats(0.0f));
    }
    LightMeeting meet(const Floats3& org, const Floats3& dir) const {
        const Place at = placeOn(org, dir);
        return meetingWhere(isOn(at), at.distance.toFloats(), radiance * spreadAt(at.cosAtLight));
    }

private:
    struct Slice {
        Doubles y0, y1; // where it begins and ends in the ellipse
        Doubles part;   // of the slice of the rectangle, by angle
    };
    struct Seen {
        Doubles3 x, y, normal; // unit vectors
        RectangleSeen from;    // the rectangle around the ellipse
        Doubles middleX, middleY, lengthX, lengthY;
        Doubles solidAngle; // of the rectangle
        Mask byAngle;       // slices, not places

        Slice sliceAt(const Doubles& place) const {
            const Doubles zero(0.0), one(1.0), s = (place - middleX) / lengthX;
            const Doubles half = lengthY * sqrt(max((one - s) * (one + s), zero));
            const Doubles d2 = place * place + from.h * from.h;
            const auto sine = [&](const Doubles& at) { return at / sqrt(d2 + at * at); };
            const Doubles y0 = middleY - half, y1 = middleY + half;
            return {y0, y1, (sine(y1) - sine(y0)) / (sine(from.y1) - sine(from.y0))};
        }
        // Slices have a density of 4 / pi times the chord's half length.
        Doubles density(const Slice& slice, const Doubles& chord) const {
            return chord * Doubles(4 / kPi) / (slice.part * solidAngle);
        }
    };
    Seen seenFrom(const Floats3& p) const {
        const Doubles zero(0.0);
        const Doubles3 d = differenceOf(FlatNumbers::centre, p), n = doublesOf(normal);
        const Doubles lengthX(lengthX_), lengthY(lengthY_);
        const Doubles3 x = doublesOf(halfX) / lengthX, y = doublesOf(halfY) / lengthY;
        const Doubles atX = dot(d, x), atY = dot(d, y), h = zero - dot(d, n);
        const RectangleSeen around{atX - lengthX, atX + lengthX, atY - lengthY, atY + lengthY, h};
        const Doubles size2 = Doubles(x2) + Doubles(y2);
        const Floats skew = abs(dot(halfX, halfY));
        const Mask isNear = (dot(d, d) < Doubles(kFarHalfAxes2) * size2) & (zero < h) &
                            (skew <= Floats(1e-5f) * lengthX_ * lengthY_) & (x2 > Floats(0.0f)) &
                            (y2 > Floats(0.0f));
        Seen seen{x, y, n, around, atX, atY, lengthX, lengthY, zero, isNear};
        if (bits(isNear) == 0) return seen;
        seen.solidAngle = around.solidAngle();
        seen.byAngle = isNear & (Doubles(kLeastSolidAngle) < seen.solidAngle);
        return seen;
    }
    static Mask isOn(const Place& at) {
        return at.isAhead & maskOf(atMost(at.x * at.x + at.y * at.y, Doubles(1.0)));
    }
    Floats area() const { return Floats(static_cast<float>(kPi)) * lengthX_ * lengthY_; }

    Floats lengthX_, lengthY_;
};

LANES_END
