#include "read/load.h"

#include "base/file_text.h"
#include "base/for_each.h"
#include "base/text.h"
#include "desc/names.h"
#include "read/mesh/mesh_file.h"
#include "read/mesh/mesh_steps.h"
#include "read/mesh/read_mtl.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <iterator>
#include <optional>
#include <utility>

namespace {

namespace fs = std::filesystem;

struct MeshFormat {
    std::string_view extension; // lower case
    MeshFile (*read)(const SourceFile&, const ReadContext&);
};
constexpr auto kMeshFormats = std::to_array<MeshFormat>({
    {".obj", readObj},
    {".ply", readPly},
});

const MeshFormat* meshFormatOf(const std::string& fileName) {
    const std::string extension = lowerExtension(fileName);
    const auto found =
        std::find_if(kMeshFormats.begin(), kMeshFormats.end(),
                     [&](const MeshFormat& format) { return format.extension == extension; });
    return found == kMeshFormats.end() ? nullptr : &*found;
}

// The places where a file may be that a scene names.
std::vector<std::string> candidates(const std::string& file, const SourceFile& scene) {
    const fs::path written(file), folder = fs::path(scene.name).parent_path();
    std::vector<std::string> out;
    const auto add = [&](const fs::path& place) {
        std::string path = place.lexically_normal().string();
        if (std::find(out.begin(), out.end(), path) == out.end()) out.push_back(std::move(path));
    };
    if (written.is_absolute())
        add(written);
    else
        for (const fs::path& start : {folder, fs::path(), folder / ".."}) add(start / written);
    // Files that came together often lie together, whatever path they were written with.
    add(folder / written.filename());
    return out;
}

std::string withSlashes(std::string path) {
    std::replace(path.begin(), path.end(), '\\', '/'); // written on Windows
    return path;
}

// Where a named file is, nothing when there is none.
std::optional<std::string> placeOf(const std::string& file, const SourceFile& scene) {
    if (file.find('\0') != std::string::npos) return {}; // the system would see a shorter name
    for (std::string& path : candidates(withSlashes(file), scene)) {
        std::error_code ignored;
        if (fs::is_regular_file(path, ignored)) return std::move(path);
    }
    return {};
}

std::string notFound(const std::string& file, const SourceFile& scene) {
    return cat("no file '", shown(file), "'; looked for ",
               join(candidates(withSlashes(file), scene)));
}

SourceFile open(const std::string& path, const SourceFile& scene, SourceLoc loc,
                const ReadContext& context, int threads) {
    std::error_code ignored;
    if (fs::file_size(path, ignored) >= SourceLoc::kUnknown)
        failAt(scene, loc.offset, cat("the file '", path, "' is larger than 4 GiB"));
    context.diagnostics.filesRead.push_back(path);
    return {path, readWholeText(path, threads)};
}

void loadMesh(MeshDesc& mesh, const SourceFile& scene, const ReadContext& context) {
    const MeshFormat* format = meshFormatOf(mesh.file);
    if (!format)
        failAt(scene, mesh.fileLoc.offset,
               cat("unknown mesh format ",
                   unknownName(fs::path(mesh.file).extension().string(), meshFileExtensions())));
    const auto path = placeOf(mesh.file, scene);
    if (!path) failAt(scene, mesh.fileLoc.offset, notFound(mesh.file, scene));
    MeshDesc loaded =
        format->read(open(*path, scene, mesh.fileLoc, context, context.options.threads), context)
            .mesh;
    if (mesh.smoothAngleDeg == 0) {
        loaded.normals.clear();
        loaded.normalTriangles.clear();
    }
    if (mesh.smoothAngleDeg > 0)
        smoothByAngle(loaded, mesh.smoothAngleDeg, context.options.threads);
    loaded.name = std::move(mesh.name);
    loaded.loc = mesh.loc;
    mesh = std::move(loaded);
}

// A library's textures lie beside it. Meshes often come without their library: a picture in grey is
// better than none.
MtlFile readLibrary(const MeshFile::Library& library, const SourceFile& source,
                    const ReadContext& context) {
    const auto path = placeOf(library.file, source);
    if (!path) {
        context.warn(source, library.loc.offset, notFound(library.file, source));
        return {};
    }
    MtlFile file = readMtl(open(*path, source, library.loc, context, 1), context);
    const fs::path folder = fs::absolute(*path).parent_path();
    const fs::path sceneFolder = fs::absolute(source.name).parent_path();
    for (TextureDesc& texture : file.textures)
        texture.file = (folder / texture.file).lexically_relative(sceneFolder).string();
    return file;
}

} // namespace

std::vector<std::string> meshFileExtensions() {
    std::vector<std::string> extensions;
    for (const MeshFormat& format : kMeshFormats) extensions.emplace_back(format.extension);
    return extensions;
}

void loadMeshFiles(SceneDesc& desc, const SourceFile& scene, const ReadContext& context) {
    std::vector<MeshDesc*> named;
    for (MeshDesc& mesh : desc.meshes)
        if (!mesh.file.empty()) named.push_back(&mesh);
    // One large file may use the threads itself.
    ReadOptions options = context.options;
    if (named.size() > 1) options.threads = 1;
    // Each file has its own warnings; they come out in the order of the scene.
    std::vector<Diagnostics> diagnostics(named.size());
    forEachOn(context.options.threads, named.size(), [&](std::size_t i) {
        const ReadContext own{options, diagnostics[i]};
        if (!options.lenient) return loadMesh(*named[i], scene, own);
        try {
            loadMesh(*named[i], scene, own);
        } catch (const Error& error) {
            own.diagnostics.warnings.push_back(asWarning(error.what(), "it is left out"));
            named[i]->file.clear();
        }
    });
    const auto move = [](std::vector<std::string>& from, std::vector<std::string>& to) {
        std::move(from.begin(), from.end(), std::back_inserter(to));
    };
    for (Diagnostics& one : diagnostics) {
        move(one.warnings, context.diagnostics.warnings);
        move(one.filesRead, context.diagnostics.filesRead);
    }
}

SceneDesc readMeshScene(const SourceFile& source, const ReadContext& context) {
    MeshFile file = meshFormatOf(source.name)->read(source, context);
    std::vector<MtlFile> libraries;
    for (const MeshFile::Library& library : file.libraries)
        libraries.push_back(readLibrary(library, source, context));
    return sceneAround(std::move(file), libraries, source, context);
}
