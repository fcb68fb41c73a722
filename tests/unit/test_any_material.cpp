// What any of many materials has, and what each of them scatters light by: found by several threads
// in parts, in whichever part the one lies that is special.
#include "base/text.h"
#include "check.h"
#include "scene/scene.h"

#include <functional>
#include <span>
#include <string>

namespace test_any_material {

namespace {

constexpr std::uint32_t kPlain = kReflects | kAnswersLights | kSpawnsRays | kDiffuse;

struct Special {
    std::string name;
    std::function<void(MaterialDesc&)> change;
    AnyMaterial has;
    std::uint32_t flags; // of its lobes, and its traits
};

const Special kSpecials[] = {
    {"plain",
     [](MaterialDesc& m) {
         m.diffuse = {0.1, 0.2, 0.3};
     },
     {},
     kPlain},
    {"mirror",
     [](MaterialDesc& m) {
         m.diffuse = {}, m.mirror = {0, 0.5, 0};
     },
     {},
     kReflects | kSpawnsRays},
    {"rough mirror",
     [](MaterialDesc& m) {
         m.diffuse = {}, m.mirror = {0, 0.5, 0}, m.roughness = 0.1;
     },
     {},
     kReflects | kAnswersLights | kSpawnsRays | kHasTangent | LobedMaterial::kSpreads},
    {"glass",
     [](MaterialDesc& m) {
         m.diffuse = {}, m.transmission = {0, 0, 1};
     },
     {.transmits = true},
     kReflects | kTransmits | kAnswersLights | kSpawnsRays | kHasSides | kHasTangent},
    {"black", [](MaterialDesc& m) { m.diffuse = {}; }, {}, 0},
    {"bright",
     [](MaterialDesc& m) {
         m.emission = {0, 1, 0};
     },
     {},
     kPlain | LobedMaterial::kEmits},
    {"lit outside",
     [](MaterialDesc& m) { m.litSide = MaterialDesc::LitSide::Outside; },
     {},
     kPlain | LobedMaterial::kLitOutside},
    {"thin",
     [](MaterialDesc& m) { m.opacity = 0.5; },
     {.seeThrough = true},
     kPlain | LobedMaterial::kSeeThrough},
};

bool areSame(const AnyMaterial& a, const AnyMaterial& b) {
    return a.transmits == b.transmits && a.pictures == b.pictures && a.seeThrough == b.seeThrough;
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
                CHECK_INFO(scene.materials().size() == kCount + 1, what); // and the default one
                CHECK_INFO(scene.lobedMaterials().size() == kCount + 1, what);
                for (const std::size_t i : {std::size_t{0}, std::size_t{1}, at, kCount}) {
                    const bool isIt = i == at;
                    CHECK_INFO(scene.lobedMaterials()[i].flags == (isIt ? special.flags : kPlain),
                               what << ", " << i << ": " << scene.lobedMaterials()[i].flags);
                    CHECK_INFO((scene.materials()[i].diffuse == Rgb{0.1f, 0.2f, 0.3f}) ==
                                   (isIt && special.name == "plain"),
                               what << ", " << i);
                }
            }
}

// A lamp that can be seen is a material, too, and it alone is one.
TEST(any_material_of_a_lamp) {
    SceneDesc desc;
    desc.cameras.resize(1);
    desc.lights.resize(1);
    desc.lights[0].kind = LightDesc::Kind::Rectangle;
    CHECK_EQUAL(sceneOf(desc, 1).materials().size(), std::size_t{1}); // the default one
    desc.lights[0].visible = true;
    const Scene scene = sceneOf(desc, 1);
    CHECK_EQUAL(scene.materials().size(), std::size_t{2});
    CHECK(!scene.materials()[0].isLamp && scene.materials()[1].isLamp);
    CHECK_EQUAL(scene.lobedMaterials()[1].flags, std::uint32_t{LobedMaterial::kEmits});
}

} // namespace test_any_material
