// Glass, and what reflects as it does, against Fresnel's and Snell's formulas.
#include "check.h"
#include "shot.h"
#include "solids.h"

#include "image/compare.h"

namespace test_glass {

namespace {

// Reflectance of unpolarised light, from the amplitudes.
double fresnel(double thetaIn, double iorIn, double iorOut) {
    const double sine = std::sin(thetaIn) * iorIn / iorOut;
    if (sine >= 1) return 1;
    const double a = std::cos(thetaIn), b = std::sqrt(1 - sine * sine);
    const double s = (iorIn * a - iorOut * b) / (iorIn * a + iorOut * b);
    const double p = (iorIn * b - iorOut * a) / (iorIn * b + iorOut * a);
    return (s * s + p * p) / 2;
}

// A plane whose colour is its place: red = x/4 + 1/2, green = y/4 + 1/2 while |x|, |y| < 2.
std::string ruler() {
    const std::string file = shot::writeTexture("ruler.pfm", 2, 2, [](double u, double v) {
        return Rgb{u < 0.5 ? 0.0f : 1.0f, v < 0.5 ? 0.0f : 1.0f, 0};
    });
    return "texture ruler {\n file " + file +
           "\n extension extend\n}\n"
           "material ruler {\n diffuse 0 0 0\n emission 1 1 1\n emission_texture ruler\n}\n"
           "plane ruler {\n scale 4 4 1\n material ruler\n}\n";
}
Vec2d ruled(Rgb c) { return {4 * (c.r - 0.5), 4 * (c.g - 0.5)}; }

} // namespace

// A pane with the index of the air is not there: the rays start anew at its faces, which moves
// them by no more than the offset that keeps them off the face, 1e-6 of the scene.
TEST(slabWithIorOneIsNotThere) {
    const std::string scene =
        "settings {\n resolution 32 32\n samples 4\n}\ncamera c {\n look_at 0 -4 3  0 0 0  0 0 "
        "1\n}\n"
        "plane floor {\n scale 5 5 1\n}\nsphere ball {\n translate 0 0 0.3\n radius 0.3\n}\n"
        "light l {\n translate 1 0.5 1\n color 3 3 3\n}\n";
    for (const std::string fresnel : {"none", "dielectric"}) {
        const std::string slab =
            "material air {\n diffuse 0 0 0\n transmission 1 1 1\n ior 1\n fresnel " + fresnel +
            "\n mirror 0.5 0.5 0.5\n}\ncube slab {\n translate 0 -2.5 1.8\n rotate 20 1 0 0\n"
            " scale 2 0.1 1\n material air\n}\n";
        const auto tweak = [&](RenderSettings& s) { s.switches.reflection = fresnel != "none"; };
        const Image without = shot::render(scene).color,
                    with = shot::render(scene + slab, tweak).color;
        int close = 0;
        for (std::size_t i = 0; i < with.pixels().size(); ++i)
            close += std::fabs(with.pixels()[i].r - without.pixels()[i].r) < 2e-6 * 3;
        CHECK(close >= 1021); // of 1024: at an edge a ray may fall to the other side
        CHECK(shot::estimate(with).mean > 0.05);
    }
}

// The ray through a slab of thickness t is moved by t (tan a - tan b), sin a = ior sin b.
TEST(slabMovesTheRayBySnell) {
    for (const double ior : {1.1, 1.5, 2.4})
        for (const double angle : {0.0, 10.0, 40.0, 60.0, 72.0}) {
            const double a = radians(angle), b = std::asin(std::sin(a) / ior), thickness = 0.6;
            const shot::Shot shot = shot::render(
                cat(shot::kOnePixel, 8, "\n}\n", ruler(),
                    "camera c {\n type orthographic\n look_at ", shortest(6 * std::tan(a)),
                    " 0 6  0 0 0  0 1 0\n}\n"
                    "material glass {\n diffuse 0 0 0\n transmission 1 1 1\n ior ",
                    ior,
                    "\n}\n"
                    "cube slab {\n translate 0 0 0.6\n scale 4 4 0.3\n material glass\n}\n"));
            const Vec2d place = ruled(shot.at(0, 0));
            // Scene of 8 m: places are rounded to 5e-7, twice; the ruler's colour to 2e-7 of 4 m.
            CHECK_NEAR(place.x, thickness * (std::tan(a) - std::tan(b)), 5e-6);
            CHECK_NEAR(place.y, 0, 2e-6);
        }
}

// From under water, without a mirror term: in red 1 - F of the sky up to the critical angle, beyond
// it in blue the ground, totally reflected. The scene has surfaces without end only.
TEST(criticalAngleFromInside) {
    constexpr int kSide = 41;
    const shot::Shot shot = shot::render(cat(
        "settings {\n resolution ", kSide, " ", kSide,
        "\n samples 1\n jitter false\n}\n"
        "world {\n background 1 0 0\n}\ncamera c {\n look_at 0 0 -1  0 0 0  0 1 0\n lens 10\n}\n"
        "material sea {\n diffuse 0 0 0\n transmission 1 1 1\n ior 1.33\n fresnel dielectric\n}\n"
        "infinite_plane sea {\n material sea\n}\n"
        "material ground {\n diffuse 0 0 0\n emission 0 0 1\n}\n"
        "infinite_plane ground {\n translate 0 0 -2\n material ground\n}\n"));
    int dark = 0;
    for (int y = 0; y < kSide; ++y)
        for (int x = 0; x < kSide; ++x) {
            const double u = ((x + 0.5) / kSide - 0.5) * 3.6, v = ((y + 0.5) / kSide - 0.5) * 3.6;
            const double theta = std::atan(std::sqrt(u * u + v * v));
            const double wanted = 1 - fresnel(theta, 1.33, 1);
            dark += wanted == 0;
            // dF/d cos grows without bound at the critical angle: 1e-7 there gives sqrt(1e-7).
            CHECK_NEAR(shot.at(x, y).r, wanted, wanted < 0.5 ? 1e-3 : 1e-5);
            CHECK_EQUAL(shot.at(x, y).b, wanted == 0 ? 1.0f : 0.0f);
        }
    CHECK(dark > 100);
}

// Total reflection without Fresnel's formula: all the transmitted light goes there.
TEST(totalReflectionKeepsTheLight) {
    const auto radiance = [](double angle) {
        const double a = radians(angle);
        return shot::render(cat(shot::kOnePixel, 4,
                                "\n}\nworld {\n background 1 1 1\n}\n"
                                "camera c {\n look_at 0 0 -1  ",
                                shortest(std::tan(a)),
                                " 0 0  0 1 0\n}\n"
                                "material sea {\n diffuse 0 0 0\n transmission 0.5 0.5 0.5\n "
                                "mirror 0.25 0.25 0.25\n"
                                " ior 1.33\n}\ninfinite_plane sea {\n material sea\n}\n"))
            .at(0, 0)
            .r;
    };
    CHECK_NEAR(radiance(48.7), 0.75, 1e-6); // asin(1/1.33) = 48.753 degrees
    CHECK_NEAR(radiance(48.8), 0.75, 1e-6);
    CHECK_NEAR(radiance(80), 0.75, 1e-6);
}

// Reflectance pictured over the angle: a plane from above, and a ball from infinity, where the sine
// of the angle is the distance from the middle. 3e-5: the cosine's error of 1e-7 times dF/dcos,
// which stays below 30 up to 88 degrees, with a factor for the ball's position.
TEST(fresnelOverTheAngle) {
    for (const double ior : {1.33, 1.5, 2.4}) {
        const std::string material =
            cat("world {\n background 1 1 1\n}\nmaterial g {\n diffuse 0 0 0\n mirror 1 1 1\n"
                " fresnel dielectric\n ior ",
                ior, "\n}\n");
        const shot::Shot plane = shot::render(
            "settings {\n resolution 41 41\n samples 1\n jitter false\n}\n" + material +
            "camera c {\n look_at 0 0 1  0 0 0  0 1 0\n lens 4\n}\ninfinite_plane p {\n material "
            "g\n}\n");
        const shot::TopView view{.pixels = 41};
        const shot::Shot ball =
            shot::render(view.text() + material + "sphere s {\n material g\n}\n");
        for (int y = 0; y < 41; ++y)
            for (int x = 0; x < 41; ++x) {
                const double u = ((x + 0.5) / 41 - 0.5) * 9, v = ((y + 0.5) / 41 - 0.5) * 9;
                CHECK_NEAR(plane.at(x, y).r, fresnel(std::atan(std::sqrt(u * u + v * v)), 1, ior),
                           3e-5);
                const Vec2d p = view.place(x, y);
                const double rho = std::sqrt(p.x * p.x + p.y * p.y);
                if (rho < 0.999) CHECK_NEAR(ball.at(x, y).r, fresnel(std::asin(rho), 1, ior), 3e-5);
                if (rho > 1) CHECK_EQUAL(ball.at(x, y).r, 1.0f);
            }
    }
}

TEST(schlickOverTheAngle) {
    const shot::TopView view{.pixels = 21};
    const shot::Shot ball = shot::render(
        view.text() + "world {\n background 1 1 1\n}\nmaterial g {\n diffuse 0 0 0\n"
                      " mirror 0.04 0.5 1\n fresnel schlick\n}\nsphere s {\n material g\n}\n");
    for (int y = 0; y < 21; ++y)
        for (int x = 0; x < 21; ++x) {
            const Vec2d p = view.place(x, y);
            const double rho2 = p.x * p.x + p.y * p.y;
            if (rho2 > 0.99) continue;
            const double rise = std::pow(1 - std::sqrt(1 - rho2), 5);
            CHECK_RGB(ball.at(x, y), (Vec3d{0.04 + 0.96 * rise, 0.5 + 0.5 * rise, 1}), 1e-5);
        }
}

// Straight or aslant through ice in water in glass: the product of (1 - F) at the six faces.
TEST(nestedMediaMultiplyFresnel) {
    const auto glass = [](const char* name, double ior) {
        return cat("material ", name,
                   " {\n diffuse 0 0 0\n transmission 1 1 1\n fresnel dielectric\n ior ", ior,
                   "\n}\n");
    };
    const std::string scene =
        "world {\n background 1 1 1\n}\n" + glass("glass", 1.5) + glass("water", 1.33) +
        glass("ice", 1.31) +
        "cube g {\n scale 9 9 3\n material glass\n}\ncube w {\n scale 8 8 2\n material water\n}\n"
        "cube i {\n scale 7 7 1\n material ice\n}\n";
    for (const double angle : {0.0, 20.0, 50.0}) {
        const double a = radians(angle);
        const shot::Shot shot =
            shot::render(cat(shot::kOnePixel, 6, "\n}\n", scene, "camera c {\n look_at ",
                             shortest(10 * std::tan(a)), " 0 10  0 0 0  0 1 0\n}\n"));
        double wanted = 1, theta = a;
        const std::vector<double> iors = {1, 1.5, 1.33, 1.31, 1.33, 1.5, 1};
        for (std::size_t k = 0; k + 1 < iors.size(); ++k) {
            wanted *= 1 - fresnel(theta, iors[k], iors[k + 1]);
            theta = std::asin(std::sin(theta) * iors[k] / iors[k + 1]);
        }
        CHECK_NEAR(shot.at(0, 0).r, wanted, 2e-6); // six factors and six directions, 1e-7 each
        CHECK_EQUAL(shot.stats.rays.refract, 6u);
    }
    // The camera inside of the glass, the water, the ice.
    for (const auto& [z, iors] : std::vector<std::pair<double, std::vector<double>>>{
             {2.5, {1.5, 1}}, {1.5, {1.33, 1.5, 1}}, {0.5, {1.31, 1.33, 1.5, 1}}}) {
        double wanted = 1;
        for (std::size_t k = 0; k + 1 < iors.size(); ++k)
            wanted *= 1 - fresnel(0, iors[k], iors[k + 1]);
        const shot::Shot shot =
            shot::render(cat(shot::kOnePixel, 6, "\n}\n", scene, "camera c {\n look_at 0 0 ", z,
                             "  0 0 10  0 1 0\n}\n"));
        CHECK_NEAR(shot.at(0, 0).r, wanted, 2e-6);
    }
}

// A glass box of triangles is the glass cube, also when it is mirrored (its inside stays inside),
// and as one of many instances.
TEST(glassMeshesMayBeMirrored) {
    const std::string scene =
        "settings {\n resolution 32 32\n samples 4\n}\nworld {\n background 0.2 0.5 1\n}\n"
        "camera c {\n look_at 2 -4 3  0 0 0  0 0 1\n lens 60\n}\nplane floor {\n translate 0 0 "
        "-1.5\n scale 4 4 1\n}\n"
        "light l {\n translate 3 -3 5\n color 50 50 50\n}\nmaterial glass {\n diffuse 0 0 0\n "
        "transmission 1 1 1\n"
        " mirror 1 1 1\n fresnel dielectric\n}\n";
    const std::string mesh = solids::text(solids::box(1)),
                      far = "instance far {\n translate 0 0 -99\n mesh box\n}\n";
    const Image cube = shot::render(scene + "cube c {\n material glass\n}\n").color;
    const Image farCube =
        shot::render(scene + "cube c {\n material glass\n}\ncube far {\n translate 0 0 -99\n}\n")
            .color;
    for (const std::string flip : {" scale 1 1 1\n", " scale -1 1 1\n", " scale -1 -1 -1\n"}) {
        const std::string box = mesh + "instance i {\n mesh box\n material glass\n" + flip + "}\n";
        // Single rays at edges may go another way: 3 of 4096 samples.
        CHECK(rmse(shot::render(scene + box).color, cube) < 0.01);
        CHECK(rmse(shot::render(scene + box + far).color, farCube) < 0.01);
    }
}

// More media inside of each other than a ray remembers: the light still comes through.
TEST(deepNestingStaysBounded) {
    std::string scene = cat(shot::kOnePixel, 60,
                            "\n}\nworld {\n background 1 1 1\n}\n"
                            "camera c {\n look_at 0 0 50  0 0 0  0 1 0\n}\n");
    for (int i = 1; i <= 20; ++i)
        scene +=
            cat("material m", i,
                " {\n diffuse 0 0 0\n transmission 1 1 1\n fresnel dielectric\n ior ", 1 + 0.02 * i,
                "\n}\ncube c", i, " {\n scale ", i, " ", i, " ", i, "\n material m", i, "\n}\n");
    const float radiance = shot::render(scene).at(0, 0).r;
    CHECK_INFO(radiance > 0.8f && radiance <= 1.0f, radiance);
}

} // namespace test_glass
