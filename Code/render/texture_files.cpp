#include "render/texture_files.h"

#include "base/text.h"

#include <algorithm>
#include <filesystem>
#include <vector>

namespace {

namespace fs = std::filesystem;

std::vector<fs::path> candidates(const std::string& file, const std::string& sceneFile,
                                 const std::string& textureFolder) {
    const fs::path written(file);
    if (written.is_absolute()) return {written};
    std::vector<fs::path> folders{fs::path(sceneFile).parent_path()};
    if (!textureFolder.empty()) folders.emplace_back(textureFolder);
    folders.emplace_back("Textures");
    std::vector<fs::path> out;
    for (const fs::path& folder : folders)
        for (const fs::path& name : {written, written.filename()}) {
            const fs::path path = (folder / name).lexically_normal();
            if (std::find(out.begin(), out.end(), path) == out.end()) out.push_back(path);
        }
    return out;
}

// The first of the candidates that is a file; into `tried` goes what was looked for.
std::optional<std::string> firstFile(const std::string& file, const std::string& sceneFile,
                                     const std::string& textureFolder,
                                     std::vector<std::string>& tried) {
    for (const fs::path& path : candidates(file, sceneFile, textureFolder)) {
        std::error_code ignored;
        if (fs::is_regular_file(path, ignored)) return path.string();
        tried.push_back(path.string());
    }
    return {};
}

} // namespace

std::vector<std::size_t> usedTextures(const SceneDesc& desc, bool showsEnvironment) {
    std::vector<std::size_t> used;
    if (desc.textures.empty()) return used;
    const auto use = [&](Handle handle) {
        const auto i = static_cast<std::size_t>(handle);
        if (handle != kNone && i < desc.textures.size() &&
            std::find(used.begin(), used.end(), i) == used.end())
            used.push_back(i);
    };
    for (const MaterialDesc& m : desc.materials) {
        for (const Handle handle : {m.diffuseTexture, m.specularTexture, m.emissionTexture,
                                    m.opacityTexture, m.normalMap, m.bumpMap})
            use(handle);
        for (const LobeDesc& lobe : m.lobes)
            for (const LobeDesc::Factor& factor : lobe.factors) use(factor.texture);
    }
    if (showsEnvironment) use(desc.world.environment);
    return used;
}

std::optional<std::string> findPicture(const std::string& file, const std::string& sceneFile,
                                       const std::string& textureFolder) {
    std::vector<std::string> tried;
    return firstFile(file, sceneFile, textureFolder, tried);
}

std::optional<StoredImage> findAndRead(const TextureDesc& texture, const std::string& sceneFile,
                                       const std::string& textureFolder, std::string& fault) {
    std::vector<std::string> tried;
    const auto path = firstFile(texture.file, sceneFile, textureFolder, tried);
    if (!path) {
        fault = cat("texture '", texture.name, "': no file '", texture.file, "'; looked for ",
                    join(tried), "; put it there or name its folder with --textures");
        return {};
    }
    try {
        return readStoredImage(*path);
    } catch (const Error& error) {
        fault = cat("texture '", texture.name, "' can't be read: ", error.what());
        return {};
    }
}

StoredImage loadPicture(const TextureDesc& texture, const SourceFile& source,
                        const std::string& textureFolder) {
    std::string fault;
    auto image = findAndRead(texture, source.name, textureFolder, fault);
    if (!image) failAt(source, texture.fileLoc.offset, fault);
    return std::move(*image);
}
