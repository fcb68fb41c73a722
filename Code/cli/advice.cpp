#include "cli/advice.h"

#include "base/text.h"
#include "cli/output.h"
#include "cli/stats_output.h"
#include "image/colour.h"
#include "scene/settings.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <vector>

namespace {

constexpr float kDark = 0.02f;

CodedImage codesOf(const Image& image, const RenderSettings& settings) {
    CodedImage codes(image.width(), image.height(), encodingOf(settings, 8));
    const auto width = static_cast<std::size_t>(image.width());
    Image row(image.width(), 1);
    for (int y = 0; y < image.height(); ++y) {
        const auto from = image.pixels().subspan(static_cast<std::size_t>(y) * width, width);
        std::copy(from.begin(), from.end(), row.pixels().begin());
        expose(row, settings.picture.exposureEv);
        codes.put(0, y, row.pixels());
    }
    return codes;
}

PictureLevels levelsOf(const CodedImage& picture, std::optional<Rgb> white) {
    constexpr std::uint8_t kLargest = 255;
    std::array<std::uint8_t, 3> except{};
    if (white) {
        CodedImage one(1, 1, picture.encoding());
        one.put(0, 0, {&*white, 1});
        std::copy(one.codes().begin(), one.codes().end(), except.begin());
    }
    const bool isSrgb = picture.encoding().transfer == Encoding::Transfer::Srgb;
    const auto decoded = [&](std::uint8_t code) {
        return isSrgb ? linearFromSrgb8(code) : unitFrom8(code);
    };
    PictureLevels levels;
    std::uint8_t most = 0;
    // memchr() goes over many codes as fast as memory gives them; most pictures have few that are
    // clipped.
    constexpr std::size_t kTogether = 3 * 256;
    for (auto codes = picture.codes(); !codes.empty();) {
        const auto some = codes.first(std::min(kTogether, codes.size()));
        codes = codes.subspan(some.size());
        if (std::memchr(some.data(), kLargest, some.size()) == nullptr) {
            if (decoded(most) < kDark)
                most = std::max(most, *std::max_element(some.begin(), some.end()));
            continue;
        }
        most = kLargest;
        for (std::size_t i = 0; i < some.size(); i += 3) {
            const auto pixel = some.subspan(i, 3);
            if (std::max({pixel[0], pixel[1], pixel[2]}) == kLargest &&
                !std::equal(except.begin(), except.end(), pixel.begin()))
                ++levels.clipped;
        }
    }
    levels.pixels = picture.codes().size() / 3;
    levels.brightest = decoded(most);
    return levels;
}

} // namespace

PictureLevels levelsOf(const Picture& picture, const RenderSettings& settings,
                       std::optional<Rgb> white) {
    if (!picture.codes.isEmpty()) return levelsOf(picture.codes, white);
    return levelsOf(codesOf(picture.color, settings), white);
}

std::optional<std::string> adviceOn(const PictureLevels& levels, double exposureEv,
                                    bool keepsBright) {
    if (levels.brightest == 0)
        return "raytracer: warning: the picture is black; no light reaches what the camera sees "
               "(--integrator normal shows what it is)";
    if (levels.brightest < kDark)
        return cat("raytracer: warning: the brightest value of the picture is ",
                   significant(levels.brightest), "; more light shows more, or --exposure ",
                   shortest(exposureEv + std::floor(-std::log2(levels.brightest))));
    if (keepsBright || 2 * levels.clipped <= levels.pixels) return {};
    return cat("raytracer: warning: ", 100 * levels.clipped / levels.pixels,
               " % of the pixels are as bright as can be; less light shows more, or --exposure ",
               shortest(exposureEv - 2));
}
