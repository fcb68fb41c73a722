#include "read/load.h"

#include "base/file_text.h"
#include "base/text.h"
#include "desc/validate.h"
#include "read/json/read_json.h"
#include "read/nff/read_nff.h"
#include "read/txt/read_txt.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <filesystem>
#include <string_view>
#include <vector>

namespace {

namespace fs = std::filesystem;

struct Format {
    std::string_view extension; // lower case
    SceneDesc (*read)(const SourceFile&, const ReadContext&);
    bool isMesh = false;
};
constexpr auto kFormats = std::to_array<Format>({
    {".txt", [](const SourceFile& source,
                const ReadContext& context) { return readTxt(source, context.options.threads); }},
    {".json", readJson},
    {".nff", readNff},
    {".obj", readMeshScene, true},
    {".ply", readMeshScene, true},
});

std::vector<std::string> extensions() {
    std::vector<std::string> out;
    for (const Format& format : kFormats) out.emplace_back(format.extension);
    return out;
}

// Files that hold scenes or pictures of other kinds, and the way from there.
struct Foreign {
    std::string_view extensions, kind; // each extension with a space behind it
    std::string_view way;
};
constexpr std::string_view kByBlender =
    "convert it to .obj or .ply, or import it into Blender and export it with Blend/Export.py";
constexpr Foreign kForeign[] = {
    {".blend .blend1 ", "a Blender file",
     "export it: blender -b FILE.blend --python-exit-code 3 -P Blend/Export.py -- -o FILE.txt"},
    {".stl .off .3mf .3ds .lwo .ctm ", "a mesh of a kind that is not read", kByBlender},
    {".gltf .glb ", "a glTF scene", kByBlender},
    {".fbx .dae .abc .x3d .wrl .usd .usda .usdc .usdz .c4d .max .ma .mb ",
     "a scene of another program", kByBlender},
    {".pov .inc .pbrt .xml .rib .ass .vrscene .mi ", "a scene of another renderer",
     "write it as native text (ASCII/README.md), or export it from Blender"},
    {".mtl ", "a material library", "name the .obj file that uses it"},
    {".png .ppm .pgm .pfm .jpg .jpeg .exr .hdr .tga .bmp .tif .tiff .gif .webp ", "a picture",
     "name the scene first and the picture that it is rendered to behind it"},
    {".zip .gz .tgz .7z .rar ", "an archive", "unpack it first"},
};

const Format& formatOf(const std::string& fileName) {
    const std::string extension = lowerExtension(fileName);
    for (const Format& format : kFormats)
        if (format.extension == extension) return format;
    if (extension.empty())
        fail(ErrorKind::Input, cat(fileName,
                                   ": error: the name has no extension, which tells the "
                                   "format of a scene; known: ",
                                   join(extensions())));
    for (const Foreign& foreign : kForeign)
        if (foreign.extensions.find(extension + " ") != std::string_view::npos)
            fail(ErrorKind::Input,
                 cat(fileName, ": error: this is ", foreign.kind, "; ", foreign.way));
    fail(ErrorKind::Input,
         cat(fileName, ": error: unknown scene format ", unknownName(extension, extensions())));
}

// The files beside a missing one that could be meant.
std::vector<std::string> sceneNamesIn(const fs::path& folder) {
    constexpr std::size_t kEnough = 1000;
    std::vector<std::string> names;
    std::error_code ignored;
    fs::directory_iterator entry(folder.empty() ? fs::path(".") : folder, ignored);
    for (; entry != fs::directory_iterator() && names.size() < kEnough; entry.increment(ignored)) {
        const std::string extension = entry->path().extension().string();
        for (const Format& format : kFormats)
            if (extension == format.extension)
                names.push_back((folder / entry->path().filename()).string());
        if (ignored) break;
    }
    std::sort(names.begin(), names.end());
    return names;
}

constexpr std::string_view kMeshBlock = "\nmesh "; // begins one in native text

std::string readStdin() {
    std::string text;
    char part[1 << 16];
    while (const std::size_t count = std::fread(part, 1, sizeof part, stdin)) {
        text.append(part, count);
        if (text.size() >= SourceLoc::kUnknown) break; // the reader says so
    }
    return text;
}

// A missing file or a folder is a better message than a wrong extension: this comes first.
void checkFile(const std::string& fileName) {
    std::error_code status;
    if (!fs::exists(fileName, status)) {
        const auto near = nearestWord(fileName, sceneNamesIn(fs::path(fileName).parent_path()));
        fail(ErrorKind::Input, cat(fileName, ": error: cannot read: no such file",
                                   near ? cat("; did you mean '", *near, "'?") : ""));
    }
    if (fs::is_directory(fileName, status))
        fail(ErrorKind::Input,
             cat(fileName, ": error: cannot read: it is a folder; name a file in it"));
    if (fs::is_regular_file(fileName, status) &&
        fs::file_size(fileName, status) >= SourceLoc::kUnknown)
        fail(ErrorKind::Input, cat(fileName, ": error: the file is larger than 4 GiB"));
}

// What stands above the first mesh of a long text: exporters write textures and materials there.
void foreseeStart(const SourceFile& source, Foreseen foreseen) {
    constexpr std::size_t kLong = 1 << 20;
    if (source.text.size() < kLong) return;
    const std::string_view start = std::string_view(source.text).substr(0, kLong);
    const std::size_t end = start.find(kMeshBlock);
    if (end == std::string_view::npos) return;
    try {
        const SourceFile part{source.name, start.substr(0, end + 1)};
        foreseen(readTxt(part, 1), source.name);
    } catch (const Error&) {
        // Reading all of it tells.
    }
}

} // namespace

LoadedScene load(const std::string& fileName, Diagnostics& diagnostics, const ReadOptions& options,
                 Foreseen foreseen) {
    const ReadContext context{options, diagnostics};
    LoadedScene scene;
    bool isLenient = false;
    if (fileName == "-") {
        scene.source = {"<stdin>", readStdin()};
        scene.desc = readTxt(scene.source, options.threads);
    } else {
        checkFile(fileName);
        const Format& format = formatOf(fileName);
        diagnostics.filesRead.push_back(fileName);
        scene.source = {fileName, readWholeText(fileName, options.threads)};
        if (foreseen && format.extension == ".txt") foreseeStart(scene.source, foreseen);
        scene.desc = format.read(scene.source, context);
        isLenient = options.lenient && format.read == readJson;
        scene.picturesMayMiss = isLenient || format.isMesh;
    }
    if (foreseen) foreseen(scene.desc, scene.source.name);
    loadMeshFiles(scene.desc, scene.source, context);
    if (isLenient) leaveOutWrong(scene.desc, scene.source, context);
    validate(scene.desc, scene.source, diagnostics, options.threads);
    return scene;
}
