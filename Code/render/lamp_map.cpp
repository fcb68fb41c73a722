#include "render/lamp_map.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdlib>
#include <optional>

namespace {

// Fewer solids are found by the tree as fast, and a map takes some rays for each to pay.
constexpr std::size_t kFewestHulls = 64;
constexpr double kRaysForHull = 6;
// The least cosine of a solid's directions to the middle of the picture.
constexpr float kLeastCosine = 0.25f;

// What all of a scene's lamps share: `nearest` is not known yet.
struct MappedShapes {
    RawVector<LampMap::Hull> hulls;
    std::vector<std::uint32_t> numbers; // of their shapes
    std::vector<Occluder> others;
    Bounds box; // of the hulls' shapes
};

// One lies in a plane across an axis, far from which the lamp is: then it does not hide itself.
bool isFlatAcross(const Bounds& box, Vec3 lamp, float extent) {
    for (std::size_t axis = 0; axis < 3; ++axis)
        if (box.lo[axis] == box.hi[axis] &&
            std::fabs(lamp[axis] - box.lo[axis]) > 0x1p-10f * max(extent, maxAbs(lamp)))
            return true;
    return false;
}

std::optional<MappedShapes> shapesOnMap(const ShapeSet& shapes, Vec3 lamp) {
    if (!shapes.placed().isEmpty()) return {};
    MappedShapes out;
    const auto isFull = [&](std::uint32_t number) {
        if (shapes.shadows[number] != ShapeSet::Shadow::Opaque) return false;
        if (out.others.size() == LampMap::kMostOthers) return true;
        Occluder other = occluderOf(shapes, number);
        if (isFlatAcross(other.box, lamp, shapes.extent))
            other.hidesInside = other.hidesOutside = false;
        out.others.push_back(other);
        return false;
    };
    if (std::any_of(shapes.unbounded.begin(), shapes.unbounded.end(), isFull)) return {};
    if (std::any_of(shapes.batched.begin(), shapes.batched.end(), isFull)) return {};
    const SolidTree& tree = shapes.solids();
    out.hulls.reserve(tree.solids.size()), out.numbers.reserve(tree.solids.size());
    for (std::size_t i = 0; i < tree.solids.size(); ++i) {
        const SolidTree::Solid& solid = tree.solids[i];
        if (!solid.hides) continue;
        if (solid.moves) return {};
        const bool isRound = solid.kind != SolidTree::Kind::Facets && solid.radius < kInfinityF &&
                             (!solid.isTube || solid.halfLength < kInfinityF);
        if (!isRound) {
            if (isFull(solid.number)) return {};
            continue;
        }
        const bool isFilled = solid.innerRadius > solid.radius * LampMap::kInner;
        out.hulls.push_back({solid.centre, isFilled ? solid.radius : -solid.radius,
                             solid.isTube ? solid.axis : Vec3{},
                             solid.isTube ? solid.halfLength : 0});
        out.numbers.push_back(solid.number);
        out.box.extend(tree.boxes[i]);
    }
    return out;
}

// What the picture shows of a hull, in units of ahead, and how near it is.
struct Footprint {
    float lo[2], hi[2], nearest;
};

class MapMaker {
public:
    MapMaker(LampMap& map, const MappedShapes& shapes) : map_(map), shapes_(shapes) {}

    // False: the lamp does not see all of them in front of it.
    bool make() {
        if (!aim() || !project() || !frame()) return false;
        sortHulls();
        list();
        return true;
    }

private:
    bool aim() {
        const Vec3 way = (shapes_.box.lo + shapes_.box.hi) * 0.5f - map_.lamp;
        const float distance = length(way);
        if (!(distance > map_.slack)) return false;
        map_.ahead = way / distance;
        const Vec3 a{std::fabs(way.x), std::fabs(way.y), std::fabs(way.z)};
        const Vec3 least = a.x <= a.y && a.x <= a.z ? Vec3{1, 0, 0}
                           : a.y <= a.z             ? Vec3{0, 1, 0}
                                                    : Vec3{0, 0, 1};
        map_.right = normalize(cross(map_.ahead, least));
        map_.up = cross(map_.ahead, map_.right);
        return true;
    }

    bool project() {
        footprints_.resize(shapes_.hulls.size());
        for (std::size_t i = 0; i < footprints_.size(); ++i)
            if (!project(shapes_.hulls[i], footprints_[i])) return false;
        return true;
    }

