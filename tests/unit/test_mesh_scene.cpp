// The scene around a file of triangles: its objects, materials, camera and light.
#include "read/mesh/mesh_file.h"

#include "base/bounds.h"
#include "base/math.h"
#include "base/text.h"
#include "base/transform.h"
#include "check.h"
#include "desc/validate.h"
#include "desc/write_txt.h"
#include "unit/damage.h"

#include <chrono>
#include <random>

namespace test_mesh_scene {

namespace {

using damage::contentOf;

using Corners = MeshDesc::Corners;

struct Result {
    SceneDesc scene;
    MeshFile file;
    std::vector<std::string> warnings;
};
// OBJ text with MTL texts; the scene must be a right one.
Result sceneOf(const std::string& obj, const std::vector<std::string>& libraries = {}) {
    Diagnostics readingObj, readingMtl, diagnostics;
    const SourceFile source{"some/thing.obj", obj};
    Result result;
    result.file = readObj(source, {{}, readingObj});
    std::vector<MtlFile> read;
    for (const std::string& text : libraries)
        read.push_back(readMtl({"t.mtl", text}, {{}, readingMtl}));
    result.scene = sceneAround(result.file, read, source, {{}, diagnostics});
    result.warnings = diagnostics.warnings;
    validate(result.scene, source, diagnostics);
    CHECK_INFO(diagnostics.warnings.size() == result.warnings.size(), join(diagnostics.warnings));
    return result;
}
const std::string kSquare = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

// Positions, uvs and normals of all corners, in the order of the triangles.
struct Soup {
    std::vector<Vec3d> points;
    std::vector<Vec2> uvs;
    std::vector<Vec3> normals;
    bool operator==(const Soup&) const = default;
    void add(const MeshDesc& mesh) {
        const auto addAll = [](auto& to, const auto& values, std::span<const Corners> corners) {
            for (const Corners& c : corners)
                for (const std::uint32_t i : c) to.push_back(values.at(i));
        };
        addAll(points, mesh.points, mesh.triangles);
        addAll(uvs, mesh.uvs, mesh.uvTriangles);
        addAll(normals, mesh.normals, mesh.normalTriangles);
    }
};

} // namespace

TEST(mesh_scene_room) {
    const std::string text = contentOf("tests/scenes/obj/room.obj");
    const Result result = sceneOf(text, {contentOf("tests/scenes/obj/room.mtl"), "", ""});
    const SceneDesc& scene = result.scene;
    CHECK(result.warnings.empty());
    CHECK_EQUAL(scene.objects.size(), std::size_t{3});
    CHECK_EQUAL(scene.meshes.size(), std::size_t{3});
    CHECK_EQUAL(scene.objects[0].name, "house.front");
    CHECK_EQUAL(scene.meshes[2].name, "tree");
    CHECK_EQUAL(text.substr(scene.objects[2].loc.offset, 6), "o tree");
    // Only what is used, in the order of use; slots count within each object.
    CHECK_EQUAL(scene.materials.size(), std::size_t{2});
    CHECK_EQUAL(scene.materials[0].name, "red brick");
    CHECK_EQUAL(text.substr(scene.materials[1].loc.offset, 12), "usemtl glass");
    CHECK_EQUAL(scene.textures.size(), std::size_t{2});
    CHECK_EQUAL(text.substr(scene.textures[0].fileLoc.offset, 8), "room.mtl");
    CHECK((scene.objects[0].materials == std::vector<Handle>{0}));
    CHECK((scene.objects[1].materials == std::vector<Handle>{1}));
    CHECK((scene.objects[2].materials == std::vector<Handle>{1, 0}));
    CHECK(scene.meshes[0].triangleMaterials.empty() && scene.meshes[1].triangleMaterials.empty());
    CHECK((scene.meshes[2].triangleMaterials == std::vector<std::uint32_t>{0, 1}));
    // Each mesh has the points that it uses.
    CHECK(
        (scene.meshes[0].points == std::vector<Vec3d>{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}));
    CHECK((scene.meshes[2].triangles == std::vector<Corners>{{0, 1, 2}, {2, 1, 0}}));
    Soup whole, parts;
    whole.add(result.file.mesh);
    for (const MeshDesc& mesh : scene.meshes) parts.add(mesh);
    CHECK(whole == parts);
}

TEST(mesh_scene_one_part_keeps_its_arrays) {
    for (const std::string name : {"", "g some\n"}) {
        const Result result = sceneOf("v 5 5 5\n" + kSquare + name + "f 4 3 2\nf 2 5 4\n");
        const MeshDesc& mesh = result.scene.meshes.at(0);
        CHECK_EQUAL(mesh.name, name.empty() ? "thing" : "some");
        CHECK(mesh.points == result.file.mesh.points &&
              mesh.triangles == result.file.mesh.triangles);
        CHECK(result.scene.materials.empty() && result.scene.objects.at(0).materials.empty());
    }
}

TEST(mesh_scene_materials) {
    const std::string faces = "f 1 2 3\nusemtl a\nf 1 2 3\nusemtl b\nf 1 2 3\nusemtl c\nf 1 2 3\n";
    // The first library that has a name wins; what comes before any name is grey without a warning.
    const Result result =
        sceneOf(kSquare + "mtllib x.mtl y.mtl\n" + faces,
                {"newmtl a\nKd 1 0 0\nmap_Kd p.ppm\nnewmtl c\nKe 3 2 1\n",
                 "newmtl a\nKd 0 1 0\nnewmtl b\nKd 0 0 1\nmap_Kd p.ppm\nnewmtl b\nKd 1 1 1\n"});
    CHECK(result.warnings.empty());
    const auto& materials = result.scene.materials;
    CHECK_EQUAL(materials.size(), std::size_t{4});
    CHECK_EQUAL(materials[0].name, "default");
    CHECK((materials[0].diffuse == Rgbd{0.8, 0.8, 0.8}));
    CHECK((materials[1].diffuse == Rgbd{1, 0, 0} && materials[2].diffuse == Rgbd{0, 0, 1}));
    CHECK((materials[3].emission == Rgbd{3, 2, 1}));
    // Textures of two libraries may have one name, but not in a scene.
    CHECK_EQUAL(result.scene.textures.size(), std::size_t{2});
    CHECK_EQUAL(materials[2].diffuseTexture, 1);
    CHECK_EQUAL(result.scene.textures[1].name, "p.ppm.2");
    CHECK_EQUAL(result.scene.textures[1].file, "p.ppm");
    // Unknown ones: one warning, at the first.
    const Result unknown = sceneOf(kSquare + faces, {"newmtl b\n"});
    CHECK_EQUAL(unknown.warnings.size(), std::size_t{1});
    CHECK(unknown.warnings[0].find("some/thing.obj:6:1: warning: unknown materials 'a', 'c'; they "
                                   "are grey") == 0);
    CHECK((unknown.scene.materials[1].diffuse == Rgbd{0.8, 0.8, 0.8}));
    CHECK_EQUAL(unknown.scene.materials[1].name, "a");
}

// Whoever has no name is called as the file, without its extension unless that is all there is.
TEST(mesh_scene_things_without_name_have_that_of_the_file) {
    const std::string obj = kSquare + "f 1 2 3\n";
    for (const auto& [file, name] : {std::pair("some/thing.obj", "thing"),
                                     {"b.c.obj", "b.c"},
                                     {"x\\y.obj", "y"},
                                     {"some/.obj", ".obj"}}) {
        Diagnostics diagnostics;
        const SourceFile source{file, obj};
        const SceneDesc scene =
            sceneAround(readObj(source, {{}, diagnostics}), {}, source, {{}, diagnostics});
        CHECK_EQUAL(scene.meshes.at(0).name, name);
    }
}

TEST(mesh_scene_names_are_right_and_unique) {
    const Result result =
        sceneOf(kSquare + "o w\nf 1 2 3\no x\nf 1 2 3\no w\nf 1 2 3\no w 2\nf 1 2 3\no w\nf 1 2 3\n"
                          "o caf\xe9\nusemtl \xe9\nf 1 2 3\nusemtl \xe8\nf 1 2 3\n");
    std::string names;
    for (const ObjectDesc& object : result.scene.objects) names += object.name + ", ";
    CHECK_EQUAL(names, "w, x, w.2, w 2, w.3, caf_, ");
    CHECK_EQUAL(result.scene.materials.at(2).name, "_.2");
}

// Random parts put together again are the whole.
TEST(mesh_scene_splits_random_meshes) {
    for (std::uint32_t seed = 0; seed < check::scaled(50u); ++seed) {
        std::mt19937 random(seed);
        std::string text;
        for (int i = 0; i < 30; ++i)
            text += cat("v ", random() % 97, " ", random() % 97, " ", random() % 97, "\nvt ",
                        random() % 7, " 0\nvn 0 0 ", 1 + random() % 7, "\n");
        for (int i = 0; i < 60; ++i) {
            if (random() % 5 == 0) text += cat("g part", random() % 6, "\n");
            if (random() % 4 == 0) text += cat("usemtl m", random() % 6, "\n");
            text += "f";
            for (int k = 0; k < 3; ++k)
                text += cat(" ", 1 + random() % 30, "/", 1 + random() % 30, "/", 1 + random() % 30);
            text += "\n";
        }
        const Result result = sceneOf(text);
        Soup whole, parts;
        std::vector<std::string> wholeMaterials, partMaterials;
        whole.add(result.file.mesh);
        for (std::size_t i = 0; i < result.file.mesh.triangles.size(); ++i) {
            const std::string& name =
                result.file.materials.at(result.file.mesh.triangleMaterials.at(i));
            wholeMaterials.push_back(name.empty() ? "default" : name);
        }
        for (const ObjectDesc& object : result.scene.objects) {
            const MeshDesc& mesh = result.scene.meshes.at(static_cast<std::size_t>(object.mesh));
            parts.add(mesh);
            for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
                const std::uint32_t slot =
                    mesh.triangleMaterials.empty() ? 0 : mesh.triangleMaterials[i];
                partMaterials.push_back(
                    result.scene.materials.at(static_cast<std::size_t>(object.materials.at(slot)))
                        .name);
            }
        }
        CHECK_INFO(whole == parts && wholeMaterials == partMaterials, "seed " << seed);
    }
}

