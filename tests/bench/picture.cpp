#include "bench/picture.h"

#include "base/platform/platform.h"
#include "base/text.h"
#include "bench/clock.h"
#include "read/load.h"
#include "scene/settings.h"
#include "render/render.h"
#include "scene/scene.h"

#include <filesystem>
#include <optional>

namespace {

class TemporaryPicture {
public:
    TemporaryPicture()
        : path_(std::filesystem::temp_directory_path() /
                cat("raytracer-bench-", processNumber(), ".png")) {}
    ~TemporaryPicture() {
        std::error_code ignored;
        std::filesystem::remove(path_, ignored);
    }
    TemporaryPicture(const TemporaryPicture&) = delete;
    TemporaryPicture& operator=(const TemporaryPicture&) = delete;
    std::string name() const { return path_.string(); }

private:
    std::filesystem::path path_;
};

} // namespace

BenchPicture timePicture(const std::string& file, const Isa& isa, int threads) {
    const TemporaryPicture output;
    BenchPicture seconds;
    Diagnostics diagnostics;
    std::optional<LoadedScene> loaded;
    seconds.read = secondsOf([&] { loaded.emplace(load(file, diagnostics)); }).wall;

    RenderSettings settings;
    settings.picture = loaded->desc.settings;
    settings.picture.width = settings.picture.height = kBenchPictureSide;
    settings.picture.crop.reset();
    settings.picture.samplesPerPixel = 1;
    settings.isa = &isa;
    settings.threads = threads;
    std::optional<Scene> scene;
    seconds.build = secondsOf([&] { scene.emplace(loaded->desc, loaded->source, settings); }).wall;

    Stats stats;
    Picture picture;
    seconds.render = secondsOf([&] { picture = render(*scene, settings, {}, stats); }).wall;
    seconds.write =
        secondsOf([&] { picture.color.write(output.name(), encodingOf(settings, 8)); }).wall;
    return seconds;
}
