#include "read/mesh/mesh_steps.h"

#include "read/mesh/exact_orientation.h"

#include <algorithm>

namespace {

using Index = std::uint32_t;
constexpr Index kNobody = 0xffffffffu;

// Twice the signed area in the plane of axes x and y, to about 100 bits.
double areaSign(std::span<const Vec3d> corners, std::size_t x, std::size_t y) {
    const Vec3d& origin = corners.front();
    const auto from = [&](const Vec3d& p, std::size_t axis) {
        return twoSum(p[axis], -origin[axis]);
    };
    DoubleDouble area;
    for (std::size_t i = 1; i + 1 < corners.size(); ++i)
        area = area + (from(corners[i], x) * from(corners[i + 1], y) -
                       from(corners[i], y) * from(corners[i + 1], x));
    return area.hi;
}

// The polygon without the coordinate along which its normal is longest, counter-clockwise.
// Coordinates stay as they are, so nothing is rounded.
void flatten(std::span<const Vec3d> corners, std::span<Vec2d> flat) {
    Vec3d normal, size;
    const Vec3d& origin = corners.front();
    for (std::size_t i = 1; i + 1 < corners.size(); ++i) {
        const Vec3d n = cross(corners[i] - origin, corners[i + 1] - origin);
        normal += n;
        size += Vec3d{std::fabs(n.x), std::fabs(n.y), std::fabs(n.z)};
    }
    const Vec3d length{std::fabs(normal.x), std::fabs(normal.y), std::fabs(normal.z)};
    const std::size_t axis = length.x >= length.y && length.x >= length.z ? 0
                             : length.y >= length.z                       ? 1
                                                                          : 2;
    std::size_t x = (axis + 1) % 3, y = (axis + 2) % 3;
    const bool isSure = length[axis] > 1e-9 * size[axis];
    if ((isSure ? normal[axis] : areaSign(corners, x, y)) < 0) std::swap(x, y);
    for (std::size_t i = 0; i < corners.size(); ++i) flat[i] = {corners[i][x], corners[i][y]};
}

// Are all triangles of the fan around corner `hub` turned left, without going around it?
bool isFan(std::span<const Vec2d> p, std::size_t hub) {
    const std::size_t n = p.size();
    const auto corner = [&](std::size_t i) { return p[(hub + i) % n]; };
    for (std::size_t i = 1; i + 1 < n; ++i) {
        if (orientation(corner(0), corner(i), corner(i + 1)) <= 0) return false;
        // Two angles below 180 degrees can't go around; more may, unless all stay left of the
        // first.
        if (n > 4 && orientation(corner(0), corner(1), corner(i + 1)) < 0) return false;
    }
    return true;
}

// Of three points on one line: does the way a, b, c turn back at b, or stand still?
bool isSpike(Vec2d a, Vec2d b, Vec2d c) {
    if (a == b || b == c) return true;
    return a.x != b.x ? (a.x > b.x) == (c.x > b.x) : (a.y > b.y) == (c.y > b.y);
}

// Cuts off ears: corners that turn left and whose triangle with their neighbours nothing else of
// the polygon reaches into. What stood in the way of a corner is kept: its test goes on from there
// once that is gone, so that all tests together take time in the square of the corners at most.
class EarClipper {
public:
    EarClipper(std::span<const Vec2d> points, std::vector<std::array<Index, 3>>& triangles)
        : p_(points), corners_(p_.size()), left_(p_.size()), triangles_(triangles) {
        const auto n = static_cast<Index>(p_.size());
        for (Index i = 0; i < n; ++i) {
            corners_[i].previous = i == 0 ? n - 1 : i - 1;
            corners_[i].next = i == n - 1 ? 0 : i + 1;
            todo_.push_back(i);
        }
        // A triangle that contains a corner contains one that does not turn left, and cutting ears
        // turns no corner to the right: these are all that can ever stand in the way.
        for (Index i = 0; i < n; ++i)
            if (turn(i) <= 0) obstacles_.push_back(i);
        std::sort(obstacles_.begin(), obstacles_.end(),
                  [&](Index a, Index b) { return p_[a].x < p_[b].x; });
    }

    void run() {
        while (left_ > 3) {
            if (todo_.empty()) resumeTests();
            if (todo_.empty()) {
                if (patience_-- == 0) break;
                cutSomething();
            }
            std::vector<Index> now;
            now.swap(todo_);
            for (const Index i : now)
                if (left_ > 3 && corners_[i].isThere && isEar(i)) cut(i);
        }
        emitFan();
    }

private:
    struct Corner {
        Index previous = 0, next = 0;
        Index changes = 0; // how often a neighbour was cut off
        bool isThere = true;
        bool isTested = false; // then nothing of obstacles_ before `reached` is in the way
        Index reached = 0;
        Index blocker = kNobody, blockerChanges = 0;
    };

    int turn(Index i) const {
        const Corner& c = corners_[i];
        return orientation(p_[c.previous], p_[i], p_[c.next]);
    }

