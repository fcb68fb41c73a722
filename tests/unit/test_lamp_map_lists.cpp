// The lists of lamps' maps by themselves: the cell of every direction that a solid is seen in must
// name it, with all of the room that rounding takes. Truth is the geometry in double.
#include "render/lamp_map/lamp_map.h"

#include "analytic_kit.h"
#include "check.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace test_lamp_map_lists {

using kit::Random;

namespace {

using Hull = MappedShapes::Hull;

std::shared_ptr<const LampMap> mapOf(const std::vector<Hull>& hulls, const Bounds& box, Vec3 lamp) {
    auto shapes = std::make_shared<MappedShapes>();
    shapes->hulls.assign(hulls.begin(), hulls.end());
    shapes->box = box;
    shapes->extent = max(maxAbs(box.lo), maxAbs(box.hi));
    return makeLampMap(std::move(shapes), lamp);
}

Hull hullAt(Random& random, Vec3d centre, double radius, double halfLength) {
    const bool isTube = random.coin();
    return {toFloat(centre), static_cast<float>(radius),
            isTube ? toFloat(random.direction()) : Vec3{},
            isTube ? static_cast<float>(halfLength) : 0};
}

std::string shownHull(const Hull& h) {
    std::ostringstream out;
    out.precision(9);
    out << "hull at " << h.centre.x << ' ' << h.centre.y << ' ' << h.centre.z << " radius "
        << h.radius << " axis " << h.axis.x << ' ' << h.axis.y << ' ' << h.axis.z << " half "
        << h.halfLength;
    return out.str();
}

// Where hulls are in a map, in double.
class Picture {
public:
    explicit Picture(const LampMap& map)
        : map_(map),
          slack_(static_cast<double>(map.slack)), axes_{toDouble(map.right), toDouble(map.up)},
          ahead_(toDouble(map.ahead)) {
        for (std::size_t i = 0; i < 2; ++i) {
            const double scale = scaleOf(i), lo = (1 - offsetOf(i)) / scale,
                         hi = lo + (cells() - 2) / scale;
            const double most = std::max(std::fabs(lo), std::fabs(hi));
            // Of lamp_map.cpp: 2^-18 of what is divided by the least depth.
            pad_[i] = scale * (1 + most) * 0x1p-18 / kLeastCosine + cells() * 0x1p-20;
        }
    }
    double cells() const { return static_cast<double>(map_.cells()); }

    // May a ray meet the hull, were its radius this one, that is looked up in the cell? Rays are
    // off by 2^-18 of the hull and the slack at both ends; tubes have another 2^-16 of the depth.
    bool shows(const Hull& hull, double radius, const std::array<double, 2>& cell) const {
        const double r = radius * (1 + 0x1p-18) + 2 * slack_;
        const Vec3d way = toDouble(hull.centre) - toDouble(map_.lamp), axis = toDouble(hull.axis);
        const Vec3d end = axis * static_cast<double>(hull.halfLength);
        for (std::size_t i = 0; i < 2; ++i) {
            double lo = kInfinity, hi = -kInfinity;
            for (const Vec3d& at : {way + end, way - end}) {
                const double x = dot(at, axes_[i]), z = dot(at, ahead_);
                const double half = r * std::sqrt(x * x + z * z - r * r), room = z * z - r * r;
                lo = std::min(lo, (x * z - half) / room), hi = std::max(hi, (x * z + half) / room);
            }
            if (cell[i] < std::floor(lo * scaleOf(i) + offsetOf(i) - pad_[i]) ||
                cell[i] > std::floor(hi * scaleOf(i) + offsetOf(i) + pad_[i]))
                return false;
        }
        const Vec3d across = way - axis * dot(way, axis);
        const double distance = length(across), sine = r / distance;
        if (hull.halfLength == 0 || distance <= 1.5 * r) return true;
        const Vec3d out = across / distance, side = cross(axis, out);
        for (const double sign : {1.0, -1.0}) {
            const Vec3d n = side * (sign * std::sqrt(1 - sine * sine)) - out * sine;
            double value = dot(n, ahead_); // the least in the cell and the room around it
            for (std::size_t i = 0; i < 2; ++i) {
                const double slope = dot(n, axes_[i]) / scaleOf(i);
                value += slope * (cell[i] + 0.5 - offsetOf(i)) - std::fabs(slope) * (0.5 + pad_[i]);
            }
            if (value > 0x1p-16) return false;
        }
        return true;
    }

