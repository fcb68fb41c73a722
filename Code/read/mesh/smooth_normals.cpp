#include "read/mesh/mesh_steps.h"

#include "base/for_each.h"
#include "base/math.h"

#include <algorithm>
#include <utility>
#include <vector>

namespace {

using Index = std::uint32_t;

// A corner of a triangle as seen from its point.
struct Around {
    Index triangle = 0, corner = 0;
    Vec3d weighted; // the triangle's normal times its angle here
};

// The normals of some points, numbered from 0.
class PointNormals {
public:
    PointNormals(MeshDesc& mesh, const std::vector<TriangleShape>& shapes)
        : mesh_(mesh), shapes_(shapes) {}

    const Vec3d& flat(Index triangle) const { return shapes_[triangle].normal; }

    // A sum without direction (sides that face each other) leaves the triangle as flat as it is.
    Index add(Vec3d sum, Index triangle) {
        const double size = maxAbs(sum);
        const Vec3d n = size > 1e-12                 ? normalize(sum / size)
                        : maxAbs(flat(triangle)) > 0 ? flat(triangle)
                                                     : Vec3d{0, 0, 1};
        normals.push_back(toFloat(n));
        return static_cast<Index>(normals.size() - 1);
    }
    void set(const Around& a, Index normal) {
        mesh_.normalTriangles[a.triangle][a.corner] = normal;
    }
    void shareAll(std::span<const Around> around) {
        Vec3d sum;
        for (const Around& a : around) sum += a.weighted;
        const Index normal = add(sum, around.front().triangle);
        for (const Around& a : around) set(a, normal);
    }

    std::vector<Vec3> normals;

private:
    MeshDesc& mesh_;
    const std::vector<TriangleShape>& shapes_;
};

class Smoother {
public:
    // Triangles of group 0 are left alone; without groups there are none.
    Smoother(MeshDesc& mesh, std::span<const Index> groups, int threads)
        : mesh_(mesh), groups_(groups), threads_(threads), shapes_(triangleShapes(mesh, threads)) {
        mesh.normals.clear();
        mesh.normalTriangles.assign(mesh.triangles.size(), {});
    }

    void keepFlat(Index triangle) {
        PointNormals one(mesh_, shapes_);
        const auto normal = static_cast<Index>(mesh_.normals.size());
        one.add({}, triangle);
        mesh_.normals.push_back(one.normals.front());
        mesh_.normalTriangles[triangle] = {normal, normal, normal};
    }

    // Calls visit(PointNormals&, the corners around a point) for each point that has any. Points
    // are visited in parts by several threads; the normals are numbered in the order of the points.
    template <class Visit> void forEachPoint(const Visit& visit) {
        const CornersByPoint byPoint(mesh_);
        constexpr std::size_t kTogether = 1 << 13;
        const std::size_t points = mesh_.points.size();
        std::vector<PointNormals> parts((points + kTogether - 1) / kTogether,
                                        PointNormals(mesh_, shapes_));
        forEachOn(threads_, parts.size(), [&](std::size_t i) {
            visitPoints(byPoint, i * kTogether, std::min(points, (i + 1) * kTogether), parts[i],
                        visit);
        });
        std::vector<Index> before(parts.size());
        auto count = static_cast<Index>(mesh_.normals.size());
        for (std::size_t i = 0; i < parts.size(); ++i)
            before[i] = std::exchange(count, count + static_cast<Index>(parts[i].normals.size()));
        mesh_.normals.resize(count);
        forEachOn(threads_, parts.size(), [&](std::size_t i) {
            std::copy(parts[i].normals.begin(), parts[i].normals.end(),
                      mesh_.normals.begin() + before[i]);
            moveNumbers(byPoint, i * kTogether, std::min(points, (i + 1) * kTogether), before[i]);
        });
    }

private:
    template <class Visit>
    void visitPoints(const CornersByPoint& byPoint, std::size_t first, std::size_t last,
                     PointNormals& normals, const Visit& visit) const {
        std::vector<Around> around;
        for (std::size_t i = first; i < last; ++i) {
            around.clear();
            for (Index at = byPoint.starts[i]; at < byPoint.starts[i + 1]; ++at) {
                const Index triangle = byPoint.corners[at] / 3, k = byPoint.corners[at] % 3;
                const TriangleShape& shape = shapes_[triangle];
                around.push_back({triangle, k, shape.normal * shape.angle[k]});
            }
            if (!around.empty()) visit(normals, std::span<Around>(around));
        }
    }
    void moveNumbers(const CornersByPoint& byPoint, std::size_t first, std::size_t last,
                     Index before) {
        for (Index at = byPoint.starts[first]; at < byPoint.starts[last]; ++at) {
            const Index triangle = byPoint.corners[at] / 3, k = byPoint.corners[at] % 3;
            if (groups_.empty() || groups_[triangle] != 0)
                mesh_.normalTriangles[triangle][k] += before;
        }
    }

