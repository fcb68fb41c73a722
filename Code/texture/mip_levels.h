// MipLevels: a picture at a half, a quarter ... of its size, for places that are seen from far.
// A level is made when it is first looked up, from the picture or from a finer level that is
// there: its numbers are the same in whatever order and by whatever thread levels are made.
#pragma once

#include "texture/texture.h"

#include <array>
#include <atomic>
#include <cstdint>
#include <memory>
#include <mutex>

class MipLevels {
public:
    explicit MipLevels(const TexelGrid& picture);
    ~MipLevels();

    // How many there are, with the picture itself, which is level 0; the last one is a single
    // texel.
    int count() const { return count_; }
    // Level `number`, from 1 to count() - 1, of the picture that this was made with. It has as many
    // channels as the picture, as floats in linear light.
    const TexelGrid& level(const TexelGrid& picture, int number) const;
    // Returns the memory of all levels that are there: at most 4/3 times 4 bytes for each channel of every fourth
    // texel.
    std::uint64_t bytes() const;
    // Returns the memory of all levels that there could be.
    std::uint64_t bytesOfAll(const TexelGrid& picture) const;

private:
    static constexpr int kMost = 17; // sides go to 65535
    void make(const TexelGrid& picture, int number) const;

    int count_;
    mutable std::mutex making_;
    mutable std::array<std::unique_ptr<const TexelGrid>, kMost> owned_; // guarded by making_
    mutable std::array<std::atomic<const TexelGrid*>, kMost> made_{};
};

// Returns half of a picture, as floats in linear light: every texel is the mean of 2 x 2 texels, or
// of parts of 3 where a side is odd, weighted by alpha if there is one. Sides of 1 stay.
StoredImage halved(const StoredImage& image, bool isSrgb);
