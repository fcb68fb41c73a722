// The course's scenes: our pictures against those of the oracle of assignment.h.
#include "assignment.h"
#include "check.h"
#include "course_scenes.h"
#include "shot.h"

#include "base/file_text.h"
#include "image/colour.h"
#include "read/load.h"

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>

namespace test_assignment {

namespace {

using assignment::Pixel;

SourceFile sourceOf(const std::string& fileName) {
    const auto bytes = readWholeFile(fileName);
    return {fileName, std::string(bytes.begin(), bytes.end())};
}
assignment::Picture oracle(const SourceFile& source) {
    const JsonDocument json = parseJson(source);
    return assignment::render(json.root, std::filesystem::path(source.name).parent_path().string());
}
assignment::Picture oracle(const std::string& text) {
    return oracle(SourceFile{"oracle.json", text});
}

assignment::Picture ours(const std::string& fileName) {
    Diagnostics diagnostics;
    SceneDesc desc = load(fileName, diagnostics).desc;
    desc.settings.jitter = false;
    CHECK(desc.settings.transfer == SettingsDesc::Transfer::Linear);
    const Image image = shot::render(desc).color;
    assignment::Picture out{image.width(), image.height(), {}};
    for (const Rgb p : image.pixels())
        out.pixels.push_back({unit8From(p.r), unit8From(p.g), unit8From(p.b)});
    return out;
}

struct Difference {
    int pixels = 0; // that differ by more than one level in a channel
    int worst = 0, x = 0, y = 0;
};
Difference difference(const assignment::Picture& a, const assignment::Picture& b) {
    Difference out;
    for (int y = 0; y < a.height; ++y) {
        for (int x = 0; x < a.width; ++x) {
            int worst = 0;
            for (std::size_t c = 0; c < 3; ++c)
                worst = std::max(worst, std::abs(a.at(x, y)[c] - b.at(x, y)[c]));
            out.pixels += worst > 1;
            if (worst > out.worst) out = {out.pixels, worst, x, y};
        }
    }
    return out;
}
std::string shown(Pixel p) { return cat(int{p[0]}, " ", int{p[1]}, " ", int{p[2]}); }

// At most one level in 99.9 % of the pixels: what is left are silhouettes and edges of shadows and
// squares that pass a sample within the rounding of float.
void compare(const std::string& fileName, const std::string& info) {
    const assignment::Picture wanted = oracle(sourceOf(fileName)), got = ours(fileName);
    CHECK_EQUAL(got.width, wanted.width);
    CHECK_EQUAL(got.height, wanted.height);
    if (got.pixels.size() != wanted.pixels.size()) return;
    const Difference d = difference(got, wanted);
    const auto allowed = static_cast<int>(wanted.pixels.size() / 1000);
    CHECK_INFO(d.pixels <= allowed, info << ": " << d.pixels << " pixels differ, allowed "
                                         << allowed << "; the worst at " << d.x << "," << d.y
                                         << " is " << shown(got.at(d.x, d.y)) << ", the oracle's "
                                         << shown(wanted.at(d.x, d.y)));
}

const std::string kFolder = "tests/scenes/json";

} // namespace

// A point light 3 above the origin of the plane, the eye 2 above; (1, 0.5, 0.25) gives 1/10.75.
TEST(assignment_oracle_light) {
    const auto shot = [](const std::string& light, const std::string& normal) {
        return oracle(R"({"resolution": [1, 1], "ambient": [0.1, 0.2, 0], "camera": {
            "position": [0, 2, 0], "lookAt": [0, 0, 0], "up": [0, 0, -1], "fov": 30},
            "materials": [{"name": "m", "diffuse": [0.5, 0.25, 1], "specular": [0, 0, 0.5],
            "shininess": 3}], "objects": [{"name": "p", "type": "plane", "materials": ["m"],
            "normal": )" +
                      normal + R"(}], "lights": [{"name": "l", "colour": [1, 1, 0.5], )" + light +
                      "}]}")
            .at(0, 0);
    };
    const std::string point = R"("type": "point", "position": [0, 3, 0], )";
    // 255 (0.1 * 0.5 + 8 / 10.75 * 0.5), 255 (0.2 * 0.25 + 8 / 10.75 * 0.25), 255 * 4 / 10.75 * 1.5
    const auto fading = shot(point + R"("power": 8, "attenuation": [1, 0.5, 0.25])", "[0, 2, 0]");
    CHECK_EQUAL(shown(fading), "108 60 142");
    // Missing: 1 / d^2. 255 (0.05 + 0.5 / 9), 255 (0.05 + 0.25 / 9), 255 * 0.5 / 9 * 1.5
    CHECK_EQUAL(shown(shot(point + R"("power": 1)", "[0, 1, 0]")), "27 20 21");
    // Behind the plane: ambient only, though the eye is on the same side.
    CHECK_EQUAL(shown(shot(point + R"("power": 8)", "[0, -1, 0]")), "13 13 0");
    // 60 degrees off: N.L = 1/2, N.H = cos 30, cubed 0.6495; power counts, attenuation does not.
    const auto sun = shot(R"("type": "directional", "direction": [0, 2, 3.4641016], "power": 0.5,
                             "attenuation": [9, 9, 9])",
                          "[0, 1, 0]");
    CHECK_EQUAL(shown(sun), "45 29 53");
}