    float radiusOf(const LampMap::Hull& hull) const {
        return std::fabs(hull.radius) * (1 + 0x1p-18f) + 2 * map_.slack;
    }

    bool project(const LampMap::Hull& hull, Footprint& out) const {
        const Vec3 way = hull.centre - map_.lamp;
        const float radius = radiusOf(hull);
        out = {{kInfinityF, kInfinityF}, {-kInfinityF, -kInfinityF}, 0};
        if (!extend(out, way + hull.axis * hull.halfLength, radius)) return false;
        if (hull.halfLength > 0 && !extend(out, way - hull.axis * hull.halfLength, radius))
            return false;
        const float height = max(-hull.halfLength, min(hull.halfLength, -dot(way, hull.axis)));
        out.nearest = length(way + hull.axis * height) - radius;
        return out.nearest > 0;
    }

    // By the planes through the lamp and along an axis of the picture that touch a ball.
    bool extend(Footprint& out, Vec3 centre, float radius) const {
        const float z = dot(centre, map_.ahead);
        if (!(z - radius >= kLeastCosine * (length(centre) + radius))) return false;
        const float room = z * z - radius * radius, perRoom = 1 / room;
        const auto side = [&](Vec3 axis, std::size_t i) {
            const float x = dot(centre, axis), half = radius * std::sqrt(x * x + room);
            out.lo[i] = min((x * z - half) * perRoom, out.lo[i]);
            out.hi[i] = max((x * z + half) * perRoom, out.hi[i]);
        };
        side(map_.right, 0), side(map_.up, 1);
        return true;
    }

    // Fits the cells about all of them, but for one at each border.
    bool frame() {
        const auto hulls = static_cast<double>(shapes_.hulls.size());
        map_.logCells = static_cast<int>(std::lround(std::log2(std::sqrt(2 * hulls))));
        if (const char* e = std::getenv("LOGCELLS")) map_.logCells = std::atoi(e);
        map_.logCells = std::clamp(map_.logCells, 3, 10);
        map_.leastCosine = kLeastCosine * (1 - 0x1p-10f);
        const auto cells = static_cast<float>(map_.cells());
        for (std::size_t i = 0; i < 2; ++i) {
            float lo = kInfinityF, hi = -kInfinityF;
            for (const Footprint& f : footprints_) lo = min(f.lo[i], lo), hi = max(f.hi[i], hi);
            map_.scale[i] = (cells - 2) / (hi - lo);
            map_.offset[i] = 1 - lo * map_.scale[i];
            // Both the look-up and the footprints are off by some 2^-19 of what they divide.
            const float most = max(std::fabs(lo), std::fabs(hi));
            pad_[i] = map_.scale[i] * (1 + most) * (0x1p-18f / kLeastCosine) + cells * 0x1p-20f;
            if (!(pad_[i] < 0.5f)) return false;
        }
        return true;
    }

    // By the steps that they start in.
    void sortHulls() {
        float lo = kInfinityF, hi = 0;
        for (const Footprint& f : footprints_) lo = min(f.nearest, lo), hi = max(f.nearest, hi);
        map_.firstStep = lo,
        map_.perStep = static_cast<float>(kSteps - 1) / max(hi - lo, lo * 0x1p-10f);
        steps_.resize(footprints_.size());
        std::array<std::uint32_t, kSteps + 1> next{};
        for (std::size_t i = 0; i < footprints_.size(); ++i) {
            steps_[i] = std::min(static_cast<std::uint32_t>(map_.stepOf(footprints_[i].nearest)),
                                 kSteps - 1);
            ++next[steps_[i] + 1];
        }
        for (std::size_t k = 1; k <= kSteps; ++k) next[k] += next[k - 1];
        order_.resize(footprints_.size());
        for (std::uint32_t i = 0; i < footprints_.size(); ++i) order_[next[steps_[i]]++] = i;
    }

    // Cells of a row.
    struct Run {
        std::uint32_t first, count, hull;
    };

    void list() {
        RawVector<std::uint32_t>& starts = map_.starts;
        starts.assign(map_.cells() * map_.cells() + 2, 0);
        runs_.clear();
        for (const std::uint32_t hull : order_) addRuns(hull, footprints_[hull]);
        for (const Run& run : runs_)
            for (std::uint32_t k = 0; k < run.count; ++k) ++starts[run.first + k + 2];
        for (std::size_t k = 1; k < starts.size(); ++k) starts[k] += starts[k - 1];
        map_.lists.resize(starts.back() + 1); // lanes may look behind the end
        for (const Run& run : runs_)
            for (std::uint32_t k = 0; k < run.count; ++k)
                map_.lists[starts[run.first + k + 1]++] =
                    steps_[run.hull] << LampMap::kHullBits | run.hull;
    }

