// ByteCounts: how often each byte comes. Private to image/.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

// Counts in turns, so that a byte needn't wait for the count of an equal one before it.
class ByteCounts {
public:
    void add(std::span<const std::uint8_t> bytes) {
        std::size_t i = 0;
        for (; i + kTurns <= bytes.size(); i += kTurns)
            for (std::size_t k = 0; k < kTurns; ++k) ++turns_[k][bytes[i + k]];
        for (; i < bytes.size(); ++i) ++turns_[0][bytes[i]];
    }
    std::array<std::uint32_t, 256> sums() const {
        std::array<std::uint32_t, 256> sums{};
        for (const auto& turn : turns_)
            for (std::size_t b = 0; b < sums.size(); ++b) sums[b] += turn[b];
        return sums;
    }

private:
    static constexpr std::size_t kTurns = 4;
    std::array<std::array<std::uint32_t, 256>, kTurns> turns_{};
};
