#include "shape/share_points.h"

#include "base/for_each.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <span>

namespace {

template <class Point> auto bitsOf(const Point& p) {
    static_assert(sizeof(Point) % sizeof(std::uint32_t) == 0);
    return std::bit_cast<std::array<std::uint32_t, sizeof(Point) / sizeof(std::uint32_t)>>(p);
}

// Products whose upper half is folded down (Fibonacci hashing, Knuth).
template <class Point> std::uint64_t pointHash(const Point& p) {
    std::uint64_t hash = 0;
    for (const std::uint32_t bits : bitsOf(p)) {
        hash = (hash ^ bits) * 0x9e3779b97f4a7c15u;
        hash ^= hash >> 32;
    }
    return hash;
}

// Which of a list's points was the first of the same bits: open addressing with linear probing.
template <class Point> class FirstPoints {
public:
    explicit FirstPoints(std::span<const Point> points)
        : points_(points), places_(1 << 10, kEmpty) {}

    // Of points that are asked for in their order.
    std::uint32_t firstOf(std::uint32_t point, std::uint64_t hash) {
        std::size_t at = hash & mask();
        for (; places_[at] != kEmpty; at = (at + 1) & mask())
            if (bitsOf(points_[places_[at]]) == bitsOf(points_[point])) return places_[at];
        places_[at] = point;
        if (2 * ++count_ > places_.size()) grow();
        return point;
    }
    void prefetch(std::uint64_t hash) const { __builtin_prefetch(&places_[hash & mask()]); }

private:
    static constexpr std::uint32_t kEmpty = 0xffffffffu;

    std::size_t mask() const { return places_.size() - 1; }
    void grow() {
        std::vector<std::uint32_t> smaller(4 * places_.size(), kEmpty);
        places_.swap(smaller);
        for (const std::uint32_t point : smaller) {
            if (point == kEmpty) continue;
            std::size_t at = pointHash(points_[point]) & mask();
            while (places_[at] != kEmpty) at = (at + 1) & mask();
            places_[at] = point;
        }
    }

    std::span<const Point> points_;
    std::vector<std::uint32_t> places_; // numbers of points
    std::size_t count_ = 0;
};

// By point, the first of the same bits. Each part is of hashes, not of points: which is first does
// not depend on how many there are.
template <class Point>
void findFirst(std::span<const Point> points, std::size_t part, std::size_t parts,
               std::span<std::uint32_t> first) {
    constexpr std::size_t kTogether = 32; // ahead of the table
    FirstPoints<Point> known(points);
    std::array<std::uint64_t, kTogether> hashes{};
    std::array<std::uint32_t, kTogether> asking{};
    for (std::size_t begin = 0; begin < points.size(); begin += kTogether) {
        const std::size_t end = std::min(begin + kTogether, points.size());
        std::size_t count = 0;
        for (std::size_t i = begin; i < end; ++i) {
            const std::uint64_t hash = pointHash(points[i]);
            if (parts > 1 && (hash >> 32) % parts != part) continue;
            known.prefetch(hash);
            hashes[count] = hash, asking[count++] = static_cast<std::uint32_t>(i);
        }
        for (std::size_t k = 0; k < count; ++k)
            first[asking[k]] = known.firstOf(asking[k], hashes[k]);
    }
}

template <class Point> bool pays(std::span<const Point> points) {
    constexpr std::size_t kSome = std::size_t{1} << 12;
    const auto some = points.first(std::min(kSome, points.size()));
    std::vector<std::uint32_t> first(some.size());
    findFirst(some, 0, 1, first);
    std::size_t different = 0;
    for (std::uint32_t i = 0; i < first.size(); ++i) different += first[i] == i;
    return different < some.size() * 3 / 4;
}

// Moves those that differ to the front of both lists, and says of all where they are then.
template <class Point>
std::vector<std::uint32_t> share(RawVector<Point>& points, RawVector<Vec3>* rounded, int threads) {
    constexpr std::size_t kWorthAThread = std::size_t{1} << 15;
    const std::size_t parts = std::clamp<std::size_t>(
        points.size() / kWorthAThread, 1,
        static_cast<std::size_t>(threads > 0 ? threads : hardwareThreads()));
    std::vector<std::uint32_t> number(points.size());
    forEachOn(threads, parts, [&](std::size_t part) {
        findFirst(std::span<const Point>(points), part, parts, number);
    });
    std::uint32_t count = 0;
    for (std::uint32_t i = 0; i < number.size(); ++i) {
        if (number[i] != i) {
            number[i] = number[number[i]]; // that of the first
            continue;
        }
        points[count] = points[i];
        if (rounded != nullptr) (*rounded)[count] = (*rounded)[i];
        number[i] = count++;
    }
    points.resize(count);
    if (rounded != nullptr) rounded->resize(count);
    return number;
}

} // namespace

void sharePoints(MeshGeometry& mesh, int threads) {
    constexpr std::size_t kTogether = std::size_t{1} << 13;
    if (mesh.points.size() <= mesh.triangles.size()) return;
    // What is the same exactly is so when it is rounded.
    const bool areExact = !mesh.exactPoints.empty();
    if (!(areExact ? pays<Vec3d>(mesh.exactPoints) : pays<Vec3>(mesh.points))) return;
    const std::vector<std::uint32_t> number = areExact
                                                  ? share(mesh.exactPoints, &mesh.points, threads)
                                                  : share(mesh.points, nullptr, threads);
    forEachPart(threads, mesh.triangles.size(), kTogether,
                [&](std::size_t first, std::size_t last) {
                    for (std::size_t i = first; i < last; ++i)
                        for (std::uint32_t& corner : mesh.triangles[i]) corner = number[corner];
                });
}
