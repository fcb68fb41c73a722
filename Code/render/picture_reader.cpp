#include "render/picture_reader.h"

#include "base/parallel.h"
#include "render/texture_files.h"

#include <algorithm>
#include <exception>
#include <system_error>
#include <utility>

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
