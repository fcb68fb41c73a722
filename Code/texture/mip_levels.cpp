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

// The mean of some texels, in the order in which they are added.
class Mean {
public:
    explicit Mean(std::size_t channels)
        : channels_(channels), colours_(channels % 2 == 0 ? channels - 1 : channels) {}
    void add(const float* texel, double weight) {
        const double alpha = colours_ < channels_ ? static_cast<double>(texel[colours_]) : 1.0;
        covered_ += weight * alpha;
        for (std::size_t c = 0; c < colours_; ++c) {
            const double value = static_cast<double>(texel[c]);
            plain_[c] += weight * value;
            seen_[c] += weight * alpha * value;
        }
    }
    void store(float* texel) const {
        const bool hasAlpha = colours_ < channels_;
        for (std::size_t c = 0; c < colours_; ++c)
            texel[c] =
                static_cast<float>(hasAlpha && covered_ > 0 ? seen_[c] / covered_ : plain_[c]);
        if (hasAlpha) texel[colours_] = static_cast<float>(covered_);
    }

private:
    std::size_t channels_, colours_;
    double plain_[3] = {}, seen_[3] = {}, covered_ = 0;
};

template <class Number, class ToLinear>
void decode(const std::vector<Number>& from, std::size_t channels, double one,
            const ToLinear& toLinear, std::vector<float>& to) {
    to.resize(from.size());
    const bool hasAlpha = channels % 2 == 0;
    for (std::size_t i = 0; i < from.size(); ++i) {
        const bool isAlpha = hasAlpha && i % channels == channels - 1;
        to[i] = isAlpha ? static_cast<float>(static_cast<double>(from[i]) / one)
                        : toLinear(from[i]);
    }
}

} // namespace

StoredImage halved(const StoredImage& image) {
    const auto channels = static_cast<std::size_t>(image.channels),
               width = static_cast<std::size_t>(image.width),
               height = static_cast<std::size_t>(image.height);
    StoredImage out;
    out.width = halfOf(image.width), out.height = halfOf(image.height);
    out.channels = image.channels, out.depth = StoredImage::Depth::Float;
    const auto columns = static_cast<std::size_t>(out.width),
               rows = static_cast<std::size_t>(out.height);
    out.floats.resize(columns * rows * channels);
    for (std::size_t y = 0; y < rows; ++y) {
        const Merged down = mergedTo(y, height);
        for (std::size_t x = 0; x < columns; ++x) {
            const Merged right = mergedTo(x, width);
            Mean mean(channels);
            for (std::size_t j = 0; j < down.count; ++j)
                for (std::size_t i = 0; i < right.count; ++i)
                    mean.add(&image.floats[((down.first + j) * width + right.first + i) * channels],
                             down.weight[j] * right.weight[i]);
            mean.store(&out.floats[(y * columns + x) * channels]);
        }
    }
    return out;
}

StoredImage linearFloats(const TexelGrid& picture) {
    const StoredImage& image = picture.image();
    StoredImage out;
    out.width = image.width, out.height = image.height, out.channels = image.channels;
    out.depth = StoredImage::Depth::Float;
    const auto channels = static_cast<std::size_t>(image.channels);
    const auto linear = [&](double code) {
        const auto part = static_cast<float>(code);
        return picture.isSrgb() ? kernels::one::linearFromSrgb(part).v : part;
    };
    switch (image.depth) {
    case StoredImage::Depth::Bits8: {
        std::array<float, 256> table;
        for (std::size_t i = 0; i < table.size(); ++i)
            table[i] = linear(static_cast<double>(i) / 255);
        decode(
            image.bytes, channels, 255, [&](std::uint8_t code) { return table[code]; }, out.floats);
        break;
    }
    case StoredImage::Depth::Bits16:
        decode(
            image.words, channels, 65535,
            [&](std::uint16_t code) { return linear(code / 65535.0); }, out.floats);
        break;
    case StoredImage::Depth::Float: out.floats = image.floats; break;
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
    StoredImage made;
    const StoredImage* finer = nullptr;
    if (from == 0) {
        made = linearFloats(picture);
        finer = &made;
    } else {
        finer = &owned_[static_cast<std::size_t>(from)]->image();
    }
    while (++from <= number) {
        StoredImage next = halved(*finer);
        if (from == 1 && number > 1) {
            made = std::move(next);
            finer = &made;
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
