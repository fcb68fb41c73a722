#include "cli/output.h"

#include "base/enum_names.h"
#include "base/error.h"
#include "base/file_text.h"
#include "base/math.h"
#include "base/platform/platform.h"
#include "image/formats.h"
#include "scene/settings.h"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <limits>

namespace {

namespace fs = std::filesystem;

[[noreturn]] void failWriting(const std::string& fileName, const std::string& reason) {
    fail(ErrorKind::Output, cat(fileName, ": error: cannot write: ", reason));
}

// The channels of an AOV's layer; where it is one, the three of the image are equal.
std::vector<std::string> channelsOf(Aov aov) {
    switch (aov) {
    case Aov::Depth: return {"Z"};
    case Aov::Normal:
    case Aov::Position: return {"X", "Y", "Z"};
    case Aov::Albedo: return {"R", "G", "B"};
    case Aov::Id:
    case Aov::Samples:
    case Aov::Error: break;
    }
    return {"V"};
}

void writeExr(const Picture& picture, const Options& options, const RenderSettings& settings,
              const std::string& output) {
    std::vector<std::vector<float>> numbers;
    const auto add = [&](const Image& image, std::size_t channels) {
        std::vector<float>& to = numbers.emplace_back();
        for (const Rgb& p : image.pixels()) {
            to.push_back(p.r);
            if (channels == 3) to.push_back(p.g), to.push_back(p.b);
        }
    };
    std::vector<ExrLayer> layers{{"", {"R", "G", "B"}, {}}};
    add(picture.color, 3);
    for (const AovImage& aov : picture.aovs) {
        layers.push_back({std::string(nameOf(aov.aov)), channelsOf(aov.aov), {}});
        add(aov.image, layers.back().channels.size());
    }
    for (std::size_t i = 0; i < layers.size(); ++i) layers[i].values = numbers[i];
    writeFileAtomically(output, [&](ByteSink use) {
        encodeExr(layers, picture.color.width(), picture.color.height(),
                  options.bits.value_or(32) == 16, settings.threads, use);
    });
}

} // namespace

void writeStdout(std::string_view data) {
    if (std::fwrite(data.data(), 1, data.size(), stdout) != data.size() || std::fflush(stdout) != 0)
        failWriting("stdout", std::strerror(errno));
}

std::string defaultOutput(const std::string& scene) {
    const std::string stem = scene == "-" ? "stdin" : fs::path(scene).stem().string();
    return stem + ".png";
}

bool isDevice(const std::string& fileName) {
    std::error_code error;
    const fs::file_status status = fs::status(fileName, error);
    return fs::exists(status) && !fs::is_regular_file(status) && !fs::is_directory(status);
}

bool hasPictureExtension(const std::string& fileName) {
    const std::string extension = lowerExtension(fileName);
    return extension == ".ppm" || extension == ".png" || extension == ".pfm" || extension == ".exr";
}

void checkWritable(const std::string& fileName) {
    std::error_code error;
    const fs::file_status status = fs::status(fileName, error);
    if (fs::is_directory(status)) failWriting(fileName, "it is a folder; name a file in it");
    if (fs::exists(status)) {
        const std::string why = whyNotWritable(fileName);
        if (!why.empty()) failWriting(fileName, why);
        if (!fs::is_regular_file(status)) return; // /dev/null, a pipe: written to directly
    }
    const fs::path folder = fs::path(fileName).parent_path();
    const std::string folderName = folder.empty() ? "." : folder.string();
    if (!fs::is_directory(folderName, error))
        failWriting(fileName, cat("there is no folder '", folderName, "'"));
    const std::string why = whyNotWritable(folderName);
    if (!why.empty()) failWriting(fileName, cat("the folder '", folderName, "': ", why));
}

std::string aovFileName(const std::string& output, Aov aov) {
    return fs::path(output).replace_extension(cat(nameOf(aov), ".pfm")).string();
}

std::vector<std::string> filesOf(const std::string& output, std::span<const Aov> aovs) {
    std::vector<std::string> names{output};
    if (lowerExtension(output) == ".exr") return names;
    for (const Aov aov : aovs) names.push_back(aovFileName(output, aov));
    return names;
}

Image padded(const Image& crop, const SettingsDesc& picture) {
    if (!picture.crop) return crop;
    Image full(picture.width, picture.height);
    for (int y = 0; y < crop.height(); ++y)
        for (int x = 0; x < crop.width(); ++x)
            full.setPixel((*picture.crop)[0] + x, (*picture.crop)[1] + y, crop.pixel(x, y));
    return full;
}

void expose(Image& image, double ev) {
    if (ev == 0) return;
    constexpr float kLargest = std::numeric_limits<float>::max();
    const auto factor = static_cast<float>(exact::exp2(ev));
    const auto exposed = [&](float value) { return clamp(value * factor, -kLargest, kLargest); };
    for (Rgb& pixel : image.pixels())
        pixel = {exposed(pixel.r), exposed(pixel.g), exposed(pixel.b)};
}

bool needsOnlyCodes(const RenderSettings& settings, const Options& options,
                    const std::string& output) {
    return options.bits.value_or(8) == 8 && settings.picture.exposureEv == 0 && !options.cropPad &&
           !options.preview && !options.partial && lowerExtension(output) != ".pfm" &&
           lowerExtension(output) != ".exr";
}

void writePicture(Picture picture, const RenderSettings& settings, const Options& options,
                  const std::string& output) {
    expose(picture.color, settings.picture.exposureEv);
    if (options.cropPad) {
        picture.color = padded(picture.color, settings.picture);
        for (AovImage& aov : picture.aovs) aov.image = padded(aov.image, settings.picture);
    }
    const Encoding encoding = encodingOf(settings, options.bits.value_or(8));
    const bool isCoded = !picture.codes.isEmpty();
    if (output == "-" || isDevice(output)) {
        const auto bytes = isCoded ? encodeImage(picture.codes, "ppm", settings.threads)
                                   : encodeImage(picture.color, "ppm", encoding, settings.threads);
        if (output != "-") return writeFileAtomically(output, bytes);
        return writeStdout({reinterpret_cast<const char*>(bytes.data()), bytes.size()});
    }
    if (lowerExtension(output) == ".exr") return writeExr(picture, options, settings, output);
    if (isCoded)
        picture.codes.write(output, settings.threads);
    else
        picture.color.write(output, encoding, settings.threads);
    for (const AovImage& aov : picture.aovs)
        aov.image.write(aovFileName(output, aov.aov), {}, settings.threads);
}
