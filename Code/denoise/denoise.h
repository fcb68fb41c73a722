// denoise(): noise out of a picture by its own statistics, after Sakai et al., "A statistical
// approach to Monte Carlo denoising" (2024): a pixel becomes the mean of those around it that do not
// differ from it by more than their noise explains, and that show the same material and normal.
//
// A picture comes as two halves, each the mean of half of the samples. Their differences show the noise,
// and each half is filtered by its own colours, so that what the filter takes of the noise of a pixel
// shows as well. Knows nothing of scenes.
#pragma once

#include "image/image.h"
#include "isa/isa.h"

#include <array>
#include <cstddef>

// Two halves of samples: `mean` of both, and `difference`, half of the first less the second.
struct HalvedImage {
    Image mean, difference;

    Rgb half(std::size_t number, int x, int y) const {
        const Rgb m = mean.pixel(x, y), d = difference.pixel(x, y);
        return number == 0 ? m + d : m - d;
    }
};

// Linear values, and what the first hits of the samples show, black where there is none.
struct HalvedPicture {
    HalvedImage color, albedo, normal;
};

// Returns the filtered halves of the colour; all images have one size. The bits are the same for any
// kernel and number of threads.
std::array<Image, 2> denoise(const HalvedPicture& picture, const Isa& isa, int threads);
