// Lights in JSON: units, fall-off and aims of the dialects, by numbers worked out by hand.
#include "unit/json_kit.h"

namespace test_json_lights {

using json_kit::checkColor;
using json_kit::checkPoint;
using json_kit::scene;

namespace {

LightDesc light(const std::string& scene_, const std::string& body) {
    return scene(cat("{", scene_, "\"lights\": [{", body, "}]}")).lights.at(0);
}

// The axis along which a light shines.
Vec3d shines(const LightDesc& l) {
    return normalize(Transform::fromRows(l.worldFromLight).vector({0, 0, -1}));
}

} // namespace

// diffuse / pi * E * cos and specular / pi * E * (N.H)^e are to be diffuse * colour * power * cos
// and specular * colour * power * (N.H)^e.
TEST(read_json_units_of_light) {
    const std::string light_ = R"("colour": [1, 0.5, 0], "power": 2)";
    checkColor(light("", R"("type": "point",)" + light_).color, {2 * kPi, kPi, 0});
    checkColor(light("", R"("type": "spot",)" + light_).color, {2 * kPi, kPi, 0});
    checkColor(light("", R"("type": "sun",)" + light_).color, {2 * kPi, kPi, 0});
    // The surface of a lamp looks as bright as it says.
    checkColor(light("", R"("type": "rectangle",)" + light_).color, {2, 1, 0});
    checkColor(light("", R"("type": "sphere", "radius": 1,)" + light_).color, {2, 1, 0});
    const SceneDesc desc = scene(R"({"materials": [
        {"name": "a", "specular": [1, 0.5, 0], "shininess": 8},
        {"name": "b", "specular": [1, 0.5, 0], "specular_model": "phong"},
        {"name": "c", "specular": [1, 0.5, 0], "specular_model": "ashikhmin"}]})");
    checkColor(desc.materials.at(0).specular, {1 / kPi, 0.5 / kPi, 0});
    checkColor(desc.materials.at(1).specular, {1 / kPi, 0.5 / kPi, 0});
    checkColor(desc.materials.at(2).specular, {1, 0.5, 0});
    CHECK_EQUAL(desc.materials[0].exponent, 8.0);
    CHECK_EQUAL(desc.materials[1].exponent, 0.0); // the default of 'shininess'
}

// Students' programs have lights of type "area": points whose radius softens the shadows.
TEST(read_json_area_lights) {
    const std::string body = R"("colour": [1, 0.5, 0], "power": 2, "position": [1, 2, 3])";
    const LightDesc area = light("", R"("type": "area", "radius": 0.5, "samples": 16,)" + body);
    const LightDesc point = light("", R"("type": "point", "radius": 0.5,)" + body);
    CHECK(area == point);
    CHECK_EQUAL(area.radius, 0.5);
    const json_kit::Reading none =
        json_kit::read(R"({"lights": [{"type": "ring", "position": [0, 0, 1]}]})", true);
    CHECK_EQUAL(none.warnings.size(), std::size_t{2});
    CHECK(none.warnings.back().find("no light is left") != std::string::npos);
    CHECK(json_kit::read(R"({"lights": []})", true).warnings.empty());
}

TEST(read_json_fall_off_of_the_dialects) {
    const std::string point = R"("type": "point", "position": [1, 2, 3])";
    const LightDesc numbered = light(R"("AA": {"samples": 1},)", point);
    CHECK((numbered.attenuation == Vec3d{0, 0, 1}));
    checkPoint(Transform::fromRows(numbered.worldFromLight).translation(), {1, 2, 3}, 0);
    CHECK((light(R"("AA_samples": 1,)", point).attenuation == Vec3d{1, 0, 0}));
    CHECK((light(R"("camera": {"position": [0, 0, 1], "fovy": 45},)", point).attenuation ==
           Vec3d{0, 0, 1}));
    CHECK((light("", point).attenuation == Vec3d{1, 0, 0}));
    CHECK((light("", point + R"(, "attenuation": [3, 2, 1])").attenuation == Vec3d{3, 2, 1}));
}

TEST(read_json_directional_light) {
    // `direction` points to the light: it shines the other way. Longer ones are normalised.
    const std::string body = R"("type": "directional", "direction": [0, 3, 4], "power": 2)";
    const LightDesc named = light("", body);
    CHECK(named.kind == LightDesc::Kind::Sun);
    checkPoint(shines(named), {0, -0.6, -0.8});
    checkColor(named.color, {2 * kPi, 2 * kPi, 2 * kPi});
    // In the first dialect its power is 1, whatever the file says.
    checkColor(light(R"("AA": {"samples": 1},)", body).color, {kPi, kPi, kPi});
    checkPoint(shines(light("", R"("type": "directional", "direction": [0, 1, 0])")), {0, -1, 0});
}

TEST(read_json_aimed_lights) {
    checkPoint(shines(light("", R"("type": "spot", "direction": [0, -2, 0])")), {0, -1, 0});
    checkPoint(shines(light("", R"("type": "spot")")), {0, -1, 0});
    const LightDesc spot = light(
        "", R"("type": "spot", "position": [1, 5, 0], "lookAt": [1, 1, 3], "cone_angle": 30)");
    checkPoint(shines(spot), {0, -0.8, 0.6});
    checkPoint(Transform::fromRows(spot.worldFromLight).translation(), {1, 5, 0});
    CHECK_EQUAL(spot.coneAngleDeg, 30.0);
    // A quarter turn about x takes -Z to +Y.
    checkPoint(shines(light("", R"("type": "rectangle", "rotation": [90, 0, 0])")), {0, 1, 0});
    const LightDesc panel = light(
        "", R"("type": "rectangle", "direction": [0, -1, 0], "up": [1, 0, 0], "size": [2, 3])");
    checkPoint(Transform::fromRows(panel.worldFromLight).vector({0, 1, 0}), {1, 0, 0});
    CHECK((panel.size == Vec2d{2, 3}));
}

} // namespace test_json_lights
