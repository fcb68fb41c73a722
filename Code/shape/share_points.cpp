#include "shape/share_points.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <span>

namespace {

constexpr std::uint32_t kEmpty = 0xffffffffu;

template <class Point> bool sameBits(const Point& a, const Point& b) {
    return std::memcmp(&a, &b, sizeof a) == 0;
}

// Products whose upper half is folded down (Fibonacci hashing, Knuth).
template <class Point> std::size_t hashOf(const Point& p) {
    static_assert(sizeof(Point) % sizeof(std::uint32_t) == 0);
    std::array<std::uint32_t, sizeof(Point) / sizeof(std::uint32_t)> words;
    std::memcpy(words.data(), &p, sizeof p);
    std::uint64_t hash = 0;
    for (const std::uint32_t word : words) {
        hash = (hash ^ word) * 0x9e3779b97f4a7c15u;
        hash ^= hash >> 32;
    }
    return static_cast<std::size_t>(hash);
}

// Different points, in the order in which they came, at the front of a list that is looked through:
// open addressing with linear probing.
template <class Point> class DifferentPoints {
public:
    explicit DifferentPoints(std::span<Point> points) : points_(points), places_(1 << 10, kEmpty) {}

    std::uint32_t count() const { return count_; }
    // Where the point is among them; it is one of the list, behind those it has been asked for.
    std::uint32_t numberOf(const Point& p, std::size_t hash) {
        for (std::size_t at = hash & mask();; at = (at + 1) & mask()) {
            if (places_[at] == kEmpty) {
                points_[count_] = p;
                places_[at] = count_;
                if (2 * (count_ + 1) > places_.size()) grow();
                return count_++;
            }
            if (sameBits(points_[places_[at]], p)) return places_[at];
        }
    }
    void prefetch(std::size_t hash) const { __builtin_prefetch(&places_[hash & mask()]); }

private:
    std::size_t mask() const { return places_.size() - 1; }
    void grow() {
        std::vector<std::uint32_t> larger(4 * places_.size(), kEmpty);
        places_.swap(larger);
        for (const std::uint32_t number : larger) {
            if (number == kEmpty) continue;
            std::size_t at = hashOf(points_[number]) & mask();
            while (places_[at] != kEmpty) at = (at + 1) & mask();
            places_[at] = number;
        }
    }

    std::span<Point> points_;
    std::vector<std::uint32_t> places_;
    std::uint32_t count_ = 0;
};

// Moves those that differ to the front; found(i, number) says which of them point i is. Returns how
// many there are.
template <class Point, class Fn> std::uint32_t findSame(std::span<Point> points, const Fn& found) {
    constexpr std::size_t kTogether = 32; // hashes, ahead of the table
    DifferentPoints<Point> different(points);
    std::array<std::size_t, kTogether> hashes{};
    for (std::size_t first = 0; first < points.size(); first += kTogether) {
        const std::size_t count = std::min(kTogether, points.size() - first);
        for (std::size_t i = 0; i < count; ++i) {
            hashes[i] = hashOf(points[first + i]);
            different.prefetch(hashes[i]);
        }
        for (std::size_t i = 0; i < count; ++i) {
            const Point p = points[first + i];
            found(first + i, different.numberOf(p, hashes[i]));
        }
    }
    return different.count();
}

template <class Point> bool pays(const std::vector<Point>& points) {
    constexpr std::size_t kSome = std::size_t{1} << 12;
    std::vector<Point> some(points.begin(), points.begin() + static_cast<std::ptrdiff_t>(
                                                                 std::min(kSome, points.size())));
    return findSame(std::span<Point>(some), [](std::size_t, std::uint32_t) {}) <
           some.size() * 3 / 4;
}

template <class Point, class Fn>
void share(MeshGeometry& mesh, std::vector<Point>& points, const Fn& found) {
    if (!pays(points)) return;
    std::vector<std::uint32_t> number(points.size());
    const std::uint32_t count =
        findSame(std::span<Point>(points), [&](std::size_t i, std::uint32_t same) {
            number[i] = same;
            found(i, same);
        });
    points.resize(count);
    for (MeshGeometry::Corners& corners : mesh.triangles)
        for (std::uint32_t& corner : corners) corner = number[corner];
}

} // namespace

void sharePoints(MeshGeometry& mesh) {
    if (mesh.points.size() <= mesh.triangles.size()) return;
    if (mesh.exactPoints.empty())
        return share(mesh, mesh.points, [](std::size_t, std::uint32_t) {});
    // What is the same exactly is so when it is rounded.
    share(mesh, mesh.exactPoints,
          [&](std::size_t i, std::uint32_t same) { mesh.points[same] = mesh.points[i]; });
    mesh.points.resize(mesh.exactPoints.size());
}
