// Finds and reads the picture that a texture of a scene names.
#pragma once

#include "base/source.h"
#include "desc/scene_desc.h"
#include "image/image.h"

#include <condition_variable>
#include <cstdint>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

// The textures that materials, and the world if it shows its environment, use: in the order of
// their first use. Handles that are no texture's are left out.
std::vector<std::size_t> usedTextures(const SceneDesc& desc, bool showsEnvironment);

// Where the picture is that a texture of the scene in `sceneFile` names: see loadPicture().
std::optional<std::string> findPicture(const std::string& file, const std::string& sceneFile,
                                       const std::string& textureFolder);

// The sizes of the files of a scene's pictures, each counted once: those that it shows, and others.
struct PictureBytes {
    std::uint64_t shown = 0, unshown = 0;
};
PictureBytes pictureBytes(const SceneDesc& desc, const std::vector<std::size_t>& used,
                          const std::string& sceneFile, const std::string& textureFolder);

// Searched beside the scene file, in `textureFolder` (if not empty) and in Textures/, each with the
// path as written and then by the file's name alone. Fails at the texture's line in the scene file
// with the places that were tried, or with what is wrong with the picture.
StoredImage loadPicture(const TextureDesc& texture, const SourceFile& source,
                        const std::string& textureFolder);
// The same; nothing when it fails, with what is wrong in `fault`.
std::optional<StoredImage> findAndRead(const TextureDesc& texture, const std::string& sceneFile,
                                       const std::string& textureFolder, std::string& fault);

// PictureReader: reads the pictures that a scene uses on threads of its own, while the rest of the
// scene is still read and built. What it cannot read it leaves to loadPicture(), so that a mistake
// is told as if it had not been there.

class PictureReader {
public:
    // Reads ahead on two threads less than `threads` (0: than the machine has); not at all on one
    // or two.
    PictureReader(std::string textureFolder, int threads);
    // Waits for what is being read.
    ~PictureReader();
    PictureReader(const PictureReader&) = delete;
    PictureReader& operator=(const PictureReader&) = delete;

    bool hasThreads() const { return mostThreads_ > 0; }
    // Begins with these textures, of the scene in `sceneFile`, that it has not seen before. They
    // may be wrong in any way.
    void begin(const SceneDesc& desc, const std::vector<std::size_t>& textures,
               const std::string& sceneFile);
    // What is not begun by now is left to take().
    void beginNoMore();
    // The picture of a texture, once, when it has been read or is being read; else nothing.
    std::optional<StoredImage> take(const TextureDesc& texture);

private:
    struct Picture {
        std::string name, file, sceneFile;
        enum class State { Waiting, Reading, Done, Taken } state = State::Waiting;
        std::optional<StoredImage> image;
    };
    void work();

    std::string textureFolder_;
    std::size_t mostThreads_;
    std::mutex mutex_;
    std::condition_variable news_;
    std::vector<Picture> pictures_; // grows only; guarded by mutex_, like all below
    std::size_t next_ = 0;
    bool noMore_ = false;
    std::vector<std::thread> threads_;
};
