// A camera's thin lens: its blur, the plane that is sharp, the form of its aperture.
#include "camera/camera.h"
#include "camera_kit.h"
#include "check.h"

namespace test_camera_lens {

using camera_kit::somewhere;
using kit::Random;
using Kind = CameraParams::Kind;

namespace {

// Where the ray is at a depth along the view axis.
Vec3d atDepth(const Ray& ray, const Camera::Axes& view, double depth) {
    const Vec3d org = toDouble(ray.org), dir = toDouble(ray.dir);
    const double t = (depth - dot(org - view.eye, view.forward)) / dot(dir, view.forward);
    return org + dir * t;
}

} // namespace

TEST(camera_thin_lens_blur) {
    Random random(804);
    for (const Kind kind : {Kind::Perspective, Kind::Orthographic}) {
        for (int s = 0; s < 20; ++s) {
            CameraParams p;
            p.kind = kind;
            p.width = 64;
            p.height = 48;
            p.worldFromCamera = somewhere(random);
            p.apertureRadius = random.uniform(0.001, 0.2);
            p.focusDistance = random.uniform(0.5, 4);
            const Camera camera(p);
            CameraParams pin = p;
            pin.apertureRadius = 0;
            const Camera pinhole(pin);
            const Camera::Axes view = camera.axesAt(0);
            const Vec2d pixel{random.uniform(0, 64), random.uniform(0, 48)};
            const Ray sharp = pinhole.ray(pixel, {}, 0);
            double widest = 0;
            const double depth = random.uniform(0.2, 8);
            for (int i = 0; i < 400; ++i) {
                const Vec2 lens{static_cast<float>(random.unit()),
                                static_cast<float>(random.unit())};
                const Ray ray = camera.ray(pixel, lens, 0);
                CHECK_NEAR(length(toDouble(ray.dir)), 1, 1e-7);
                // In the sharp plane all meet: the rounded direction errs by 1e-7 of the way.
                const Vec3d focus = atDepth(ray, view, p.focusDistance);
                CHECK_NEAR(length(focus - atDepth(sharp, view, p.focusDistance)), 0, 2e-6);
                // The lens is flat and across the axis.
                const double lensDepth = dot(toDouble(ray.org) - toDouble(sharp.org), view.forward);
                CHECK_NEAR(lensDepth, 0, 1e-6);
                const Vec3d off = atDepth(ray, view, depth) - atDepth(sharp, view, depth);
                widest = max(widest, length(off));
            }
            // Circle of confusion: similar triangles.
            const double radius = p.apertureRadius * std::fabs(1 - depth / p.focusDistance);
            CHECK(widest <= radius + 4e-6);
            CHECK(widest >= 0.95 * radius - 4e-6); // 400 points reach nearly to the rim
        }
    }
}

TEST(camera_lens_rays_meet_far_from_the_origin) {
    // The origin is rounded to 2^-14 here, and yet all rays of a pixel meet within 1e-6: dir is
    // made from the rounded origin. (g++ 12 breaks this at -O2 unless -fno-tree-slp-vectorize: its
    // vectoriser drops the rounding in double -> float -> double.)
    Random random(806);
    CameraParams p;
    p.worldFromCamera = Transform::translate({1000.1, 700.3, 1300.7});
    p.apertureRadius = 0.3;
    p.focusDistance = 2;
    const Camera camera(p);
    const Vec3d focus{1000.1, 700.3, 1298.7};
    for (int i = 0; i < 1000; ++i) {
        const Vec2 lens{static_cast<float>(random.unit()), static_cast<float>(random.unit())};
        const Ray ray = camera.ray({0.5, 0.5}, lens, 0);
        CHECK_NEAR(length(atDepth(ray, camera.axesAt(0), p.focusDistance) - focus), 0, 1e-6);
    }
}

TEST(camera_polygonal_aperture) {
    Random random(805);
    for (int blades = 3; blades <= 9; ++blades) {
        CameraParams p;
        p.apertureRadius = 0.5;
        p.apertureBlades = blades;
        p.apertureRotationRad = random.uniform(-3, 3);
        p.apertureRatio = blades % 2 == 0 ? 2 : 1;
        const Camera camera(p);
        double nearestToEdge = 1, nearestToCorner = 1, meanX = 0, meanY = 0;
        const int count = 4000;
        for (int i = 0; i < count; ++i) {
            const Vec2 lens{static_cast<float>(random.unit()), static_cast<float>(random.unit())};
            const Vec3 org = camera.ray({0.5, 0.5}, lens, 0).org;
            const double x = static_cast<double>(org.x) / 0.5 * p.apertureRatio;
            const double y = static_cast<double>(org.y) / 0.5;
            meanX += x / count;
            meanY += y / count;
            for (int k = 0; k < blades; ++k) {
                const double corner = p.apertureRotationRad + kTwoPi * k / blades;
                const double middle = corner + kPi / blades;
                const double distance =
                    std::cos(kPi / blades) - (x * std::cos(middle) + y * std::sin(middle));
                CHECK(distance >= -1e-6);
                nearestToEdge = min(nearestToEdge, distance);
                nearestToCorner =
                    min(nearestToCorner, std::hypot(x - std::cos(corner), y - std::sin(corner)));
            }
        }
        CHECK(nearestToEdge < 0.01 && nearestToCorner < 0.2); // and all of it is used
        CHECK_NEAR(meanX, 0, 0.05);
        CHECK_NEAR(meanY, 0, 0.05);
    }
}

} // namespace test_camera_lens
