// How different two pictures are. Values are linear unless it says otherwise; all functions fail
// (ErrorKind::Input) with both sizes when the sizes differ.
// A metric is no picture: its last bits may depend on the machine's exp, pow and cbrt.
#pragma once

#include "image/image.h"

#include <span>
#include <string_view>

// Over all pixels and channels.
double rmse(const Image& a, const Image& b); // root of the mean squared difference
double mae(const Image& a, const Image& b);  // mean absolute difference
double psnr(const Image& a, const Image& b); // -20 log10(rmse), dB for peak 1; infinite if equal

// Structural similarity (Wang et al. 2004) of the luma of the sRGB-encoded pictures: gaussian
// window 11x11 with sigma 1.5, K1 0.01, K2 0.03, only windows that lie inside. Pictures with a side
// below 11 get the largest odd window that fits. 1 when equal.
double ssim(const Image& a, const Image& b);

// LDR-FLIP (Andersson et al. 2020): what a viewer notices who flips between both, 0 to 1, mean over
// the pixels. The default is a 0.7 m wide 3840-pixel screen at 0.7 m.
inline constexpr double kFlipPixelsPerDegree = 0.7 * (3840 / 0.7) * 3.14159265358979323846 / 180;
double flip(const Image& reference, const Image& test, double pixelsPerDegree);
double flip(const Image& reference, const Image& test); // kFlipPixelsPerDegree

// |a - b| per channel.
Image differenceImage(const Image& a, const Image& b);

struct Metric {
    std::string_view name, help;
    double (*measure)(const Image& a, const Image& b);
    bool isLargerBetter;
};
std::span<const Metric> metrics();

// Fails unless both have the same size.
void checkSameSize(const Image& a, const Image& b);
