#include "render/thin_places.h"

#include "render/outline.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <numbers>
#include <optional>
#include <span>

namespace {

// ---- bodies as hulls of points

using Body = std::vector<BodyBall>;

constexpr std::size_t kRim = 8; // points of a circle
// Points of a rim leave out so much of the radius between them.
const double kLeftOut = 1 - std::cos(std::numbers::pi / kRim);

void addRim(const Transform& place, double z, double radius, Body& body) {
    for (std::size_t i = 0; i < kRim; ++i) {
        const exact::SinCos at = exact::sinCos(2 * kPi * static_cast<double>(i) / kRim);
        body.push_back({place.point({radius * at.cos, radius * at.sin, z}), 0});
    }
}
void addBox(const Transform& place, const BoundsD& box, Body& body) {
    for (int i = 0; i < 8; ++i) body.push_back({place.point(box.corner(i)), 0});
}
void addCorners(const StillShape& shape, Body& body) {
    const StillCorners& flat = *shape.corners;
    const std::size_t z = 3 - flat.axisX - flat.axisY;
    for (const StillCorners::Edge& edge : flat.edges) {
        Vec3d p = flat.centre;
        p[flat.axisX] = edge.from.x, p[flat.axisY] = edge.from.y;
        p[z] -= dot(flat.normal, p - flat.centre) / flat.normal[z];
        body.push_back({shape.worldFromObject.point(p), 0});
    }
}
// Returns the hull of a shape; what moves is as large as its box.
Body bodyOf(const Bounds& box, const SolidForm& form) {
    Body body;
    const BoundsD unit{{-1, -1, -1}, {1, 1, 1}};
    if (!form.motion && form.sphere != nullptr && form.hull.radius < kInfinity)
        body.push_back({form.hull.centre, form.hull.radius});
    else if (!form.motion && form.tube) {
        const StillTube& tube = *form.tube;
        const StillShape& shape = *tube.shape;
        const bool isCone = shape.kind == StillShape::Kind::Cone;
        addRim(shape.worldFromObject, -1, isCone ? shape.cone->radius : shape.radius, body);
        addRim(shape.worldFromObject, 1, isCone ? shape.cone->topRadius : shape.radius, body);
    } else if (!form.motion && form.faces && form.faces->of == StillFaces::Of::Cube)
        addBox(form.faces->shape->worldFromObject, unit, body);
    else if (!form.motion && form.faces && form.faces->of == StillFaces::Of::Disk)
        addRim(form.faces->shape->worldFromObject, 0, form.faces->shape->radius, body);
    else if (!form.motion && form.faces && form.faces->of == StillFaces::Of::Corners)
        addCorners(*form.faces->shape, body);
    else
        addBox(Transform(), toDouble(box), body);
    return body;
}

// ---- triangles of meshes

// Keeps the part of a convex polygon where n . p <= limit; kept in the order of its corners.
void clip(std::vector<Vec2d>& polygon, Vec2d n, double limit) {
    static thread_local std::vector<Vec2d> out;
    out.clear();
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const Vec2d a = polygon[i], b = polygon[(i + 1) % polygon.size()];
        const double da = n.x * a.x + n.y * a.y - limit, db = n.x * b.x + n.y * b.y - limit;
        if (da <= 0) out.push_back(a);
        if ((da < 0 && db > 0) || (da > 0 && db < 0)) out.push_back(a + (b - a) * (da / (da - db)));
    }
    polygon.swap(out);
}
// Returns twice the area, with the sign of the way around.
double area2(const std::vector<Vec2d>& polygon) {
    double sum = 0;
    for (std::size_t i = 2; i < polygon.size(); ++i) {
        const Vec2d a = polygon[i - 1] - polygon[0], b = polygon[i] - polygon[0];
        sum += a.x * b.y - a.y * b.x;
    }
    return sum;
}

// ---- the picture

class Marks {
public:
    Marks(const Scene& scene, int width, int height, double reach, std::vector<std::uint16_t>& to)
        : map_(scene.camera()), width_(width), height_(height),
          // Samples of a pixel go so far beyond its sides.
          beyond_(std::max(reach - 0.5, 0.0)), columns_((width + kSide - 1) / kSide),
          rows_((height + kSide - 1) / kSide), samples_(to) {}

