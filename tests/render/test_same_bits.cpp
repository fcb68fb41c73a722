// Promises P1 and P3 where the stress battery (verify/same_bits.cpp, placement.cpp) has no scenes:
// textures, which are files; crops; meshes of many triangles for the kernels. And that the
// battery's scenes are what they should be.
#include "check.h"
#include "scenes.h"
#include "shot.h"

#include "base/text.h"
#include "desc/validate.h"
#include "image/compare.h"
#include "verify/anything.h"
#include "verify/scene_trials.h"
#include "verify/scenes.h"

#include <algorithm>
#include <array>

namespace test_same_bits {

namespace {

void checkSame(const std::string& name, const std::string& what, const Image& a, const Image& b) {
    const int differing = shot::differingPixels(a, b);
    CHECK_INFO(differing == 0, name << ": " << differing << " pixels differ with " << what
                                    << ", by up to " << shot::maxDifference(a, b));
}

} // namespace

// Maps of every use and an environment: sizes and places of a scene are none of the pictures'.
TEST(sameBitsWithTextures) {
    int count = 0;
    for (const auto& [name, text] : scenes::all()) {
        const SceneDesc desc = shot::parse(text);
        if (desc.textures.empty()) continue;
        ++count;
        const Image one = shot::render(desc).color;
        CHECK(shot::largest(one) > 0.2);
        checkSame(name, "3 threads in small tiles", one, shot::render(desc, [](RenderSettings& s) {
                                                             s.threads = 3;
                                                             s.tileSide = 5;
                                                         }).color);
        checkSame(name, "no accelerator", one,
                  shot::render(desc, [](RenderSettings& s) { s.accel = AccelKind::None; }).color);
        checkSame(name, "the best kernel", one,
                  shot::render(desc, [](RenderSettings& s) { s.isa = &bestIsa(); }).color);
        for (const int k : {-20, 5})
            checkSame(name, cat("scale 2^", k), one,
                      shot::render(scenes::scaled(desc, std::ldexp(1.0, k))).color);
        // 1000 extents of 12 m off, where places are rounded by 1e-12 m. No sample may fall to the
        // other side of a bright edge: one of 4 in one of 3072 pixels is 5e-3 of the peak.
        const Image far = shot::render(scenes::moved(desc, {12000, -7000, 3000})).color;
        CHECK_INFO(rmse(one, far) < 1e-4 * shot::largest(one),
                   name << ": " << rmse(one, far) / shot::largest(one));
    }
    CHECK_EQUAL(count, 2);
}

// Meshes that stand still are one for the kernels: opaque and see-through ones, beside other
// shapes, instances and moving meshes, with camera rays from a point and from a lens, mirrors,
// point lights (their shadow rays share an origin) and an area light.
TEST(sameBitsForKernels) {
    SceneDesc desc = shot::parse("settings {\n resolution 64 48\n samples 4\n}\n"
                                 "camera c {\n look_at 2 -6 3  0 0 0.7  0 0 1\n}\n"
                                 "world {\n background 0.2 0.3 0.5\n}\n"
                                 "light a {\n translate -2 -3 5\n color 40 40 35\n}\n"
                                 "light b {\n translate 3 -2 4\n color 20 20 25\n}\n"
                                 "light c {\n translate 0 -1 6\n radius 0.5\n color 20 20 20\n}\n"
                                 "material mirror {\n diffuse 0.2 0.2 0.2\n mirror 0.6 0.6 0.6\n}\n"
                                 "material veil {\n diffuse 0.6 0.2 0.2\n opacity 0.5\n}\n"
                                 "plane floor {\n scale 6 6 1\n}\n"
                                 "sphere s {\n translate 0.8 -1.4 0.3\n radius 0.3\n}\n");
    const std::pair<const char*, MeshDesc> parts[] = {{"ball", meshes::icosphere(4)},
                                                      {"ring", meshes::torus(0.3, 64, 32)},
                                                      {"shell", meshes::uvSphere(32, 16)},
                                                      {"box", meshes::cube()}};
    const std::array<Vec3d, 4> places = {
        Vec3d{-1.2, 0, 1}, {0.9, 0.6, 1}, {0.1, -1.8, 0.9}, {2.2, -0.6, 0.4}};
    const char* materials[] = {"", "mirror", "veil", ""};
    for (std::size_t i = 0; i < 4; ++i) {
        ObjectDesc object;
        object.kind = ObjectDesc::Kind::Mesh;
        object.name = parts[i].first;
        object.mesh = static_cast<Handle>(desc.meshes.size());
        desc.meshes.push_back(parts[i].second);
        desc.meshes.back().name = parts[i].first;
        for (std::size_t m = 0; m < desc.materials.size(); ++m)
            if (desc.materials[m].name == materials[i]) object.materials = {static_cast<Handle>(m)};
        object.worldFromObject = {
            (Transform::translate(places[i]) * Transform::scale(i == 3 ? 0.4 : 0.7)).rows()};
        desc.objects.push_back(object);
    }
    for (const bool lens : {false, true}) {
        desc.cameras[0].apertureRadius = lens ? 0.1 : 0;
        desc.cameras[0].focusDistance = 6;
        const Image scalar = shot::render(desc).color;
        CHECK(shot::largest(scalar) > 0.2);
        for (const Isa& kernel : allIsas()) {
            if (!kernel.supported()) continue;
            const auto with = [&](RenderSettings& s) { s.isa = &kernel; };
            checkSame(lens ? "lens" : "pinhole", kernel.name, scalar,
                      shot::render(desc, with).color);
        }
    }
}

// Glass between two mirrors: some samples have many rays, others one that goes on and on, and sums
// run over rays in the order of their parents, whichever of them the registers send on together.
TEST(sameBitsOfGlassBesideMirrors) {
    std::string text = "settings {\n resolution 96 72\n samples 4\n max_depth 8\n}\n"
                       "camera c {\n look_at 0 -6 1  0 0 1  0 0 1\n}\n"
                       "light l {\n translate -2 -3 2\n color 40 40 35\n}\n"
                       "material mirror {\n diffuse 0.2 0.2 0.2\n mirror 0.7 0.6 0.6\n}\n"
                       "material glass {\n diffuse 0.1 0.1 0\n mirror 1 1 1\n transmission 1 0.9 "
                       "1\n fresnel dielectric\n ior 1.5\n}\n"
                       "plane floor {\n scale 20 20 1\n material mirror\n}\n"
                       "plane ceiling {\n translate 0 0 3\n scale 20 20 1\n material mirror\n}\n";
    for (int i = 0; i < 12; ++i)
        text += cat("sphere s", i, " {\n translate ", 1.4 * (i % 4 - 1.5), ' ', 1.5 * (i / 4), " ",
                    0.5 + i % 3, "\n radius 0.3\n material glass\n}\n");
    const Image scalar = shot::render(text).color;
    CHECK(shot::largest(scalar) > 0.2);
    for (const Isa& kernel : allIsas())
        if (kernel.supported())
            checkSame("balls", kernel.name, scalar,
                      shot::render(text, [&](RenderSettings& s) { s.isa = &kernel; }).color);
}

// Rough mirrors and glass of every law of Fresnel, narrow and wide, sharp ones beside them: those
// whose highlights have counted the lamps don't show the lamps' bodies, others do.
TEST(sameBitsOfRoughMirrorsBesideLamps) {
    std::string text =
        "settings {\n resolution 96 72\n samples 4\n max_depth 6\n}\n"
        "world {\n background 0.2 0.3 0.5\n}\n"
        "camera c {\n look_at 0 -6 2  0 0 0.7  0 0 1\n}\n"
        "light r {\n type rectangle\n look_at 2 2 3  0 0 0  0 0 1\n size 2 2\n color "
        "9 9 8\n visible true\n}\n"
        "light s {\n type sphere\n translate 0 3.5 1.2\n radius 1\n color 9 5 3\n "
        "visible true\n}\n"
        "plane floor {\n scale 9 9 1\n material m1\n}\n";
    const char* laws[] = {"none", "dielectric", "schlick"};
    for (int i = 0; i < 18; ++i)
        text += cat("material m", i, " {\n diffuse 0.1 0.1 0.2\n mirror 0.8 0.", i % 9, " 0.4\n",
                    " roughness ", i % 6 == 0 ? 0 : 0.055 * i, "\n fresnel ", laws[i % 3], '\n',
                    i % 4 == 1 ? " specular 0.5 0.4 0.3\n" : "",
                    i % 2 == 0 ? " transmission 0.9 0.8 0.7\n ior 1.4\n" : "", "}\n");
    for (int i = 0; i < 18; ++i)
        text += cat("sphere s", i, " {\n translate ", 0.8 * (i % 6 - 2.5), ' ', 0.9 * (i / 6 - 1),
                    " 0.4\n radius 0.35\n material m", i, "\n}\n");
    using Kind = SettingsDesc::Sampler;
    for (const auto& [name, sampler] :
         {std::pair("sobol", Kind::Sobol), std::pair("stratified", Kind::Stratified),
          std::pair("zsobol", Kind::ZSobol)}) {
        SceneDesc desc = shot::parse(text);
        desc.settings.sampler = sampler;
        const Image scalar = shot::render(desc).color;
        CHECK(shot::largest(scalar) > 0.2);
        for (const Isa& kernel : allIsas())
            if (kernel.supported())
                checkSame(name, kernel.name, scalar,
                          shot::render(desc, [&](RenderSettings& s) { s.isa = &kernel; }).color);
    }
}

// Mirrors of many colours, and what mirrors nothing: nobody asks what rays are inside of, but each
// goes on with its own weight, at its own time and for its own sample.
TEST(sameBitsOfMirrorsInMotion) {
    std::string text = "settings {\n resolution 96 72\n samples 2\n max_depth 5\n}\n"
                       "world {\n background 0.2 0.3 0.5\n ambient 0.3 0.2 0.1\n}\n"
                       "camera c {\n look_at 0 -6 2  0 0 0.5  0 0 1\n}\n"
                       "light l {\n translate -2 -3 4\n color 40 40 35\n}\n"
                       "material m0 {\n diffuse 0.3 0.2 0.1\n}\n"
                       "plane floor {\n scale 9 9 1\n material m1\n}\n";
    for (int i = 1; i < 6; ++i)
        text += cat("material m", i, " {\n diffuse 0.", i, " 0.1 0.2\n specular 0 0.", i - 1,
                    " 0\n mirror 0.", i + 3, " 0.5 0.4\n}\n");
    for (int i = 0; i < 40; ++i)
        text += cat("sphere s", i, " {\n translate ", 0.5 * (i % 8 - 3.5), ' ', 0.6 * (i / 8), ' ',
                    0.1 * (i % 5),
                    i % 3 == 0 ? cat("\n key\n translate ", 0.5 * (i % 8 - 3), " 0 1") : "",
                    "\n radius 0.25\n material m", i % 6, "\n}\n");
    const Image scalar = shot::render(text).color;
    CHECK(shot::largest(scalar) > 0.2);
    for (const Isa& kernel : allIsas())
        if (kernel.supported())
            checkSame("mirrors", kernel.name, scalar,
                      shot::render(text, [&](RenderSettings& s) { s.isa = &kernel; }).color);
}

TEST(sameBitsInCrops) {
    for (const auto& [name, text] : scenes::all()) {
        const Image full = shot::render(text).color;
        for (const std::array<int, 4> crop :
             {std::array{0, 0, 17, 48}, std::array{13, 7, 50, 31}, std::array{63, 47, 64, 48}}) {
            const Image part =
                shot::render(text, [&](RenderSettings& s) { s.picture.crop = crop; }).color;
            CHECK_EQUAL(part.width(), crop[2] - crop[0]);
            CHECK_EQUAL(part.height(), crop[3] - crop[1]);
            int wrong = 0;
            for (int y = 0; y < part.height(); ++y)
                for (int x = 0; x < part.width(); ++x)
                    wrong += part.pixel(x, y) != full.pixel(x + crop[0], y + crop[1]);
            CHECK_INFO(wrong == 0, name << ": " << wrong << " cropped pixels differ");
        }
    }
}

// What --stats calls needed can be seen; that the rest leaves no trace is T17 of the battery.
TEST(featuresThatAreNeededShow) {
    const std::vector<std::pair<std::string, bool Switches::*>> switches = {
        {"soft-shadows", &Switches::softShadows}, {"reflection", &Switches::reflection},
        {"refraction", &Switches::refraction},    {"glossy", &Switches::glossy},
        {"textures", &Switches::textures},        {"dof", &Switches::dof},
        {"motion-blur", &Switches::motionBlur},   {"fresnel", &Switches::fresnel},
        {"shadows", &Switches::shadows}};
    int count = 0;
    for (const auto& [name, text] : scenes::all()) {
        const shot::Shot all = shot::render(text);
        const auto& needed = all.stats.featuresNeeded;
        for (const auto& [feature, member] : switches) {
            if (std::find(needed.begin(), needed.end(), feature) == needed.end()) continue;
            ++count;
            const Image without = shot::render(text, [&, m = member](RenderSettings& s) {
                                      s.switches.*m = false;
                                  }).color;
            CHECK_INFO(shot::differingPixels(all.color, without) > 0,
                       name << " does not show " << feature);
        }
    }
    CHECK(count >= 20);
}

// The scenes of the battery are valid ones, without so much as a warning, and show something: a
// fifth of the pixels at least differ from their left neighbour (sky and floor are flat).
TEST(scenesOfTheBattery) {
    meshes::Random random(1);
    for (int i = 0; i < check::scaled(3); ++i)
        for (const scenes::Maker& maker : scenes::makers()) {
            const SceneDesc desc = maker.make(random);
            Diagnostics diagnostics;
            validate(desc, {"scene", ""}, diagnostics);
            CHECK_INFO(diagnostics.warnings.empty(), maker.name << ": " << diagnostics.warnings[0]);
            const Image image = scenes::render(desc).color;
            int changes = 0;
            for (int y = 0; y < image.height(); ++y)
                for (int x = 1; x < image.width(); ++x)
                    changes += image.pixel(x, y) != image.pixel(x - 1, y);
            CHECK_INFO(changes > image.width() * image.height() / 5,
                       maker.name << " " << i << ": " << changes);
            CHECK(scenes::largest(image) > 0.05);
        }
}

// Many of their numbers have no effect, but validate() throws for none.
TEST(anythingIsValid) {
    meshes::Random random(2);
    for (int i = 0; i < check::scaled(100); ++i) {
        Diagnostics diagnostics;
        validate(scenes::anything(random), {"scene", ""}, diagnostics);
    }
}

// Another seed gives other noise; the same seed the same.
TEST(seedsMatter) {
    const std::string& text = scenes::all()[3].text; // soft
    const Image a = shot::render(text).color;
    const Image b = shot::render(text, [](RenderSettings& s) { s.picture.seed = 7; }).color;
    CHECK(shot::differingPixels(a, b) > 1000);
    CHECK_EQUAL(shot::differingPixels(a, shot::render(text).color), 0);
}

} // namespace test_same_bits
