#include "cli/bench_rays.h"

#include "sample/warp.h"

#include <algorithm>
#include <optional>

namespace {

constexpr int kSide = 1024, kTile = 16;
constexpr int kTilesPerBatch = 16; // 4096 rays, as many as the renderer traces together

struct View {
    Vec3d eye, forward, right, up; // right and up of half the picture's size, at distance 1
    Vec3d light;
    double diagonal;
};

// Eye 0.9 diagonals of the box from its centre, 45 degrees up and down; light above and behind.
View viewOf(const MeshGeometry& geometry) {
    Bounds box;
    for (const auto& corners : geometry.triangles)
        for (const std::uint32_t corner : corners) box.extend(geometry.points[corner]);
    const Vec3d lo = toDouble(box.lo), hi = toDouble(box.hi), centre = (lo + hi) * 0.5;
    View view;
    view.diagonal = length(hi - lo);
    view.eye = centre + normalize(Vec3d{0.6, 0.4, 1}) * (0.9 * view.diagonal);
    view.light = centre + Vec3d{-0.8, 1.2, 0.6} * view.diagonal;
    view.forward = normalize(centre - view.eye);
    const Vec3d right = normalize(cross(view.forward, Vec3d{0, 1, 0}));
    const double tangent = exact::tan(radians(22.5));
    view.right = right * tangent;
    view.up = cross(right, view.forward) * tangent;
    return view;
}

// Bits 0, 2 of i are x, bits 1, 3 y: neighbours in a 4 x 4 square in Z order.
int squareX(int i) { return (i & 1) | (i >> 1 & 2); }
int squareY(int i) { return (i >> 1 & 1) | (i >> 2 & 2); }

// PCG of one word (Jarzynski, Olano 2020), as the peers' programs have it.
float random(std::uint32_t seed) {
    const std::uint32_t state = seed * 747796405u + 2891336453u;
    const std::uint32_t word = ((state >> ((state >> 28) + 4)) ^ state) * 277803737u;
    return static_cast<float>((word >> 22) ^ word) * 0x1p-32f;
}

struct HitPoint {
    Vec3d p, n;
};

std::optional<HitPoint> firstHit(const Mesh& mesh, const MeshGeometry& geometry, const View& view,
                                 Vec3d dir) {
    const Ray ray{toFloat(view.eye), toFloat(dir)};
    Hit hit;
    if (!mesh.intersect(ray, hit)) return std::nullopt;
    const auto& c = geometry.triangles[hit.prim];
    const Vec3d a = toDouble(geometry.points[c[0]]);
    Vec3d n =
        normalize(cross(toDouble(geometry.points[c[1]]) - a, toDouble(geometry.points[c[2]]) - a));
    if (dot(n, dir) > 0) n = -n;
    const Vec3d p = view.eye + dir * static_cast<double>(hit.t);
    return HitPoint{p + n * (1e-4 * view.diagonal), n};
}

} // namespace

RaySpan BenchRays::batch(std::size_t i) const {
    const std::size_t first = batches[i], n = batches[i + 1] - first;
    const auto part = [&](const auto& all) { return std::span(all).subspan(first, n); };
    return {part(org), part(dir), part(tMin), part(tMax), part(time)};
}

void BenchRays::push(Vec3 from, Vec3 towards, float tEnd) {
    org.push_back(from), dir.push_back(towards);
    tMin.push_back(0), tMax.push_back(tEnd), time.push_back(0);
}

std::vector<BenchRays> benchRays(const MeshGeometry& geometry) {
    const View view = viewOf(geometry);
    const Mesh mesh(geometry, {0}, {{0, 0}});
    std::vector<BenchRays> sets(4);
    BenchRays &primary = sets[0], &shadow = sets[1], &bounce = sets[2], &bounceAny = sets[3];
    primary.name = "primary", shadow.name = "shadow";
    bounce.name = "bounce", bounceAny.name = "bounceany";
    shadow.anyHit = bounceAny.anyHit = true;
    for (BenchRays& set : sets) set.endBatch();
    const Vec3 light = toFloat(view.light);
    for (int tile = 0; tile < (kSide / kTile) * (kSide / kTile); ++tile) {
        const int x0 = tile % (kSide / kTile) * kTile, y0 = tile / (kSide / kTile) * kTile;
        for (int i = 0; i < kTile * kTile; ++i) {
            const int block = i / 16, inside = i % 16;
            const int x = x0 + squareX(block) * 4 + inside % 4;
            const int y = y0 + squareY(block) * 4 + inside / 4;
            const Vec3d dir = normalize(view.forward + view.right * ((2 * x + 1.0) / kSide - 1) +
                                        view.up * (1 - (2 * y + 1.0) / kSide));
            primary.push(toFloat(view.eye), toFloat(dir), kInfinityF);
            const auto hit = firstHit(mesh, geometry, view, dir);
            if (!hit) continue;
            const Vec3 p = toFloat(hit->p);
            shadow.push(light, p - light, 1);
            const auto pixel = static_cast<std::uint32_t>(y * kSide + x);
            const Vec2 u{random(2 * pixel), random(2 * pixel + 1)};
            const Vec3 away = frameAround(toFloat(hit->n)).toWorld(cosineHemisphereFromSquare(u));
            bounce.push(p, away, kInfinityF);
            bounceAny.push(p, away, kInfinityF);
        }
        shadow.endBatch(); // a tile's, as the renderer has them with one sample per pixel
        if (tile % kTilesPerBatch != kTilesPerBatch - 1) continue;
        for (BenchRays* set : {&primary, &bounce, &bounceAny}) set->endBatch();
    }
    return sets;
}
