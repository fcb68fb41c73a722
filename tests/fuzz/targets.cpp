#include "fuzz/targets.h"

#include "fuzz/png_parts.h"
#include "fuzz/sound.h"
#include "read/json/read_json.h"
#include "read/mesh/mesh_file.h"
#include "read/mesh/read_mtl.h"
#include "read/nff/read_nff.h"
#include "read/txt/read_txt.h"

#include <algorithm>
#include <array>
#include <string>

namespace fuzz {

namespace {

constexpr std::string_view kName = "input"; // what messages call the file

SourceFile sourceOf(Bytes file) {
    return {std::string(kName), std::string(file.begin(), file.end())};
}

void readNative(Bytes file) {
    const SourceFile source = sourceOf(file);
    checkScene(readTxt(source), source);
}

// load() brings what meshes have in files of their own; here a triangle stands for it.
void bringMeshes(SceneDesc& desc) {
    for (MeshDesc& mesh : desc.meshes) {
        if (mesh.file.empty()) continue;
        expect(mesh.points.empty() && mesh.triangles.empty(), "a mesh with a file and triangles");
        mesh.file.clear();
        mesh.smoothAngleDeg = MeshDesc{}.smoothAngleDeg;
        mesh.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
        mesh.triangles = {{0, 1, 2}};
    }
}

// Formats of others: what they say differently is settled in the reader.
template <SceneDesc (*read)(const SourceFile&, const ReadContext&)>
void checkForeign(Bytes file, const ReadOptions& options = {}) {
    const SourceFile source = sourceOf(file);
    Diagnostics diagnostics;
    SceneDesc desc = read(source, {options, diagnostics});
    checkWarnings(diagnostics, kName);
    bringMeshes(desc);
    checkScene(desc, source);
}
void readCourse(Bytes file) {
    for (const bool lenient : {false, true}) checkForeign<readJson>(file, {.lenient = lenient});
}
void readDatabase(Bytes file) { checkForeign<readNff>(file); }

// What `raytracer bunny.obj` makes of the triangles.
void checkSceneAround(MeshFile file, std::span<const MtlFile> libraries, const SourceFile& source) {
    Diagnostics diagnostics;
    const SceneDesc desc = sceneAround(std::move(file), libraries, source, {{}, diagnostics});
    checkWarnings(diagnostics, kName);
    checkScene(desc, source);
}

template <MeshFile (*read)(const SourceFile&, const ReadContext&)> void checkTriangles(Bytes file) {
    const SourceFile source = sourceOf(file);
    Diagnostics diagnostics;
    MeshFile mesh = read(source, {{}, diagnostics});
    checkWarnings(diagnostics, kName);
    checkMesh(mesh, source);
    checkSceneAround(std::move(mesh), {}, source);
}

// A triangle with each material of the library.
void readMaterials(Bytes file) {
    const SourceFile source = sourceOf(file);
    Diagnostics diagnostics;
    const MtlFile library = readMtl(source, {{}, diagnostics});
    checkWarnings(diagnostics, kName);
    MeshFile mesh;
    mesh.mesh.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    mesh.libraries = {{"library.mtl", {}}};
    for (const MaterialDesc& material : library.materials) {
        mesh.mesh.triangleMaterials.push_back(static_cast<std::uint32_t>(mesh.materials.size()));
        mesh.mesh.triangles.push_back({0, 1, 2});
        mesh.materials.push_back(material.name);
        mesh.materialLocs.push_back({0});
    }
    if (library.materials.empty()) return;
    try {
        checkSceneAround(std::move(mesh), {&library, 1}, source);
    } catch (const Error& error) { // too late: it names no line of the library
        throw Unsound(error.what());
    }
}

void readPicture(Bytes file) { checkPicture(decodeImage(file, std::string(kName))); }
void readPng(Bytes file) { readPicture(withRightChecksums(file)); }
void readPngRows(Bytes file) { readPicture(withPackedRows(file)); }

constexpr auto kTargets = std::to_array<Target>({
    {"txt", readNative},
    {"json", readCourse},
    {"nff", readDatabase},
    {"obj", checkTriangles<readObj>},
    {"mtl", readMaterials},
    {"ply", checkTriangles<readPly>},
    {"ppm", readPicture},
    {"pfm", readPicture},
    {"jpeg", readPicture},
    {"exr", readPicture},
    {"hdr", readPicture},
    {"tga", readPicture},
    {"png", readPng},
    {"png_rows", readPngRows},
});

} // namespace

std::span<const Target> targets() { return kTargets; }

const Target* findTarget(std::string_view name) {
    const auto found = std::find_if(kTargets.begin(), kTargets.end(),
                                    [&](const Target& target) { return target.name == name; });
    return found == kTargets.end() ? nullptr : &*found;
}

Outcome run(const Target& target, Bytes file) {
    try {
        target.read(file);
        return Outcome::Read;
    } catch (const Error& error) {
        checkError(error, kName);
        return Outcome::Refused;
    }
}

} // namespace fuzz