// All points are in the picture, and those farthest out are near its edge.
TEST(mesh_scene_camera_sees_all) {
    for (std::uint32_t seed = 0; seed < check::scaled(50u); ++seed) {
        std::mt19937 random(seed);
        const double size = std::pow(10.0, static_cast<double>(random() % 41) - 20);
        std::string text;
        // On a ball, so that its outline is known.
        for (int i = 0; i < 300; ++i) {
            const auto number = [&] { return static_cast<double>(random()) / 2147483648.0 - 1; };
            const Vec3d p = normalize(Vec3d{number(), number(), number()}) * size;
            text +=
                cat("v ", shortest(p.x + 3 * size), " ", shortest(p.y), " ", shortest(p.z), "\n");
        }
        for (int i = 1; i <= 100; ++i) text += cat("f ", i, " ", i + 100, " ", i + 200, "\n");
        const Result result = sceneOf(text);
        const CameraDesc& camera = result.scene.cameras.at(0);
        const Transform worldFromCamera = Transform::fromRows(camera.worldFromCamera.at(0));
        const Transform cameraFromWorld = worldFromCamera.inverse();
        const double aspect = 960.0 / 540, tangent = camera.sensorWidthMm / 2 / camera.lensMm;
        double farthest = 0;
        for (const Vec3d& p : result.scene.meshes.at(0).points) {
            const Vec3d seen = cameraFromWorld.point(p);
            CHECK_INFO(seen.z < 0, "seed " << seed);
            farthest = std::fmax(farthest, std::fabs(seen.y / seen.z) / (tangent / aspect));
        }
        CHECK_INFO(farthest > 0.85 && farthest < 1, "seed " << seed << ": " << farthest);
        // From the front, the right and above; upright.
        const Vec3d back = worldFromCamera.vector({0, 0, 1});
        CHECK_NEAR(length(back - normalize(Vec3d{0.6, 0.45, 1})), 0, 1e-9);
        CHECK_NEAR(worldFromCamera.vector({1, 0, 0}).y, 0, 1e-12);
        CHECK(worldFromCamera.vector({0, 1, 0}).y > 0.8);
    }
}

