#include "base/motion.h"

#include <algorithm>
#include <utility>

namespace {

using Matrix = std::array<double, 9>;

Vec3d times(const Matrix& m, Vec3d v) {
    return {m[0] * v.x + m[1] * v.y + m[2] * v.z, m[3] * v.x + m[4] * v.y + m[5] * v.z,
            m[6] * v.x + m[7] * v.y + m[8] * v.z};
}

Matrix times(const Matrix& a, const Matrix& b) {
    Matrix out{};
    for (std::size_t i = 0; i < 9; i += 3)
        for (std::size_t j = 0; j < 3; ++j)
            out[i + j] = a[i] * b[j] + a[i + 1] * b[3 + j] + a[i + 2] * b[6 + j];
    return out;
}

Matrix transposed(const Matrix& m) {
    return {m[0], m[3], m[6], m[1], m[4], m[7], m[2], m[5], m[8]};
}

Matrix linearOf(const Transform::Rows& r) {
    return {r[0], r[1], r[2], r[4], r[5], r[6], r[8], r[9], r[10]};
}

Transform affine(const Matrix& m, Vec3d t) {
    return Transform::fromRows(
        {m[0], m[1], m[2], t.x, m[3], m[4], m[5], t.y, m[6], m[7], m[8], t.z});
}

// Arvo's box of the mapped box, without a pad for rounding.
BoundsD boxOf(const Matrix& m, const BoundsD& box) {
    BoundsD out{{}, {}};
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 3; ++j) {
            const double a = m[3 * i + j] * box.lo[j], b = m[3 * i + j] * box.hi[j];
            out.lo[i] += min(a, b);
            out.hi[i] += max(a, b);
        }
    return out;
}

double frobenius(const Matrix& m) {
    double sum = 0;
    for (const double x : m) sum += x * x;
    return std::sqrt(sum);
}

// The orthogonal factor nearest to an invertible matrix, by Newton's iteration X = (X + X^-T) / 2
// with Higham's scaling (1986); it converges quadratically, about 8 steps.
Matrix orthogonalFactor(Matrix x) {
    for (int step = 0; step < 40; ++step) {
        const Transform map = affine(x, {});
        if (map.isSingular()) break;
        const Matrix inverseTransposed = transposed(linearOf(map.inverse().rows()));
        const double scale = std::sqrt(frobenius(inverseTransposed) / frobenius(x));
        Matrix next;
        double change = 0;
        for (std::size_t i = 0; i < 9; ++i) {
            next[i] = 0.5 * (scale * x[i] + inverseTransposed[i] / scale);
            change = max(change, std::fabs(next[i] - x[i]));
        }
        x = next;
        if (change < 1e-15) break;
    }
    return x;
}

Quaternion normalized(Quaternion q) {
    const double size = std::sqrt(q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z);
    return {q.w / size, q.x / size, q.y / size, q.z / size};
}

// Shepperd 1978: starts from the largest component, so nothing cancels.
Quaternion quaternionOf(const Matrix& m) {
    const double trace = m[0] + m[4] + m[8];
    const double largest = std::max({trace, m[0], m[4], m[8]});
    Quaternion q;
    if (largest == trace)
        q = {1 + trace, m[7] - m[5], m[2] - m[6], m[3] - m[1]};
    else if (largest == m[0])
        q = {m[7] - m[5], 1 + m[0] - m[4] - m[8], m[1] + m[3], m[2] + m[6]};
    else if (largest == m[4])
        q = {m[2] - m[6], m[1] + m[3], 1 + m[4] - m[0] - m[8], m[5] + m[7]};
    else
        q = {m[3] - m[1], m[2] + m[6], m[5] + m[7], 1 + m[8] - m[0] - m[4]};
    return normalized(q);
}

Matrix matrixOf(Quaternion q) {
    const double xx = q.x * q.x, yy = q.y * q.y, zz = q.z * q.z;
    const double xy = q.x * q.y, yz = q.y * q.z, zx = q.z * q.x;
    const double wx = q.w * q.x, wy = q.w * q.y, wz = q.w * q.z;
    return {1 - 2 * (yy + zz), 2 * (xy - wz), 2 * (zx + wy), 2 * (xy + wz),    1 - 2 * (xx + zz),
            2 * (yz - wx),     2 * (zx - wy), 2 * (yz + wx), 1 - 2 * (xx + yy)};
}

