// Lamps that some rays see and go on behind: how bright they are, and for whom.
#include "check.h"
#include "shot.h"

#include "base/math.h"
#include "base/text.h"

#include <cmath>
#include <string>

namespace test_seen_lamps {

namespace {

// What a camera 10 above the origin sees of a scene, straight down.
Rgb seen(const std::string& scene) {
    const shot::TopView view{.pixels = 1};
    return shot::render(view.text() + "world {\n background 0.5 0.25 0.125\n}\n" + scene).at(0, 0);
}
std::string lamp(const std::string& type, const std::string& by, const std::string& rest) {
    return cat("light ", type, by, " {\n type ", type, "\n seen_by ", by, "\n", rest, "\n}\n");
}
// Faces the camera from a place below it.
const std::string kUp = " translate 0 0 -2\n rotate 180 1 0 0\n";
// Shines down onto a floor, from a place above the camera.
const std::string kDown = " translate 0 0 20\n";
std::string floorOf(const std::string& material) {
    return cat("material m {\n ", material,
               "\n}\nplane p {\n translate 0 0 -3\n scale 9 9 1\n material m\n}\n");
}
const std::string kMirror = floorOf("diffuse 0 0 0\n mirror 1 1 1");
bool isNear(Rgb a, Rgb b) {
    return std::fabs(a.r - b.r) < 1e-5f * b.r && std::fabs(a.g - b.g) < 1e-5f * b.g &&
           std::fabs(a.b - b.b) < 1e-5f * b.b;
}
constexpr Rgb kSky{0.5f, 0.25f, 0.125f};

// The lines that give a lamp the radiance 3 2 1 where it is seen.
struct Kind {
    std::string type, lines;
};
std::vector<Kind> kinds() {
    const double half = radians(20.0), sin2 = std::sin(half) * std::sin(half);
    const auto color = [](double times) {
        return cat(" color ", 3 * times, " ", 2 * times, " ", times, "\n");
    };
    const double spread = radians(45.0), straight = std::tan(spread) / (std::tan(spread) - spread);
    return {{"rectangle", color(1) + " size 4 4\n"},
            {"disk", color(1) + " size 4 4\n"},
            {"sphere", color(1) + " radius 1.5\n"},
            {"point", color(kPi * 1.5 * 1.5) + " radius 1.5\n"},
            {"spot", color(kPi * 1.5 * 1.5) + " radius 1.5\n cone_angle 90\n"},
            {"sun", color(kPi * sin2) + " angle 40\n"},
            {"rectangle", color(1 / straight) + " size 4 4\n spread 90\n"}};
}

} // namespace

TEST(seen_lamps_are_as_bright_as_their_light_says) {
    const Rgb both = kSky + Rgb{3, 2, 1};
    for (const auto& [type, lines] : kinds()) {
        for (const std::string by : {"camera", "all"})
            CHECK(isNear(seen(lamp(type, by, kUp + lines)), both));
        for (const std::string by : {"reflections", "all"})
            CHECK(isNear(seen(kMirror + lamp(type, by, kDown + lines)), both));
        for (const std::string by : {"none", "reflections"})
            CHECK(seen(lamp(type, by, kUp + lines)) == kSky);
        for (const std::string by : {"none", "camera"})
            CHECK(seen(kMirror + lamp(type, by, kDown + lines)) == kSky);
    }
}

TEST(seen_lamps_have_no_back_and_are_hidden_by_what_is_in_front) {
    const std::string flat = " translate 0 0 -2\n size 4 4\n";
    CHECK(seen(lamp("rectangle", "camera", flat)) == kSky);
    const std::string behind = " translate 0 0 -6\n rotate 180 1 0 0\n";
    for (const auto& [type, lines] : kinds())
        CHECK((seen(floorOf("diffuse 0 0 0\n emission 7 7 7") +
                    lamp(type, "all", behind + lines)) == Rgb{7, 7, 7}));
    // In front of a surface both are seen.
    const auto [type, lines] = kinds()[0];
    CHECK(isNear(seen(floorOf("diffuse 0 0 0\n emission 7 7 7") + lamp(type, "all", kUp + lines)),
                 {10, 9, 8}));
    // A ball is seen once, though a ray goes in and out; from inside, too.
    CHECK(
        isNear(seen(lamp("sphere", "camera", " color 3 2 1\n radius 30\n")), kSky + Rgb{3, 2, 1}));
}

// A sharp mirror shows them, a rough one has them in its highlight, a diffuse floor is lit by them:
// none of them counts them twice.
TEST(seen_lamps_are_counted_once) {
    for (const std::string floor :
         {"diffuse 0.5 0.5 0.5", "mirror 0.5 0.5 0.5\n roughness 0.3\n specular 0.5 0.5 0.5"})
        for (const auto& [type, lines] : kinds())
            CHECK(seen(floorOf(floor) + lamp(type, "reflections", kDown + lines)) ==
                  seen(floorOf(floor) + lamp(type, "none", kDown + lines)));
}

// A ray that goes straight on behind a clear surface is still the camera's.
TEST(seen_lamps_are_seen_through_what_is_clear) {
    const std::string pane =
        "material c {\n diffuse 0 0 0\n opacity 0\n}\nplane c {\n scale 9 9 1\n"
        " material c\n}\n";
    const auto [type, lines] = kinds()[0];
    CHECK(isNear(seen(pane + lamp(type, "camera", kUp + lines)), kSky + Rgb{3, 2, 1}));
    CHECK(seen(pane + lamp(type, "reflections", kUp + lines)) == kSky);
}

} // namespace test_seen_lamps
