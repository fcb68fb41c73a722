// Specular highlights of lamps against the stated formulas.
#include "check.h"
#include "shot.h"

#include <string_view>

namespace test_highlight {

namespace {

const Vec3d kEye{0.5, -1.5, 2}, kTarget{0.1, 0.2, 0}, kLamp{-0.4, 1.2, 1.75};

// The places on z = 0 that a 3x3 picture of a 50 mm lens sees, from the camera's definition.
Vec3d seen(int x, int y) {
    const Vec3d forward = normalize(kTarget - kEye);
    const Vec3d right = normalize(cross(forward, Vec3d{0, 0, 1})), up = cross(right, forward);
    const double u = ((x + 0.5) / 3 - 0.5) * 36 / 50, v = (0.5 - (y + 0.5) / 3) * 36 / 50;
    const Vec3d d = forward + right * u + up * v;
    return kEye + d * (-kEye.z / d.z);
}

double highlight(Vec3d p, double exponent, std::string_view model) {
    const Vec3d n{0, 0, 1}, l = normalize(kLamp - p), v = normalize(kEye - p), h = normalize(l + v);
    const double lobe = std::pow(dot(n, h), exponent), e = 10 / dot(kLamp - p, kLamp - p);
    if (model == "blinn") return e * lobe;
    if (model == "phong")
        return e * std::pow(std::max(dot(n * (2 * dot(n, l)) - l, v), 0.0), exponent);
    return e * (exponent + 1) / (8 * kPi) * lobe / (dot(h, v) * std::max(dot(n, l), dot(n, v))) *
           dot(n, l);
}

} // namespace

// Relative error: the cosine has one of 1e-7, its power exponent times that, and 1e-6 for the rest.
TEST(highlightsOfAllModels) {
    for (const std::string_view model : {"blinn", "phong", "ashikhmin"})
        for (const double exponent : {1.0, 20.0, 400.0}) {
            const shot::Shot shot = shot::render(
                cat("settings {\n resolution 3 3\n samples 1\n jitter false\n}\n"
                    "camera c {\n look_at 0.5 -1.5 2  0.1 0.2 0  0 0 1\n}\n"
                    "material m {\n diffuse 0 0 0\n specular 1 0.5 0.25\n specular_model ",
                    model, "\n exponent ", exponent,
                    "\n}\nplane f {\n scale 9 9 1\n material m\n}\n"
                    "light l {\n translate -0.4 1.2 1.75\n color 10 10 10\n}\n"));
            for (int y = 0; y < 3; ++y)
                for (int x = 0; x < 3; ++x) {
                    const double e = highlight(seen(x, y), exponent, model);
                    const double relative = 3e-7 * exponent + 2e-6;
                    const double quantum = 0x1p-41; // films round what is dim to it
                    const Rgb rgb = shot.at(x, y);
                    CHECK_NEAR(rgb.r, e, relative * e + quantum);
                    CHECK_NEAR(rgb.g, e / 2, relative * e + quantum);
                    CHECK_NEAR(rgb.b, e / 4, relative * e + quantum);
                }
        }
}

// Diffuse and specular add up, and the classic form has no cosine: behind the horizon it is cut.
TEST(highlightEndsAtTheHorizon) {
    const auto scene = [](double elevation) {
        return shot::TopView{.pixels = 1}.text() +
               "material m {\n diffuse 0.5 0.5 0.5\n specular 1 1 1\n exponent 1\n}\n"
               "plane f {\n material m\n}\n"
               "light l {\n type sun\n rotate " +
               shortest(90 - elevation) + " 0 1 0\n}\n";
    };
    for (const double elevation : {1.0, 30.0, 90.0}) {
        const double half = std::cos(radians((90 - elevation) / 2));
        CHECK_NEAR(shot::render(scene(elevation)).at(0, 0).r,
                   half + 0.5 / kPi * std::sin(radians(elevation)), 1e-6);
    }
    CHECK_EQUAL(shot::render(scene(-1)).at(0, 0).r, 0.0f);
}

} // namespace test_highlight
