#include "texture/mip_levels.h"

#include "texture/texels_in_lanes.h"

#include <algorithm>
#include <bit>
#include <cstddef>
#include <utility>
#include <vector>

namespace {

// Which texels of a side become one, and what part of it each is: the texel covers 1/n of the side,
// where n is half of the side, rounded down.
struct Merged {
    std::size_t first = 0, count = 1;
    double weight[3] = {1, 0, 0};
};
Merged mergedTo(std::size_t i, std::size_t side) {
    if (side == 1) return {};
    const std::size_t half = side / 2;
    const auto all = static_cast<double>(side), n = static_cast<double>(half);
    if (side % 2 == 0) return {2 * i, 2, {0.5, 0.5, 0}};
    const auto at = static_cast<double>(i);
    return {2 * i, 3, {(n - at) / all, n / all, (at + 1) / all}};
}
int halfOf(int side) { return side > 1 ? side / 2 : 1; }

// Halves a picture of kChannels channels, of which the last one is alpha if there are two or four.
// linear(i, isAlpha) is number i of the picture in linear light.
template <std::size_t kChannels, class Linear>
void halve(const StoredImage& image, const Linear& linear, StoredImage& out) {
    constexpr bool kHasAlpha = kChannels % 2 == 0;
    constexpr std::size_t kColours = kHasAlpha ? kChannels - 1 : kChannels;
    const auto width = static_cast<std::size_t>(image.width),
               height = static_cast<std::size_t>(image.height),
               columns = static_cast<std::size_t>(out.width),
               rows = static_cast<std::size_t>(out.height);
    std::vector<Merged> across(columns);
    for (std::size_t x = 0; x < columns; ++x) across[x] = mergedTo(x, width);
    float* to = out.floats.data();
    for (std::size_t y = 0; y < rows; ++y) {
        const Merged down = mergedTo(y, height);
        for (const Merged& right : across) {
            double plain[kColours] = {}, seen[kColours] = {}, covered = 0;
            for (std::size_t j = 0; j < down.count; ++j) {
                std::size_t at = ((down.first + j) * width + right.first) * kChannels;
                for (std::size_t i = 0; i < right.count; ++i, at += kChannels) {
                    const double weight = down.weight[j] * right.weight[i];
                    double covers = 0;
                    if constexpr (kHasAlpha) covered += covers = weight * linear(at + kColours, true);
                    for (std::size_t c = 0; c < kColours; ++c) {
                        const double value = linear(at + c, false);
                        plain[c] += weight * value;
                        if constexpr (kHasAlpha) seen[c] += covers * value;
                    }
                }
            }
            const bool isWeighted = kHasAlpha && covered > 0;
            for (std::size_t c = 0; c < kColours; ++c)
                *to++ = static_cast<float>(isWeighted ? seen[c] / covered : plain[c]);
            if constexpr (kHasAlpha) *to++ = static_cast<float>(covered);
        }
    }
}
template <class Linear>
void halveAny(const StoredImage& image, const Linear& linear, StoredImage& out) {
    switch (image.channels) {
    case 1: return halve<1>(image, linear, out);
    case 2: return halve<2>(image, linear, out);
    case 3: return halve<3>(image, linear, out);
    default: return halve<4>(image, linear, out);
    }
}

} // namespace

StoredImage halved(const StoredImage& image, bool isSrgb) {
    StoredImage out;
    out.width = halfOf(image.width), out.height = halfOf(image.height);
    out.channels = image.channels, out.depth = StoredImage::Depth::Float;
    const auto channels = static_cast<std::size_t>(image.channels);
    out.floats.resize(static_cast<std::size_t>(out.width) * static_cast<std::size_t>(out.height) *
                      channels);
    const auto linear = [&](double code, bool isCode) {
        const auto part = static_cast<float>(code);
        return static_cast<double>(isCode ? kernels::one::linearFromSrgb(part).v : part);
    };
    switch (image.depth) {
    case StoredImage::Depth::Bits8: {
        std::array<double, 256> colours, alphas;
        for (std::size_t i = 0; i < 256; ++i) {
            const double code = static_cast<double>(i) / 255;
            colours[i] = linear(code, isSrgb), alphas[i] = linear(code, false);
        }
        halveAny(
            image,
            [&](std::size_t i, bool isAlpha) {
                return (isAlpha ? alphas : colours)[image.bytes[i]];
            },
            out);
        break;
    }
    case StoredImage::Depth::Bits16:
        halveAny(
            image,
            [&](std::size_t i, bool isAlpha) {
                return linear(image.words[i] / 65535.0, isSrgb && !isAlpha);
            },
            out);
        break;
    case StoredImage::Depth::Float:
        halveAny(
            image, [&](std::size_t i, bool) { return static_cast<double>(image.floats[i]); }, out);
        break;
    }
    return out;
}

MipLevels::MipLevels(const TexelGrid& picture)
    : count_(static_cast<int>(std::bit_width(
          static_cast<unsigned>(std::max({picture.width(), picture.height(), 1}))))) {}

MipLevels::~MipLevels() = default;

const TexelGrid& MipLevels::level(const TexelGrid& picture, int number) const {
    const auto i = static_cast<std::size_t>(number);
    if (const TexelGrid* const there = made_[i].load(std::memory_order_acquire)) return *there;
    const std::lock_guard lock(making_);
    if (!owned_[i]) make(picture, number);
    return *owned_[i];
}

// The finest level takes as much room as a picture of bytes, so that it is kept only if it is
// looked up; the others on the way are a third of it together.
void MipLevels::make(const TexelGrid& picture, int number) const {
    int from = number - 1;
    while (from > 0 && !owned_[static_cast<std::size_t>(from)]) --from;
    StoredImage first;
    const StoredImage* finer =
        from == 0 ? &picture.image() : &owned_[static_cast<std::size_t>(from)]->image();
    while (++from <= number) {
        StoredImage next = halved(*finer, from == 1 && picture.isSrgb());
        if (from == 1 && number > 1) {
            first = std::move(next);
            finer = &first;
            continue;
        }
        auto& owned = owned_[static_cast<std::size_t>(from)];
        owned = std::make_unique<const TexelGrid>(std::move(next), ColorSpace::Linear,
                                                  Interpolation::Bilinear);
        made_[static_cast<std::size_t>(from)].store(owned.get(), std::memory_order_release);
        finer = &owned->image();
    }
}

std::uint64_t MipLevels::bytes() const {
    const std::lock_guard lock(making_);
    std::uint64_t sum = 0;
    for (const auto& level : owned_)
        if (level) sum += level->image().floats.size() * sizeof(float);
    return sum;
}

std::uint64_t MipLevels::bytesOfAll(const TexelGrid& picture) const {
    std::uint64_t texels = 0;
    int width = picture.width(), height = picture.height();
    for (int number = 1; number < count_; ++number) {
        width = halfOf(width), height = halfOf(height);
        texels += static_cast<std::uint64_t>(width) * static_cast<std::uint64_t>(height);
    }
    return texels * static_cast<std::uint64_t>(picture.image().channels) * sizeof(float);
}
