#include "render/texture_files.h"

#include "base/text.h"

#include <algorithm>
#include <filesystem>
#include <vector>

namespace {

namespace fs = std::filesystem;

std::vector<fs::path> candidates(const std::string& file, const SourceFile& source,
                                 const std::string& textureFolder) {
    const fs::path written(file);
    if (written.is_absolute()) return {written};
    std::vector<fs::path> folders{fs::path(source.name).parent_path()};
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

} // namespace

StoredImage loadPicture(const TextureDesc& texture, const SourceFile& source,
                        const std::string& textureFolder) {
    std::vector<std::string> tried;
    for (const fs::path& path : candidates(texture.file, source, textureFolder)) {
        tried.push_back(path.string());
        std::error_code ignored;
        if (!fs::is_regular_file(path, ignored)) continue;
        try {
            return readStoredImage(path.string());
        } catch (const Error& error) {
            failAt(source, texture.fileLoc.offset,
                   cat("texture '", texture.name, "' can't be read: ", error.what()));
        }
    }
    failAt(source, texture.fileLoc.offset,
           cat("texture '", texture.name, "': no file '", texture.file, "'; looked for ",
               join(tried), "; put it there or name its folder with --textures"));
}
