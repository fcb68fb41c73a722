// Closed-form pictures of a Lambertian floor under every kind of light.
#include "check.h"
#include "shot.h"

namespace test_lights {

namespace {

using shot::TopView;

// Surfaces whose upper side is z = 0 and covers [-1,1]^2.
const std::vector<std::string> kFloors = {
    "plane f {\n scale 2 2 1\n material m\n}\n",
    "infinite_plane f {\n material m\n}\n",
    "disk f {\n radius 2\n material m\n}\n",
    "cube f {\n translate 0 0 -1\n scale 2 2 1\n material m\n}\n",
    "cylinder f {\n translate 0 0 -1\n radius 2\n material m\n}\n",
    "cone f {\n translate 0 0 -1\n radius 1\n top_radius 2\n material m\n}\n",
    ("mesh q {\n points 4\n -2 -2 0 2 -2 0 2 2 0 -2 2 0\n triangles 2\n 0 1 2 0 2 3\n}\n"
     "instance f {\n mesh q\n material m\n}\n"),
    ("mesh q {\n points 4\n -2 -2 0 2 -2 0 2 2 0 -2 2 0\n triangles 2\n 0 1 2 0 2 3\n}\n"
     "instance f {\n mesh q\n material m\n}\n"
     "instance g {\n translate 0 0 -5\n mesh q\n material m\n}\n")};

const std::string kMaterial = "material m {\n diffuse 0.8 0.5 0.25\n}\n";
constexpr Vec3d kDiffuse{0.8, 0.5, 0.25};

// Irradiance of a point of z = 0 from a point light of unit intensity at `light`.
double pointIrradiance(Vec3d light, Vec2d p) {
    const Vec3d d = light - Vec3d{p.x, p.y, 0};
    const double r = shot::length3(d);
    return d.z / (r * r * r);
}

// E = L * (1/2) sum of angle_i * (unit normal of the plane through edge i and the receiver). n
// (Lambert 1760); corners of a polygon above z = 0, given in either turn.
double polygonIrradiance(const std::vector<Vec3d>& corners, Vec3d p, Vec3d n) {
    double sum = 0;
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const Vec3d a = normalize(corners[i] - p);
        const Vec3d b = normalize(corners[(i + 1) % corners.size()] - p);
        sum += std::acos(dot(a, b)) * dot(normalize(cross(a, b)), n);
    }
    return std::fabs(sum) / 2;
}

// The centre of the picture as the mean of 1024 pixels of 16 independent samples of the lamp. More
// than 3 sigma is wrong; and sigma below 2 % makes sure that the test can tell. Lamps with and
// without shadows are the same here.
void checkSoft(const std::string& light, Vec2d place, double expected) {
    TopView view{.pixels = 32,
                 .side = 1e-4,
                 .centre = place,
                 .samples = 4,
                 .more = "sampler random\n light_samples 4"};
    for (const bool casts : {true, false}) {
        const std::string scene =
            cat(view.text(), "material m {\n diffuse 0.8 0.5 0.25\n}\n", kFloors[0],
                "light l {\n shadows ", casts ? "true" : "false", light);
        const shot::Estimate e = shot::estimate(shot::render(scene).color);
        CHECK_INFO(std::fabs(e.mean - expected) < 3 * e.sigma,
                   e.mean << " +- " << e.sigma << ", expected " << expected << " in\n"
                          << scene);
        CHECK_INFO(e.sigma < 0.02 * expected, e.sigma / expected);
        CHECK(e.sigma > 0);
    }
}

} // namespace

// Nine pixels, relative error 1e-5: some 20 float roundings of 6e-8 each, and positions to 1e-7 of
// the scene's extent.
TEST(pointLightOnEveryFloor) {
    const TopView view;
    for (const std::string& floor : kFloors) {
        const shot::Shot shot =
            shot::render(view.text() + kMaterial + floor +
                             "light l {\n translate 0.3 -0.2 1.5\n color 10 20 30\n}\n",
                         [](RenderSettings& s) { s.specialise = false; }); // no ray is left out
        for (int y = 0; y < 3; ++y)
            for (int x = 0; x < 3; ++x) {
                const double e = pointIrradiance({0.3, -0.2, 1.5}, view.place(x, y)) / kPi;
                const Vec3d wanted{kDiffuse.x * e * 10, kDiffuse.y * e * 20, kDiffuse.z * e * 30};
                CHECK_RGB(shot.at(x, y), wanted, 1e-5);
            }
        CHECK_EQUAL(shot.stats.rays.shadow, 9u);
        CHECK_EQUAL(shot.stats.cameraHits, 9u);
    }
}

