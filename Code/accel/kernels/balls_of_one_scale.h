// Which of a tree's solids are balls of one scale: the one that most of them have.
#pragma once

#include "accel/kernels/solids.h"

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

class BallsOfOneScale {
public:
    // Solids are looked at in parts of `together`.
    BallsOfOneScale(std::size_t solids, std::size_t together);

    // In order within a part; parts may be looked at by several threads.
    void look(std::size_t place, const SolidTree::Solid& solid);
    // Once, behind all of them.
    void decide();

    // Then:
    double scale() const { return scale_; } // 0: there are none
    std::size_t count() const { return count_; }
    bool isOne(std::size_t place) const {
        return isBall_[place] != 0 && parts_[place / together_].scale == scale_;
    }
    // By place; anything where none is. They are gone here.
    RawVector<SolidTree::Ball> taken() { return std::move(balls_); }

private:
    struct Part {
        double scale = 0;
        std::size_t balls = 0; // of that scale
        std::size_t seen = 0;  // of any
    };
    std::size_t together_;
    std::vector<Part> parts_;
    std::vector<std::uint8_t> isBall_; // of its part's scale
    RawVector<SolidTree::Ball> balls_;
    double scale_ = 0;
    std::size_t count_ = 0;
};
