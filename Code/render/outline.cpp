#include "render/outline.h"

#include "base/math.h"

#include <array>

std::vector<OutlineDisk> outlineOf(const PictureMap& map, std::span<const BodyBall> body) {
    std::vector<OutlineDisk> out;
    double farthest = 0;
    for (const BodyBall& ball : body) farthest = std::max(farthest, map.depth(ball.centre));
    if (!(farthest > 0)) return out;
    // Sides are cut a little before the camera.
    const double nearest = 1e-3 * farthest;
    for (std::size_t i = 0; i < body.size(); ++i) {
        const double depth = map.depth(body[i].centre);
        if (depth >= nearest) {
            out.push_back(map.disk(body[i]));
            continue;
        }
        for (const BodyBall& other : body) {
            const double beyond = map.depth(other.centre);
            if (beyond <= nearest) continue;
            const double part = (nearest - depth) / (beyond - depth);
            out.push_back(map.disk({body[i].centre + (other.centre - body[i].centre) * part,
                                    body[i].radius + (other.radius - body[i].radius) * part}));
        }
    }
    return out;
}

Extent extentAlong(std::span<const OutlineDisk> outline, Vec2d n, bool withBlur) {
    Extent extent;
    for (const OutlineDisk& disk : outline) {
        const double middle = disk.centre.x * n.x + disk.centre.y * n.y;
        const double reach = disk.radius + (withBlur ? disk.blur : 0);
        extent.low = std::min(extent.low, middle - reach);
        extent.high = std::max(extent.high, middle + reach);
    }
    return extent;
}

Vec2d narrowestWay(std::span<const OutlineDisk> outline) {
    Vec2d best{1, 0};
    double least = kInfinity;
    const auto look = [&](Vec2d n) {
        if (const double size = extentAlong(outline, n, false).size(); size < least)
            least = size, best = n;
    };
    static const std::array<Vec2d, 16> kWays = [] {
        std::array<Vec2d, 16> ways;
        for (std::size_t i = 0; i < ways.size(); ++i) {
            const exact::SinCos at = exact::sinCos(kPi * static_cast<double>(i) / 16);
            ways[i] = {at.cos, at.sin};
        }
        return ways;
    }();
    for (const Vec2d way : kWays) look(way);
    for (std::size_t i = 0; i < outline.size(); ++i)
        for (std::size_t j = 0; j < i; ++j) {
            const double x = outline[i].centre.x - outline[j].centre.x,
                         y = outline[i].centre.y - outline[j].centre.y;
            const double length = std::sqrt(x * x + y * y);
            if (!(length > 0)) continue;
            // Sides of disks of different sizes lean to their common tangents.
            const double lean =
                std::clamp((outline[i].radius - outline[j].radius) / length, -1.0, 1.0);
            const double level = std::sqrt(1 - lean * lean);
            for (const double side : {1.0, -1.0})
                look({(-y * side * level + x * lean) / length,
                      (x * side * level + y * lean) / length});
        }
    return best;
}
