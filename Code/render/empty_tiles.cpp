#include "render/empty_tiles.h"

#include <array>

namespace {

// More boxes than these cost more than the rays of a tile that they keep away: one box around all.
constexpr std::size_t kMostBoxes = 64;

// The four sides of the pyramid (of a perspective camera) or prism that a rectangle of the picture
// sees, as planes that face inwards.
struct View {
    struct Side {
        Vec3d point, normal; // of unit length
    };
    std::array<Side, 4> sides;

    View(const Camera& camera, Vec2d lo, Vec2d hi) {
        const std::array<Vec2d, 4> corners{lo, {hi.x, lo.y}, hi, {lo.x, hi.y}};
        const Camera::Line middle = camera.line({0.5 * (lo.x + hi.x), 0.5 * (lo.y + hi.y)});
        const Vec3d inside = middle.org + middle.dir;
        for (std::size_t i = 0; i < 4; ++i) {
            const Camera::Line a = camera.line(corners[i]), b = camera.line(corners[(i + 1) % 4]);
            const Vec3d across = (b.org + b.dir) - (a.org + a.dir);
            const Vec3d n = normalize(cross(a.dir, across));
            sides[i] = {a.org, dot(n, inside - a.org) < 0 ? -n : n};
        }
    }

    // NaN, of a view without area, misses nothing.
    bool misses(const BoundsD& box, double slack) const {
        const Vec3d centre = box.centre(), half = box.size() * 0.5;
        for (const Side& side : sides) {
            const Vec3d n = side.normal;
            const double most = dot(n, centre - side.point) + std::fabs(n.x) * half.x +
                                std::fabs(n.y) * half.y + std::fabs(n.z) * half.z;
            if (most < -slack) return true;
        }
        return false;
    }
};

} // namespace

EmptyTiles::EmptyTiles(const IntegratorContext& context, const CameraRays& rays)
    : rays_(rays), camera_(context.scene.camera()) {
    const ShapeSet& shapes = context.scene.shapes();
    canTell_ = context.settings.specialise && context.scene.environment() == nullptr &&
               shapes.unbounded.empty() && shapes.distant.empty() &&
               (context.scene.pathLights().unshapedSeenBy() & PathLights::kSeesAsCamera) == 0 &&
               !camera_.hasLens() && !camera_.isMoving();
    if (!canTell_) return;
    const bool areFew = shapes.bounded.size() <= kMostBoxes;
    BoundsD all;
    for (const std::uint32_t number : shapes.bounded) {
        const BoundsD box = toDouble(shapes.boxes[number]);
        if (areFew) boxes_.push_back(box);
        all.extend(box);
    }
    if (!areFew) boxes_.push_back(all);
    // Rays are rounded to 2^-24 of their coordinates, boxes padded, and a triangle may be met 2^-20
    // of them off its edges.
    const Camera::Line line = camera_.line({0, 0});
    slack_ = 0x1p-16 * (static_cast<double>(shapes.extent) + maxAbs(line.org));
}

bool EmptyTiles::isEmpty(const Tile& tile) const {
    if (!canTell_) return false;
    const double reach = rays_.reach() * (1 + 0x1p-20);
    const Vec2d first = rays_.middle(tile.x0, tile.y0);
    const Vec2d last = rays_.middle(tile.x1 - 1, tile.y1 - 1);
    // A hundredth of a pixel more: a view of one corner must have an area.
    const double more = reach + 0.01;
    const View view(camera_, {first.x - more, first.y - more}, {last.x + more, last.y + more});
    for (const BoundsD& box : boxes_)
        if (!view.misses(box, slack_)) return false;
    return true;
}