    // Of a direction; nothing where no look-up is made.
    std::optional<std::array<double, 2>> cellOf(Vec3d dir) const {
        const double depth = dot(dir, ahead_);
        if (!(depth > kLeastCosine * length(dir))) return std::nullopt;
        std::array<double, 2> cell{};
        for (std::size_t i = 0; i < 2; ++i) {
            cell[i] = std::floor(dot(dir, axes_[i]) / depth * scaleOf(i) + offsetOf(i));
            if (!(cell[i] >= 0 && cell[i] < cells())) return std::nullopt;
        }
        return cell;
    }

    // Does the cell's list have the hull among what begins up to that far from the lamp?
    bool lists(const std::array<double, 2>& cell, std::uint32_t number, double distance) const {
        const std::size_t at =
            static_cast<std::size_t>(cell[1]) * map_.cells() + static_cast<std::size_t>(cell[0]);
        const double reach =
            (distance + slack_ - static_cast<double>(map_.firstStep)) * map_.perStep;
        constexpr std::uint32_t kNumber = (1u << LampMap::kHullBits) - 1;
        for (std::uint32_t k = map_.starts[at]; map_.lists[k] != LampMap::kEnd; ++k)
            if ((map_.lists[k] & kNumber) == number)
                return map_.lists[k] >> LampMap::kHullBits < std::max(reach, 0.0) + 1;
        return false;
    }

private:
    static constexpr double kLeastCosine = LampMap::kLeastCosine;
    double scaleOf(std::size_t i) const { return static_cast<double>(map_.scale[i]); }
    double offsetOf(std::size_t i) const { return static_cast<double>(map_.offset[i]); }

    const LampMap& map_;
    double slack_;
    Vec3d axes_[2], ahead_;
    std::array<double, 2> pad_{};
};

// Hulls within a cube of anchors, which alone decide where the cells are.
struct Crowd {
    std::vector<Hull> hulls;
    Bounds box;
    Vec3 lamp;
    double size;
};
constexpr std::size_t kAnchors = 8;
Crowd crowd(Random& random) {
    Crowd out;
    out.size = random.chance(0.5) ? 1 : random.logUniform(1e-12, 1e12);
    const Vec3d middle = random.outwards(0, random.coin() ? 1 : 30);
    const Transform turn = random.turn();
    for (std::size_t i = 0; i < kAnchors; ++i) {
        const Vec3d corner{i & 1 ? 1.0 : -1.0, i & 2 ? 1.0 : -1.0, i & 4 ? 1.0 : -1.0};
        const Vec3 at = toFloat((middle + turn.vector(corner)) * out.size);
        out.hulls.push_back({at, static_cast<float>(0.05 * out.size), {}, 0});
        out.box.extend(at);
    }
    out.lamp = toFloat((middle + random.outwards(2.5, random.chance(0.7) ? 4 : 60)) * out.size);
    for (int i = 0; i < 30; ++i)
        out.hulls.push_back(hullAt(random, (middle + turn.vector(random.inBox(0.5))) * out.size,
                                   random.logUniform(0.01, 0.1) * out.size,
                                   random.logUniform(0.01, 0.2) * out.size));
    return out;
}

// A direction from the lamp into the hull, and where it is surely in it: aimed at its skin, mostly
// where that is seen at the very edge.
Vec3d intoHull(Random& random, const Hull& hull, Vec3 lamp) {
    const double along = random.chance(0.3) ? (random.coin() ? 1 : -1) : random.signedUniform(0, 1);
    const Vec3d centre = toDouble(hull.centre) +
                         toDouble(hull.axis) * (along * static_cast<double>(hull.halfLength)) -
                         toDouble(lamp);
    const double radius = static_cast<double>(hull.radius), far = length(centre);
    const Vec3d aside = normalize(cross(centre, random.direction()));
    const double part = random.coin() ? 1 - 1e-12 : random.uniform(-1, 1), sine = radius / far;
    if (sine >= 1) return centre + random.direction() * (radius * part);
    // The point of the great circle across the edge's own direction.
    return centre * (1 - sine * sine * part * part) +
           aside * (radius * part * std::sqrt(1 - sine * sine * part * part));
}

} // namespace