Quaternion combine(double a, Quaternion p, double b, Quaternion q) {
    return {a * p.w + b * q.w, a * p.x + b * q.x, a * p.y + b * q.y, a * p.z + b * q.z};
}

double size(Quaternion q) { return std::sqrt(q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z); }

struct Moment {
    std::size_t segment; // one more than there are, at the end
    double s;            // within it
};
Moment momentOf(double time, std::size_t segments) {
    const double place = clamp(time, 0.0, 1.0) * static_cast<double>(segments);
    const auto i = static_cast<std::size_t>(place);
    return {i, place - static_cast<double>(i)};
}

} // namespace

MovingTransform::MovingTransform(std::span<const Transform> keys) : keys_(1) {
    if (!keys.empty()) keys_.assign(keys.begin(), keys.end());
    const bool allEqual =
        std::all_of(keys_.begin(), keys_.end(), [&](const Transform& k) { return k == keys_[0]; });
    if (allEqual) {
        keys_.assign(1, keys_.front());
        return;
    }
    for (std::size_t i = 0; i + 1 < keys_.size(); ++i) {
        const bool linearOnly = keys_[i].isSingular() || keys_[i + 1].isSingular();
        Segment segment{decompose(keys_[i], linearOnly), decompose(keys_[i + 1], linearOnly)};
        segment.translates = linearOf(keys_[i].rows()) == linearOf(keys_[i + 1].rows());
        Quaternion& from = segment.from.rotation;
        const Quaternion& to = segment.to.rotation;
        if (from.w * to.w + from.x * to.x + from.y * to.y + from.z * to.z < 0)
            from = {-from.w, -from.x, -from.y, -from.z}; // the same turn, and now the shorter arc
        segment.arcRad =
            2 * exact::atan2(size(combine(1, to, -1, from)), size(combine(1, to, 1, from)));
        segments_.push_back(segment);
    }
}

MovingTransform::Parts MovingTransform::decompose(const Transform& map, bool linearOnly) {
    const Matrix linear = linearOf(map.rows());
    if (linearOnly) return {map.translation(), {}, linear};
    Matrix rotation = orthogonalFactor(linear);
    if (map.mirrors()) // the mirror goes into the stretch: M = (-Q)(-S)
        for (double& x : rotation) x = -x;
    const Quaternion q = quaternionOf(rotation);
    Matrix stretch = times(transposed(matrixOf(q)), linear);
    for (const auto& [i, j] : {std::array<std::size_t, 2>{1, 3}, {2, 6}, {5, 7}})
        stretch[i] = stretch[j] = 0.5 * (stretch[i] + stretch[j]);
    return {map.translation(), q, stretch};
}

MovingTransform::Matrix MovingTransform::linearPart(const Parts& parts) {
    return times(matrixOf(parts.rotation), parts.stretch);
}

Quaternion MovingTransform::rotationAt(const Segment& segment, double s) {
    const double arc = segment.arcRad;
    // Below 1e-4 radians the chord is the arc to 1e-9 of itself, and sin(arc) may be 0.
    if (arc < 1e-4)
        return normalized(combine(1 - s, segment.from.rotation, s, segment.to.rotation));
    return normalized(combine(exact::sin((1 - s) * arc), segment.from.rotation, exact::sin(s * arc),
                              segment.to.rotation));
}

MovingTransform::Matrix MovingTransform::stretchAt(const Segment& segment, double s) {
    Matrix out;
    for (std::size_t i = 0; i < 9; ++i)
        out[i] = lerp(segment.from.stretch[i], segment.to.stretch[i], s);
    return out;
}

std::optional<MovingTransform::Shift> MovingTransform::shiftAt(double time) const {
    const auto [i, s] = momentOf(time, segments_.size());
    if (s == 0) return Shift{i, {}};
    const Segment& segment = segments_[i];
    if (!segment.translates) return {};
    return Shift{i, (segment.to.translation - segment.from.translation) * s};
}

// Transform::translate(offset) * key, operation by operation; at keys that adds zeros.
Vec3d Drift::offsetAt(double time) const {
    const auto [i, s] = momentOf(time, legs_.size() - 1);
    return vectorUnder(inverse_, -(legs_[i].step * s)) + legs_[i].offset;
}

