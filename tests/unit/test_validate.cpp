// The rules that hold for every format, on scenes that no reader of text would pass on.
#include "desc/validate.h"

#include "base/text.h"
#include "check.h"
#include "desc/properties.h"
#include "desc/scene_bounds.h"

#include <algorithm>
#include <functional>
#include <limits>
#include <random>

namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

// A sound scene: a camera, a light, a sphere, an instance of a triangle with a material.
SceneDesc soundScene() {
    SceneDesc desc;
    desc.cameras.emplace_back().name = "camera";
    desc.lights.emplace_back().name = "lamp";
    desc.materials.emplace_back().name = "red";
    MeshDesc& mesh = desc.meshes.emplace_back();
    mesh.name = "mesh";
    mesh.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    mesh.triangles = {{0, 1, 2}};
    ObjectDesc& instance = desc.objects.emplace_back();
    instance.name = "instance";
    instance.kind = ObjectDesc::Kind::Mesh;
    instance.mesh = 0;
    instance.materials = {0};
    desc.objects.emplace_back().name = "ball";
    return desc;
}

std::string errorsOf(const SceneDesc& desc) {
    Diagnostics diagnostics;
    return check::thrown([&] { validate(desc, {"s.json", ""}, diagnostics); });
}
std::string errorsAfter(const std::function<void(SceneDesc&)>& damage) {
    SceneDesc desc = soundScene();
    damage(desc);
    return errorsOf(desc);
}
std::string warningsAfter(const std::function<void(SceneDesc&)>& change) {
    SceneDesc desc = soundScene();
    change(desc);
    Diagnostics diagnostics;
    validate(desc, {"s.json", ""}, diagnostics);
    return join(diagnostics.warnings, "\n");
}

void checkError(const std::string& errors, const std::string& words) {
    CHECK_INFO(errors.find(words) != std::string::npos,
               "expected '" << words << "' in '" << errors << "'");
}

// Every number of every property of the block, one at a time: NaN and what is out of range.
template <class Block> void checkNumbersOf(Block& block, const SceneDesc& desc) {
    for (const Property<Block>& property : propertiesOf<Block>()) {
        if (!(property.kinds & kindOf(block))) continue;
        for (const Field<Block>* field :
             {&property.first, property.second ? &*property.second : nullptr}) {
            if (!field) continue;
            forEachNumber(block, *field, [&](auto& number) {
                const auto before = number;
                const auto check = [&](double bad, std::string_view words) {
                    number = static_cast<std::remove_reference_t<decltype(number)>>(bad);
                    checkError(errorsOf(desc), cat("'", property.keyword, "' ", words));
                    number = before;
                };
                const Range& range = property.range;
                if constexpr (std::is_same_v<std::remove_reference_t<decltype(number)>, double>) {
                    check(kNan, "is not a finite number");
                    check(-1.0 / 0.0, "is not a finite number");
                    check(range.hi * 1.1, "must be ");
                    check(range.aboveLo ? range.lo : range.lo - std::fabs(range.lo) - 1,
                          "must be ");
                } else if (range.hi < kLargestUnsigned) {
                    check(range.hi + 1, "must be from ");
                    check(range.lo - 1, "must be from ");
                }
            });
        }
    }
}

} // namespace

TEST(validate_sound_scene) {
    CHECK_EQUAL(errorsOf(soundScene()), "");
    CHECK_EQUAL(warningsAfter([](SceneDesc&) {}), "");
}

TEST(validate_every_number) {
    SceneDesc desc = soundScene();
    desc.textures.emplace_back().name = "t";
    desc.textures[0].file = "t.ppm";
    desc.settings.crop = {0, 0, 10, 10};
    for (const auto& row : kEnumNames<ObjectDesc::Kind>) {
        ObjectDesc& object = desc.objects.emplace_back();
        object.name = cat("o", row.name);
        object.kind = row.value;
        if (row.value == ObjectDesc::Kind::Mesh) object.mesh = 0;
    }
    for (const auto& row : kEnumNames<LightDesc::Kind>) {
        LightDesc& light = desc.lights.emplace_back();
        light.name = cat("l", row.name);
        light.kind = row.value;
        light.radius = 1;
    }
    CHECK_EQUAL(errorsOf(desc), "");
    forEachBlock(desc, [&](auto& block) { checkNumbersOf(block, desc); });
}