    MeshDesc& mesh_;
    std::span<const Index> groups_;
    int threads_;
    std::vector<TriangleShape> shapes_;
};

// Directions in cells of about ten degrees, 9 x 9 on each side of a cube. Around points with very
// many triangles these are compared instead of the triangles, whose pairs would take for ever.
constexpr Index kCellsPerSide = 9, kCells = 6 * kCellsPerSide * kCellsPerSide + 1;
constexpr std::size_t kManyTriangles = 512;
Index cellOf(Vec3d n) {
    const double size = maxAbs(n);
    if (!(size > 0)) return kCells - 1;
    Index axis = 0;
    while (std::fabs(n[axis]) < size) ++axis;
    const auto step = [&](double x) {
        return std::min(kCellsPerSide - 1,
                        static_cast<Index>((x / size * 0.5 + 0.5) * kCellsPerSide));
    };
    const Index side = 2 * axis + (n[axis] > 0 ? 1 : 0);
    return (side * kCellsPerSide + step(n[(axis + 1) % 3])) * kCellsPerSide +
           step(n[(axis + 2) % 3]);
}

// A triangle, or the triangles of one cell: what is compared around a point.
struct Bundle {
    Vec3d direction, weighted;
};

// For each bundle the sum over those that bend less away from it than the angle says; triangles
// without a direction of their own take all.
std::vector<Vec3d> sumsWithin(std::span<const Bundle> bundles, double cosine) {
    std::vector<Vec3d> sums(bundles.size());
    for (std::size_t i = 0; i < bundles.size(); ++i)
        for (std::size_t j = 0; j < bundles.size(); ++j)
            if (i == j || dot(bundles[i].direction, bundles[j].direction) > cosine ||
                maxAbs(bundles[i].direction) == 0)
                sums[i] += bundles[j].weighted;
    return sums;
}

void smoothFew(PointNormals& normals, std::span<const Around> around, double cosine) {
    std::vector<Bundle> bundles;
    bundles.reserve(around.size());
    for (const Around& a : around) bundles.push_back({normals.flat(a.triangle), a.weighted});
    const std::vector<Vec3d> sums = sumsWithin(bundles, cosine);
    // Equal sums are one normal.
    std::vector<Index> numbers(around.size());
    for (std::size_t i = 0; i < around.size(); ++i) {
        const std::size_t first =
            static_cast<std::size_t>(std::find(sums.begin(), sums.end(), sums[i]) - sums.begin());
        numbers[i] = first < i ? numbers[first] : normals.add(sums[i], around[i].triangle);
        normals.set(around[i], numbers[i]);
    }
}

void smoothMany(PointNormals& normals, std::span<const Around> around, double cosine) {
    constexpr Index kNone = 0xffffffffu;
    std::vector<Index> bundleOfCell(kCells, kNone);
    std::vector<Bundle> bundles;
    std::vector<Index> bundleOf, firstTriangle;
    for (const Around& a : around) {
        Index& bundle = bundleOfCell[cellOf(normals.flat(a.triangle))];
        if (bundle == kNone) {
            bundle = static_cast<Index>(bundles.size());
            bundles.push_back({});
            firstTriangle.push_back(a.triangle);
        }
        bundles[bundle].direction += normals.flat(a.triangle);
        bundles[bundle].weighted += a.weighted;
        bundleOf.push_back(bundle);
    }
    for (Bundle& b : bundles)
        if (maxAbs(b.direction) > 0) b.direction = normalize(b.direction);
    const std::vector<Vec3d> sums = sumsWithin(bundles, cosine);
    std::vector<Index> numbers;
    for (std::size_t i = 0; i < bundles.size(); ++i)
        numbers.push_back(normals.add(sums[i], firstTriangle[i]));
    for (std::size_t i = 0; i < around.size(); ++i) normals.set(around[i], numbers[bundleOf[i]]);
}

} // namespace

void smoothByAngle(MeshDesc& mesh, double smoothAngleDeg, int threads) {
    if (!(smoothAngleDeg > 0)) {
        mesh.normals.clear();
        mesh.normalTriangles.clear();
        return;
    }
    Smoother smoother(mesh, {}, threads);
    if (smoothAngleDeg >= 180)
        return smoother.forEachPoint([](PointNormals& normals, std::span<const Around> around) {
            normals.shareAll(around);
        });
    const double cosine = exact::cos(radians(smoothAngleDeg));
    smoother.forEachPoint([&](PointNormals& normals, std::span<const Around> around) {
        if (around.size() > kManyTriangles)
            smoothMany(normals, around, cosine);
        else
            smoothFew(normals, around, cosine);
    });
}

void smoothByGroup(MeshDesc& mesh, std::span<const std::uint32_t> groups, int threads) {
    Smoother smoother(mesh, groups, threads);
    for (Index i = 0; i < mesh.triangles.size(); ++i)
        if (groups[i] == 0) smoother.keepFlat(i);
    smoother.forEachPoint([&](PointNormals& normals, std::span<Around> around) {
        const auto isBefore = [&](const Around& a, const Around& b) {
            return groups[a.triangle] < groups[b.triangle];
        };
        // Most points have triangles of one group only.
        if (!std::is_sorted(around.begin(), around.end(), isBefore))
            std::stable_sort(around.begin(), around.end(), isBefore);
        for (std::size_t first = 0, last = 0; first < around.size(); first = last) {
            const Index group = groups[around[first].triangle];
            while (last < around.size() && groups[around[last].triangle] == group) ++last;
            if (group != 0) normals.shareAll(around.subspan(first, last - first));
        }
    });
}
