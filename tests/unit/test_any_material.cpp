// What any of many materials has, and the table of them: found by several threads in parts, in
// whichever part the one lies that has it.
#include "base/text.h"
#include "check.h"
#include "render/material_table.h"
#include "render/scene.h"

#include <functional>
#include <span>
#include <string>

namespace test_any_material {

namespace {

struct Special {
    std::string name;
    std::function<void(MaterialDesc&)> change;
    AnyMaterial has;
};

const Special kSpecials[] = {
    {"plain",
     [](MaterialDesc& m) {
         m.diffuse = {0.1, 0.2, 0.3};
     },
     {}},
    {"mirror",
     [](MaterialDesc& m) {
         m.mirror = {0, 0.5, 0};
     },
     {.bounces = true}},
    {"glass",
     [](MaterialDesc& m) {
         m.transmission = {0, 0, 1};
     },
     {.bounces = true, .transmits = true, .branches = true}},
    {"rough", [](MaterialDesc& m) { m.roughness = 0.1; }, {.isRough = true, .branches = true}},
    {"fresnel",
     [](MaterialDesc& m) { m.fresnel = MaterialDesc::Fresnel::Schlick; },
     {.branches = true}},
    {"thin", [](MaterialDesc& m) { m.opacity = 0.5; }, {.branches = true, .seeThrough = true}},
};

bool areSame(const AnyMaterial& a, const AnyMaterial& b) {
    return a.isLamp == b.isLamp && a.bounces == b.bounces && a.transmits == b.transmits &&
           a.isRough == b.isRough && a.branches == b.branches && a.pictures == b.pictures &&
           a.seeThrough == b.seeThrough;
}

Scene sceneOf(const SceneDesc& desc, int threads) {
    RenderSettings settings;
    settings.picture = desc.settings;
    settings.threads = threads;
    return Scene(desc, {"t", ""}, settings);
}

} // namespace

TEST(any_material_wherever_it_is) {
    constexpr std::size_t kCount = 9001;
    for (const std::size_t at : {std::size_t{0}, std::size_t{4095}, std::size_t{4096}, kCount - 1})
        for (const Special& special : kSpecials)
            for (const int threads : {1, 3}) {
                SceneDesc desc;
                desc.cameras.resize(1);
                desc.materials.resize(kCount);
                special.change(desc.materials[at]);
                const Scene scene = sceneOf(desc, threads);
                const std::string what = cat(special.name, " at ", at, ", ", threads, " threads");
                CHECK_INFO(areSame(scene.anyMaterial(), special.has), what);
                CHECK_INFO(scene.hasSeeThrough() == special.has.seeThrough, what);
                CHECK_INFO(scene.materials().size() == kCount + 1, what); // and the default one
                const MaterialTable table(scene, threads);
                for (const std::size_t i : {std::size_t{0}, std::size_t{1}, at, kCount}) {
                    const bool isIt = i == at, mirrors = isIt && special.name == "mirror";
                    const auto number = static_cast<std::uint32_t>(i);
                    CHECK_INFO(((table.traits(number) & MaterialTable::Mirrors) != 0) == mirrors,
                               what << ", " << i);
                    CHECK_INFO((table.traits(number) & MaterialTable::AnswersLamps) != 0,
                               what << ", " << i);
                    CHECK_INFO((scene.materials()[i].base.diffuse == Rgb{0.1f, 0.2f, 0.3f}) ==
                                   (isIt && special.name == "plain"),
                               what << ", " << i);
                }
            }
}

// A lamp that can be seen is a material, too, and it alone is bright.
TEST(any_material_of_a_lamp) {
    SceneDesc desc;
    desc.cameras.resize(1);
    desc.lights.resize(1);
    desc.lights[0].kind = LightDesc::Kind::Rectangle;
    CHECK(!sceneOf(desc, 1).anyMaterial().isLamp);
    desc.lights[0].visible = true;
    CHECK(sceneOf(desc, 1).anyMaterial().isLamp);
}

} // namespace test_any_material