TEST(validate_handles) {
    for (const Handle wrong : {-2, 1, 1000}) {
        checkError(errorsAfter([&](SceneDesc& d) { d.objects[0].mesh = wrong; }),
                   cat("'mesh' refers to mesh ", wrong, " of 1"));
        checkError(errorsAfter([&](SceneDesc& d) { d.objects[0].materials[0] = wrong; }),
                   cat("'materials' refers to material ", wrong, " of 1"));
        checkError(errorsAfter([&](SceneDesc& d) { d.objects[1].materials = {wrong}; }),
                   "'materials' refers to material");
        checkError(errorsAfter([&](SceneDesc& d) { d.materials[0].bumpMap = wrong; }),
                   "'bump_map' refers to texture");
        checkError(errorsAfter([&](SceneDesc& d) { d.world.environment = wrong; }),
                   "'environment' refers to texture");
    }
    checkError(errorsAfter([](SceneDesc& d) { d.objects[0].materials = {kNone}; }),
               "one of its material slots is empty");
    checkError(errorsAfter([](SceneDesc& d) { d.objects[0].mesh = kNone; }),
               "instance 'instance': has no 'mesh'");
    checkError(errorsAfter([](SceneDesc& d) {
                   d.objects[1].materials = {0, 0};
               }),
               "sphere 'ball': has 2 materials");
}

TEST(validate_transforms) {
    const auto at = [](std::size_t i, double value) {
        return [=](SceneDesc& d) { d.objects[1].worldFromObject[0][i] = value; };
    };
    checkError(errorsAfter(at(3, kNan)), "its transform has numbers beyond");
    checkError(errorsAfter(at(3, 1e61)), "its transform has numbers beyond");
    checkError(errorsAfter(at(5, 0)), "sphere 'ball': its transform flattens it");
    checkError(errorsAfter([](SceneDesc& d) { d.objects[1].worldFromObject.clear(); }),
               "one key is needed");
    checkError(errorsAfter([](SceneDesc& d) { d.cameras[0].worldFromCamera[0][0] = 0; }),
               "camera 'camera': its transform flattens it");
    checkError(errorsAfter([](SceneDesc& d) { d.lights[0].worldFromLight[0] = 0; }),
               "light 'lamp': its transform flattens it");
    checkError(errorsAfter([](SceneDesc& d) {
                   d.objects[1].worldFromObject.push_back(kIdentityRows);
                   d.objects[1].worldFromObject[1][0] = -1;
               }),
               "one of its keys mirrors");
    CHECK_EQUAL(errorsAfter(at(5, 1e-9)), "");
    CHECK_EQUAL(errorsAfter(at(5, -1)), "");
}

TEST(validate_names) {
    checkError(errorsAfter([](SceneDesc& d) { d.objects[1].name = "instance"; }),
               "another object has this name");
    checkError(errorsAfter([](SceneDesc& d) { d.materials.push_back(d.materials[0]); }),
               "material 'red': another material has this name");
    for (const std::string bad : {"", "a\nb", "\xff"})
        checkError(errorsAfter([&](SceneDesc& d) { d.meshes[0].name = bad; }),
                   "a name is UTF-8 without control characters");
    CHECK_EQUAL(errorsAfter([](SceneDesc& d) { d.materials[0].name = "ball"; }),
                ""); // another kind
}