    void addShape(const Shape& shape, const Bounds& box) {
        bool isMesh = false;
        shape.forEachTriangle(
            [&](std::uint32_t, const std::array<Vec3, 3>& corners, std::uint32_t) {
                isMesh = true;
                addTriangle(corners);
            });
        if (isMesh) return;
        const SolidForm form = shape.solidForm();
        addBody(bodyOf(box, form));
    }
    // Marks pixels that small triangles cover in part, and that have none beside them which are
    // covered: that would be the edge of something large.
    void addMeshes() {
        if (front_.empty()) return;
        const auto covered = [&](int x, int y) {
            if (x < 0 || y < 0 || x >= width_ || y >= height_) return 0.0f;
            return std::max(front_[index(x, y)], back_[index(x, y)]);
        };
        for (int y = 0; y < height_; ++y)
            for (int x = 0; x < width_; ++x) {
                if (!(covered(x, y) > 0)) continue;
                float most = 0, sum = 0;
                std::array<bool, 3> columns{}, rows{}; // where something is covered
                for (std::size_t j = 0; j < 3; ++j)
                    for (std::size_t i = 0; i < 3; ++i) {
                        const float of =
                            covered(x - 1 + static_cast<int>(i), y - 1 + static_cast<int>(j));
                        most = std::max(most, of), sum += of;
                        columns[i] |= of > 0, rows[j] |= of > 0;
                    }
                constexpr float kWhole = 0.98f;
                if (most >= kWhole) continue;
                const bool isLong = (columns[0] && columns[2]) || (rows[0] && rows[2]);
                const double least = isLong ? kThinnest * kLongest : kThinnest * kThinnest;
                mark({{static_cast<double>(x), static_cast<double>(x + 1)},
                      {static_cast<double>(y), static_cast<double>(y + 1)}},
                     std::max(static_cast<double>(sum), least), [](double, double) { return true; });
            }
    }

private:
    static constexpr int kSide = ThinPlaces::kSide;
    // In pixels: what is thinner counts as if it were as wide as this, and of what is long so much counts, as lies
    // about one pixel.
    static constexpr double kThinnest = 1.0 / 8, kLongest = 2;
    struct Box {
        Extent x, y;
    };

    // Returns the least power of two of which twelve meet an area of so many pixels, on average, so that one at least
    // does.
    static std::uint16_t samplesFor(double area) {
        const double wanted = 12 / area;
        if (!(wanted < ThinPlaces::kMostSamples)) return ThinPlaces::kMostSamples;
        return static_cast<std::uint16_t>(
            std::bit_ceil(static_cast<unsigned>(std::ceil(wanted))));
    }
    // Marks blocks that touch a box and of which isHit(x, y) holds at their middles.
    template <class IsHit> void mark(const Box& box, double area, const IsHit& isHit) {
        const std::uint16_t samples = samplesFor(area);
        if (samples <= 1) return;
        const auto range = [&](const Extent& extent, int blocks) {
            const double low = std::floor((extent.low - beyond_) / kSide),
                         high = std::floor((extent.high + beyond_) / kSide);
            return std::array{static_cast<int>(std::clamp(low, 0.0, double(blocks))),
                              static_cast<int>(std::clamp(high, -1.0, double(blocks - 1)))};
        };
        const auto [left, right] = range(box.x, columns_);
        const auto [top, bottom] = range(box.y, rows_);
        for (int row = top; row <= bottom; ++row)
            for (int column = left; column <= right; ++column) {
                if (!isHit((column + 0.5) * kSide, (row + 0.5) * kSide)) continue;
                std::uint16_t& there = samples_[static_cast<std::size_t>(row) *
                                                    static_cast<std::size_t>(columns_) +
                                                static_cast<std::size_t>(column)];
                there = std::max(there, samples);
            }
    }
    void addBody(const Body& body) {
        const std::vector<OutlineDisk> outline = outlineOf(map_, body);
        if (outline.empty()) return;
        const Vec2d n = narrowestWay(outline);
        const double width = std::max(extentAlong(outline, n, false).size(), kThinnest);
        const double length =
            std::clamp(extentAlong(outline, {-n.y, n.x}, false).size(), kThinnest, kLongest);
        const Extent strip = extentAlong(outline, n, true);
        const double more = kLeftOut * strip.size() + beyond_ +
                            kSide * 0.5 * (std::fabs(n.x) + std::fabs(n.y));
        Box box{extentAlong(outline, {1, 0}, true), extentAlong(outline, {0, 1}, true)};
        for (Extent* const extent : {&box.x, &box.y}) {
            const double left = kLeftOut * extent->size();
            extent->low -= left, extent->high += left;
        }
        mark(box, width * length, [&](double x, double y) {
            const double at = x * n.x + y * n.y;
            return at > strip.low - more && at < strip.high + more;
        });
    }

