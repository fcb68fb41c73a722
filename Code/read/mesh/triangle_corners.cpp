#include "read/mesh/mesh_steps.h"

#include "base/for_each.h"
#include "base/math.h"

#include <algorithm>
#include <utility>

namespace {

using Index = std::uint32_t;

// A side of a triangle over its largest coordinate: squares of the sides' own lengths could leave
// double. Sides of no length stay zero.
struct Side {
    double size;
    Vec3d direction;

    explicit Side(Vec3d v) : size(maxAbs(v)), direction(size > 0 ? v / size : Vec3d{}) {}
    Side(double length, Vec3d v) : size(length), direction(v) {}
    Side operator-() const { return {size, -direction}; }
};

double angleBetween(const Side& a, const Side& b) {
    if (!(a.size > 0 && b.size > 0)) return 0;
    return exact::atan2(length(cross(a.direction, b.direction)), dot(a.direction, b.direction));
}

// Each side is divided once for the two corners that it ends in.
TriangleShape shapeOf(const MeshDesc& mesh, const MeshDesc::Corners& t) {
    const Vec3d p0 = mesh.points[t[0]], p1 = mesh.points[t[1]], p2 = mesh.points[t[2]];
    const Side a(p1 - p0), b(p2 - p0), c(p2 - p1);
    TriangleShape out;
    const Vec3d n = cross(a.direction, b.direction);
    const double size = maxAbs(n);
    if (size > 0) out.normal = normalize(n / size);
    out.angle = {angleBetween(a, b), angleBetween(c, -a), angleBetween(-b, -c)};
    return out;
}

} // namespace

std::vector<TriangleShape> triangleShapes(const MeshDesc& mesh, int threads) {
    constexpr std::size_t kTogether = 1 << 13;
    std::vector<TriangleShape> shapes(mesh.triangles.size());
    forEachOn(threads, (shapes.size() + kTogether - 1) / kTogether, [&](std::size_t part) {
        const std::size_t last = std::min(shapes.size(), (part + 1) * kTogether);
        for (std::size_t i = part * kTogether; i < last; ++i)
            shapes[i] = shapeOf(mesh, mesh.triangles[i]);
    });
    return shapes;
}

CornersByPoint::CornersByPoint(const MeshDesc& mesh)
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
