// denoise(): noise out of a picture by its own statistics, after Sakai et al., "A statistical
// approach to Monte Carlo denoising" (2024): a pixel becomes the mean of those around it that do not
// differ from it by more than their noise explains, and that show the same material and normal.
//
// A picture comes as two halves, each of half of the samples and independent of the other, in two
// parts each, whose difference shows the noise of the half. Each half is filtered by what it knows
// itself, which lets the error of the result be known, its bias included: the other half had no say
// in it. Knows nothing of scenes.
#pragma once

#include "image/image.h"
#include "isa/isa.h"

#include <array>
#include <cstddef>

// What some of the samples show: linear values, and their first hits, black where there is none.
struct PartPicture {
    Image color, albedo, normal;
};
using HalfPicture = std::array<PartPicture, 2>;

struct Denoised {
    Image color;
    // The squared error of each pixel and channel, estimated: means over many pixels say something,
    // a single one may be negative.
    Image squaredError;
};

// Filters both halves; all pictures have one size. What is above `brightest` counts as that in the estimated
// error. The bits are the same for any kernel and number of threads.
Denoised denoise(const std::array<HalfPicture, 2>& halves, float brightest, const Isa& isa,
                 int threads);