    void addTriangle(const std::array<Vec3, 3>& corners) {
        std::array<OutlineDisk, 3> outline;
        for (std::size_t i = 0; i < 3; ++i) {
            const BodyBall corner{toDouble(corners[i]), 0};
            if (!(map_.depth(corner.centre) > 0)) return; // behind the camera, or so near that it is large
            outline[i] = map_.disk(corner);
        }
        const Extent x = extentAlong(outline, {1, 0}, false),
                     y = extentAlong(outline, {0, 1}, false);
        if (!(x.high > 0 && y.high > 0 && x.low < width_ && y.low < height_)) return;
        const double size = std::min(x.size(), y.size());
        if (size > 1 && extentAlong(outline, narrowestWay(outline), false).size() > 1) return;
        if (front_.empty()) {
            const auto pixels =
                static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_);
            front_.resize(pixels), back_.resize(pixels);
        }
        cover({outline[0].centre, outline[1].centre, outline[2].centre}, x, y);
    }
    // Adds the area of a triangle to the pixels that it touches.
    void cover(const std::array<Vec2d, 3>& corners, const Extent& x, const Extent& y) {
        const Vec2d a = corners[1] - corners[0], b = corners[2] - corners[0];
        const double whole = 0.5 * (a.x * b.y - a.y * b.x);
        const auto add = [&](int i, int j, double area) {
            std::vector<float>& side = area > 0 ? front_ : back_;
            // Seen edge-on it is a line, which counts as hardly anything.
            side[index(i, j)] += std::max(static_cast<float>(std::fabs(area)), 1e-20f);
        };
        if (std::floor(x.low) == std::floor(x.high) && std::floor(y.low) == std::floor(y.high))
            return add(static_cast<int>(x.low), static_cast<int>(y.low), whole);
        const auto first = [](double at) { return std::max(0, static_cast<int>(at)); };
        const auto last = [](double at, int size) {
            return static_cast<int>(std::min(at, size - 1.0));
        };
        static thread_local std::vector<Vec2d> row, part;
        for (int j = first(y.low); j <= last(y.high, height_); ++j) {
            row.assign(corners.begin(), corners.end());
            clip(row, {0, -1}, -j), clip(row, {0, 1}, j + 1.0);
            if (row.empty()) continue;
            Extent inRow;
            for (const Vec2d p : row)
                inRow.low = std::min(inRow.low, p.x), inRow.high = std::max(inRow.high, p.x);
            for (int i = first(inRow.low); i <= last(inRow.high, width_); ++i) {
                part = row;
                clip(part, {-1, 0}, -i), clip(part, {1, 0}, i + 1.0);
                if (part.size() < 3) continue;
                add(i, j, 0.5 * area2(part));
            }
        }
    }
    std::size_t index(int x, int y) const {
        return static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) +
               static_cast<std::size_t>(x);
    }

    PictureMap map_;
    int width_, height_;
    double beyond_;
    int columns_, rows_;
    std::vector<std::uint16_t>& samples_;
    std::vector<float> front_, back_; // what part of a pixel small triangles cover, by side
};

} // namespace

ThinPlaces::ThinPlaces(const Scene& scene, int width, int height, double reach)
    : columns_((width + kSide - 1) / kSide), rows_((height + kSide - 1) / kSide),
      samples_(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_), 1) {
    if (scene.camera().isMoving()) return;
    const ShapeSet& set = scene.shapes();
    Marks marks(scene, width, height, reach, samples_);
    for (const std::vector<std::uint32_t>* const some : {&set.bounded, &set.distant})
        for (const std::uint32_t number : *some)
            marks.addShape(*set.shapes[number], set.boxes[number]);
    marks.addMeshes();
}
