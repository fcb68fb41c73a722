#include "scene/texture_files.h"

#include "base/parallel.h"
#include "base/text.h"

#include <algorithm>
#include <exception>
#include <filesystem>
#include <map>
#include <system_error>
#include <utility>
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

PictureBytes pictureBytes(const SceneDesc& desc, const std::vector<std::size_t>& used,
                          const std::string& sceneFile, const std::string& textureFolder) {
    std::map<std::string, bool> isShown;
    for (std::size_t i = 0; i < desc.textures.size(); ++i)
        if (const auto path = findPicture(desc.textures[i].file, sceneFile, textureFolder))
            isShown[*path] |= std::find(used.begin(), used.end(), i) != used.end();
    PictureBytes bytes;
    for (const auto& [path, shown] : isShown) {
        std::error_code unknown;
        const std::uintmax_t size = fs::file_size(path, unknown);
        if (!unknown) (shown ? bytes.shown : bytes.unshown) += size;
    }
    return bytes;
}

StoredImage loadPicture(const TextureDesc& texture, const SourceFile& source,
                        const std::string& textureFolder) {
    std::string fault;
    auto image = findAndRead(texture, source.name, textureFolder, fault);
    if (!image) failAt(source, texture.fileLoc.offset, fault);
    return std::move(*image);
}

namespace {

// Reading the rest keeps two threads busy: with a third one the whole became slower on two.
std::size_t spareThreads(int threads) {
    return static_cast<std::size_t>(std::max(0, (threads > 0 ? threads : hardwareThreads()) - 2));
}

} // namespace

PictureReader::PictureReader(std::string textureFolder, int threads)
    : textureFolder_(std::move(textureFolder)), mostThreads_(spareThreads(threads)) {}

PictureReader::~PictureReader() {
    beginNoMore();
    for (std::thread& thread : threads_) thread.join();
}

void PictureReader::begin(const SceneDesc& desc, const std::vector<std::size_t>& textures,
                          const std::string& sceneFile) {
    if (!hasThreads()) return;
    const std::lock_guard lock(mutex_);
    for (const std::size_t i : textures) {
        const TextureDesc& texture = desc.textures[i];
        const auto isIt = [&](const Picture& p) {
            return p.name == texture.name && p.file == texture.file;
        };
        if (std::none_of(pictures_.begin(), pictures_.end(), isIt))
            pictures_.push_back({texture.name, texture.file, sceneFile, {}, {}});
    }
    try {
        while (threads_.size() < std::min(mostThreads_, pictures_.size()))
            threads_.emplace_back([this] { work(); });
    } catch (const std::system_error&) {
        // The system gives no more threads: others read what these would have.
    }
    news_.notify_all();
}

void PictureReader::beginNoMore() {
    const std::lock_guard lock(mutex_);
    noMore_ = true;
    news_.notify_all();
}

std::optional<StoredImage> PictureReader::take(const TextureDesc& texture) {
    std::unique_lock lock(mutex_);
    const auto found =
        std::find_if(pictures_.begin(), pictures_.end(), [&](const Picture& picture) {
            return picture.name == texture.name && picture.file == texture.file;
        });
    if (found == pictures_.end()) return {};
    const auto i = static_cast<std::size_t>(found - pictures_.begin());
    news_.wait(lock, [&] { return pictures_[i].state != Picture::State::Reading; });
    pictures_[i].state = Picture::State::Taken;
    return std::exchange(pictures_[i].image, std::nullopt);
}

void PictureReader::work() {
    std::unique_lock lock(mutex_);
    for (;;) {
        news_.wait(lock, [this] { return noMore_ || next_ < pictures_.size(); });
        if (noMore_) return;
        const std::size_t i = next_++;
        if (pictures_[i].state != Picture::State::Waiting) continue;
        pictures_[i].state = Picture::State::Reading;
        const std::string file = pictures_[i].file, sceneFile = pictures_[i].sceneFile;
        lock.unlock();
        std::optional<StoredImage> image;
        try {
            if (const auto path = findPicture(file, sceneFile, textureFolder_))
                image = readStoredImage(*path);
        } catch (const std::exception&) {
            // Whoever uses the texture meets it again, and tells.
        }
        lock.lock();
        pictures_[i].image = std::move(image);
        pictures_[i].state = Picture::State::Done;
        news_.notify_all();
    }
}
