// What can be seen of one-sided objects, and the checkerboard of two materials.
#include "check.h"
#include "shot.h"

namespace test_sides {

namespace {

std::string sided(const std::string& object, const std::string& sides) {
    return shot::TopView{.pixels = 1}.text() +
           "world {\n background 0.25 0.5 1\n ambient 1 1 1\n}\n"
           "material m {\n diffuse 1 0 0\n}\n" +
           object + "\n material m\n sides " + sides + "\n}\n";
}
bool isSeen(const std::string& object, const std::string& sides) {
    const Rgb c = shot::render(sided(object, sides)).at(0, 0);
    CHECK(c == (Rgb{1, 0, 0}) || c == (Rgb{0.25f, 0.5f, 1}));
    return c.r == 1;
}

const char* const kTriangle = "points 3\n -9 -9 0  9 -9 0  0 9 0\n triangles 1\n 0 1 2\n}\n";

} // namespace

// From above: a plane by itself, turned over, and mirrored, which keeps its +Z up.
TEST(sidesThatAreSeen) {
    for (const std::string sides : {"both", "front", "back"}) {
        const bool front = sides != "back", back = sides != "front";
        CHECK_EQUAL(isSeen("plane p {", sides), front);
        CHECK_EQUAL(isSeen("plane p {\n rotate 180 1 0 0", sides), back);
        CHECK_EQUAL(isSeen("plane p {\n scale -1 1 1", sides), front);
        CHECK_EQUAL(isSeen("infinite_plane p {", sides), front);
        const std::string mesh = std::string("mesh t {\n ") + kTriangle;
        CHECK_EQUAL(isSeen(mesh + "instance p {\n mesh t", sides), front);
        CHECK_EQUAL(isSeen(mesh + "instance p {\n mesh t\n rotate 180 0 1 0", sides), back);
        CHECK_EQUAL(isSeen(mesh + "instance p {\n mesh t\n scale -1 1 1", sides), front);
        // The same as an instance, which is not merged, that stands elsewhere.
        const std::string twice = mesh +
                                  "instance far {\n mesh t\n translate 0 0 -50\n sides back\n"
                                  " scale 1e-3 1e-3 1\n}\n";
        CHECK_EQUAL(isSeen(twice + "instance p {\n mesh t\n scale -1 1 1", sides), front);
        // A closed shape has a front on top, and a back at the bottom that is seen through it.
        CHECK(isSeen("sphere p {", sides) && isSeen("cube p {", sides));
    }
}

// A roof whose lower side is not there still keeps the sun off the floor.
TEST(sidesCastShadowsBothWays) {
    for (const std::string sides : {"front", "back"}) {
        const std::string scene = "settings {\n resolution 1 1\n samples 1\n jitter false\n}\n"
                                  "camera c {\n look_at 0 0 1  0 0 0  0 1 0\n}\n"
                                  "plane floor {\n scale 5 5 1\n}\n"
                                  "plane roof {\n translate 0 0 3\n scale 5 5 1\n sides " +
                                  sides + "\n}\nlight sun {\n type sun\n}\n";
        CHECK_EQUAL(shot::render(scene).at(0, 0).g, 0.0f);
    }
}

// Squares of side 1 about the object's origin, turned and moved with it, in float to 1e-6 of a
// side.
TEST(checkerboardSquares) {
    for (const double turn : {0.0, 30.0}) {
        const shot::TopView view{.pixels = 40, .side = 8, .centre = {100.25, -50.5},
                                 .more = "texture_filter none"};
        const shot::Shot shot = shot::render(
            view.text() + cat("world {\n ambient 1 1 1\n}\nmaterial a {\n diffuse 1 0 0\n}\n"
                              "material b {\n diffuse 0 1 0\n}\ninfinite_plane p {\n translate 0.1 "
                              "0.2 0\n rotate ",
                              turn, " 0 0 1\n materials a b\n}\n"));
        int first = 0;
        for (int y = 0; y < 40; ++y)
            for (int x = 0; x < 40; ++x) {
                const Vec2d at = view.place(x, y);
                const double c = std::cos(radians(turn)), s = std::sin(radians(turn));
                const double u = c * (at.x - 0.1) + s * (at.y - 0.2);
                const double v = c * (at.y - 0.2) - s * (at.x - 0.1);
                const double border =
                    std::min(std::fabs(u - std::round(u)), std::fabs(v - std::round(v)));
                if (border < 1e-4) continue;
                const bool isFirst = (static_cast<long>(std::floor(u) + std::floor(v)) & 1) == 0;
                CHECK_INFO(shot.at(x, y) == (isFirst ? Rgb{1, 0, 0} : Rgb{0, 1, 0}),
                           "pixel " << x << ' ' << y << " turn " << turn);
                first += isFirst;
            }
        CHECK(first > 600 && first < 1000);
    }
}

} // namespace test_sides
