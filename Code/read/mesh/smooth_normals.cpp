#include "read/mesh/smooth_normals.h"

#include "base/math.h"

#include <algorithm>
#include <utility>
#include <vector>

namespace {

using Index = std::uint32_t;

// Unit normals; zero for a triangle without area, so that it has no weight.
std::vector<Vec3d> triangleNormals(const MeshDesc& mesh) {
    std::vector<Vec3d> normals;
    normals.reserve(mesh.triangles.size());
    for (const MeshDesc::Corners& t : mesh.triangles) {
        const Vec3d a = mesh.points[t[1]] - mesh.points[t[0]],
                    b = mesh.points[t[2]] - mesh.points[t[0]];
        // The sides' own lengths first: their squares could leave double.
        const double sizeA = maxAbs(a), sizeB = maxAbs(b);
        const Vec3d n = sizeA > 0 && sizeB > 0 ? cross(a / sizeA, b / sizeB) : Vec3d{};
        const double size = maxAbs(n);
        normals.push_back(size > 0 ? normalize(n / size) : Vec3d{});
    }
    return normals;
}

double angleBetween(Vec3d a, Vec3d b) {
    const double sizeA = maxAbs(a), sizeB = maxAbs(b);
    if (!(sizeA > 0 && sizeB > 0)) return 0;
    a = a / sizeA;
    b = b / sizeB;
    return exact::atan2(length(cross(a, b)), dot(a, b));
}

// A corner of a triangle as seen from its point.
struct Around {
    Index triangle = 0, corner = 0;
    Vec3d weighted; // the triangle's normal times its angle here
};

// The corners of all triangles in the order of their points, by counting: those of point i are
// [starts[i], starts[i + 1]) of `corners`, numbered 3 * triangle + corner.
struct CornersByPoint {
    std::vector<Index> starts, corners;

    explicit CornersByPoint(const MeshDesc& mesh)
        : starts(mesh.points.size() + 1), corners(mesh.triangles.size() * 3) {
        for (const MeshDesc::Corners& t : mesh.triangles)
            for (const Index point : t) ++starts[point];
        Index sum = 0;
        for (Index& start : starts) sum += std::exchange(start, sum);
        for (Index i = 0; i < mesh.triangles.size(); ++i)
            for (Index k = 0; k < 3; ++k) corners[starts[mesh.triangles[i][k]]++] = 3 * i + k;
        // Each start has moved to the next one's place.
        std::move_backward(starts.begin(), starts.end() - 1, starts.end());
        starts.front() = 0;
    }
};

class Smoother {
public:
    explicit Smoother(MeshDesc& mesh) : mesh_(mesh), flat_(triangleNormals(mesh)) {
        mesh.normals.clear();
        mesh.normalTriangles.assign(mesh.triangles.size(), {});
    }

    const Vec3d& flat(Index triangle) const { return flat_[triangle]; }

    // Calls with the corners around each point that has any.
    template <class Visit> void forEachPoint(Visit visit) {
        const CornersByPoint byPoint(mesh_);
        std::vector<Around> around;
        for (std::size_t i = 0; i < mesh_.points.size(); ++i) {
            around.clear();
            for (Index at = byPoint.starts[i]; at < byPoint.starts[i + 1]; ++at) {
                const Index triangle = byPoint.corners[at] / 3, k = byPoint.corners[at] % 3;
                const MeshDesc::Corners& t = mesh_.triangles[triangle];
                const Vec3d p = mesh_.points[i];
                const double angle = angleBetween(mesh_.points[t[(k + 1) % 3]] - p,
                                                  mesh_.points[t[(k + 2) % 3]] - p);
                around.push_back({triangle, k, flat_[triangle] * angle});
            }
            if (!around.empty()) visit(std::span<Around>(around));
        }
    }

