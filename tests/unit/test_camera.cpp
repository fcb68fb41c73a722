// The camera's rays: Blender's formulas, clipping, motion, batches. Its lens is in
// test_camera_lens.cpp.
#include "camera/camera.h"
#include "camera_kit.h"
#include "check.h"

namespace test_camera {

using camera_kit::somewhere;
using kit::Random;
using Fit = CameraParams::SensorFit;
using Kind = CameraParams::Kind;

namespace {

using L = long double;
struct Vec3l {
    L x, y, z;
};
Vec3l wide(Vec3d v) { return {v.x, v.y, v.z}; }
Vec3l operator+(Vec3l a, Vec3l b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
Vec3l operator*(Vec3l a, L s) { return {a.x * s, a.y * s, a.z * s}; }
Vec3l unit(Vec3l a) { return a * (1 / std::sqrt(a.x * a.x + a.y * a.y + a.z * a.z)); }

struct Expected {
    Vec3l org, dir;
};

// The definition of Blender's cameras in long double, written apart from Code/camera/; rows count
// from the bottom here.
Expected formula(const CameraParams& p, Vec2d pixel) {
    const L w = p.width, h = p.height, xr = w * p.pixelAspect.x, yr = h * p.pixelAspect.y;
    bool horizontal = true;
    L sensor = p.sensorWidthMm;
    if (p.sensorFit == Fit::Auto) horizontal = xr > yr;
    if (p.sensorFit == Fit::Vertical) {
        horizontal = false;
        sensor = p.sensorHeightMm;
    }
    const L fitted = horizontal ? xr : yr, py = h - static_cast<L>(pixel.y);
    const L u = (pixel.x / w - 0.5L) * xr / fitted + p.shiftX;
    const L v = (py / h - 0.5L) * yr / fitted + p.shiftY;
    const Transform map = p.worldFromCamera.at(0);
    const Vec3l r0 = unit(wide(map.column(0))), r1 = unit(wide(map.column(1))),
                r2 = unit(wide(map.column(2))), o = wide(map.translation());
    if (p.kind == Kind::Orthographic)
        return {o + r0 * (u * p.orthoScale) + r1 * (v * p.orthoScale), r2 * -1};
    const L perLens = sensor / p.lensMm;
    return {o, unit(r0 * (u * perLens) + r1 * (v * perLens) + r2 * -1)};
}

double apart(Vec3 a, Vec3l b) {
    const L x = a.x - b.x, y = a.y - b.y, z = a.z - b.z;
    return static_cast<double>(std::sqrt(x * x + y * y + z * z));
}

} // namespace

TEST(camera_follows_blenders_formulas) {
    Random random(801);
    int cases = 0;
    for (const Kind kind : {Kind::Perspective, Kind::Orthographic})
        for (const Fit fit : {Fit::Auto, Fit::Horizontal, Fit::Vertical})
            for (const Vec2d size :
                 {Vec2d{640, 480}, Vec2d{480, 640}, Vec2d{512, 512}, Vec2d{1, 7}})
                for (const Vec2d aspect : {Vec2d{1, 1}, Vec2d{2, 1}, Vec2d{1, 1.5}})
                    for (int s = 0; s < 3; ++s) {
                        CameraParams p;
                        p.kind = kind;
                        p.sensorFit = fit;
                        p.width = static_cast<int>(size.x);
                        p.height = static_cast<int>(size.y);
                        p.pixelAspect = aspect;
                        p.worldFromCamera = somewhere(random);
                        p.lensMm = random.uniform(10, 200);
                        p.sensorWidthMm = random.uniform(10, 50);
                        p.sensorHeightMm = random.uniform(10, 50);
                        p.orthoScale = random.uniform(0.5, 10);
                        p.shiftX = s == 0 ? 0 : random.uniform(-0.6, 0.6);
                        p.shiftY = s == 0 ? 0 : random.uniform(-0.6, 0.6);
                        const Camera camera(p);
                        for (int i = 0; i < 20; ++i) {
                            const Vec2d pixel{random.uniform(0, size.x), random.uniform(0, size.y)};
                            const Ray ray = camera.ray(pixel, {0.5f, 0.5f}, 0);
                            const Expected e = formula(p, pixel);
                            // Rounding to float: half an ulp of three numbers, below 1 in dir.
                            CHECK_NEAR(apart(ray.dir, e.dir), 0, 0x1p-24);
                            CHECK_NEAR(apart(ray.org, e.org), 0,
                                       0x1p-23 * length(toDouble(ray.org)));
                            CHECK(ray.tMin == 0 && ray.tMax == kInfinityF);
                        }
                        ++cases;
                    }
    CHECK_EQUAL(cases, 216);
}

TEST(camera_by_hand) {
    // 36 mm sensor, 18 mm lens: 45 degrees to each side of a landscape picture.
    CameraParams p;
    p.width = 200;
    p.height = 100;
    p.lensMm = 18;
    const Camera camera(p);
    const float half = static_cast<float>(std::sqrt(0.5));
    const Ray left = camera.ray({0, 50}, {}, 0), right = camera.ray({200, 50}, {}, 0);
    CHECK_NEAR(left.dir.x, -half, 1e-7);
    CHECK_NEAR(right.dir.x, half, 1e-7);
    CHECK_NEAR(left.dir.z, -half, 1e-7);
    const Ray top = camera.ray({100, 0}, {}, 0); // the top of the file is up
    CHECK_NEAR(top.dir.y / -top.dir.z, 0.5, 1e-7);
    // Portrait: Auto gives the sensor's width to the height.
    std::swap(p.width, p.height);
    CHECK_NEAR(Camera(p).ray({50, 0}, {}, 0).dir.y, half, 1e-7);
    CHECK(camera.axesAt(0).forward == (Vec3d{0, 0, -1}) && camera.axesAt(0).eye == (Vec3d{}));
    CHECK(camera.hasSharedOrigin() && !camera.hasLens() && !camera.isMoving());
}

TEST(camera_pinhole_shares_its_origin) {
    Random random(802);
    CameraParams p;
    p.width = 31;
    p.height = 17;
    p.worldFromCamera = somewhere(random);
    const Camera camera(p);
    const Vec3 origin = camera.ray({0, 0}, {0.5f, 0.5f}, 0).org;
    bool same = true;
    for (int i = 0; i < 1000; ++i) {
        const Vec2 lens{static_cast<float>(random.unit()), static_cast<float>(random.unit())};
        same = same && origin == camera
                                     .ray({random.uniform(0, 31), random.uniform(0, 17)}, lens,
                                          static_cast<float>(random.unit()))
                                     .org;
    }
    CHECK(same);
}

TEST(camera_drops_scale_and_keeps_mirrors) {
    CameraParams p;
    p.worldFromCamera = Transform::scale(Vec3d{3, 0.1, 7});
    CameraParams mirrored = p, plain = p;
    plain.worldFromCamera = Transform();
    mirrored.worldFromCamera = Transform::scale(Vec3d{-2, 1, 1});
    const Vec2d corner{0.1, 0.2};
    const Ray a = Camera(p).ray(corner, {}, 0), b = Camera(plain).ray(corner, {}, 0),
              c = Camera(mirrored).ray(corner, {}, 0);
    CHECK(a.dir == b.dir);
    CHECK(c.dir.x == -b.dir.x && c.dir.y == b.dir.y && c.dir.z == b.dir.z);
}

TEST(camera_clip_start_is_a_depth) {
    Random random(803);
    for (const Kind kind : {Kind::Perspective, Kind::Orthographic}) {
        CameraParams p;
        p.kind = kind;
        p.width = p.height = 10;
        p.lensMm = 10;
        p.clipStart = 0.125;
        p.worldFromCamera = somewhere(random);
        p.apertureRadius = 0.01;
        const Camera camera(p);
        const Camera::Axes axes = camera.axesAt(0);
        for (int i = 0; i < 100; ++i) {
            const Ray ray = camera.ray({random.uniform(0, 10), random.uniform(0, 10)},
                                       {static_cast<float>(random.unit()), 0.25f}, 0);
            const Vec3d start =
                toDouble(ray.org) + toDouble(ray.dir) * static_cast<double>(ray.tMin);
            CHECK_NEAR(dot(start - axes.eye, axes.forward), 0.125, 1e-6);
        }
    }
}

TEST(camera_moves_with_its_keys) {
    const std::vector<Transform> keys = {Transform::translate({0, 0, 0}),
                                         Transform::translate({2, 0, 0})};
    CameraParams p;
    p.worldFromCamera = MovingTransform(std::span<const Transform>(keys));
    const Camera camera(p);
    CHECK(camera.isMoving() && !camera.hasSharedOrigin());
    const Ray ray = camera.ray({0.5, 0.5}, {}, 0.25f);
    CHECK(ray.org == (Vec3{0.5f, 0, 0}) && ray.time == 0.25f);
    CHECK(ray.dir == (Vec3{0, 0, -1}));
    CHECK(camera.axesAt(1).eye == (Vec3d{2, 0, 0}));
}

// The line of a place is what its ray rounds, of cameras without a lens.
TEST(camera_lines_are_what_rays_round) {
    Random random(417);
    for (int i = 0; i < check::scaled(200); ++i) {
        CameraParams p;
        p.worldFromCamera = kit::randomMap(random);
        p.width = 64, p.height = 48;
        p.shiftX = random.uniform(-1, 1);
        if (random.coin()) p.kind = CameraParams::Kind::Orthographic;
        const Camera camera(p);
        CHECK(camera.hasSharedOrigin() == (p.kind == CameraParams::Kind::Perspective));
        for (int k = 0; k < 15; ++k) {
            const Vec2d at{random.uniform(-3, 67), random.uniform(-3, 51)};
            const Ray ray = camera.ray(at, {0.25f, 0.75f}, 0.5f);
            const Camera::Line line = camera.line(at);
            CHECK(toFloat(line.org) == ray.org && toFloat(normalize(line.dir)) == ray.dir);
        }
    }
}

} // namespace test_camera
