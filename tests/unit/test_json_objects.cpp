// The list "objects" of a JSON scene: all kinds of objects in their order, and what has to be said
// of one, wherever it stands.
#include "unit/json_kit.h"

#include "base/text.h"
#include "check.h"

#include <string>
#include <utility>
#include <vector>

namespace test_json_objects {

using namespace json_kit;

namespace {

// Shapes with and without names, the same name twice, a node and meshes between them; keys before
// and behind the list.
std::string sceneOf(const std::vector<std::string>& objects, const std::string& behind = "") {
    std::string text = R"({ "AA": {"samples": 1},
 "materials": [{"name": "a", "ID": 0, "hardness": 1}, {"name": "b", "ID": 1}],
 "objects" : [)";
    for (std::size_t i = 0; i < objects.size(); ++i)
        text += (i > 0 ? i % 3 == 0 ? " ,\n\t" : "," : " \n") + objects[i];
    return text + " ]\n, \"lights\": [{\"type\": \"point\", \"position\": [0, 1, 2]}]" + behind +
           "}";
}
const std::vector<std::string> kObjects = {
    R"({"type": "sphere", "radius": 2, "materials": [0]})",
    R"({"name": "x", "type": "sphere", "position": [1, 2, 3.5], "materials": ["b"]})",
    R"({"type": "box", "min": [0, 0, 0], "max": [1, 2, 3], "materials": [1]})",
    R"({"name": "x", "type": "cube", "scale": 0.25, "comment": "[{\"]}"})",
    R"({"type": "node", "position": [1, 0, 0], "children": [
        {"type": "sphere"}, {"name": "in", "type": "cone"}, {"type": "node", "children": []}]})",
    R"({"type": "sphere", "materials": [1]})",
    R"({"type": "mesh", "filepath": "a/b.obj"})",
    R"({"type": "plane", "normal": [0, 1, 0], "position": [0, -1, 0], "materials": [0, 1]})",
    R"({"name": "y\\\u00e4\"", "type": "disk", "keys": [{"position": [0, 0, 1]}, {}]})",
    R"({"type": "mesh", "filepath": "a/b.obj"})",
    R"({"type": "sphere", "radius": 0.001})",
};

} // namespace

// With --lenient what is missing or odd is a warning, and there is a picture.
TEST(json_objects_lenient) {
    struct Row {
        std::string object, warning;
    };
    const Row rows[] = {
        {R"({"type": "instance", "ref": "nothing"})", "no earlier object is named 'nothing'"},
        {R"({"type": "box", "min": [-1, -1, 1], "max": [1, 1, -9]})", "a box has a 'max' above"},
        {R"({"type": "box", "min": [-1, 0, -1], "max": [1, 0, 1]})", "a box has a 'max' above"},
    };
    for (const Row& row : rows) {
        CHECK_THROWS(read(sceneOf({row.object}), false), row.warning);
        const Reading reading = read(sceneOf({row.object}), true);
        const std::string said = join(reading.warnings);
        CHECK_INFO(said.find(row.warning) != std::string::npos, said);
    }
    const auto placeOf = [&](const std::string& object) {
        return read(sceneOf({object}), true).desc.objects.at(0).worldFromObject.at(0);
    };
    CHECK(placeOf(rows[1].object) ==
          placeOf(R"({"type": "box", "min": [-1, -1, -9], "max": [1, 1, 1]})"));
    const Rows flat = placeOf(rows[2].object);
    CHECK_NEAR(flat[5], 1e-6, 1e-18); // half of 1e-6 of its width of 2
    CHECK_NEAR(flat[0], 1, 0);
}

