#include "render/denoised.h"

#include "denoise/denoise.h"
#include "image/colour.h"
#include "sample/hash.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace {

// Tells whether one part stands for all, since numbers of objects cannot be averaged.
bool isOfOnePart(Aov aov) { return aov == Aov::Id; }

constexpr std::size_t kParts = 4; // two of each half

// The parts of a half are one sequence; the halves have a seed each, as samples of one sequence
// avoid each other and are not independent.
RenderSettings partOf(const RenderSettings& settings, std::size_t part) {
    constexpr std::uint32_t kHalfSalt = 0x68616c66u;
    RenderSettings of = settings;
    of.picture.denoise = false;
    of.onlyCodes = false;
    const int samples = settings.picture.samplesPerPixel, each = samples / static_cast<int>(kParts);
    of.picture.samplesPerPixel = each;
    if (part % 2 == 1) of.firstSample = each;
    if (part >= 2) of.picture.seed = low32(hash(settings.picture.seed, kHalfSalt));
    for (const Aov aov : {Aov::Albedo, Aov::Normal})
        if (std::find(of.aovs.begin(), of.aovs.end(), aov) == of.aovs.end())
            of.aovs.push_back(aov);
    return of;
}

const Image& aovOf(const Picture& picture, Aov aov) {
    return std::find_if(picture.aovs.begin(), picture.aovs.end(),
                        [&](const AovImage& one) { return one.aov == aov; })
        ->image;
}

// Returns by how much a picture as it is shown changes per change of the linear value.
// `reach` is how far values around this one are looked at.
float slopeOf(float value, float reach, float exposure, bool isSrgb) {
    const auto shown = [&](float v) {
        return isSrgb ? srgbFromLinear(clampToUnit(v * exposure)) : clampToUnit(v * exposure);
    };
    return (shown(value + reach) - shown(value - reach)) / (2 * reach);
}

// Sums of the squared errors of a block of pixels, to the root of their mean: noise in single
// estimates is not to decide where the picture is looked at.
class BlockErrors {
public:
    explicit BlockErrors(const Image& squares)
        : columns_((squares.width() + kSide - 1) / kSide),
          blocks_(static_cast<std::size_t>(columns_ * ((squares.height() + kSide - 1) / kSide))) {
        for (int y = 0; y < squares.height(); ++y)
            for (int x = 0; x < squares.width(); ++x) {
                const Rgb square = squares.pixel(x, y);
                Block& block = blocks_[indexOf(x, y)];
                block.sum += static_cast<double>(square.r) + static_cast<double>(square.g) +
                             static_cast<double>(square.b);
                block.count += 3;
            }
    }
    float at(int x, int y) const {
        const Block& block = blocks_[indexOf(x, y)];
        return static_cast<float>(std::sqrt(max(block.sum / block.count, 0.0)));
    }

private:
    static constexpr int kSide = 8;
    struct Block {
        double sum = 0, count = 0;
    };
    std::size_t indexOf(int x, int y) const {
        return static_cast<std::size_t>(y / kSide) * static_cast<std::size_t>(columns_) +
               static_cast<std::size_t>(x / kSide);
    }
    int columns_;
    std::vector<Block> blocks_;
};

// Returns the RMSE over pixels and channels of the picture as it is shown, 1 is white.
double shownError(const Denoised& picture, const SettingsDesc& settings) {
    constexpr float kLeastReach = 0x1p-12f;
    const auto exposure = static_cast<float>(exact::exp2(settings.exposureEv));
    const bool isSrgb = settings.transfer == SettingsDesc::Transfer::Srgb;
    const BlockErrors errors(picture.squaredError);
    double sum = 0;
    for (int y = 0; y < picture.color.height(); ++y)
        for (int x = 0; x < picture.color.width(); ++x) {
            const Rgb color = picture.color.pixel(x, y), square = picture.squaredError.pixel(x, y);
            const float reach = max(errors.at(x, y), kLeastReach / exposure);
            const auto shown = [&](float value, float squared) {
                const double slope = slopeOf(value, reach, exposure, isSrgb);
                return static_cast<double>(squared) * slope * slope;
            };
            sum += shown(color.r, square.r) + shown(color.g, square.g) + shown(color.b, square.b);
        }
    return std::sqrt(max(sum / (3.0 * static_cast<double>(picture.color.pixels().size())), 0.0));
}

// Joins the AOVs that were asked for, of all parts.
std::vector<AovImage> joinedAovs(std::array<Picture, kParts>& parts,
                                 const RenderSettings& settings) {
    std::vector<AovImage> joined;
    for (std::size_t a = 0; a < settings.aovs.size(); ++a) {
        AovImage& first = parts[0].aovs[a];
        const float share = settings.aovs[a] == Aov::Samples ? 1.0f : 1.0f / kParts;
        if (!isOfOnePart(first.aov))
            for (std::size_t i = 0; i < first.image.pixels().size(); ++i) {
                Rgb sum = first.image.pixels()[i];
                for (std::size_t part = 1; part < kParts; ++part)
                    sum = sum + parts[part].aovs[a].image.pixels()[i];
                first.image.pixels()[i] = sum * share;
            }
        joined.push_back(std::move(first));
    }
    return joined;
}

} // namespace

Picture renderDenoised(const Scene& scene, const RenderSettings& settings,
                       const RenderControl& control, Stats& stats) {
    std::array<Picture, kParts> parts;
    std::array<HalfPicture, 2> halves;
    for (std::size_t p = 0; p < kParts; ++p) {
        const auto progress = [&](double done) {
            control.progress((static_cast<double>(p) + done) / kParts);
        };
        RenderControl partControl = control;
        if (control.progress) partControl.progress = progress;
        parts[p] = render(scene, partOf(settings, p), partControl, stats);
        // What is done of a picture that was stopped is not filtered.
        if (!parts[p].finished) {
            parts[0].aovs.resize(settings.aovs.size());
            parts[0].finished = false;
            return std::move(parts[0]);
        }
        halves[p / 2][p % 2] = {parts[p].color, aovOf(parts[p], Aov::Albedo),
                                aovOf(parts[p], Aov::Normal)};
    }
    // Errors above white do not show, but one sample of it could be more than all others.
    constexpr float kBrightest = 2;
    const auto exposure = static_cast<float>(exact::exp2(settings.picture.exposureEv));
    Denoised denoised = denoise(halves, kBrightest / exposure, *settings.isa, settings.threads);
    const int samplesOfPart = settings.picture.samplesPerPixel / static_cast<int>(kParts);
    stats.samplesMin = stats.samplesMean = stats.samplesMax =
        static_cast<double>(kParts) * samplesOfPart;
    stats.denoisedError = shownError(denoised, settings.picture);
    Picture picture;
    picture.aovs = joinedAovs(parts, settings);
    picture.color = std::move(denoised.color);
    picture.finished = true;
    return picture;
}