    // A sum without direction (sides that face each other) leaves the triangle as flat as it is.
    Index add(Vec3d sum, Index triangle) {
        const double size = maxAbs(sum);
        const Vec3d n = size > 1e-12                 ? normalize(sum / size)
                        : maxAbs(flat(triangle)) > 0 ? flat(triangle)
                                                     : Vec3d{0, 0, 1};
        mesh_.normals.push_back(toFloat(n));
        return static_cast<Index>(mesh_.normals.size() - 1);
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

private:
    MeshDesc& mesh_;
    std::vector<Vec3d> flat_;
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

void smoothFew(Smoother& smoother, std::span<const Around> around, double cosine) {
    std::vector<Bundle> bundles;
    bundles.reserve(around.size());
    for (const Around& a : around) bundles.push_back({smoother.flat(a.triangle), a.weighted});
    const std::vector<Vec3d> sums = sumsWithin(bundles, cosine);
    // Equal sums are one normal.
    std::vector<Index> normals(around.size());
    for (std::size_t i = 0; i < around.size(); ++i) {
        const std::size_t first =
            static_cast<std::size_t>(std::find(sums.begin(), sums.end(), sums[i]) - sums.begin());
        normals[i] = first < i ? normals[first] : smoother.add(sums[i], around[i].triangle);
        smoother.set(around[i], normals[i]);
    }
}

void smoothMany(Smoother& smoother, std::span<const Around> around, double cosine) {
    constexpr Index kNone = 0xffffffffu;
    std::vector<Index> bundleOfCell(kCells, kNone);
    std::vector<Bundle> bundles;
    std::vector<Index> bundleOf, firstTriangle;
    for (const Around& a : around) {
        Index& bundle = bundleOfCell[cellOf(smoother.flat(a.triangle))];
        if (bundle == kNone) {
            bundle = static_cast<Index>(bundles.size());
            bundles.push_back({});
            firstTriangle.push_back(a.triangle);
        }
        bundles[bundle].direction += smoother.flat(a.triangle);
        bundles[bundle].weighted += a.weighted;
        bundleOf.push_back(bundle);
    }
    for (Bundle& b : bundles)
        if (maxAbs(b.direction) > 0) b.direction = normalize(b.direction);
    const std::vector<Vec3d> sums = sumsWithin(bundles, cosine);
    std::vector<Index> normals;
    for (std::size_t i = 0; i < bundles.size(); ++i)
        normals.push_back(smoother.add(sums[i], firstTriangle[i]));
    for (std::size_t i = 0; i < around.size(); ++i) smoother.set(around[i], normals[bundleOf[i]]);
}

} // namespace

void smoothByAngle(MeshDesc& mesh, double smoothAngleDeg) {
    if (!(smoothAngleDeg > 0)) {
        mesh.normals.clear();
        mesh.normalTriangles.clear();
        return;
    }
    Smoother smoother(mesh);
    if (smoothAngleDeg >= 180)
        return smoother.forEachPoint([&](std::span<Around> around) { smoother.shareAll(around); });
    const double cosine = exact::cos(radians(smoothAngleDeg));
    smoother.forEachPoint([&](std::span<Around> around) {
        if (around.size() > kManyTriangles)
            smoothMany(smoother, around, cosine);
        else
            smoothFew(smoother, around, cosine);
    });
}

void smoothByGroup(MeshDesc& mesh, std::span<const std::uint32_t> groups) {
    Smoother smoother(mesh);
    for (Index i = 0; i < mesh.triangles.size(); ++i)
        if (groups[i] == 0) {
            const Index normal = smoother.add({}, i);
            mesh.normalTriangles[i] = {normal, normal, normal};
        }
    smoother.forEachPoint([&](std::span<Around> around) {
        const auto groupOf = [&](const Around& a) { return groups[a.triangle]; };
        std::stable_sort(around.begin(), around.end(),
                         [&](const Around& a, const Around& b) { return groupOf(a) < groupOf(b); });
        for (std::size_t first = 0, last = 0; first < around.size(); first = last) {
            while (last < around.size() && groupOf(around[last]) == groupOf(around[first])) ++last;
            if (groupOf(around[first]) != 0) smoother.shareAll(around.subspan(first, last - first));
        }
    });
}
