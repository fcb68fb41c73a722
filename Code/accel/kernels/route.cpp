// Which kernel function gets which rays of a batch: those that share their origin with many others
// (camera rays of a pinhole, shadow rays of a point light) go as bundles, the rest as beams or one
// by one.
// Nothing here can change an answer.
#include "accel/kernels/kernels.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <numeric>

namespace {

// Fewer rays from one point than this are no bundle.
constexpr std::size_t kFewestForBundle = 32;
// Origins that are looked for: the point lights of a wave.
constexpr std::size_t kMostOrigins = 8;

// Origins are one point where they have the same bits: of 0 and -0 differences have other signs.
bool allEqual(std::span<const Vec3> v) {
    return v.empty() || std::memcmp(v.data(), v.data() + 1, v.size_bytes() - sizeof(Vec3)) == 0;
}
bool areEqual(Vec3 a, Vec3 b) {
    using Words = std::array<std::uint32_t, 3>;
    return std::bit_cast<Words>(a) == std::bit_cast<Words>(b);
}

class Groups {
public:
    struct Group {
        Vec3 origin;
        std::vector<std::uint32_t> rays;
    };
    std::vector<Group> fromPoint; // the first `used`; kept for their memory
    std::size_t used = 0;
    std::vector<std::uint32_t> rest;

    // False when no rays are worth a bundle; then the lists are not complete.
    bool sort(std::span<const Vec3> origins) {
        used = 0;
        rest.clear();
        const auto n = static_cast<std::uint32_t>(origins.size());
        std::size_t strangers = 0;
        for (std::uint32_t i = 0; i < n;) {
            const Vec3 origin = origins[i];
            const std::uint32_t first = i++;
            while (i < n && areEqual(origins[i], origin)) ++i;
            if (std::vector<std::uint32_t>* group = groupOf(origin)) {
                append(*group, first, i);
                continue;
            }
            // Origins of their own, as after a bounce: don't look at all the others.
            append(rest, first, i);
            if (++strangers < kFewestForBundle) continue;
            if (!hasBundles()) return false;
            append(rest, i, n);
            break;
        }
        if (!hasBundles()) return false;
        for (std::size_t g = 0; g < used; ++g) {
            auto& few = fromPoint[g].rays;
            if (few.size() >= kFewestForBundle) continue;
            rest.insert(rest.end(), few.begin(), few.end());
            few.clear();
        }
        return true;
    }

    // 0 to count - 1.
    std::span<const std::uint32_t> numbers(std::size_t count) {
        if (numbers_.size() < count)
            append(numbers_, static_cast<std::uint32_t>(numbers_.size()),
                   static_cast<std::uint32_t>(count));
        return std::span(numbers_).first(count);
    }

private:
    bool hasBundles() const {
        return std::any_of(fromPoint.begin(), fromPoint.begin() + static_cast<std::ptrdiff_t>(used),
                           [](const Group& g) { return g.rays.size() >= kFewestForBundle; });
    }

    static void append(std::vector<std::uint32_t>& list, std::uint32_t first, std::uint32_t end) {
        list.resize(list.size() + (end - first));
        std::iota(list.end() - (end - first), list.end(), first);
    }

    // The list of an origin; null when there are too many of them.
    std::vector<std::uint32_t>* groupOf(Vec3 origin) {
        for (std::size_t g = 0; g < used; ++g)
            if (areEqual(fromPoint[g].origin, origin)) return &fromPoint[g].rays;
        if (used == kMostOrigins) return nullptr;
        if (fromPoint.size() == used) fromPoint.emplace_back();
        fromPoint[used].origin = origin;
        fromPoint[used].rays.clear();
        return &fromPoint[used++].rays;
    }

    std::vector<std::uint32_t> numbers_;
};

template <class KernelFn, class Results>
void route(KernelFn queue, KernelFn bundle, const WideMesh& mesh, const RaySpan& rays,
           const Results& results) {
    thread_local Groups groups;
    const auto all = groups.numbers(rays.size());
    if (all.size() >= kFewestForBundle && allEqual(rays.org))
        return bundle(mesh, rays, all, results);
    if (!groups.sort(rays.org)) {
        if (!all.empty()) queue(mesh, rays, all, results);
        return;
    }
    for (std::size_t g = 0; g < groups.used; ++g)
        if (const auto& list = groups.fromPoint[g].rays; !list.empty())
            bundle(mesh, rays, list, results);
    if (!groups.rest.empty()) queue(mesh, rays, groups.rest, results);
}

} // namespace

void closestHits(const Isa& isa, const WideMesh& mesh, const RaySpan& rays,
                 std::span<TriangleHit> hits) {
    route(isa.triangles->closest, isa.triangles->closestFromPoint, mesh, rays,
          HitLists{.brief = hits.data()});
}

void closestHits(const Isa& isa, const WideMesh& mesh, const RaySpan& rays, std::uint32_t number,
                 std::span<Hit> hits) {
    route(isa.triangles->closest, isa.triangles->closestFromPoint, mesh, rays,
          HitLists{.whole = hits.data(), .shape = number});
}

void anyHits(const Isa& isa, const WideMesh& mesh, const RaySpan& rays,
             std::span<std::uint8_t> hidden) {
    route(isa.triangles->any, isa.triangles->anyFromPoint, mesh, rays, hidden.data());
}
