// What validate() says: the order of its errors and how many are shown, and its warnings.
#include "desc/lobes.h"
#include "desc/validate.h"
#include "unit/validate_kit.h"

#include <algorithm>
#include <random>

namespace test_validate_messages {

using namespace validate_kit;

// First of single properties, then of names, then of blocks as wholes, each in the order of the
// scene: also where blocks are looked at some at a time.
TEST(validate_messages_come_by_stage) {
    constexpr std::size_t kMany = 200;
    for (std::size_t apart = 1; apart < kMany; apart += 13) {
        const std::string errors = errorsAfter([&](SceneDesc& d) {
            d.objects.resize(kMany);
            for (std::size_t i = 2; i < kMany; ++i) d.objects[i].name = cat("ball", i);
            d.objects[1].worldFromObject = {Rows{}};        // flat
            d.objects[1 + apart % (kMany - 1)].radius = -1; // a property
            d.objects[kMany - apart].name = "ball" + std::to_string(kMany + 1);
            d.objects.emplace_back().name = "ball" + std::to_string(kMany + 1); // a name
            d.materials[0].ior = -2;
        });
        const std::size_t ior = errors.find("'ior'"), radius = errors.find("'radius'"),
                          name = errors.find("has this name"), flat = errors.find("flattens it");
        CHECK_INFO(ior < radius && radius < name && name < flat && flat != std::string::npos,
                   apart << " apart: " << errors);
        CHECK(std::count(errors.begin(), errors.end(), '\n') == 3);
    }
}

// More than are shown are counted, whichever stage they are of.
TEST(validate_counts_messages_of_all_stages) {
    const std::string errors = errorsAfter([](SceneDesc& d) {
        for (int i = 0; i < 30; ++i) {
            ObjectDesc& ball = d.objects.emplace_back();
            ball.name = "same";
            ball.radius = -1;
        }
    });
    checkError(errors, "and 39 more errors"); // 30 radii and 29 names, of which 20 are shown
    CHECK(errors.find("has this name") == std::string::npos);
}

TEST(validate_collects_errors) {
    const std::string errors = errorsAfter([](SceneDesc& d) {
        for (int i = 0; i < 30; ++i) {
            d.objects.emplace_back().name = cat("s", i);
            d.objects.back().radius = -1;
        }
    });
    checkError(errors, "sphere 's0': 'radius' must be > 0, got -1\n");
    checkError(errors, "sphere 's19'");
    CHECK(errors.find("'s20'") == std::string::npos);
    CHECK(errors.ends_with("s.json: error: and 10 more errors"));
}

TEST(validate_warnings) {
    const std::string dark = "there is no light, no emission and no ambient: ";
    const auto darken = [](SceneDesc& d) { d.lights[0].color = {}; };
    checkError(warningsAfter(darken),
               "s.json: warning: " + dark + "the picture will be black; add a light");
    checkError(warningsAfter([&](SceneDesc& d) {
                   darken(d);
                   d.materials.emplace_back().name = "lava"; // which nothing is made of
                   d.materials[1].emission = {1, 1, 1};
               }),
               dark + "the picture");
    checkError(warningsAfter([&](SceneDesc& d) {
                   darken(d);
                   d.world.background = {1, 1, 1};
               }),
               dark + "diffuse surfaces");
    CHECK_EQUAL(warningsAfter([&](SceneDesc& d) {
                    darken(d);
                    d.world.ambient = {1, 1, 1};
                }),
                "");
    CHECK_EQUAL(warningsAfter([&](SceneDesc& d) {
                    darken(d);
                    d.materials[0].emission = {1, 1, 1};
                }),
                "");
    checkError(warningsAfter([](SceneDesc& d) { d.objects.clear(); }), "the scene has no objects");
    checkError(warningsAfter([](SceneDesc& d) { d.objects[0].materials.clear(); }),
               "nothing uses the material red");
    checkError(warningsAfter([](SceneDesc& d) { d.objects.erase(d.objects.begin()); }),
               "nothing uses the mesh mesh");
    const auto addTextures = [](SceneDesc& d) {
        for (int i = 0; i < 13; ++i) {
            d.textures.emplace_back().name = cat("t", i);
            d.textures.back().file = "t.ppm";
        }
    };
    checkError(warningsAfter(addTextures),
               "nothing uses the textures t0, t1, t2, t3, t4, t5, t6, t7, t8, t9 and 3 more");
    checkError(warningsAfter([&](SceneDesc& d) {
                   addTextures(d);
                   d.world.environment = 0;
               }),
               "the environment is multiplied by 'background', which is 0 0 0");
    const auto moveBy = [](double x) {
        return [x](SceneDesc& d) {
            for (ObjectDesc& object : d.objects)
                for (Rows& key : object.worldFromObject) key[7] -= x;
        };
    };
    CHECK_EQUAL(warningsAfter(moveBy(1e8)), ""); // of a scene of some metres
    checkError(warningsAfter(moveBy(1e11)), "the scene lies more than 10^10 times its size away");
    checkError(warningsAfter([](SceneDesc& d) { d.lights[0].coneAngleDeg = 10; }),
               "light 'lamp': 'cone_angle' has no effect on type point");
}

// A sky that lights is light.
TEST(validate_warns_of_darkness_but_under_a_sky) {
    const auto warnings = [](bool lights, Rgbd sky) {
        return warningsAfter([&](SceneDesc& d) {
            d.lights.clear();
            d.world.background = sky;
            d.world.environmentLights = lights;
        });
    };
    CHECK_EQUAL(warnings(true, {0, 0.1, 0}), "");
    CHECK_EQUAL(warningsAfter([](SceneDesc& d) {
                    d.lights.clear();
                    d.world.background = {0, 0.1, 0};
                    d.settings.integrator = SettingsDesc::Integrator::Path;
                }),
                "");
    checkError(warnings(false, {0, 0.1, 0}), "diffuse surfaces will be black");
    checkError(warnings(true, {}), "the picture will be black");
}

// Covers, lobes that are no part of the light, and those that a picture multiplies, do not count.
TEST(validate_warns_of_weights_above_one) {
    const auto lobe = [](std::string_view kind, Rgbd weight) {
        for (const LobeForm& form : lobeForms()) {
            LobeDesc lobe = form.usual;
            lobe.weight = weight;
            if (form.name == kind) return lobe;
        }
        return LobeDesc{};
    };
    const auto warnings = [](std::vector<LobeDesc> lobes) {
        return warningsAfter([&](SceneDesc& d) {
            d.textures.emplace_back().name = "t";
            d.textures[0].file = "t.ppm";
            d.objects[1].materials = {0};
            d.materials[0].bumpMap = 0; // so that it is used
            d.materials[0].lobes = std::move(lobes);
        });
    };
    const LobeDesc diffuse = lobe("diffuse", {0.5, 0.8, 0.5}),
                   mirror = lobe("mirror", {0.5, 0.2, 0.1});
    CHECK_EQUAL(warnings({diffuse, mirror}), "");
    CHECK_EQUAL(
        warnings({diffuse, mirror, lobe("sheen", {0.25, 0.1, 0})}),
        "s.json: warning: material 'red': the weights of its lobes sum up to 1.25; they are "
        "scaled to 1");
    LobeDesc coat = lobe("coat", {1, 1, 1}), painted = lobe("mirror", {1, 1, 1});
    checkError(warnings({coat, diffuse}), "sum up to 1.8;");
    coat.covers = true;
    painted.factors = {{.texture = 0}};
    CHECK_EQUAL(warnings({coat, painted, lobe("phong", {1, 1, 1}), diffuse}), "");
}

TEST(validate_warns_of_materials_that_return_more_than_they_get) {
    const auto warnings = [](const std::function<void(MaterialDesc&)>& change) {
        return warningsAfter([&](SceneDesc& d) { change(d.materials[0]); });
    };
    // diffuse is 0.8
    CHECK_EQUAL(warnings([](MaterialDesc& m) { m.mirror = {0.2, 0.2, 0.2}; }), "");
    CHECK_EQUAL(warnings([](MaterialDesc& m) {
                    m.mirror = {0.3, 0.2, 0.2};
                }),
                "s.json: warning: material 'red': diffuse + mirror + transmission is 1.1; above 1 "
                "a surface gives back more light than it gets");
    checkError(warnings([](MaterialDesc& m) { m.transmission = {0.1, 0.45, 0.1}; }), "is 1.25;");
    checkError(warnings([](MaterialDesc& m) {
                   m.mirror = {0, 0.15, 0};
                   m.transmission = {0, 0, 0.25};
               }),
               "is 1.05;");
    CHECK_EQUAL(warnings([](MaterialDesc& m) {
                    m.mirror = {0.15, 0.05, 0}, m.transmission.b = 0.2;
                }),
                "");
    // Glass shares what comes between mirror and transmission, and varnish is no mirror.
    using Fresnel = MaterialDesc::Fresnel;
    CHECK_EQUAL(warnings([](MaterialDesc& m) {
                    m.diffuse = {};
                    m.mirror = m.transmission = {1, 1, 1};
                    m.fresnel = Fresnel::Dielectric;
                }),
                "");
    CHECK_EQUAL(warnings([](MaterialDesc& m) {
                    m.mirror = {1, 1, 1};
                    m.fresnel = Fresnel::Dielectric;
                }),
                "");
    checkError(warnings([](MaterialDesc& m) {
                   m.transmission = {1, 1, 1};
                   m.fresnel = Fresnel::Dielectric;
               }),
               "is 1.8;");
    checkError(warnings([](MaterialDesc& m) {
                   m.mirror = {0.5, 0.5, 0.5};
                   m.fresnel = Fresnel::Schlick;
               }),
               "is 1.3;");
    // One warning for all of them; those that nothing is made of, or with a picture, don't count.
    const auto many = [](int count) {
        return warningsAfter([&](SceneDesc& d) {
            d.textures.emplace_back().name = "paper";
            d.textures[0].file = "paper.png";
            d.materials.resize(static_cast<std::size_t>(count) + 2);
            for (std::size_t i = 0; i < d.materials.size(); ++i) {
                d.materials[i].name = cat("m", i);
                d.materials[i].mirror = {0.4, 0.4, 0.4};
            }
            d.materials[0].diffuseTexture = 0;
            d.objects[0].materials = {0};
            for (int i = 1; i <= count; ++i) {
                d.objects.emplace_back().name = cat("o", i);
                d.objects.back().materials = {i};
            }
        });
    };
    const std::string unused = "s.json: warning: nothing uses the material ";
    CHECK_EQUAL(many(0), unused + "m1");
    const auto told = [&](int count, const std::string& others) {
        return cat(
            unused, "m", count + 1, "\ns.json: warning: material 'm1'", others,
            ": diffuse + mirror + transmission is 1.2; above 1 a surface gives back more light "
            "than it gets");
    };
    CHECK_EQUAL(many(1), told(1, ""));
    CHECK_EQUAL(many(2), told(2, " and one other"));
    CHECK_EQUAL(many(5), told(5, " and 4 others"));
}

// Scenes of a few objects of any kind, size and place, about the distance at which it is told: the
// short way to the answer is the one by the box of the whole scene.
TEST(validate_tells_what_is_far_by_the_box_of_all) {
    std::mt19937_64 engine(610);
    const auto uniform = [&](double lo, double hi) {
        return lo + (hi - lo) * (static_cast<double>(engine() >> 11) * 0x1p-53);
    };
    int farCount = 0;
    const int count = check::scaled(2000);
    for (int i = 0; i < count; ++i) {
        SceneDesc desc = soundScene();
        for (Vec3d& p : desc.meshes[0].points) p *= std::exp2(uniform(-10, 10));
        const Vec3d away =
            Vec3d{uniform(-1, 1), uniform(-1, 1), uniform(-1, 1)} * std::exp2(uniform(20, 36));
        desc.objects.resize(1 + engine() % 4);
        for (std::size_t k = 1; k < desc.objects.size(); ++k) {
            ObjectDesc& object = desc.objects[k];
            object.name = cat("object", k);
            object.kind = static_cast<ObjectDesc::Kind>(engine() % 7); // no meshes
            object.radius = std::exp2(uniform(-5, 5));
        }
        for (ObjectDesc& object : desc.objects) {
            const double size = std::exp2(uniform(-3, 3));
            const Vec3d p = away + Vec3d{uniform(-9, 9), uniform(-9, 9), uniform(-9, 9)};
            object.worldFromObject = {{size, 0, 0, p.x, 0, size, 0, p.y, 0, 0, size, p.z}};
        }
        Diagnostics diagnostics;
        validate(desc, {"s.json", ""}, diagnostics);
        const bool told = join(diagnostics.warnings, " ").find("lies more") != std::string::npos;
        const BoundsD box = boundsOf(desc);
        const double extent = maxAbs(box.size());
        const bool isFar = max(maxAbs(box.lo), maxAbs(box.hi)) / extent > 0x1p28;
        CHECK_INFO(told == isFar, "scene " << i << " of seed 610");
        farCount += isFar;
    }
    CHECK(farCount > count / 10 && farCount < count - count / 10);
}

} // namespace test_validate_messages