// One number is a grey; true is 1.
TEST(json_colours_of_one_number) {
    const auto mirrorOf = [](const std::string& written) {
        return read(R"({"materials": [{"name": "m", "mirror": )" + written + "}]}")
            .desc.materials.at(0)
            .mirror;
    };
    CHECK((mirrorOf("true") == Rgbd{1, 1, 1}));
    CHECK((mirrorOf("false") == Rgbd{}));
    CHECK((mirrorOf("0.3") == Rgbd{0.3, 0.3, 0.3}));
    CHECK((mirrorOf("[0.1, 0.2, 0.3]") == Rgbd{0.1, 0.2, 0.3}));
    CHECK_THROWS(mirrorOf("-1"), "'mirror' must be");
    CHECK_THROWS(mirrorOf("\"yes\""), "expected an array of 3 values for 'mirror'");
}

TEST(json_objects_come_in_their_order) {
    const Reading all = read(sceneOf(kObjects));
    CHECK_INFO(all.warnings.empty(), join(all.warnings));
    CHECK_EQUAL(all.desc.meshes.size(), std::size_t{1});
    std::vector<std::string> names;
    for (const ObjectDesc& object : all.desc.objects) names.push_back(object.name);
    CHECK_EQUAL(join(names), "sphere1, x, box1, x.2, node1/sphere2, node1/in, sphere3, mesh1, "
                             "plane1, y\\\u00e4\", mesh2, sphere4");
    CHECK(all.desc.objects.at(8).materials == std::vector<Handle>({0, 1}));
    CHECK(all.desc.objects.at(7).mesh == all.desc.objects.at(10).mesh);
    // Of two that could be meant the first one is.
    std::vector<std::string> named = kObjects;
    named.insert(named.begin(), R"({"name": "in", "type": "sphere", "radius": 3})");
    named.emplace_back(R"({"type": "instance", "ref": "in"})");
    const SceneDesc desc = scene(sceneOf(named)); // CHECK_EQUAL keeps a reference
    CHECK_EQUAL(desc.objects.back().radius, 3.0);
}

// Of one object, wherever it stands, and of what stands around them.
TEST(json_objects_are_refused_wherever_they_stand) {
    const std::vector<std::pair<std::string, std::string>> cases = {
        {R"({"type": "sphere", "radius": -1})", "'radius'"},
        {R"({"type": "sphere", "colour": 1})", "unknown key 'colour'"},
        {R"({"type": "ball"})", "unknown type"},
        {R"({"type": "sphere", "materials": ["c"]})", "unknown material"},
        {R"({"type": "plane", "normal": [1, 0, 0], "materials": [0, 1]})", "is vertical"},
        {R"({"type": "node", "ref": "late"})", "no earlier"},
        {R"({"type": "sphere", "type": "cube"})", "given already"},
        {R"({"type": "sphere" "radius": 1})", "expected ','"},
        {R"({"type": "sphere", "radius": 01})", "no octal"},
        {R"({"type": "sphere", "name": "a)", "error"},
        {"{\"type\": \"sphere\", \"name\": \"\xff\"}", "not UTF-8"},
        {R"(}, {"type": "sphere")", "expected a value"},
        {R"([{"type": "sphere"}])", "expected an object"},
        {R"({"type": "sphere"},)", "','"}, // at the end it is JSON5
        {R"({"type": "sphere"}])", "error"},
        {"7", "expected an object"},
    };
    const auto saidOf = [](const std::string& text, bool lenient) {
        Reading reading;
        const std::string said = check::thrown([&] { reading = read(text, lenient); });
        return said + join(reading.warnings, "\n");
    };
    for (const bool lenient : {false, true}) {
        for (const auto& [object, words] : cases)
            for (const std::size_t at : {std::size_t{0}, std::size_t{5}, kObjects.size()}) {
                std::vector<std::string> objects = kObjects;
                objects.insert(objects.begin() + static_cast<std::ptrdiff_t>(at), object);
                const std::string said = saidOf(sceneOf(objects), lenient);
                CHECK_INFO(said.find(words) != std::string::npos,
                           object << " at " << at << ": " << said);
            }
        for (const char* behind :
             {", \"objects\": []", ", \"fog\": 1", ", \"camera\": 3", "]", ", "})
            CHECK_INFO(!saidOf(sceneOf(kObjects, behind), lenient).empty(), behind);
    }
}

} // namespace test_json_objects
