// The rules that hold for every format, on scenes that no reader of text would pass on. The order
// of what is said, and warnings, are in test_validate_messages.cpp.
#include "desc/lobes.h"
#include "desc/properties.h"
#include "desc/validate.h"
#include "unit/validate_kit.h"

#include <limits>
#include <utility>

namespace test_validate {

using namespace validate_kit;

namespace {

using Corners4 = std::array<Vec3d, 4>;
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

// Every number of every property of the block, one at a time: NaN and what is out of range.
template <class Block> void checkNumbersOf(Block& block, const SceneDesc& desc) {
    for (const Property& property : propertiesOf(Block::kType)) {
        if (!(property.kinds & AnyBlock(block).kind)) continue;
        std::array<double, kMostNumbers> numbers;
        const std::size_t count = getNumbers(property, &block, numbers.data());
        CHECK_EQUAL(count, property.numberCount());
        for (std::size_t i = 0; i < count; ++i) {
            const auto check = [&](double bad, std::string_view words) {
                const double before = std::exchange(numbers[i], bad);
                setNumbers(property, &block, numbers.data());
                checkError(errorsOf(desc), cat("'", property.keyword, "' ", words));
                numbers[i] = before;
                setNumbers(property, &block, numbers.data());
            };
            const Range& range = property.range;
            if (!property.isWhole()) {
                check(kNan, "is not a finite number");
                check(-1.0 / 0.0, "is not a finite number");
                if (range.hi < kEndless) check(range.hi * 1.1, "must be ");
                check(range.aboveLo ? range.lo : range.lo - std::fabs(range.lo) - 1, "must be ");
            } else if (range.hi < kLargestUnsigned) {
                check(range.hi + 1, "must be from ");
                check(range.lo - 1, "must be from ");
            }
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
    for (const auto kind : kValuesOf<ObjectDesc::Kind>) {
        ObjectDesc& object = desc.objects.emplace_back();
        object.name = cat("o", nameOf(kind));
        object.kind = kind;
        if (kind == ObjectDesc::Kind::Mesh) object.mesh = 0;
    }
    for (const auto kind : kValuesOf<LightDesc::Kind>) {
        LightDesc& light = desc.lights.emplace_back();
        light.name = cat("l", nameOf(kind));
        light.kind = kind;
        light.radius = 1;
    }
    CHECK_EQUAL(errorsOf(desc), "");
    forEachBlock(desc, [&](auto& block) { checkNumbersOf(block, desc); });
}

// The same for lobes, whose numbers are in no table of properties.
TEST(validate_lobes) {
    const auto errors = [](const std::function<void(LobeDesc&)>& damage) {
        return errorsAfter([&](SceneDesc& d) {
            d.textures.emplace_back().name = "t";
            d.textures[0].file = "t.ppm";
            LobeDesc& lobe = d.materials[0].lobes.emplace_back();
            for (const LobeForm& form : lobeForms())
                if (form.name == "conductor") lobe = form.usual;
            damage(lobe);
        });
    };
    CHECK_EQUAL(errors([](LobeDesc&) {}), "");
    CHECK_EQUAL(errors([](LobeDesc& lobe) { lobe.factors = {{.field = 2, .texture = 0}}; }), "");
    for (const LobeForm& form : lobeForms())
        for (const LobeFieldForm& field : form.fields)
            for (std::size_t i = 0; i < field.count; ++i)
                for (const double bad : {field.range.lo - 1, 1.1 * field.range.hi + 1, kNan})
                    checkError(errors([&](LobeDesc& lobe) {
                                   lobe = form.usual;
                                   lobe.numbers[field.first + i] = bad;
                               }),
                               cat("material 'red': its lobe 1: '", field.name, "' "));
    checkError(errors([](LobeDesc& lobe) { lobe.weight.g = -1; }), "'weight' must be >= 0, got -1");
    checkError(errors([](LobeDesc& lobe) { lobe.kind = 100; }), "and none has the number 100");
    checkError(errors([](LobeDesc& lobe) { lobe.factors.emplace_back(); }),
               "a picture that multiplies a value is missing");
    checkError(errors([](LobeDesc& lobe) { lobe.factors = {{.texture = 1}}; }),
               "'lobe' refers to texture 1 of 1");
    checkError(errors([](LobeDesc& lobe) { lobe.factors = {{.field = 5, .texture = 0}}; }),
               "conductor has no field 5");
    checkError(errors([](LobeDesc& lobe) { lobe.factors = {{.texture = 0, .strength = 2}}; }),
               "'without' must be from 0 to 1, got 2");
    checkError(errorsAfter([](SceneDesc& d) { d.materials[0].lobes.resize(9); }),
               "material 'red': has 9 lobes; at most 8 are possible");
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

// Several threads look at the parts of a large mesh; what they say is of all of it.
TEST(validate_a_large_mesh) {
    SceneDesc sound = soundScene();
    MeshDesc& mesh = sound.meshes[0];
    for (std::uint32_t i = 3; i < 40000; ++i) {
        mesh.points.push_back({0.25 * i, -0.5 * i, 1});
        mesh.triangles.push_back({i - 2, i - 1, i});
    }
    for (const int threads : {1, 2, 5}) {
        const auto errorsAfter = [&](const std::function<void(MeshDesc&)>& damage) {
            SceneDesc desc = sound;
            damage(desc.meshes[0]);
            Diagnostics diagnostics;
            return check::thrown([&] { validate(desc, {"s.json", ""}, diagnostics, threads); });
        };
        CHECK(errorsAfter([](MeshDesc&) {}).empty());
        checkError(errorsAfter([](MeshDesc& m) { m.points[20000].z = m.points[39999].x = kNan; }),
                   "point 20000 is not finite");
        checkError(errorsAfter([](MeshDesc& m) { m.triangles.back()[1] = 40000; }),
                   "'triangles' uses 40000 of 'points', which has 40000");
        CHECK(boundsOf(mesh, threads) == (BoundsD{{0, -0.5 * 39999, 0}, {0.25 * 39999, 1, 1}}));
        CHECK(boundsOf(sound, threads).contains(boundsOf(mesh)));
    }
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

TEST(validate_settings_and_rest) {
    checkError(errorsAfter([](SceneDesc& d) { d.settings.width = d.settings.height = 60000; }),
               "more than 2^28 pixels");
    const auto sized = [](int height) {
        return errorsAfter([&](SceneDesc& d) {
            d.settings.width = 1 << 14;
            d.settings.height = height;
        });
    };
    CHECK_EQUAL(sized(1 << 14), "");
    checkError(sized((1 << 14) + 1), "more than 2^28 pixels");
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
    checkError(errorsAfter([](SceneDesc& d) {
                   d.objects[1].kind = ObjectDesc::Kind::Cone;
                   d.objects[1].radius = 0;
               }),
               "'radius' and 'top_radius' are both 0");
}

} // namespace test_validate