// Four squares of a floor under a wide picture from above: red +x+z and -x-z. With z down in the
// picture and x to the right, a narrow red ball sits in the right upper pixel alone.
TEST(assignment_oracle_directions) {
    const std::string text = R"({"resolution": [2, 2], "ambient": [1, 1, 1], "camera": {
        "position": [0, 1, 0], "lookAt": [0, 0, 0], "up": [0, 0, -1], "fov": 90},
        "materials": [{"name": "r", "diffuse": [1, 0, 0], "specular": [0, 0, 0]},
                      {"name": "g", "diffuse": [0, 1, 0], "specular": [0, 0, 0]},
                      {"name": "b", "diffuse": [0, 0, 1], "specular": [0, 0, 0]}],
        "objects": [{"name": "p", "type": "plane", "materials": ["r", "g"], "normal": [0, 1, 0]}@]})";
    const auto with = [&](const std::string& object) {
        std::string out = text;
        out.replace(out.find('@'), 1, object);
        const assignment::Picture picture = oracle(out);
        std::string all;
        for (const Pixel p : picture.pixels) all += p[0] ? 'r' : p[1] ? 'g' : p[2] ? 'b' : '-';
        return all;
    };
    CHECK_EQUAL(with(""), "rggr"); // rows of z < 0, then z > 0
    // The pixel's middle is (0.5, 0, -0.5) on the floor, (0.25, 0.5, -0.25) half way up.
    CHECK_EQUAL(with(R"(, {"name": "s", "type": "sphere", "position": [0.25, 0.5, -0.25],
        "radius": 0.1, "materials": ["b"]})"),
                "rbgr");
    // Rx before Ry in T Rx Ry Rz S: the ball at +z goes to +x by 90 degrees about y.
    CHECK_EQUAL(with(R"(, {"name": "n", "type": "node", "position": [0, 0.5, 0.25],
        "rotation": [0, 90, 0], "scale": [1, 1, 0.5], "materials": ["b"], "children": [
        {"name": "s", "type": "sphere", "position": [0, 0, 0.5], "radius": 0.1}]})"),
                "rggb");
    // Rx acts last: +z goes to +x by Ry and stays, +x goes to -z by Ry and then to +y.
    CHECK_EQUAL(with(R"(, {"name": "n", "type": "node", "position": [0.25, 0.25, 0.25],
        "rotation": [90, 90, 0], "materials": ["b"], "children": [
        {"name": "s", "type": "sphere", "position": [0.25, 0, 0], "radius": 0.1}]})"),
                "rggb");
}

TEST(assignment_scenes) {
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(kFolder))
        if (entry.path().extension() == ".json") names.push_back(entry.path().string());
    std::sort(names.begin(), names.end());
    CHECK_INFO(names.size() >= 10, "only " << names.size() << " scenes in " << kFolder);
    for (const std::string& name : names) compare(name, name);
}

TEST(assignment_random_scenes) {
    const auto count = check::scaled(std::uint32_t{9});
    for (std::uint32_t seed = 0; seed < count; ++seed) {
        const std::string name = shot::textureFolder() + "/random.json";
        std::ofstream(name) << randomCourseScene(seed);
        compare(name, cat("randomCourseScene(", seed, ")"));
    }
}

} // namespace test_assignment
