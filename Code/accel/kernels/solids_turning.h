// The maps of a solid that turns or grows, at the times of all rays of a packet: what
// MovingTransform::at() and Transform::fromRows() compute, operation by operation. Lanes for which
// these choose another way than between two keys ask them. Without it, one ray at a time, pictures of
// such shapes take 27 % (ASCII/moving_shapes.txt) and 12 % (motion_blur.txt) longer.
#pragma once

#include "simd/sine_lanes.h"
#include "accel/kernels/solids.h"
#include "accel/kernels/solids_hulls.h"
#include "accel/kernels/solids_objects.h"
#include "base/ray.h"
#include "simd/lanes.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>

LANES_BEGIN

class TurningMaps {
public:
    TurningMaps(const SolidTree::Movement& movement, const RaySpan& rays,
                const std::uint32_t (&ray)[W])
        : movement_(movement), segments_(movement.motion.turning->segments()) {
        const auto count = static_cast<double>(segments_.size());
        for (std::size_t i = 0; i < W; ++i) {
            time_[i] = static_cast<double>(rays.time[ray[i]]);
            const double place = clamp(time_[i], 0.0, 1.0) * count; // momentOf()
            const auto segment = static_cast<std::size_t>(place);
            s_[i] = place - static_cast<double>(segment);
            // At the end there is none.
            segment_[i] = &segments_[std::min(segment, segments_.size() - 1)];
            others_ |= unsigned{s_[i] == 0 || segment_[i]->translates} << i;
        }
    }

    // Returns which of the lanes come near it within their ranges: only those are made.
    unsigned make(const Lines& lines, unsigned lanes) {
        static_assert(sizeof(MovingTransform::Parts) == kParts * sizeof(double) &&
                      offsetof(MovingTransform::Segment, to) == kParts * sizeof(double) &&
                      offsetof(MovingTransform::Segment, arcRad) == 2 * kParts * sizeof(double));
        if (segments_.size() == 1)
            return make(SameSegment{&segment_[0]->from.translation.x}, lines, lanes);
        alignas(64) double columns[2 * kParts + 1][W];
        const double* row[W];
        for (std::size_t i = 0; i < W; ++i) {
            row[i] = &segment_[i]->from.translation.x;
            columns[2 * kParts][i] = segment_[i]->arcRad;
        }
        for (std::size_t column = 0; column < 2 * kParts; column += 4) {
            storeRows(row, columns + column);
            for (const double*& from : row) from += 4;
        }
        return make(SegmentLanes{columns}, lines, lanes);
    }
    MapLanes objectFromWorld() const { return {inverse_}; }

private:
    using Matrix = std::array<Doubles, 9>; // row-major
    // The numbers of MovingTransform::Parts in their order.
    static constexpr std::size_t kRotation = 3, kStretch = 7, kParts = 16;
    struct SameSegment {
        const double* numbers;
        Doubles operator()(std::size_t i) const { return Doubles(numbers[i]); }
    };
    struct SegmentLanes {
        const double (*columns)[W];
        Doubles operator()(std::size_t i) const { return Doubles::load(columns[i]); }
    };

    template <class Segment>
    unsigned make(const Segment& segment, const Lines& lines, unsigned lanes) {
        const Doubles s = Doubles::load(s_), rest = Doubles(1.0) - s;
        const auto between = [&](std::size_t i) {
            return segment(i) * rest + segment(kParts + i) * s;
        };
        const Doubles place[3] = {between(0), between(1), between(2)};
        lanes &= comingNear(place, lines) | others_;
        if (lanes == 0) return 0;
        const Matrix turn = rotation(segment, s, rest);
        const Matrix stretch = {
            between(kStretch),     between(kStretch + 1), between(kStretch + 2),
            between(kStretch + 3), between(kStretch + 4), between(kStretch + 5),
            between(kStretch + 6), between(kStretch + 7), between(kStretch + 8)};
        const unsigned asked = (invert(product(turn, stretch), place) | others_) & lanes;
        for (unsigned left = asked; left != 0; left &= left - 1) {
            const int i = std::countr_zero(left);
            const Transform map = movement_.motion.turning->at(time_[i]);
            for (std::size_t k = 0; k < 12; ++k) inverse_[k][i] = map.inverseRows()[k];
        }
        return lanes;
    }

    // The ball that it is in at the ray's time, with the slack of nearBall(). NaN comes near.
    unsigned comingNear(const Doubles (&place)[3], const Lines& lines) const {
        const auto wide = [](Floats x) { return Doubles(x); };
        const Doubles dx = wide(lines.dir[0]), dy = wide(lines.dir[1]), dz = wide(lines.dir[2]);
        const Doubles x = place[0] - wide(lines.org[0]), y = place[1] - wide(lines.org[1]),
                      z = place[2] - wide(lines.org[2]);
        const Doubles foot = ((x * dx + y * dy) + z * dz) / ((dx * dx + dy * dy) + dz * dz);
        const Doubles px = x - dx * foot, py = y - dy * foot, pz = z - dz * foot;
        const Doubles reach = Doubles(movement_.motion.reach * (1 + 0x1p-20)) + wide(lines.slack);
        const Doubles half = reach * wide(lines.perLength);
        return ~(less(reach * reach, (px * px + py * py) + pz * pz) |
                 less(foot + half, wide(lines.tMin)) | less(wide(lines.best), foot - half));
    }

