// Lights in one lane, asked with plain numbers, and lamps and points to ask about.
#pragma once

#include "light/light_row.h"
#include "light/lights.h"
#include "sample/warp.h"
#include "verify/meshes.h"
#include "warp_kit.h"

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

inline Vec3 unitVector(meshes::Random& random) { return sphereFromSquare(random.square()); }

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

} // namespace
} // namespace light_kit
