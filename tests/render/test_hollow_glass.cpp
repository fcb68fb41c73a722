// Glass shells that are inside out, and what they must not do to others.
#include "check.h"
#include "shot.h"
#include "solids.h"

#include "base/text.h"

#include <string>
#include <utility>

namespace test_hollow_glass {

namespace {

const std::string kView =
    "settings {\n resolution 60 45\n samples 2\n max_depth 12\n}\nworld {\n background 0.6 0.7 "
    "0.8\n}\ncamera c {\n look_at 0 -6 2.5  0 0 0  0 0 1\n}\ninfinite_plane floor {\n translate 0 "
    "0 -1.3\n}\nlight l {\n translate 3 -3 5\n color 60 60 60\n}\n";
std::string glass(const std::string& name, double ior) {
    return cat("material ", name,
               " {\n diffuse 0 0 0\n mirror 1 1 1\n transmission 1 1 1\n fresnel dielectric\n ior ",
               ior, "\n}\n");
}
// A ball about the origin; inside out, its triangles turn the other way.
MeshDesc shell(const std::string& name, double radius, bool isInsideOut) {
    MeshDesc mesh = solids::ball(4);
    mesh.name = name;
    for (Vec3d& p : mesh.points) p = p * radius;
    if (isInsideOut)
        for (auto& t : mesh.triangles) std::swap(t[1], t[2]);
    return mesh;
}
MeshDesc joined(const MeshDesc& a, const MeshDesc& b) {
    MeshDesc both = a;
    const auto first = static_cast<std::uint32_t>(a.points.size());
    for (const Vec3d p : b.points) both.points.push_back(p);
    for (const auto& t : b.triangles)
        both.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
    return both;
}
std::string placed(const MeshDesc& mesh, const std::string& material,
                   const std::string& at = "0 0 0") {
    return solids::text(mesh) + cat("instance of_", mesh.name, " {\n mesh ", mesh.name,
                                    "\n material ", material, "\n translate ", at, "\n}\n");
}
Image seen(const std::string& things) {
    return shot::render(kView + glass("g", 1.5) + things).color;
}

} // namespace

// The inner shell of a hollow ball may be an object and a material of its own.
TEST(hollow_glass_of_two_objects) {
    const MeshDesc outer = shell("outer", 1.2, false), inner = shell("inner", 1, true);
    const Image hollow = seen(placed(joined(outer, inner), "g"));
    CHECK(shot::maxDifference(hollow, seen(placed(outer, "g"))) > 0.2); // a solid ball is another
    CHECK_EQUAL(shot::differingPixels(hollow, seen(placed(outer, "g") + placed(inner, "g"))), 0);
    CHECK_EQUAL(shot::differingPixels(
                    hollow, seen(glass("own", 1.5) + placed(outer, "g") + placed(inner, "own"))),
                0);
}

// The eye is not inside of a body that is inside out, so that a glass ball beside it stays as it
// is.
TEST(hollow_glass_does_not_reach_the_eye) {
    const std::string ball = "sphere s {\n translate -0.9 0 0\n radius 0.9\n material g\n}\n";
    const MeshDesc insideOut = shell("b", 0.2, true), right = shell("b", 0.2, false);
    // Before and behind the ball, in the middle of the view.
    for (const std::string at : {"0 -3 1.25", "0 40 -16"})
        for (const double ior : {1.5, 1.33, 2.4})
            for (const std::string material : {"own", "g"}) {
                const std::string own = glass("own", ior) + ball;
                const Image with = seen(own + placed(insideOut, material, at));
                const Image beside = seen(own + placed(right, material, at));
                int differing = 0; // on the ball, left of the other body, which it mirrors
                for (int y = 0; y < 45; ++y)
                    for (int x = 8; x < 18; ++x) {
                        const Rgb a = with.pixel(x, y), b = beside.pixel(x, y);
                        differing += maxAbs(Vec3{a.r - b.r, a.g - b.g, a.b - b.b}) > 0.05f;
                    }
                CHECK_INFO(differing < 20, differing << " of 450 at " << at << ", " << ior);
            }
}

// An eye that is inside of a closed ball of glass sees out of it, whatever is inside out elsewhere:
// the light is bent at the surface from the ior of the ball, by Snell's law. Nothing is bent when
// the ball has the ior of air.
TEST(hollow_glass_around_the_eye) {
    const std::string around = "sphere a {\n translate 0 -6 2.5\n radius 1.5\n material g\n}\n";
    const std::string other = placed(shell("b", 0.5, true), "g", "0 0 0");
    const Image with = seen(around + other), alone = seen(around);
    int differing = 0;
    for (int y = 0; y < 10; ++y)
        for (int x = 0; x < 60; ++x) differing += with.pixel(x, y) != alone.pixel(x, y);
    CHECK_INFO(differing < 60, differing << " of 600 pixels of the sky");
}

} // namespace test_hollow_glass