TEST(validate_meshes) {
    const auto with = [](const std::function<void(MeshDesc&)>& damage) {
        return errorsAfter([&](SceneDesc& d) { damage(d.meshes[0]); });
    };
    checkError(with([](MeshDesc& m) { m.triangles[0][1] = 3; }),
               "'triangles' uses 3 of 'points', which has 3");
    checkError(with([](MeshDesc& m) { m.triangles.clear(); }), "has no triangles");
    checkError(with([](MeshDesc& m) { m.points[1].y = kNan; }), "point 1 is not finite");
    checkError(with([](MeshDesc& m) { m.points[2].x = 1e61; }),
               "point 2 is not finite or beyond 1e+60");
    checkError(with([](MeshDesc& m) {
                   m.normals = {{0, 0, 1}};
               }),
               "has normals, but no normal_triangles");
    checkError(with([](MeshDesc& m) {
                   m.normalTriangles = {{0, 0, 0}};
               }),
               "'normal_triangles' uses 0 of 'normals', which has 0");
    checkError(with([](MeshDesc& m) {
                   m.normals = {{0, 0, 1e30f}};
                   m.normalTriangles = {{0, 0, 0}};
               }),
               "a normal is not finite");
    checkError(with([](MeshDesc& m) {
                   m.uvs = {{0, 0}};
                   m.uvTriangles = {{0, 0, 0}, {0, 0, 0}};
               }),
               "1 triangles, but 2 uv_triangles");
    checkError(with([](MeshDesc& m) {
                   m.uvs = {{0, 1.0f / 0.0f}};
                   m.uvTriangles = {{0, 0, 0}};
               }),
               "a uv is not finite");
    checkError(with([](MeshDesc& m) {
                   m.triangleMaterials = {0, 0};
               }),
               "1 triangles, but 2 triangle_materials");
    checkError(errorsAfter([](SceneDesc& d) {
                   d.meshes[0].triangleMaterials = {2};
                   d.objects[0].materials = {0, 0};
               }),
               "its mesh uses material slot 2, but it has 2 materials");
    CHECK_EQUAL(with([](MeshDesc& m) { m.triangleMaterials = {1}; }), ""); // one for all slots
    CHECK_EQUAL(with([](MeshDesc& m) {
                    m = {};
                    m.name = "later";
                    m.file = "later.obj"; // load() reads it
                }),
                "");
    checkError(with([](MeshDesc& m) { m.triangleMaterials = {4294967295u}; }),
               "material slot 4294967295 is above 65535");
    CHECK_EQUAL(errorsAfter([](SceneDesc& d) {
                    d.meshes[0].triangleMaterials = {7};
                    d.objects[0].materials.clear(); // the default material for all slots
                }),
                "");
}

TEST(validate_corners) {
    const auto with = [](const Corners4& corners) {
        return errorsAfter([&](SceneDesc& d) {
            d.objects[1].kind = ObjectDesc::Kind::Plane;
            d.objects[1].corners = corners;
        });
    };
    CHECK_EQUAL(with({{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}}), "");
    CHECK_EQUAL(with({{{0, 0, 0}, {0, 1, 0}, {1, 1, 0}, {1, 0, 0}}}), ""); // the other way round
    CHECK_EQUAL(with({{{1e6, 0, 0}, {1e6 + 1, 0, 0.01}, {1e6 + 1, 1, 0}, {1e6, 1, 0}}}),
                ""); // as float can
    checkError(with({{{0, 0, 0}, {1, 0, 0}, {1, 1, 0.01}, {0, 1, 0}}}), "do not lie in one plane");
    checkError(with({{{0, 0, 0}, {1, 0, 0}, {1, 0, 0}, {0, 1, 0}}}), "must go around a convex");
    checkError(with({{{0, 0, 0}, {2, 0, 0}, {0.5, 0.5, 0}, {0, 2, 0}}}), "must go around a convex");
    checkError(with({{{0, 0, 0}, {1, 1, 0}, {2, 2, 0}, {3, 3, 0}}}), "have no area");
    checkError(with({}), "have no area");
    for (const double scale : {1e-50, 1e-9, 1e9, 1e50}) {
        Corners4 corners{{{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}}};
        for (Vec3d& corner : corners) corner *= scale;
        CHECK_EQUAL(with(corners), "");
    }
}

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

TEST(validate_settings_and_rest) {
    checkError(errorsAfter([](SceneDesc& d) { d.settings.width = d.settings.height = 60000; }),
               "more than 2^28 pixels");
    checkError(errorsAfter([](SceneDesc& d) {
                   d.settings.crop = {0, 0, 961, 10};
               }),
               "'crop' ends at 961 10, outside");
    checkError(errorsAfter([](SceneDesc& d) {
                   d.settings.crop = {5, 0, 5, 10};
               }),
               "'crop' is empty");
    checkError(errorsAfter([](SceneDesc& d) { d.cameras.clear(); }),
               "s.json: error: the scene has no camera");
    checkError(errorsAfter([](SceneDesc& d) { d.textures.emplace_back().name = "t"; }),
               "texture 't': has no 'file'");
    checkError(errorsAfter([](SceneDesc& d) { d.textures.emplace_back().file = "a\nb"; }),
               "its 'file' is not UTF-8");
    checkError(errorsAfter([](SceneDesc& d) { d.lights[0].kind = LightDesc::Kind::Sphere; }),
               "needs a 'radius' > 0");
    checkError(errorsAfter([](SceneDesc& d) {
                   d.objects[1].kind = ObjectDesc::Kind::Cone;
                   d.objects[1].radius = 0;
               }),
               "'radius' and 'top_radius' are both 0");
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
    checkError(warningsAfter(darken), "s.json: warning: " + dark + "the picture will be black");
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
