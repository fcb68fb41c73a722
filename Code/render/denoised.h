// denoisedPicture(): of each place of a picture as much of what denoise() makes of it as brings it nearest to
// the true one, and how near that is.
//
// R is the mean of both halves, D half their difference, and F and G are the filtered halves; S = (F + G) / 2
// is the filtered picture and H = (F - G) / 2. The mean square of R's error is V = q D^2, where
// q = 1 / (2^theta - 1) (see film/noise_map.h). How the filter changes D to H shows how it changes R's error:
// the product of that error and of what is left of it in S has the mean K = D H where halves are independent,
// and is between q D H and D H where they are spread together. So the mean square of the error of R + b (S - R) is
//     V - 2 b (V - K) + b^2 (S - R)^2,
// Stein's estimate (1981) with a difference in place of the filter's derivative. It includes what the filter has
// blurred. A place is what is around it. There, b is what makes this least with the first K; the error is told
// with the second, which is the larger.
#pragma once

#include "denoise/denoise.h"
#include "film/error_measure.h"

struct DenoisedPicture {
    Image color;
    double error = 0; // RMSE over pixels and channels, as it is measured
};

// `past` holds the mean square of D around each pixel in r, and in g what it was two doublings of the samples
// before. The bits are the same for any kernel and number of threads.
DenoisedPicture denoisedPicture(const HalvedPicture& picture, const Image& past,
                                const ErrorMeasure& measure, const Isa& isa, int threads);