// White of any direction stays below 1, and what the camera sees from the front is not dark.
TEST(mesh_scene_exposure) {
    const SceneDesc scene = sceneOf(kSquare + "f 1 2 3 4").scene;
    CHECK_EQUAL(scene.lights.size(), std::size_t{2});
    const auto radiance = [&](Vec3d normal) {
        double sum = scene.world.ambient.r;
        for (const LightDesc& light : scene.lights) {
            const Vec3d toLight = Transform::fromRows(light.worldFromLight).vector({0, 0, 1});
            sum += light.color.r / kPi * std::fmax(0, dot(normalize(toLight), normal));
        }
        return sum;
    };
    double brightest = 0;
    std::mt19937 random(1);
    for (int i = 0; i < 20000; ++i) {
        const auto number = [&] { return static_cast<double>(random()) / 2147483648.0 - 1; };
        brightest = std::fmax(brightest, radiance(normalize(Vec3d{number(), number(), number()})));
    }
    CHECK_INFO(brightest > 0.8 && brightest < 1, brightest);
    const double front = radiance(normalize(Vec3d{0.6, 0.45, 1}));
    CHECK_INFO(front > 0.5, front);
    CHECK(scene.world.background.r > 0.3 && scene.world.background.r < 1);
}

// Splitting takes no time for each part beyond its own triangles.
TEST(mesh_scene_many_parts) {
    const auto textOf = [](int parts) {
        std::string text = kSquare;
        for (int i = 0; i < 20000; ++i) text += cat("v ", i, " 0 5\n");
        for (int i = 0; i < parts; ++i)
            text += cat(i % 2 ? "g a\nusemtl x\n" : "g b\nusemtl y\n", "f 1 2 3\n");
        return text + "f 1 5 20004\n";
    };
    const auto start = std::chrono::steady_clock::now();
    const Result many = sceneOf(textOf(20000));
    const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
    CHECK_EQUAL(many.scene.objects.size(), std::size_t{20000});
    CHECK_EQUAL(many.scene.objects[19998].name, "b.10000");
    CHECK_INFO(seconds.count() < 10, seconds.count()); // 0.05 s measured
    // More than anyone wants to have apart are one.
    const Result more = sceneOf(textOf(70000));
    CHECK_EQUAL(more.scene.objects.size(), std::size_t{1});
    CHECK(!more.warnings.empty() &&
          more.warnings[0].find("70000 objects and groups, more than 65536") != std::string::npos);
}

} // namespace test_mesh_scene
