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
        const FlatSeen seen(*this, lengthX_, lengthY_, p);
        const unsigned near = bits(seen.byAngle);
        const auto far = [&] {
            return from(p, FlatNumbers::centre + halfX * disk.x + halfY * disk.y, area(),
                        noLanes());
        };
        if (near == 0) return far();
        const Floats one(1.0f), half(0.5f), zero(0.0f);
        const Floats chord = sqrt(max((one - disk.x) * (one + disk.x), zero));
        const Floats onChord = min(max(half + half * (disk.y / chord), zero), one);
        const Floats x = seen.from.place(seen.solidAngle, half + half * disk.x, half).x;
        const Slice slice = sliceAt(seen, x);
        const Floats3 d = seen.wayTo(x, seen.from.placeOnLine(x, slice.y0, slice.y1, onChord));
        const Floats distance = sqrt(dot(d, d));
        const Floats pdf = density(seen, x, slice);
        const SampledLight sliced =
            where(seen.byAngle & (pdf > zero), d / distance, distance * seen.scale,
                  radiance * (spreadAt(seen.from.h / distance) / pdf), pdf, noLanes());
        return near == kAllLanes ? sliced : select(seen.byAngle, sliced, far());
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
        const FlatSeen seen(*this, lengthX_, lengthY_, p);
        if (bits(seen.byAngle & isMet) != 0) {
            const Floats placeX =
                seen.from.x0 + lengthX_ / seen.scale * (Floats(1.0f) + at.x.toFloats());
            const Floats x = min(max(placeX, seen.from.x0), seen.from.x1);
            pdf = select(seen.byAngle, density(seen, x, sliceAt(seen, x)), pdf);
        }
        return select(isMet & (pdf < Floats(kInfinityF)), pdf, Floats(0.0f));
    }
    LightMeeting meet(const Floats3& org, const Floats3& dir) const {
        const Place at = placeOn(org, dir);
        return meetingWhere(isOn(at), at.distance.toFloats(), radiance * spreadAt(at.cosAtLight));
    }

private:
    struct Slice {
        Floats y0, y1; // where it begins and ends in the ellipse
        Floats part;   // of the slice of the rectangle, by angle
    };
    static Slice sliceAt(const FlatSeen& seen, Floats place) {
        const Floats zero(0.0f), one(1.0f), half(0.5f);
        const RectangleSeen& of = seen.from;
        const Floats lengthX = half * (of.x1 - of.x0), lengthY = half * (of.y1 - of.y0);
        const Floats s = (place - half * (of.x0 + of.x1)) / lengthX;
        const Floats halfChord = lengthY * sqrt(max((one - s) * (one + s), zero));
        const Floats d2 = place * place + of.h * of.h, middleY = half * (of.y0 + of.y1);
        const auto sine = [&](Floats at) { return at / sqrt(d2 + at * at); };
        const Floats y0 = middleY - halfChord, y1 = middleY + halfChord;
        return {y0, y1, (sine(y1) - sine(y0)) / (sine(of.y1) - sine(of.y0))};
    }
    // Slices have a density of 4 / pi times half the chord of the unit disk at t, where (1 + t) / 2
    // is the part of the rectangle's solid angle before x.
    static Floats density(const FlatSeen& seen, Floats x, const Slice& slice) {
        const Floats zero(0.0f), one(1.0f), two(2.0f);
        RectangleSeen before = seen.from;
        before.x1 = x;
        const Floats part = before.solidAngle() / seen.solidAngle;
        const Floats chord = two * sqrt(max(part * (one - part), zero));
        return max(chord * Floats(static_cast<float>(4 / kPi)) / (slice.part * seen.solidAngle),
                   zero); // at the rim it may round below
    }
    static Mask isOn(const Place& at) {
        return at.isAhead & maskOf(atMost(at.x * at.x + at.y * at.y, Doubles(1.0)));
    }
    Floats area() const { return Floats(static_cast<float>(kPi)) * lengthX_ * lengthY_; }

    Floats lengthX_, lengthY_;
};

LANES_END