    // A plane through the lamp: nothing of a hull is where a x + b y + c > 0 in cells.
    struct Edge {
        float a, b, c;
    };

    // The two planes that touch a tube's side. `room`: of half a cell, and for rounding.
    std::size_t edgesOf(const LampMap::Hull& hull, Edge (&edges)[2]) const {
        const Vec3 way = hull.centre - map_.lamp;
        const Vec3 across = way - hull.axis * dot(way, hull.axis);
        const float distance = length(across), radius = radiusOf(hull);
        if (!(hull.halfLength > 0 && distance > 1.5f * radius)) return 0;
        const Vec3 out = across / distance, side = cross(hull.axis, out);
        const float sine = radius / distance, cosine = std::sqrt(1 - sine * sine);
        for (std::size_t k = 0; k < 2; ++k) {
            const Vec3 n = side * (k == 0 ? cosine : -cosine) - out * sine;
            const float a = dot(n, map_.right) / map_.scale[0], b = dot(n, map_.up) / map_.scale[1];
            const float c = dot(n, map_.ahead) - a * map_.offset[0] - b * map_.offset[1];
            const float room = std::fabs(a) * (0.5f + pad_[0]) + std::fabs(b) * (0.5f + pad_[1]);
            edges[k] = {a, b, c - room - 0x1p-16f};
        }
        return 2;
    }

    void addRuns(std::uint32_t number, const Footprint& f) {
        const float last = static_cast<float>(map_.cells() - 1);
        const auto cellAt = [&](float at, std::size_t i, float pad) {
            const float x = at * map_.scale[i] + map_.offset[i] + pad;
            return max(0.0f, min(last, std::floor(x)));
        };
        const float x0 = cellAt(f.lo[0], 0, -pad_[0]), x1 = cellAt(f.hi[0], 0, pad_[0]);
        const float y0 = cellAt(f.lo[1], 1, -pad_[1]), y1 = cellAt(f.hi[1], 1, pad_[1]);
        Edge edges[2];
        const std::size_t count = edgesOf(shapes_.hulls[number], edges);
        for (float y = y0; y <= y1; ++y) {
            float from = x0, to = x1;
            for (std::size_t k = 0; k < count; ++k) {
                const auto [a, b, c] = edges[k];
                const float rest = b * (y + 0.5f) + c;
                const float at = -rest / a - 0.5f; // of cells, whose middles count
                if (a > 0)
                    to = min(to, std::floor(at));
                else if (a < 0)
                    from = max(from, std::ceil(at));
                else if (rest > 0)
                    to = -1;
            }
            if (from > to) continue;
            const auto row = static_cast<std::uint32_t>(y) << map_.logCells;
            runs_.push_back({row + static_cast<std::uint32_t>(from),
                             static_cast<std::uint32_t>(to - from) + 1, number});
        }
    }

    LampMap& map_;
    const MappedShapes& shapes_;
    std::vector<Footprint> footprints_;
    static constexpr std::uint32_t kSteps = 1u << (32 - LampMap::kHullBits);
    std::vector<std::uint32_t> order_, steps_; // of the hulls
    std::vector<Run> runs_;
    float pad_[2] = {}; // of a footprint, in cells
};

} // namespace

std::shared_ptr<const LampMap> makeLampMap(const ShapeSet& shapes, const PointEmission& lamp,
                                           double rays) {
    if (rays < kRaysForHull * static_cast<double>(shapes.solids().solids.size())) return {};
    if (shapes.solids().solids.size() < kFewestHulls) return {};
    auto mapped = shapesOnMap(shapes, lamp.position);
    if (!mapped || mapped->hulls.size() < kFewestHulls ||
        mapped->hulls.size() >> LampMap::kHullBits)
        return {};
    auto map = std::make_shared<LampMap>();
    map->lamp = lamp.position;
    map->slack = 0x1p-18f * max(shapes.extent, maxAbs(lamp.position));
    map->others = std::move(mapped->others);
    if (!MapMaker(*map, *mapped).make()) return {};
    map->hulls = std::move(mapped->hulls);
    map->hullOf.assign(shapes.shapes.size(), LampMap::kNoHull);
    for (std::uint32_t i = 0; i < map->hulls.size(); ++i) map->hullOf[mapped->numbers[i]] = i;
    return map;
}
