#include "render/lamp_map/lamp_map.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace {

// All of it lies in a plane across an axis, from which the lamp is far: then it can't hide itself.
bool isFlatAcross(const Bounds& box, Vec3 lamp, float extent) {
    for (std::size_t axis = 0; axis < 3; ++axis)
        if (box.lo[axis] == box.hi[axis] &&
            std::fabs(lamp[axis] - box.lo[axis]) > 0x1p-10f * max(extent, maxAbs(lamp)))
            return true;
    return false;
}

// What the picture shows of a hull, as tangents of angles to `ahead`, and how near it is.
struct Footprint {
    std::array<float, 2> lo, hi;
    float nearest;
};

class MapMaker {
public:
    explicit MapMaker(LampMap& map)
        : map_(map), shapes_(*map.shapes), footprints_(shapes_.hulls.size()) {}

    // False: the lamp does not see all of them in front of it.
    bool make() {
        if (!aim()) return false;
        for (std::size_t i = 0; i < footprints_.size(); ++i)
            if (!project(shapes_.hulls[i], footprints_[i])) return false;
        if (!frame()) return false;
        sortByStep();
        return makeLists();
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

    // What a ray may be off by does not take it out of the footprint.
    float radiusOf(const MappedShapes::Hull& hull) const {
        return hull.radius * (1 + 0x1p-18f) + 2 * map_.slack;
    }

    bool project(const MappedShapes::Hull& hull, Footprint& out) const {
        const Vec3 way = hull.centre - map_.lamp, end = hull.axis * hull.halfLength;
        const float radius = radiusOf(hull);
        out = {{kInfinityF, kInfinityF}, {-kInfinityF, -kInfinityF}, 0};
        if (!extend(out, way + end, radius)) return false;
        if (hull.halfLength > 0 && !extend(out, way - end, radius)) return false;
        const float height = max(-hull.halfLength, min(hull.halfLength, -dot(way, hull.axis)));
        out.nearest = length(way + hull.axis * height) - radius;
        return out.nearest > 0;
    }

    // By the planes through the lamp and along an axis of the picture that touch a ball.
    bool extend(Footprint& out, Vec3 centre, float radius) const {
        // Its farthest directions have a cosine of more than this over its distance.
        constexpr float kCosine = LampMap::kLeastCosine * (1 + 0x1p-10f);
        const float z = dot(centre, map_.ahead), least = z - radius * (1 + kCosine);
        if (!(least > 0 && least * least > kCosine * kCosine * dot(centre, centre))) return false;
        const float room = z * z - radius * radius, perRoom = 1 / room;
        const auto side = [&](Vec3 axis, std::size_t i) {
            const float x = dot(centre, axis), half = radius * std::sqrt(x * x + room);
            out.lo[i] = min((x * z - half) * perRoom, out.lo[i]);
            out.hi[i] = max((x * z + half) * perRoom, out.hi[i]);
        };
        side(map_.right, 0), side(map_.up, 1);
        return true;
    }

    // Fits the cells about all of them, with one to spare at each border. Two cells for a solid:
    // with fewer the lists get long, with more filling them takes longer than it saves.
    bool frame() {
        const double hulls = static_cast<double>(footprints_.size());
        map_.logCells = std::clamp(static_cast<int>(std::lround(std::log2(2 * hulls) / 2)), 5, 10);
        const auto cells = static_cast<float>(map_.cells());
        for (std::size_t i = 0; i < 2; ++i) {
            float lo = kInfinityF, hi = -kInfinityF;
            for (const Footprint& f : footprints_) lo = min(f.lo[i], lo), hi = max(f.hi[i], hi);
            map_.scale[i] = (cells - 2) / (hi - lo);
            map_.offset[i] = 1 - lo * map_.scale[i];
            // Look-ups and footprints are off by less than 2^-18 of what is divided by the depth,
            // which is at least kLeastCosine.
            const float most = max(std::fabs(lo), std::fabs(hi));
            pad_[i] =
                map_.scale[i] * (1 + most) * (0x1p-18f / LampMap::kLeastCosine) + cells * 0x1p-20f;
            if (!(pad_[i] < 0.5f)) return false; // too far away
        }
        return true;
    }

    void sortByStep() {
        float lo = kInfinityF, hi = 0;
        for (const Footprint& f : footprints_) lo = min(f.nearest, lo), hi = max(f.nearest, hi);
        map_.firstStep = lo;
        map_.perStep = static_cast<float>(kSteps - 1) / max(hi - lo, lo * 0x1p-10f);
        std::vector<std::uint32_t> next(kSteps + 1, 0); // by step: where its next one goes
        step_.resize(footprints_.size()), order_.resize(footprints_.size());
        for (std::size_t i = 0; i < step_.size(); ++i) {
            const float step = map_.stepOf(footprints_[i].nearest);
            step_[i] = std::min(static_cast<std::uint32_t>(step), kSteps - 1);
            ++next[step_[i] + 1];
        }
        for (std::size_t k = 1; k <= kSteps; ++k) next[k] += next[k - 1];
        for (std::uint32_t i = 0; i < step_.size(); ++i) order_[next[step_[i]]++] = i;
    }

    // False: the solids hide behind each other so often, or are so small in the picture, that the
    // lists would take more time than the tree.
    bool makeLists() {
        runs_.reserve(4 * order_.size());
        const double most = kMeanLength * static_cast<double>(map_.cells() * map_.cells());
        std::size_t entries = 0;
        for (const std::uint32_t hull : order_) {
            entries += addRuns(hull);
            if (static_cast<double>(entries) > most) return false; // so long if all are alike
        }
        RawVector<std::uint32_t>& starts = map_.starts;
        starts.assign(map_.cells() * map_.cells(), 0);
        for (const Run& run : runs_)
            for (std::uint32_t k = 0; k < run.count; ++k) ++starts[run.first + k];
        double squares = 0;
        std::uint32_t end = 0;
        for (std::uint32_t& start : starts) { // until they are filled: where the next one goes
            const std::uint32_t count = start;
            if (count > kLongestList) return false;
            squares += sqr(static_cast<double>(count));
            start = end, end += count + 1;
        }
        if (squares > kMeanLength * static_cast<double>(entries)) return false;
        map_.lists.resize(end);
        for (const Run& run : runs_)
            for (std::uint32_t k = 0; k < run.count; ++k)
                map_.lists[starts[run.first + k]++] =
                    step_[run.hull] << LampMap::kHullBits | run.hull;
        std::uint32_t begin = 0;
        for (std::uint32_t& start : starts) {
            map_.lists[start] = LampMap::kEnd;
            begin = std::exchange(start, begin) + 1;
        }
        return true;
    }

    // A line in the picture that a hull is on one side of: nothing of it is where a x + b y + c is
    // positive, x and y in cells.
    struct Edge {
        float a, b, c;
    };

    // Of the two planes through the lamp that touch the side of a tube, for whole cells.
    std::size_t edgesOf(const MappedShapes::Hull& hull, std::array<Edge, 2>& edges) const {
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

    // The cells that show something of a hull, row by row. Returns how many.
    std::size_t addRuns(std::uint32_t number) {
        const Footprint& f = footprints_[number];
        const float last = static_cast<float>(map_.cells() - 1);
        const auto cellAt = [&](float at, std::size_t i, float pad) {
            return max(0.0f, min(last, std::floor(at * map_.scale[i] + map_.offset[i] + pad)));
        };
        const float x0 = cellAt(f.lo[0], 0, -pad_[0]), x1 = cellAt(f.hi[0], 0, pad_[0]);
        const float y0 = cellAt(f.lo[1], 1, -pad_[1]), y1 = cellAt(f.hi[1], 1, pad_[1]);
        std::array<Edge, 2> edges;
        const std::size_t count = edgesOf(shapes_.hulls[number], edges);
        std::size_t cells = 0;
        for (float y = y0; y <= y1; ++y) {
            float from = x0, to = x1;
            for (const auto& [a, b, c] : std::span(edges).first(count)) {
                const float rest = b * (y + 0.5f) + c, at = -rest / a - 0.5f;
                if (a > 0)
                    to = min(to, std::floor(at));
                else if (a < 0)
                    from = max(from, std::ceil(at));
                else if (rest > 0)
                    to = -1;
            }
            if (from > to) continue;
            const auto row = static_cast<std::uint32_t>(y) << map_.logCells;
            const auto length = static_cast<std::uint32_t>(to - from) + 1;
            runs_.push_back({row + static_cast<std::uint32_t>(from), length, number});
            cells += length;
        }
        return cells;
    }

    // Of a list as its entries see it; 15 is fine still, of 20 the tree is as fast.
    static constexpr double kMeanLength = 18;
    static constexpr std::uint32_t kLongestList = 256;
    static constexpr std::uint32_t kSteps = 1u << (32 - LampMap::kHullBits);
    struct Run {
        std::uint32_t first, count, hull; // cells of a row
    };

    LampMap& map_;
    const MappedShapes& shapes_;
    std::vector<Footprint> footprints_;       // by hull
    std::vector<std::uint32_t> step_, order_; // the same; hulls in the order of their steps
    std::vector<Run> runs_;
    std::array<float, 2> pad_{}; // of a footprint, in cells
};

} // namespace

std::shared_ptr<const LampMap> makeLampMap(std::shared_ptr<const MappedShapes> shapes, Vec3 lamp) {
    auto map = std::make_shared<LampMap>();
    map->shapes = std::move(shapes);
    map->lamp = lamp;
    map->slack = 0x1p-18f * max(map->shapes->extent, maxAbs(lamp));
    map->others = map->shapes->others;
    for (Occluder& other : map->others)
        if (isFlatAcross(other.box, lamp, map->shapes->extent))
            other.hidesInside = other.hidesOutside = false;
    if (!MapMaker(*map).make()) return {};
    return map;
}