// Each hull gets the radius with which it only just reaches a cell: a footprint that is 1e-5 of it
// too small misses the cell.
TEST(lamp_maps_list_what_grazes_a_cell) {
    Random random(523);
    int grazing = 0, tubes = 0;
    for (int i = 0; i < check::scaled(300); ++i) {
        Crowd c = crowd(random);
        const auto first = mapOf(c.hulls, c.box, c.lamp);
        if (!first) continue;
        const Picture picture(*first);
        std::vector<std::optional<std::array<double, 2>>> cells(c.hulls.size());
        for (std::size_t h = kAnchors; h < c.hulls.size(); ++h) {
            Hull& hull = c.hulls[h];
            double lo = static_cast<double>(hull.radius) / 2, hi = 4 * lo;
            Hull wide = hull;
            wide.radius = static_cast<float>(hi);
            const auto cell = picture.cellOf(intoHull(random, wide, c.lamp));
            if (!cell || !picture.shows(hull, hi, *cell) || picture.shows(hull, lo, *cell))
                continue;
            for (int step = 0; step < 50; ++step) {
                const double middle = (lo + hi) / 2;
                (picture.shows(hull, middle, *cell) ? hi : lo) = middle;
            }
            // And what floats are off by there.
            hi += 2e-6 * hi + 3e-7 * length(toDouble(hull.centre) - toDouble(c.lamp));
            hull.radius = static_cast<float>(hi);
            cells[h] = cell;
        }
        const auto map = mapOf(c.hulls, c.box, c.lamp);
        CHECK_INFO(map && map->scale == first->scale && map->offset == first->offset, "case " << i);
        if (!map) continue;
        for (std::uint32_t h = 0; h < c.hulls.size(); ++h) {
            if (!cells[h]) continue;
            ++grazing, tubes += c.hulls[h].halfLength > 0;
            CHECK_INFO(Picture(*map).lists(*cells[h], h, kInfinity),
                       "case " << i << " size " << c.size << ", cell " << (*cells[h])[0] << ' '
                               << (*cells[h])[1] << " of " << map->cells() << ": "
                               << shownHull(c.hulls[h]));
        }
    }
    std::printf("%d hulls at the border of a cell, %d of them tubes\n", grazing, tubes);
    CHECK(grazing > 2000 && tubes > 800);
}

// Hulls of any size near the lamp, around it, beside it and behind it: there is no map, or it lists
// all that is met, with directions that it has no cells for.
TEST(lamp_maps_list_what_is_seen) {
    Random random(524);
    int maps = 0, none = 0, seen = 0;
    for (int i = 0; i < check::scaled(3000); ++i) {
        const double size = random.chance(0.5) ? 1 : random.logUniform(1e-12, 1e12);
        const Vec3d way = random.direction();
        const double nearest = random.logUniform(1e-3, 10), farthest = random.logUniform(1, 100);
        const double widest = random.uniform(0.1, 2); // beyond pi/2 behind the lamp
        const Vec3 lamp = toFloat(random.inBox(random.coin() ? 1 : 100) * size);
        std::vector<Hull> hulls;
        Bounds box;
        for (int h = 0; h < 20; ++h) {
            const Vec3d aside = normalize(cross(way, random.direction()));
            const double angle = widest * std::sqrt(random.unit());
            const double far = nearest * std::pow(farthest / nearest, random.unit());
            const Vec3d at = (way * std::cos(angle) + aside * std::sin(angle)) * far;
            const double radius = far * random.logUniform(1e-4, 0.5);
            hulls.push_back(hullAt(random, toDouble(lamp) + at * size, radius * size,
                                   far * size * random.logUniform(1e-3, 1)));
            const Hull& hull = hulls.back();
            const double reach = static_cast<double>(hull.radius) + hull.halfLength;
            box.extend(hull.centre + toFloat(Vec3d{reach, reach, reach}));
            box.extend(hull.centre - toFloat(Vec3d{reach, reach, reach}));
        }
        const auto map = mapOf(hulls, box, lamp);
        ++(map ? maps : none);
        if (!map) continue;
        const Picture picture(*map);
        for (std::uint32_t h = 0; h < hulls.size(); ++h)
            for (int k = 0; k < 20; ++k) {
                const Vec3d dir = intoHull(random, hulls[h], lamp);
                const auto cell = picture.cellOf(dir);
                ++seen;
                CHECK_INFO(cell && picture.lists(*cell, h, length(dir)),
                           "case " << i << " size " << size << ", direction " << dir.x << ' '
                                   << dir.y << ' ' << dir.z << (cell ? "" : " has no cell") << ": "
                                   << shownHull(hulls[h]));
            }
    }
    std::printf("%d maps, none in %d cases, %d directions\n", maps, none, seen);
    CHECK(maps > 300 && none > 300);
}

} // namespace test_lamp_map_lists
