// Nodes in JSON: transforms, materials, names and keys that come down a tree, and copies of parts
// of it.
#include "unit/json_kit.h"

namespace test_json_nodes {

using json_kit::checkPoint;
using json_kit::hasWarning;
using json_kit::objects;
using json_kit::read;
using json_kit::Reading;
using json_kit::readObjects;
using json_kit::scene;
using json_kit::worldPoint;

// T * Rx * Ry * Rz * S, checked by a point that each factor moves: S doubles x, Rz takes x to y, Ry
// leaves y, Rx takes y to z.
TEST(read_json_order_of_transforms) {
    const ObjectDesc sphere = objects(R"({"type": "sphere", "position": [10, 0, 0],
        "rotation": [90, 90, 90], "scale": [2, 3, 4]})")
                                  .at(0);
    checkPoint(worldPoint(sphere, {1, 0, 0}), {10, 0, 2});
    checkPoint(worldPoint(sphere, {0, 1, 0}), {10, -3, 0}); // y to -x, -x to z, z to -y
    checkPoint(worldPoint(sphere, {0, 0, 1}), {14, 0, 0});  // z, z to x, x
}

TEST(read_json_nested_nodes) {
    const std::vector<ObjectDesc> list = objects(R"(
        {"name": "top", "type": "node", "position": [0, 0, 5], "rotation": [0, 90, 0], "scale": 2,
         "children": [
            {"name": "mid", "type": "node", "position": [1, 0, 0], "rotation": [0, 0, 90],
             "scale": [1, 1, 1], "children": [
                {"name": "ball", "type": "sphere", "position": [0, 2, 0], "radius": 3}]},
            {"name": "ball", "type": "sphere"}]})");
    CHECK_EQUAL(list.size(), std::size_t{2});
    CHECK_EQUAL(list.at(0).name, "top/mid/ball");
    CHECK_EQUAL(list.at(1).name, "top/ball");
    // (0,2,0): Rz90 to (-2,0,0), moved to (-1,0,0), doubled to (-2,0,0), Ry90 takes x to -z.
    checkPoint(worldPoint(list[0], {}), {0, 0, 7});
    checkPoint(worldPoint(list[0], {1, 0, 0}), {0, 2, 7}); // x to y, doubled
    CHECK_EQUAL(list[0].radius, 3.0);
}

// A node with 'ref' takes the children of an earlier node: its own transform replaces that one's in
// the first dialect, and multiplies in the others.
TEST(read_json_references) {
    const std::string nodes = R"("objects": [
        {"name": "one", "type": "node", "position": [1, 0, 0], "ref": "", "children": [
            {"name": "ball", "type": "sphere", "position": [0, 1, 0]}]},
        {"name": "two", "type": "node", "position": [0, 0, 7], "ref": "one", "materials": []}]})";
    const SceneDesc replaced = scene(R"({"AA": {"samples": 1},)" + nodes);
    CHECK_EQUAL(replaced.objects.at(1).name, "two/ball");
    checkPoint(worldPoint(replaced.objects[0], {}), {1, 1, 0});
    checkPoint(worldPoint(replaced.objects[1], {}), {0, 1, 7});
    const SceneDesc multiplied = scene(R"({"AA_samples": 1,)" + nodes);
    CHECK_EQUAL(multiplied.objects.at(1).name, "two/one/ball");
    checkPoint(worldPoint(multiplied.objects[1], {}), {1, 1, 7});
}

TEST(read_json_instances) {
    const SceneDesc desc = scene(R"({"objects": [
        {"name": "ball", "type": "sphere", "position": [1, 0, 0], "radius": 2},
        {"name": "pair", "type": "node", "children": [
            {"name": "l", "type": "instance", "ref": "ball", "position": [0, 5, 0]},
            {"name": "r", "type": "instance", "ref": "ball", "scale": [-2, 2, 2]}]},
        {"type": "instance", "ref": "pair", "rotation": [0, 0, 90]},
        {"type": "instance", "ref": "r", "position": [0, 0, 1]}]})");
    const std::vector<ObjectDesc>& list = desc.objects;
    CHECK_EQUAL(list.size(), std::size_t{6});
    checkPoint(worldPoint(list.at(1), {}), {1, 5, 0});
    checkPoint(worldPoint(list.at(2), {}), {-2, 0, 0});
    CHECK_EQUAL(list.at(3).name, "instance1/pair/l/ball");
    checkPoint(worldPoint(list[3], {}), {-5, 1, 0});
    checkPoint(worldPoint(list.at(5), {}), {-2, 0, 1}); // without what is above 'r'
    CHECK_THROWS(scene(R"({"objects": [{"name": "a", "type": "node", "children": [
                       {"type": "instance", "ref": "a"}]}]})"),
                 "no earlier object is named 'a'");
}

TEST(read_json_materials_come_from_above) {
    const std::vector<ObjectDesc> list = objects(R"(
        {"type": "node", "materials": [1], "children": [
            {"type": "sphere"}, {"type": "sphere", "materials": null},
            {"type": "sphere", "materials": [0]},
            {"type": "node", "materials": [], "children": [{"type": "sphere", "materials": []}]}]},
        {"type": "sphere"})");
    const std::vector<std::vector<Handle>> expected = {{1}, {1}, {0}, {1}, {}};
    for (std::size_t i = 0; i < expected.size(); ++i)
        CHECK_INFO(list.at(i).materials == expected[i], "object " << i);
    // Of a reference with materials, these; of one without, those of the node that it names.
    const std::vector<ObjectDesc> refs = objects(R"(
        {"name": "n", "type": "node", "materials": [0], "children": [{"type": "sphere"}]},
        {"type": "node", "ref": "n"}, {"type": "node", "ref": "n", "materials": [1]})");
    CHECK((refs.at(1).materials == std::vector<Handle>{0}));
    CHECK((refs.at(2).materials == std::vector<Handle>{1}));
}