    bool isEar(Index i) {
        Corner& corner = corners_[i];
        corner.blocker = kNobody;
        const Vec2d a = p_[corner.previous], b = p_[i], c = p_[corner.next];
        // Ways there and back enclose nothing. Left where they are, two of them could pass for the
        // sides of a triangle that is outside.
        if (const int sign = orientation(a, b, c); sign <= 0) return sign == 0 && isSpike(a, b, c);
        const auto [loX, hiX] = std::minmax({a.x, b.x, c.x});
        const auto [loY, hiY] = std::minmax({a.y, b.y, c.y});
        if (!corner.isTested) {
            const auto first = std::lower_bound(obstacles_.begin(), obstacles_.end(), loX,
                                                [&](Index o, double x) { return p_[o].x < x; });
            corner.reached = static_cast<Index>(first - obstacles_.begin());
            corner.isTested = true;
        }
        for (; corner.reached < obstacles_.size(); ++corner.reached) {
            const Index o = obstacles_[corner.reached];
            if (p_[o].x > hiX) break;
            if (p_[o].y < loY || p_[o].y > hiY || !corners_[o].isThere) continue;
            if (o == corner.previous || o == i || o == corner.next || !reachesInto(a, b, c, o))
                continue;
            corner.blocker = o;
            corner.blockerChanges = corners_[o].changes;
            return false;
        }
        return true;
    }

    // Is corner o in the triangle or on the side ca that would be cut? Where it only touches ab or
    // bc (polygons with holes go along a bridge twice, and meet their own corners there): does one
    // of its sides go inside?
    bool reachesInto(Vec2d a, Vec2d b, Vec2d c, Index o) const {
        const int ab = orientation(a, b, p_[o]), bc = orientation(b, c, p_[o]);
        if (ab < 0 || bc < 0) return false;
        const int ca = orientation(c, a, p_[o]);
        if (ca < 0) return false;
        if (ab > 0 && bc > 0) return true;
        const auto goesInside = [&](Index neighbour) {
            const Vec2d q = p_[neighbour];
            return (ab > 0 || orientation(a, b, q) > 0) && (bc > 0 || orientation(b, c, q) > 0) &&
                   (ca > 0 || orientation(c, a, q) > 0);
        };
        return goesInside(corners_[o].previous) || goesInside(corners_[o].next);
    }

    void emit(Index a, Index b, Index c) { triangles_.push_back({a, b, c}); }
    void emitFan() { // of all that is left
        const Index hub = anyCorner();
        for (Index i = corners_[hub].next; corners_[i].next != hub; i = corners_[i].next)
            emit(hub, i, corners_[i].next);
    }

    void cut(Index i) {
        const auto [previous, next] = std::pair(corners_[i].previous, corners_[i].next);
        emit(previous, i, next);
        corners_[i].isThere = false;
        corners_[previous].next = next;
        corners_[next].previous = previous;
        for (const Index neighbour : {previous, next}) {
            ++corners_[neighbour].changes;
            corners_[neighbour].isTested = false;
            todo_.push_back(neighbour);
        }
        --left_;
    }

    // Corners whose blocker was cut off, or has other neighbours now, may be ears.
    void resumeTests() {
        forEachCorner([&](Index i) {
            const Corner& corner = corners_[i];
            if (corner.blocker == kNobody) return;
            const Corner& blocker = corners_[corner.blocker];
            if (!blocker.isThere || blocker.changes != corner.blockerChanges) todo_.push_back(i);
        });
    }

    // No ears: what is left has no area, or the polygon crosses itself. Corners without area go
    // first, then any that turns left.
    void cutSomething() {
        Index best = anyCorner();
        int bestRank = 3;
        forEachCorner([&](Index i) {
            const int sign = turn(i), rank = sign == 0 ? 0 : sign > 0 ? 1 : 2;
            if (rank < bestRank) {
                best = i;
                bestRank = rank;
            }
        });
        cut(best);
    }

    Index anyCorner() {
        while (!corners_[first_].isThere) ++first_;
        return first_;
    }
    template <class Visit> void forEachCorner(Visit visit) {
        const Index start = anyCorner();
        Index i = start;
        do {
            const Index next = corners_[i].next;
            visit(i);
            i = next;
        } while (i != start);
    }

    std::span<const Vec2d> p_;
    std::vector<Corner> corners_;
    std::vector<Index> obstacles_; // by x
    std::vector<Index> todo_;      // corners that may have become ears
    std::size_t left_;
    int patience_ = 256; // with a polygon that crosses itself, for its right parts' sake
    Index first_ = 0;    // no corner before it is left
    std::vector<std::array<Index, 3>>& triangles_;
};

} // namespace

void triangulate(std::span<const Vec3d> corners,
                 std::vector<std::array<std::uint32_t, 3>>& triangles) {
    const auto n = static_cast<Index>(corners.size());
    if (n < 3) return;
    if (n == 3) {
        triangles.push_back({0, 1, 2});
        return;
    }
    // Faces of a mesh are many and small: no memory is asked for those.
    std::array<Vec2d, 16> few;
    std::vector<Vec2d> many(n > few.size() ? n : 0);
    const std::span<Vec2d> flat = many.empty() ? std::span(few).first(n) : std::span(many);
    flatten(corners, flat);
    for (Index hub = 0; hub < (n == 4 ? 2u : 1u); ++hub)
        if (isFan(flat, hub)) {
            for (Index i = 1; i + 1 < n; ++i)
                triangles.push_back({hub, (hub + i) % n, (hub + i + 1) % n});
            return;
        }
    EarClipper(flat, triangles).run();
}