std::optional<Drift> MovingTransform::drift() const {
    constexpr double kMost = 0x1p200; // nothing overflows
    const AffineRows& inverse = keys_[0].inverseRows();
    std::vector<Drift::Leg> legs;
    for (std::size_t i = 0; i < keys_.size(); ++i) {
        const Transform& key = keys_[i];
        const AffineRows& m = key.inverseRows();
        const Vec3d offset{m[3], m[7], m[11]};
        if (key.isSingular() || linearOf(m) != linearOf(inverse)) return {};
        if (!(maxAbs(offset) < kMost && maxAbs(key.translation()) < kMost)) return {};
        legs.push_back({offset, {}});
        if (i == segments_.size()) break;
        if (!segments_[i].translates) return {};
        legs[i].step = segments_[i].to.translation - segments_[i].from.translation;
    }
    return Drift(inverse, std::move(legs));
}

Transform MovingTransform::at(double time) const {
    const auto [i, s] = momentOf(time, segments_.size());
    if (s == 0) return keys_[i];
    const Segment& segment = segments_[i];
    if (segment.translates) {
        const Vec3d step = segment.to.translation - segment.from.translation;
        return Transform::translate(step * s) * keys_[i];
    }
    const Parts parts{lerp(segment.from.translation, segment.to.translation, s),
                      rotationAt(segment, s), stretchAt(segment, s)};
    return affine(linearPart(parts), parts.translation);
}

// On a piece of the shutter where the body turns by D, a point p of the object goes to
// T(s) + R(s) x(s), with x(s) = S(s) p linear in s. For a fixed x, R(s) x runs on an arc of at most
// the radius |x| and angle D, which stays within (1 - cos(D/2)) |x| of its chord. So R(s) x(s),
// between R(s) x0 and R(s) x1, is in the hull of the four R_i x_j, grown by that sagitta; T(s) is
// between T0 and T1. The R_i x_j are linear maps of the box.
BoundsD MovingTransform::sweptBounds(const Segment& segment, const BoundsD& box) {
    constexpr double kLargestTurn = kPi / 16; // sagitta below half a percent of the radius
    const double turn = 2 * segment.arcRad;
    // At least a few pieces, as T and R x of one piece are boxed each on its own.
    const int pieces = 8 + static_cast<int>(turn / kLargestTurn);
    const double half = exact::sin(turn / (4 * pieces)); // 1 - cos(D/2) = 2 sin^2(D/4)
    const double sagitta = 2 * half * half;
    struct End { // of a piece
        Matrix rotation, stretch;
        Vec3d translation;
        double radius; // of the stretched box about the origin
    };
    const auto endAt = [&](int piece) {
        const double s = static_cast<double>(piece) / pieces;
        End end{matrixOf(rotationAt(segment, s)), stretchAt(segment, s),
                lerp(segment.from.translation, segment.to.translation, s), 0};
        for (int corner = 0; corner < 8; ++corner)
            end.radius = max(end.radius, length(times(end.stretch, box.corner(corner))));
        return end;
    };
    BoundsD out;
    End last = endAt(0);
    for (int piece = 1; piece <= pieces; ++piece) {
        const End next = endAt(piece);
        BoundsD turned, moved;
        for (const End* j : {&std::as_const(last), &next}) {
            for (const End* i : {&std::as_const(last), &next})
                turned.extend(boxOf(times(i->rotation, j->stretch), box));
            moved.extend(j->translation);
        }
        // All roundings here and in at() are below 1e-13 of the coordinates.
        const double radius = max(last.radius, next.radius);
        const double reach = radius + maxAbs(moved.lo) + maxAbs(moved.hi);
        const double pad = sagitta * radius + 1e-13 * reach;
        out.extend({turned.lo + moved.lo - Vec3d{pad, pad, pad},
                    turned.hi + moved.hi + Vec3d{pad, pad, pad}});
        last = next;
    }
    return out;
}

BoundsD MovingTransform::bounds(const BoundsD& objectBox) const {
    if (objectBox.isEmpty()) return {};
    BoundsD out;
    for (const Transform& key : keys_) out.extend(key.bounds(objectBox));
    if (segments_.empty()) return out;
    if (!objectBox.isFinite()) { // a moving plane is everywhere
        const Vec3d inf{kInfinity, kInfinity, kInfinity};
        return {-inf, inf};
    }
    for (const Segment& segment : segments_) {
        // Points of a translation move on lines between the keys.
        if (!segment.translates) out.extend(sweptBounds(segment, objectBox));
    }
    const double size = maxAbs(out.lo) > maxAbs(out.hi) ? maxAbs(out.lo) : maxAbs(out.hi);
    return out.padded(1e-14 * size);
}