TEST(read_json_unknown_materials_are_left_out) {
    const Reading reading = readObjects(R"({"type": "plane", "materials": [7, "bb", "b", 0]})");
    CHECK((reading.desc.objects.at(0).materials == std::vector<Handle>{1, 0}));
    CHECK(hasWarning(reading, "warning: no material has the ID 7; it is left out"));
    CHECK(hasWarning(reading, "unknown material 'bb'; did you mean 'b'?"));
    const Reading many = readObjects(R"({"type": "sphere", "materials": [0, 1]})");
    CHECK((many.desc.objects.at(0).materials == std::vector<Handle>{0}));
    CHECK(hasWarning(many, "has 2 materials; only the first counts"));
    // Of equal IDs and names the first counts.
    const Reading twice = read(R"({"materials": [{"name": "m", "ID": 3}, {"name": "m", "ID": 3}],
        "objects": [{"type": "sphere", "materials": [3]}, {"type": "sphere", "material": "m"}]})");
    CHECK_EQUAL(twice.desc.materials.at(1).name, "m.2");
    CHECK(twice.desc.objects.at(0).materials == twice.desc.objects.at(1).materials);
    CHECK_EQUAL(twice.warnings.size(), std::size_t{2});
}

TEST(read_json_names_are_unique) {
    const std::vector<ObjectDesc> list = objects(R"(
        {"name": "x", "type": "sphere"}, {"name": "x", "type": "sphere"}, {"type": "sphere"},
        {"name": "x.2", "type": "sphere"}, {"type": "disk", "name": ""}, {"type": "sphere"},
        {"name": "n", "type": "node", "children": [{"name": "x", "type": "sphere"}]})");
    const std::vector<std::string> expected = {"x",     "x.2",     "sphere1", "x.2.2",
                                               "disk1", "sphere2", "n/x"};
    for (std::size_t i = 0; i < expected.size(); ++i) CHECK_EQUAL(list.at(i).name, expected[i]);
}

TEST(read_json_motion) {
    const std::vector<ObjectDesc> list = objects(R"(
        {"type": "node", "position": [0, 1, 0], "keys": [{}, {"position": [0, 2, 0]}], "children": [
            {"type": "sphere", "position": [1, 0, 0], "scale": 2},
            {"type": "sphere", "keys": [{"position": [5, 0, 0]}, {"scale": 3}]}]})");
    const auto at = [&](std::size_t object, std::size_t key) {
        return Transform::fromRows(list.at(object).worldFromObject.at(key)).point({1, 0, 0});
    };
    checkPoint(at(0, 0), {3, 1, 0});
    checkPoint(at(0, 1), {3, 2, 0});
    checkPoint(at(1, 0), {6, 1, 0});
    checkPoint(at(1, 1), {3, 2, 0});
    CHECK_THROWS(objects(R"({"type": "node", "keys": [{}, {}], "children": [
                          {"name": "s", "type": "sphere", "keys": [{}, {}, {}]}]})"),
                 "'s' has 3 keys, and what is above it 2");
}

// Copies of copies: the sum is known before any is made.
TEST(read_json_copies_are_bounded) {
    const auto tower = [](int levels, std::string_view dialect) {
        std::string text =
            cat("{", dialect,
                R"("objects": [{"name": "n0", "type": "node", "children": [{"type": "sphere"}]})");
        for (int i = 1; i <= levels; ++i) {
            const std::string ref = cat(R"({"type": "instance", "ref": "n)", i - 1, "\"}");
            text += cat(",\n{\"name\": \"n", i, R"(", "type": "node", "children": [)", ref, ",",
                        ref, "]}");
        }
        return text + "]}";
    };
    CHECK_EQUAL(scene(tower(3, "")).objects.size(), std::size_t{1 + 2 + 4 + 8});
    CHECK_THROWS(scene(tower(64, "")), "the scene has more than 1048576 objects");
    // One inside the other, so deep that following them would end the stack.
    std::string chain = R"({"objects": [{"name": "n0", "type": "sphere"})";
    for (int i = 1; i <= 3000; ++i)
        chain += cat(R"(,{"name": "n)", i, R"(", "type": "instance", "ref": "n)", i - 1, "\"}");
    CHECK_THROWS(scene(chain + "]}"), "nodes and instances are nested more than 1000 deep here");
}

TEST(read_json_keys_of_copies_are_bounded) {
    const auto scenery = [](int copies) {
        std::string keys = "{}";
        for (int i = 1; i < 200; ++i) keys += ",{}";
        std::string text = cat(R"({"objects": [{"name": "n", "type": "node", "keys": [)", keys,
                               R"(], "children": [{"type": "sphere"}]})");
        for (int i = 0; i < copies; ++i) text += R"(,{"type": "instance", "ref": "n"})";
        return text + "]}";
    };
    CHECK_EQUAL(scene(scenery(9)).objects.at(9).worldFromObject.size(), std::size_t{200});
    CHECK_THROWS(scene(scenery(11000)), "the keys and materials of all objects are more than");
}

} // namespace test_json_nodes