TEST(spotConeFallsOffAsSmoothstep) {
    const TopView view{.pixels = 21};
    const Vec3d place{0.1, 0.05, 2};
    const Vec3d target{0, 0.1, 0};
    for (const bool cosine : {false, true}) {
        const shot::Shot shot = shot::render(
            view.text() + kMaterial + kFloors[0] +
            "light l {\n type spot\n look_at 0.1 0.05 2  0 0.1 0  0 1 0\n color 10 20 30\n"
            " cone_angle 50\n blend 0.4\n cosine_falloff " +
            (cosine ? "true" : "false") + "\n}\n");
        int dark = 0, full = 0, soft = 0;
        for (int y = 0; y < view.pixels; ++y)
            for (int x = 0; x < view.pixels; ++x) {
                const Vec2d p = view.place(x, y);
                const double c =
                    dot(normalize(Vec3d{p.x, p.y, 0} - place), normalize(target - place));
                const double edge = std::cos(radians(25));
                const double s = clamp((c - edge) / ((1 - edge) * 0.4), 0.0, 1.0);
                const double cone = s * s * (3 - 2 * s) * (cosine ? c : 1);
                (s <= 0 ? dark : s >= 1 ? full : soft) += 1;
                const double e = pointIrradiance(place, p) * cone / kPi;
                // The cone's edge is a difference of cosines: absolute error 1e-7 / 0.04 of s.
                CHECK_NEAR(shot.at(x, y).r, 10 * kDiffuse.x * e, 3e-5 * e * 10 + 2e-5);
            }
        CHECK(dark > 20 && full > 20 && soft > 20); // all three branches are in the picture
    }
}

TEST(sunHasTheCosineOnly) {
    const TopView view;
    for (const std::string& floor : kFloors) {
        const shot::Shot shot =
            shot::render(view.text() + kMaterial + floor +
                         "light l {\n type sun\n rotate 35 1 0.5 0\n color 1 2 3\n}\n");
        const double e = std::cos(radians(35)) / kPi; // the axis of the turn is level
        for (int i = 0; i < 9; ++i)
            CHECK_RGB(shot.at(i % 3, i / 3),
                      (Vec3d{kDiffuse.x * e, kDiffuse.y * e * 2, kDiffuse.z * e * 3}), 1e-6);
    }
    // From below: dark.
    CHECK_EQUAL(shot::largest(shot::render(view.text() + kMaterial + kFloors[0] +
                                           "light l {\n type sun\n rotate 170 1 0 0\n}\n")
                                  .color),
                0.0);
}

TEST(ambientAndEmissionAreExact) {
    const TopView view;
    const shot::Shot shot =
        shot::render(view.text() + kFloors[0] +
                     "world {\n ambient 0.25 0.5 1\n background 9 9 9\n}\n"
                     "material m {\n diffuse 0.5 0.25 0.125\n emission 0.125 0 3\n}\n");
    for (const Rgb& pixel : shot.color.pixels())
        CHECK((pixel == Rgb{0.5f * 0.25f + 0.125f, 0.25f * 0.5f, 0.125f + 3}));
}

TEST(diskLightOnItsAxis) {
    const std::string light = "\n type disk\n translate 0 0 1.5\n size 2 2\n color 3 3 3\n}\n";
    const double r = 1, h = 1.5; // E = pi L r^2/(r^2+h^2)
    checkSoft(light, {0, 0}, kDiffuse.x * 3 * r * r / (r * r + h * h));
}

TEST(rectangleLightIsLambertsPolygon) {
    const std::string light = "\n type rectangle\n translate 0.2 0.1 1.25\n rotate 25 1 1 0\n"
                              " size 1.5 0.75\n color 3 3 3\n}\n";
    const Transform place =
        Transform::translate({0.2, 0.1, 1.25}) * Transform::rotate({1, 1, 0}, radians(25));
    std::vector<Vec3d> corners;
    for (const Vec2d c : {Vec2d{-1, -1}, Vec2d{1, -1}, Vec2d{1, 1}, Vec2d{-1, 1}})
        corners.push_back(place.point({c.x * 0.75, c.y * 0.375, 0}));
    for (const Vec2d p : {Vec2d{0, 0}, Vec2d{0.6, -0.4}, Vec2d{-0.5, 0.75}})
        checkSoft(light, p,
                  kDiffuse.x / kPi * 3 * polygonIrradiance(corners, {p.x, p.y, 0}, {0, 0, 1}));
}

// An ellipse as a polygon of 256 corners: 1e-4 of its area is missing, below the noise.
TEST(ellipseLightIsLambertsPolygonToo) {
    const std::string light = "\n type disk\n translate 0.2 0.1 1.25\n rotate 25 1 1 0\n"
                              " scale 1.5 1 1\n size 1 0.75\n color 3 3 3\n}\n";
    const Transform place = Transform::translate({0.2, 0.1, 1.25}) *
                            Transform::rotate({1, 1, 0}, radians(25)) *
                            Transform::scale({1.5, 1, 1});
    std::vector<Vec3d> corners;
    for (int i = 0; i < 256; ++i)
        corners.push_back(
            place.point({0.5 * std::cos(kTwoPi * i / 256), 0.375 * std::sin(kTwoPi * i / 256), 0}));
    for (const Vec2d p : {Vec2d{0.1, 0}, Vec2d{0.6, -0.4}})
        checkSoft(light, p,
                  kDiffuse.x / kPi * 3 * polygonIrradiance(corners, {p.x, p.y, 0}, {0, 0, 1}));
}

