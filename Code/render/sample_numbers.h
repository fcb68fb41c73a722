// SampleNumbers: which samples of their pixels the slots of a chunk are. They are the same for most
// chunks of a picture, and are written when they are new.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

class SampleNumbers {
public:
    // Of so many slots: samples first .. first + count - 1 of one pixel, then of the next.
    void set(std::uint32_t first, std::uint32_t count, std::size_t slots) {
        if (first != first_ || count != count_) numbers_.clear();
        first_ = first, count_ = count;
        numbers_.reserve(slots);
        std::uint32_t inPixel = static_cast<std::uint32_t>(numbers_.size()) % count;
        while (numbers_.size() < slots) {
            numbers_.push_back(first + inPixel);
            inPixel = inPixel + 1 < count ? inPixel + 1 : 0;
        }
    }
    const std::uint32_t& operator[](std::size_t slot) const { return numbers_[slot]; }

private:
    std::uint32_t first_ = 0, count_ = 0;
    std::vector<std::uint32_t> numbers_; // there may be more
};
