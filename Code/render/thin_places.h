// ThinPlaces: where a picture shows what is smaller than some samples of a pixel are sure to meet:
// small bodies, thin ones, and thin parts of meshes. An adaptive picture that looked at such a
// place with few samples and met nothing would believe that nothing is there.
#pragma once

#include "scene/scene.h"

#include <cstddef>
#include <cstdint>
#include <vector>

class ThinPlaces {
public:
    static constexpr int kSide = 4; // pixels of a block, each way
    // The most samples that are asked for. A net of 1024 has one in each cell of 1/32 x 1/32, and a
    // disk of 1/8 has all of such a cell in it. What is long needs fewer, as it lies in many cells.
    static constexpr std::uint16_t kMostSamples = 1024;

    // Looks at a picture of width x height pixels. `reach`: how far from the middle of its pixel a sample
    // may be, in pixels. With a moving camera no place is known. Things that move count by their
    // boxes over the whole shutter, so that one which moves by more than it measures may be missed.
    ThinPlaces(const Scene& scene, int width, int height, double reach);

    int columns() const { return columns_; }
    int rows() const { return rows_; }
    // Returns how many well-spread samples each pixel of a block needs: a power of two; 1 where nothing is
    // thin.
    std::uint16_t samples(int column, int row) const { return samples_[index(column, row)]; }

private:
    std::size_t index(int column, int row) const {
        return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) +
               static_cast<std::size_t>(column);
    }
    int columns_, rows_;
    std::vector<std::uint16_t> samples_;
};
