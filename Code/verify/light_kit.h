// Lights in one lane, called with plain numbers; lamps of any form, many lamps, and skies.
#pragma once

#include "light/light_row.h"
#include "light/lights.h"
#include "light/sky/sky_table.h"
#include "light/tree/light_tree.h"
#include "sample/warp.h"
#include "sample/warps.h"
#include "texture/environment.h"
#include "verify/meshes.h"

#include <string>
#include <vector>

namespace light_kit {
namespace {

inline Vec3 plain(const kernels::one::Floats3& v) { return {v.x.v, v.y.v, v.z.v}; }
inline kernels::one::Floats3 lane(Vec3 v) { return {v.x, v.y, v.z}; }

struct Sample {
    Vec3 toLight;
    float distance;
    Rgb irradiance;
    float pdf;
    bool single;
};
inline Sample plain(const kernels::one::SampledLight& s) {
    const Vec3 e = plain(s.irradiance);
    return {plain(s.toLight), s.distance.v, {e.x, e.y, e.z}, s.pdf.v, s.single.v};
}

// A light of any kind.
class OneLight {
public:
    explicit OneLight(const LightRow& row) : row_(row) {}
    template <class Row> explicit OneLight(const Row& row) : row_(lightRow(row)) {}
    Sample sample(Vec3 p, Vec2 u) const {
        Sample out{};
        with([&](const auto& l) { out = plain(l.sample(lane(p), u.x, u.y)); });
        return out;
    }
    Sample centre(Vec3 p) const {
        Sample out{};
        with([&](const auto& l) { out = plain(l.centre(lane(p))); });
        return out;
    }
    float pdf(Vec3 p, Vec3 dir) const {
        float out = 0;
        with([&](const auto& l) { out = l.pdf(lane(p), lane(dir)).v; });
        return out;
    }
    struct Meeting {
        float distance;
        Rgb radiance;
    };
    Meeting meet(Vec3 p, Vec3 dir) const {
        Meeting out{};
        with([&](const auto& l) {
            const auto m = l.meet(lane(p), lane(dir));
            out = {m.distance.v, {m.radiance.x.v, m.radiance.y.v, m.radiance.z.v}};
        });
        return out;
    }
    const char* name() const { return lightKinds()[row_.kind].name; }
    const LightRow& row() const { return row_; }

private:
    template <class Fn> void with(Fn&& fn) const {
        kernels::one::forLight(row_.kind, [&]<class L>() {
            fn(L(kernels::one::LightNumbers{row_.numbers.data(), 1}));
        });
    }
    LightRow row_;
};

inline Vec3 unitVector(meshes::Random& random) {
    const Vec2 u = random.square();
    const auto v = kernels::one::sphereFromSquare(u.x, u.y);
    return {v.x.v, v.y.v, v.z.v};
}

// A flat lamp of half axes up to `size`, about a centre; its sides are perpendicular.
template <class Row> Row flat(meshes::Random& random, Vec3 centre, float size) {
    const Frame frame = frameAround(unitVector(random));
    const auto half = [&] { return size * (0.1f + 0.9f * static_cast<float>(random.unit())); };
    Row row;
    row.centre = centre, row.halfX = frame.x * half(), row.halfY = frame.y * half();
    row.normal = frame.z, row.radiance = {1, 2, 3};
    return row;
}

inline TriangleRow triangle(meshes::Random& random, Vec3 centre, float size) {
    const auto corner = [&] { return centre + toFloat(random.inBox(1)) * size; };
    TriangleRow row;
    row.a = corner(), row.b = corner(), row.c = corner();
    row.radiance = {1, 2, 3}, row.isTwoSided = 1;
    return row;
}

inline SphereRow sphere(Vec3 centre, float radius) { return {centre, radius, {1, 2, 3}}; }
inline PointRow point(Vec3 centre, float radius) { return {centre, {1, 2, 3}, {1, 0, 0}, radius}; }
inline SpotRow spot(meshes::Random& random, Vec3 centre, float radius) {
    return {point(centre, radius), unitVector(random), 0.3f, 0.5f, 0};
}
inline SunRow sun(meshes::Random& random, double halfAngleRad) {
    return {unitVector(random), {1, 2, 3}, static_cast<float>(2 * sqr(std::sin(halfAngleRad / 2)))};
}

// A lamp of each kind that has directions, of about this size and about this place.
inline std::vector<OneLight> lampsOfSize(meshes::Random& random, Vec3 centre, float size) {
    return {
        OneLight(point(centre, size)),
        OneLight(spot(random, centre, size)),
        OneLight(sun(random, 0.5 * static_cast<double>(size) / (1 + static_cast<double>(size)))),
        OneLight(flat<RectangleRow>(random, centre, size)),
        OneLight(flat<DiskRow>(random, centre, size)),
        OneLight(sphere(centre, size)),
        OneLight(triangle(random, centre, size))};
}

// Lamps of all kinds, some in a heap, some far away, a few dark; and maybe suns and a sky.
inline std::vector<LightRow> someLights(meshes::Random& random, std::size_t count,
                                        bool hasDistant) {
    std::vector<LightRow> out;
    for (std::size_t i = 0; i < count; ++i) {
        const Vec3 centre = toFloat(random.inBox(random.chance(0.2) ? 5 : 0.5));
        const auto size = static_cast<float>(random.logUniform(1e-3, 0.5));
        const float bright = static_cast<float>(random.logUniform(1e-3, 1e3));
        switch (random.below(8)) {
        case 0: {
            PointRow row = point(centre, random.chance(0.5) ? 0 : size);
            row.intensity *= Rgb{bright, bright, bright};
            out.push_back(lightRow(row));
            break;
        }
        case 1: {
            SpotRow row = spot(random, centre, random.chance(0.5) ? 0 : size);
            row.cosHalfAngle = static_cast<float>(random.uniform(-0.2, 0.99));
            out.push_back(lightRow(row));
            break;
        }
        case 2: out.push_back(lightRow(flat<RectangleRow>(random, centre, size))); break;
        case 3: {
            auto row = flat<DiskRow>(random, centre, size);
            setSpread(row, random.uniform(0.2, 1.5));
            out.push_back(lightRow(row));
            break;
        }
        case 4: out.push_back(lightRow(sphere(centre, random.chance(0.1) ? 0 : size))); break;
        case 5:
            if (hasDistant) {
                out.push_back(lightRow(sun(random, random.logUniform(1e-3, 1))));
                break;
            }
            [[fallthrough]];
        default: {
            TriangleRow row = triangle(random, centre, size);
            row.radiance = Rgb{bright, bright, bright}, row.isTwoSided = random.chance(0.5) ? 1 : 0;
            out.push_back(lightRow(row));
        }
        }
    }
    return out;
}

inline std::vector<LightBounds> boundsOf(const std::vector<LightRow>& rows) {
    std::vector<LightBounds> out;
    for (const LightRow& row : rows) out.push_back(::boundsOf(row));
    return out;
}

// A dim sky with a few bright spots.
inline StoredImage skyImage(meshes::Random& random, int width, int height, double dim) {
    StoredImage image;
    image.width = width, image.height = height, image.channels = 3;
    image.depth = StoredImage::Depth::Float;
    for (int i = 0; i < width * height; ++i) {
        const bool isBright = random.chance(0.01);
        for (int c = 0; c < 3; ++c)
            image.floats.push_back(static_cast<float>(random.unit() * (isBright ? 100 : dim)));
    }
    return image;
}
} // namespace
} // namespace light_kit