    // matrixOf(rotationAt())
    template <class Segment>
    static Matrix rotation(const Segment& segment, const Doubles& s, const Doubles& rest) {
        const Doubles arc = segment(2 * kParts), one(1.0), two(2.0);
        Doubles from = rest, to = s; // weights
        const unsigned chord = less(arc, Doubles(1e-4)), all = (1u << W) - 1;
        if (chord != all) {
            from = select(maskOf(chord), rest, sineOfArc(rest * arc));
            to = select(maskOf(chord), s, sineOfArc(s * arc));
        }
        const auto combined = [&](std::size_t i) {
            return from * segment(kRotation + i) + to * segment(kParts + kRotation + i);
        };
        const Doubles w = combined(0), x = combined(1), y = combined(2), z = combined(3);
        const Doubles size = sqrt(((w * w + x * x) + y * y) + z * z);
        const Doubles qw = w / size, qx = x / size, qy = y / size, qz = z / size;
        const Doubles xx = qx * qx, yy = qy * qy, zz = qz * qz;
        const Doubles xy = qx * qy, yz = qy * qz, zx = qz * qx;
        const Doubles wx = qw * qx, wy = qw * qy, wz = qw * qz;
        return {one - two * (yy + zz), two * (xy - wz),       two * (zx + wy),
                two * (xy + wz),       one - two * (xx + zz), two * (yz - wx),
                two * (zx - wy),       two * (yz + wx),       one - two * (xx + yy)};
    }
    static Matrix product(const Matrix& a, const Matrix& b) {
        const auto entry = [&](std::size_t i, std::size_t j) {
            return (a[3 * i] * b[j] + a[3 * i + 1] * b[3 + j]) + a[3 * i + 2] * b[6 + j];
        };
        return {entry(0, 0), entry(0, 1), entry(0, 2), entry(1, 0), entry(1, 1),
                entry(1, 2), entry(2, 0), entry(2, 1), entry(2, 2)};
    }

    // Transform::fromRows(). Returns the lanes that it treats in another way: what can't be
    // inverted, or is so large or small that it is scaled by more than a power of two.
    unsigned invert(const Matrix& m, const Doubles (&place)[3]) {
        const Doubles zero(0.0), minus(-0.0), one(1.0);
        const Doubles others = max(max(max(abs(m[1]), abs(m[2])), max(abs(m[3]), abs(m[5]))),
                                   max(abs(m[6]), abs(m[7])));
        const Doubles largest = max(max(others, abs(m[0])), max(abs(m[4]), abs(m[8])));
        unsigned asked = ~(less(Doubles(0x1p-1000), largest) & less(largest, Doubles(0x1p1000)));
        alignas(64) double numbers[W]; // PowerOfTwo
        largest.store(numbers);
        for (double& x : numbers) {
            const std::uint64_t biased = std::bit_cast<std::uint64_t>(x) >> 52;
            x = std::bit_cast<double>((2045 - std::min<std::uint64_t>(biased, 2045)) << 52);
        }
        const Doubles power = Doubles::load(numbers);

        const Doubles a = m[0] * power, b = m[1] * power, c = m[2] * power;
        const Doubles d = m[3] * power, e = m[4] * power, f = m[5] * power;
        const Doubles g = m[6] * power, h = m[7] * power, i = m[8] * power;
        const Doubles cofactor[9] = {e * i - f * h, f * g - d * i, d * h - e * g,
                                     h * c - i * b, i * a - g * c, g * b - h * a,
                                     b * f - c * e, c * d - a * f, a * e - b * d};
        const Doubles value = (a * cofactor[0] + b * cofactor[1]) + c * cofactor[2];
        const Doubles products =
            ((((abs(a * e * i) + abs(a * f * h)) + abs(b * f * g)) + abs(b * d * i)) +
             abs(c * d * h)) +
            abs(c * e * g);
        asked |= ~less(Doubles(8 * 0x1p-53) * products, abs(value));

        // ScalingDeterminant, whose inverse has no -0.
        const unsigned scaling = atMost(others, zero);
        if (scaling != 0) {
            unsigned negative = ~(less(zero, m[0]) & less(zero, m[4]) & less(zero, m[8]));
            for (const std::size_t k : {1u, 2u, 3u, 5u, 6u, 7u})
                negative |= less(withSign(one, m[k]), zero);
            asked |= scaling & negative;
        }
        Doubles sum = (place[0] * zero + place[1] * zero) + place[2] * zero; // NaN: not finite
        for (std::size_t k = 0; k < 3; ++k) {
            const auto entry = [&](std::size_t j) {
                const Doubles x = (cofactor[3 * j + k] / value) * power;
                return j == k || scaling == 0 ? x : select(maskOf(scaling), zero, x);
            };
            const Doubles row[3] = {entry(0), entry(1), entry(2)};
            const Doubles offset =
                minus - ((row[0] * place[0] + row[1] * place[1]) + row[2] * place[2]);
            for (std::size_t j = 0; j < 3; ++j) {
                row[j].store(inverse_[4 * k + j]);
                sum = sum + row[j] * zero;
            }
            offset.store(inverse_[4 * k + 3]);
            sum = sum + offset * zero;
        }
        return asked | ~atMost(sum, zero);
    }

    const SolidTree::Movement& movement_;
    std::span<const MovingTransform::Segment> segments_;
    const MovingTransform::Segment* segment_[W];
    alignas(64) double time_[W], s_[W]; // s: within the segment
    alignas(64) double inverse_[12][W];
    unsigned others_ = 0; // lanes that are not between two keys, or only moved
};

LANES_END
