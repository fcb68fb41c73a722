// MovingTransform: a map that changes while the shutter is open, given by keys.
// Knows nothing about shapes; a shape's box comes in, the box over the whole shutter goes out.
#pragma once

#include "base/one_or_more.h"
#include "base/transform.h"

#include <array>
#include <optional>
#include <span>
#include <utility>
#include <vector>

// A unit quaternion w + xi + yj + zk.
struct Quaternion {
    double w = 1, x = 0, y = 0, z = 0;
    bool operator==(const Quaternion&) const = default;
};

// A movement without turns, for who maps many points back: of the inverse map only the offset
// changes, and at() has these bits.
class Drift {
public:
    // At each key: the inverse's offset, and what the body moves by up to the next one.
    struct Leg {
        Vec3d offset, step;
    };
    Drift(const AffineRows& inverse, std::vector<Leg> legs)
        : inverse_(inverse), legs_(std::move(legs)) {}
    Vec3d offsetAt(double time) const;
    std::span<const Leg> legs() const { return legs_; }

private:
    AffineRows inverse_;
    std::vector<Leg> legs_;
};

class MovingTransform {
public:
    MovingTransform() = default; // the identity, at rest
    MovingTransform(const Transform& atRest) : keys_(1, atRest) {}
    // One or more keys, equally spaced over the shutter [0,1]. Between two keys M = T R S moves by
    // its parts (Shoemake and Duff 1992): the translation T and the symmetric stretch S linearly,
    // the rotation R along the shortest arc at constant speed. If one of two neighbours mirrors
    // and the other does not, the map must pass through flat, and S does it. Next to a singular
    // key the whole matrix moves linearly.
    explicit MovingTransform(std::span<const Transform> keys);

    // Keys are met to the last bit at their times; outside [0,1] the ends hold, NaN is 0.
    Transform at(double time) const;
    bool isStatic() const { return segments_.empty(); }
    // The common movement, which asks for no new inverse: between two keys that differ by a
    // translation, at() is the first one, moved by `offset`.
    struct Shift {
        std::size_t key = 0;
        Vec3d offset;
    };
    std::optional<Shift> shiftAt(double time) const;
    // Where nothing else happens between any two keys.
    std::optional<Drift> drift() const;
    // These are what at() computes with between two keys; kernels map by many times at once.
    using Matrix = std::array<double, 9>; // row-major
    struct Parts {
        Vec3d translation;
        Quaternion rotation;
        Matrix stretch; // symmetric; negative definite if the map mirrors
    };
    struct Segment {
        Parts from, to;
        double arcRad = 0;       // angle between the quaternions: half the turn of the body
        bool translates = false; // the linear parts are equal to the last bit
    };
    std::span<const Segment> segments() const { return segments_; }
    std::span<const Transform> keys() const { return {keys_.data(), keys_.size()}; }
    // A world box around the mapped box over the whole shutter: not the smallest, but no point at
    // any time is outside.
    BoundsD bounds(const BoundsD& objectBox) const;

private:
    static Parts decompose(const Transform& map, bool linearOnly);
    static Matrix linearPart(const Parts& parts);
    static Quaternion rotationAt(const Segment& segment, double s);
    static Matrix stretchAt(const Segment& segment, double s);
    static BoundsD sweptBounds(const Segment& segment, const BoundsD& box);

    OneOrMore<Transform> keys_ = OneOrMore<Transform>(1);
    std::vector<Segment> segments_; // one less than keys; empty when all keys are equal
};
