#include "cli/advice.h"

#include "base/text.h"
#include "cli/output.h"
#include "cli/stats_output.h"
#include "image/colour.h"
#include "render/encoding.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace {

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
    std::array<std::uint8_t, 3> except{};
    if (white) {
        CodedImage one(1, 1, picture.encoding());
        one.put(0, 0, {&*white, 1});
        std::copy(one.codes().begin(), one.codes().end(), except.begin());
    }
    PictureLevels levels;
    std::uint8_t most = 0;
    const auto codes = picture.codes();
    for (std::size_t i = 0; i < codes.size(); i += 3) {
        const std::uint8_t brightest = std::max({codes[i], codes[i + 1], codes[i + 2]});
        most = std::max(most, brightest);
        if (brightest == 255 && !std::equal(except.begin(), except.end(),
                                            codes.begin() + static_cast<std::ptrdiff_t>(i)))
            ++levels.clipped;
    }
    levels.pixels = codes.size() / 3;
    levels.brightest = picture.encoding().transfer == Encoding::Transfer::Srgb
                           ? linearFromSrgb8(most)
                           : unitFrom8(most);
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
    constexpr float kDark = 0.02f;
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
