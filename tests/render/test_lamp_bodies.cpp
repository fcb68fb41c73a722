// Bodies of lamps that can be seen: which sides shine, and what is behind them.
#include "check.h"
#include "shot.h"

#include "base/text.h"

#include <string>

namespace test_lamp_bodies {

namespace {

// What a camera above the origin sees of a scene, straight down.
Rgb seen(const std::string& scene) {
    const shot::TopView view{.pixels = 1};
    return shot::render(view.text() + "world {\n background 0.5 0.25 0.125\n}\n" + scene).at(0, 0);
}
std::string lamp(const std::string& name, const std::string& type, const std::string& rest) {
    return cat("light ", name, " {\n type ", type, "\n color 3 2 1\n visible true\n", rest,
               "\n}\n");
}

} // namespace

// Lamps shine along -Z; turned over, they face the camera above them.
TEST(lamp_bodies_of_flat_lamps_have_no_back) {
    for (const std::string type : {"rectangle", "disk"}) {
        const std::string up = " rotate 180 1 0 0\n size 4 4", down = " size 4 4";
        CHECK(seen(lamp("a", type, up)) == (Rgb{3, 2, 1}));
        CHECK(seen(lamp("a", type, down)) == (Rgb{0.5f, 0.25f, 0.125f}));
        // Two in one place, back to back, in either order.
        CHECK(seen(lamp("a", type, up) + lamp("b", type, down)) == (Rgb{3, 2, 1}));
        CHECK(seen(lamp("a", type, down) + lamp("b", type, up)) == (Rgb{3, 2, 1}));
        // A floor is seen through the back of a lamp.
        const std::string floor = "material m {\n diffuse 0 0 0\n emission 7 7 7\n}\nplane p {\n "
                                  "translate 0 0 -3\n scale 9 9 1\n material m\n}\n";
        CHECK(seen(lamp("a", type, down) + floor) == (Rgb{7, 7, 7}));
    }
}

TEST(lamp_bodies_of_spheres_shine_inwards) {
    CHECK(seen(lamp("a", "sphere", " radius 2")) == (Rgb{3, 2, 1}));
    CHECK(seen(lamp("a", "sphere", " radius 20")) == (Rgb{3, 2, 1})); // the camera is in it
}

} // namespace test_lamp_bodies