// E = pi L r^2/d^2 cos, whatever the distance, while the sphere is all above the horizon.
TEST(sphereLightIsItsSolidAngle) {
    for (const Vec3d place : {Vec3d{0, 0, 1.5}, Vec3d{1, 0.5, 1.25}, Vec3d{0, 0, 1.001}}) {
        const std::string light = cat("\n type sphere\n translate ", place.x, " ", place.y, " ",
                                      place.z, "\n radius 1\n color 3 3 3\n}\n");
        const double d2 = dot(place, place);
        checkSoft(light, {0, 0}, kDiffuse.x * 3 * place.z / (d2 * std::sqrt(d2)));
    }
    // Inside of it all light comes from the upper half: E = pi L.
    checkSoft("\n type sphere\n radius 5\n color 3 3 3\n}\n", {0, 0}, kDiffuse.x * 3);
}

// A sun of 40 degrees gives the same irradiance as one of 0 on a surface that it is all above.
TEST(wideSunKeepsItsIrradiance) {
    const std::string sun = "\n type sun\n rotate 30 1 0 0\n color 3 3 3\n angle 40\n}\n";
    checkSoft(sun, {0, 0}, kDiffuse.x / kPi * 3 * std::cos(radians(30)));
}

// E = I * mean over the disk, that faces the receiver, of cosAtDisk * cosAtReceiver / distance^2;
// on the axis, where all is round: 2 I h^2 / r^2 * integral of s ds / (h^2+s^2)^2 = I / (h^2 +
// r^2).
TEST(pointLightWithRadius) {
    const std::string light = "\n translate 0 0 1.5\n radius 0.75\n color 3 3 3\n}\n";
    checkSoft(light, {0, 0}, kDiffuse.x / kPi * 3 / (1.5 * 1.5 + 0.75 * 0.75));
}

// A lamp so small that it is a point: E = L A cosLight cos/d^2 * (tan h - tan a) / (tan h - h).
TEST(spreadNarrowsTheEmission) {
    const TopView view{.pixels = 9};
    const shot::Shot shot = shot::render(view.text() + kMaterial + kFloors[0] +
                                         "light l {\n type rectangle\n translate 0 0 1\n size "
                                         "0.001 0.001\n color 1e6 1e6 1e6\n spread 80\n}\n");
    const double h = radians(40);
    for (int y = 0; y < 9; ++y)
        for (int x = 0; x < 9; ++x) {
            const Vec2d p = view.place(x, y);
            const double tangent = std::sqrt(p.x * p.x + p.y * p.y),
                         c = 1 / std::sqrt(1 + tangent * tangent);
            const double spread = max(std::tan(h) - tangent, 0.0) / (std::tan(h) - h);
            // The lamp's half side of 5e-4 moves tan a by as much, times the slope of the spread.
            CHECK_NEAR(shot.at(x, y).r, kDiffuse.x / kPi * c * c * c * c * spread,
                       5e-3 * kDiffuse.x);
        }
    CHECK_EQUAL(shot.at(0, 0).r, 0.0f); // outside of the spread: nothing at all
}

// Lamps that do not cast shadows shine through; the others do not. Inverse square over 3 decades.
TEST(shadowsFlagAndInverseSquare) {
    const TopView view;
    const std::string lid = "disk lid {\n translate 0 0 0.5\n radius 0.01\n material m\n}\n";
    for (const double h : {1.0, 10.0, 100.0, 1000.0}) {
        const TopView one{.pixels = 1, .side = 1e-3, .height = 0.25};
        const auto scene = [&](bool shadows) {
            return cat(one.text(), kMaterial, kFloors[0], lid, "light l {\n translate 0 0 ", h,
                       "\n color 1 1 1\n shadows ", shadows ? "true" : "false", "\n}\n");
        };
        CHECK_EQUAL(shot::render(scene(true)).at(0, 0).r, 0.0f);
        CHECK_NEAR(shot::render(scene(false)).at(0, 0).r * h * h, kDiffuse.x / kPi, 1e-6);
    }
}

// Several lamps add up: the picture of all is the sum of the pictures of each.
TEST(lightsAddUp) {
    const TopView view{.pixels = 16};
    const std::vector<std::string> lights = {
        "light a {\n translate 0.3 -0.2 1.5\n color 1 2 3\n}\n",
        "light b {\n type sun\n rotate 35 1 0.5 0\n color 1 2 3\n}\n",
        "light c {\n type spot\n translate 0 0 1\n color 3 2 1\n}\n"};
    const std::string scene = view.text() + kMaterial + kFloors[0] +
                              "sphere s {\n translate 0 0 0.4\n radius 0.2\n material m\n}\n";
    const Image all = shot::render(scene + lights[0] + lights[1] + lights[2]).color;
    Image sum(16, 16);
    for (const std::string& light : lights) {
        const Image one = shot::render(scene + light).color;
        for (std::size_t i = 0; i < sum.pixels().size(); ++i) sum.pixels()[i] += one.pixels()[i];
    }
    CHECK(shot::maxDifference(all, sum) <= 4e-7 * shot::largest(all)); // three float additions
}

} // namespace test_lights
