// Depth of field and motion blur against geometry.
#include "check.h"
#include "shot.h"

#include "image/compare.h"

namespace test_lens_motion {

namespace {

const std::string kGlow = "material glow {\n diffuse 0 0 0\n emission 1 1 1\n}\n";

struct Spread {
    double energy = 0, x = 0, y = 0, varianceX = 0, varianceY = 0, radius = 0;
};
// Moments of a picture's light about its centre of mass, in pixels; radius: the farthest lit pixel.
Spread spreadOf(const Image& image) {
    Spread s;
    const auto each = [&](auto&& fn) {
        for (int y = 0; y < image.height(); ++y)
            for (int x = 0; x < image.width(); ++x)
                fn(x + 0.5, y + 0.5, double{image.pixel(x, y).r});
    };
    each([&](double x, double y, double w) { s.energy += w, s.x += w * x, s.y += w * y; });
    s.x /= s.energy, s.y /= s.energy;
    each([&](double x, double y, double w) {
        s.varianceX += w * sqr(x - s.x) / s.energy, s.varianceY += w * sqr(y - s.y) / s.energy;
        if (w > 0) s.radius = max(s.radius, std::sqrt(sqr(x - s.x) + sqr(y - s.y)));
    });
    return s;
}

constexpr double kFocus = 4;
constexpr int kSide = 64;
constexpr double kPixel = kFocus * 0.1 / kSide; // in the plane of focus; sensor over lens is 0.1
// A glowing disk on the axis at a depth, of a radius of `size` pixels.
Image ball(double depth, double aperture, const std::string& lens, double size = 4) {
    return shot::render(cat("settings {\n resolution 64 64\n samples 128\n filter box 1\n}\n"
                            "camera c {\n look_at 0 0 0  0 1 0  0 0 1\n lens 100\n sensor 10 10\n"
                            " focus_distance ",
                            kFocus, "\n aperture_radius ", aperture, "\n", lens, "}\n", kGlow,
                            "disk d {\n translate 0 ", depth, " 0\n rotate 90 1 0 0\n radius ",
                            shortest(size * kPixel / kFocus * depth), "\n material glow\n}\n"))
        .color;
}

Image moving(const std::string& object, int samples = 256) {
    shot::TopView view{.pixels = 40, .side = 4, .samples = samples};
    return shot::render(view.text() + kGlow + object).color;
}
double distance(const shot::TopView& view, int x, int y) {
    const Vec2d p = view.place(x, y);
    return std::sqrt(p.x * p.x + p.y * p.y);
}

} // namespace

// In the plane of focus a lens changes nothing: the same samples see the same, but for the few at
// the disk's rim (the lens ray comes from the side and is rounded otherwise).
TEST(inFocusThereIsNoBlur) {
    const Image sharp = ball(kFocus, 0, ""), lens = ball(kFocus, 0.1, "");
    CHECK(shot::maxDifference(sharp, lens) < 1.5 / 128); // at most one of 128 samples of any pixel
    CHECK(shot::differingPixels(sharp, lens) <= 4);
    CHECK(shot::estimate(sharp).mean > 0);
}

// A point at depth d is a disk of radius a |d - f| / d in the plane of focus; its variance along an
// axis is a quarter of the radius squared, on top of what the sharp picture has.
TEST(blurCircleHasItsRadius) {
    for (const double depth : {2.0, 3.0, 6.0, 12.0}) {
        const double radius = 15, aperture = radius * kPixel * depth / std::fabs(depth - kFocus);
        const Spread sharp = spreadOf(ball(depth, 0, "")),
                     soft = spreadOf(ball(depth, aperture, ""));
        // 6,000 lens samples hit the disk: 1 % of noise in a variance, so 2 % of a radius is 3
        // sigma.
        CHECK_NEAR(2 * std::sqrt(soft.varianceX - sharp.varianceX), radius, 0.02 * radius);
        CHECK_NEAR(2 * std::sqrt(soft.varianceY - sharp.varianceY), radius, 0.02 * radius);
        CHECK_NEAR(soft.radius, radius + sharp.radius, 1.5); // a pixel, and half for the centre
        CHECK_NEAR(soft.x, kSide / 2, 0.02 * radius);
        CHECK_NEAR(soft.y, kSide / 2, 0.02 * radius);
    }
}

// Blades: the blur is the polygon of the lens, whose variance is R^2 (2 + cos(2 pi / n)) / 12 along
// each axis. In front of the focus it stands on its head. The ratio squeezes it in x.
TEST(bokehHasBlades) {
    const double radius = 20, aperture = radius * kPixel * 12 / (12 - kFocus);
    const Spread sharp = spreadOf(ball(12, 0, "", 2));
    for (const int blades : {3, 5, 6}) {
        const Spread s = spreadOf(
            ball(12, aperture, cat(" aperture_blades ", blades, "\n aperture_rotation 10\n"), 2));
        const double variance = radius * radius * (2 + std::cos(kTwoPi / blades)) / 12;
        CHECK_NEAR(s.varianceX - sharp.varianceX, variance, 0.06 * variance); // 1,600 samples: 2 %
        CHECK_NEAR(s.varianceY - sharp.varianceY, variance, 0.06 * variance);
    }
    const Image triangle = ball(12, aperture, " aperture_blades 3\n aperture_rotation 10\n", 2);
    const auto around = [&](double angle) { // 3x3 pixels at 0.75 of the radius
        const int x = static_cast<int>(kSide / 2 + 0.75 * radius * std::cos(angle));
        const int y = static_cast<int>(kSide / 2 - 0.75 * radius * std::sin(angle));
        double sum = 0;
        for (int i = 0; i < 9; ++i) sum += double{triangle.pixel(x - 1 + i % 3, y - 1 + i / 3).r};
        return sum;
    };
    for (int k = 0; k < 3; ++k) {
        // A lens point a sees the far point at a (d-f)/d in the plane of focus: upright.
        const double corner = radians(10) + kTwoPi * k / 3;
        CHECK(around(corner) > 0);
        CHECK_EQUAL(around(corner + kPi / 3), 0.0);
    }
    const Spread wide = spreadOf(ball(12, aperture, " aperture_ratio 2\n", 2));
    CHECK_NEAR(2 * std::sqrt(wide.varianceX - sharp.varianceX), radius / 2, 0.03 * radius);
    CHECK_NEAR(2 * std::sqrt(wide.varianceY - sharp.varianceY), radius, 0.03 * radius);
}

// An edge that sweeps evenly covers a pixel for a part of the shutter that is linear in its place.
// 256 Sobol samples: 2 % covers the pixel's own width (0.1 of 2 units) and the sampling.
TEST(movingEdgeCoversLinearly) {
    const shot::TopView view{.pixels = 40, .side = 4};
    for (const std::string kind : {"plane e {\n", "cube e {\n"}) {
        const Image image =
            moving(kind + " translate -4 0 0\n scale 3 3 1\n key\n translate -2 0 0\n"
                          " scale 3 3 1\n material glow\n}\n"); // edge from -1 to 1
        for (int y = 0; y < 40; ++y)
            for (int x = 0; x < 40; ++x) {
                const double wanted = clamp((1 - view.place(x, y).x) / 2, 0.0, 1.0);
                CHECK_NEAR(image.pixel(x, y).r, wanted, 0.02);
            }
    }
}

// A turning bar covers what is at distance r for 2 asin(w/r) of its quarter turn; the turn has an
// even speed. Three keys make it a turn of 2 * 45 degrees about the same axis.
TEST(turningBarCoversByAngle) {
    const shot::TopView view{.pixels = 40, .side = 4};
    for (const std::string keys :
         {" rotate 90 0 0 1\n", " rotate 45 0 0 1\n scale 5 0.2 1\n key\n rotate 90 0 0 1\n"}) {
        const Image image = moving("plane bar {\n scale 5 0.2 1\n key\n" + keys +
                                   " scale 5 0.2 1\n material glow\n}\n");
        for (int y = 0; y < 40; ++y)
            for (int x = 0; x < 40; ++x) {
                const double r = distance(view, x, y);
                if (r < 0.8) continue;
                const Vec2d p = view.place(x, y);
                double angle = std::atan2(p.y, p.x);
                if (angle < -kPi / 4) angle += kPi; // the bar has two ends
                if (angle > 3 * kPi / 4) angle -= kPi;
                const double half = std::asin(0.2 / r);
                const double from = max(angle - half, 0.0), to = min(angle + half, kHalfPi);
                // The pixel spans 0.1/r radians of pi/2: 8 % of blur at the ends, 3 % elsewhere.
                const bool nearEnd = std::fabs(angle + half) < 0.2 ||
                                     std::fabs(angle - half) < 0.2 ||
                                     std::fabs(angle + half - kHalfPi) < 0.2 ||
                                     std::fabs(angle - half - kHalfPi) < 0.2;
                CHECK_NEAR(image.pixel(x, y).r, max(to - from, 0.0) / kHalfPi,
                           nearEnd ? 0.08 : 0.03);
            }
    }
}

// A body that grows from radius 0.5 to 1.5 covers a distance r for 1.5 - r of the shutter: every
// kind of shape, mesh and instance too.
TEST(growingBodiesCoverByRadius) {
    const shot::TopView view{.pixels = 40, .side = 4};
    std::string points, triangles;
    for (int i = 0; i < 64; ++i) {
        points += cat(std::cos(kTwoPi * i / 64), " ", std::sin(kTwoPi * i / 64), " 0 ");
        triangles += cat("64 ", i, " ", (i + 1) % 64, " ");
    }
    const std::string fan =
        "mesh fan {\n points 65\n " + points + "0 0 0\n triangles 64\n " + triangles + "\n}\n";
    for (const std::string body : {"sphere b {\n", "disk b {\n", "cylinder b {\n",
                                   "cone b {\n top_radius 0.5\n", "instance b {\n mesh fan\n"}) {
        const Image image =
            moving((body.starts_with("instance") ? fan : "") + body +
                   " scale 0.5 0.5 0.5\n key\n scale 1.5 1.5 1.5\n material glow\n}\n");
        for (int y = 0; y < 40; ++y)
            for (int x = 0; x < 40; ++x)
                CHECK_NEAR(image.pixel(x, y).r, clamp(1.5 - distance(view, x, y), 0.0, 1.0), 0.05);
    }
}

// A camera that moves to the right sees what a scene sees that moves to the left.
TEST(movingCameraIsMovingSceneBackwards) {
    const std::string settings = "settings {\n resolution 48 48\n samples 16\n}\n" + kGlow;
    const Image camera = shot::render(settings + "camera c {\n translate 0 0 5\n key\n translate 1 "
                                                 "0.5 5\n}\nsphere s {\n material glow\n}\n")
                             .color;
    const Image scene = shot::render(settings + "camera c {\n translate 0 0 5\n}\nsphere s {\n "
                                                "material glow\n key\n translate -1 -0.5 0\n}\n")
                            .color;
    CHECK(rmse(camera, scene) < 2e-3); // single samples at the rim
    CHECK(shot::estimate(camera).mean > 0.05);
}

// --no-motion-blur shows the middle of the shutter, --no-dof the pinhole's picture.
TEST(switchedOffBlurs) {
    const std::string settings = "settings {\n resolution 32 32\n samples 4\n}\n" + kGlow;
    const std::string camera =
        "camera c {\n translate 0 0 5\n aperture_radius 0.3\n focus_distance 2\n}\n";
    const Image off =
        shot::render(settings + camera + "sphere s {\n material glow\n key\n translate -1 0 0\n}\n",
                     [](RenderSettings& s) { s.switches.motionBlur = s.switches.dof = false; })
            .color;
    const Image still =
        shot::render(settings + "camera c {\n translate 0 0 5\n}\n"
                                "sphere s {\n translate -0.5 0 0\n material glow\n}\n")
            .color;
    CHECK_EQUAL(shot::differingPixels(off, still), 0);
}

} // namespace test_lens_motion
