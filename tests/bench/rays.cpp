#include "bench/rays.h"

#include "sample/warp.h"

namespace {

constexpr int kSide = 1024, kTile = 16;
constexpr int kTilesPerBatch = 16; // 4096 rays, as many as the renderer traces together

struct View {
    Vec3d eye, forward, right, up; // right and up of half the picture's size, at distance 1
    Vec3d light;
    double diagonal;
};

View viewOf(const MeshGeometry& geometry, BenchView from) {
    Bounds box;
    for (const auto& corners : geometry.triangles)
        for (const std::uint32_t corner : corners) box.extend(geometry.points[corner]);
    const Vec3d lo = toDouble(box.lo), hi = toDouble(box.hi), centre = (lo + hi) * 0.5;
    View view;
    view.diagonal = length(hi - lo);
    const auto at = [&](double x, double y, double z) {
        return lo + Vec3d{x * (hi - lo).x, y * (hi - lo).y, z * (hi - lo).z};
    };
    const bool inside = from == BenchView::Inside;
    view.eye = inside ? at(0.15, 0.3, 0.55)
                      : centre + normalize(Vec3d{0.6, 0.4, 1}) * (0.9 * view.diagonal);
    view.light = inside ? at(0.5, 0.8, 0.5) : centre + Vec3d{-0.8, 1.2, 0.6} * view.diagonal;
    view.forward = normalize((inside ? at(1, 0.35, 0.5) : centre) - view.eye);
    const Vec3d right = normalize(cross(view.forward, Vec3d{0, 1, 0}));
    const double tangent = exact::tan(radians(inside ? 30.0 : 22.5)); // half the height
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
    Vec3d p, n; // p a little off the surface, n to the viewer
};

HitPoint pointOf(const Hit& hit, Vec3d dir, const MeshGeometry& geometry, const View& view) {
    const auto& c = geometry.triangles[hit.prim];
    const Vec3d a = toDouble(geometry.points[c[0]]);
    Vec3d n =
        normalize(cross(toDouble(geometry.points[c[1]]) - a, toDouble(geometry.points[c[2]]) - a));
    if (dot(n, dir) > 0) n = -n;
    const Vec3d p = view.eye + dir * static_cast<double>(hit.t);
    return {p + n * (1e-4 * view.diagonal), n};
}

struct Pixel {
    int x, y;
};
// Pixel i of a tile.
Pixel pixelOf(int tile, int i) {
    const int block = i / 16, inside = i % 16;
    return {tile % (kSide / kTile) * kTile + squareX(block) * 4 + inside % 4,
            tile / (kSide / kTile) * kTile + squareY(block) * 4 + inside / 4};
}

Vec3d directionOf(Pixel pixel, const View& view) {
    return normalize(view.forward + view.right * ((2 * pixel.x + 1.0) / kSide - 1) +
                     view.up * (1 - (2 * pixel.y + 1.0) / kSide));
}

} // namespace

RaySpan BenchRays::batch(std::size_t i) const {
    return part(batches[i], batches[i + 1] - batches[i]);
}

RaySpan BenchRays::part(std::size_t first, std::size_t count) const {
    const auto of = [&](const auto& all) { return std::span(all).subspan(first, count); };
    return {of(org), of(dir), of(tMin), of(tMax), of(time)};
}

void BenchRays::push(Vec3 from, Vec3 towards, float tEnd) {
    org.push_back(from), dir.push_back(towards);
    tMin.push_back(0), tMax.push_back(tEnd), time.push_back(0);
}

std::vector<BenchRays> benchRays(const MeshGeometry& geometry, BenchView from) {
    const View view = viewOf(geometry, from);
    const Mesh mesh(geometry, {0}, {{0, 0}});
    std::vector<BenchRays> sets(4);
    BenchRays &primary = sets[0], &shadow = sets[1], &bounce = sets[2], &bounceAny = sets[3];
    primary.name = "primary", shadow.name = "shadow";
    bounce.name = "bounce", bounceAny.name = "bounceany";
    shadow.anyHit = bounceAny.anyHit = true;
    for (BenchRays& set : sets) set.endBatch();
    const Vec3 light = toFloat(view.light);
    constexpr std::size_t kTileRays = kTile * kTile;
    std::vector<Hit> hits(kTileRays);
    for (int tile = 0; tile < (kSide / kTile) * (kSide / kTile); ++tile) {
        const std::size_t first = primary.size();
        for (int i = 0; i < kTile * kTile; ++i)
            primary.push(toFloat(view.eye), toFloat(directionOf(pixelOf(tile, i), view)),
                         kInfinityF);
        mesh.intersectBatch(primary.part(first, kTileRays), 0, hits);
        for (int i = 0; i < kTile * kTile; ++i) {
            const Hit& hit = hits[static_cast<std::size_t>(i)];
            if (!hit.isHit()) continue;
            const Pixel pixel = pixelOf(tile, i);
            const HitPoint point = pointOf(hit, directionOf(pixel, view), geometry, view);
            const Vec3 p = toFloat(point.p);
            shadow.push(light, p - light, 1);
            const auto number = static_cast<std::uint32_t>(pixel.y * kSide + pixel.x);
            const Vec2 u{random(2 * number), random(2 * number + 1)};
            const Vec3 away = frameAround(toFloat(point.n)).toWorld(cosineHemisphereFromSquare(u));
            bounce.push(p, away, kInfinityF);
            bounceAny.push(p, away, kInfinityF);
        }
        shadow.endBatch(); // a tile's, as the renderer has them with one sample per pixel
        if (tile % kTilesPerBatch != kTilesPerBatch - 1) continue;
        for (BenchRays* set : {&primary, &bounce, &bounceAny}) set->endBatch();
    }
    return sets;
}
