#include "image/compare.h"

#include "base/error.h"
#include "base/text.h"
#include "image/colour.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace {

// The mean of term(difference) over all channels; row sums first, so that the error does not grow
// with the number of pixels.
template <class Term> double meanOver(const Image& a, const Image& b, Term term) {
    checkSameSize(a, b);
    const auto width = static_cast<std::size_t>(a.width());
    double sum = 0;
    for (std::size_t start = 0; start < a.pixels().size(); start += width) {
        double row = 0;
        for (std::size_t i = start; i < start + width; ++i) {
            const Rgb p = a.pixels()[i], q = b.pixels()[i];
            row += term(static_cast<double>(p.r) - static_cast<double>(q.r)) +
                   term(static_cast<double>(p.g) - static_cast<double>(q.g)) +
                   term(static_cast<double>(p.b) - static_cast<double>(q.b));
        }
        sum += row;
    }
    return sum / (3 * static_cast<double>(a.pixels().size()));
}

std::vector<double> encodedLuma(const Image& image) {
    std::vector<double> luma;
    luma.reserve(image.pixels().size());
    for (const Rgb& p : image.pixels()) // Rec. 709 weights
        luma.push_back(0.2126 * static_cast<double>(srgbFromLinear(p.r)) +
                       0.7152 * static_cast<double>(srgbFromLinear(p.g)) +
                       0.0722 * static_cast<double>(srgbFromLinear(p.b)));
    return luma;
}

// The window's weighted means of a quantity at all places where the window lies inside.
class WindowMean {
public:
    WindowMean(const Image& image)
        : width_(static_cast<std::size_t>(image.width())),
          height_(static_cast<std::size_t>(image.height())) {
        constexpr std::size_t kWindow = 11;
        constexpr double kSigma = 1.5;
        std::size_t size = std::min({kWindow, width_, height_});
        if (size % 2 == 0) --size;
        const std::size_t middle = size / 2;
        double sum = 0;
        for (std::size_t i = 0; i < size; ++i) {
            const double x = static_cast<double>(i) - static_cast<double>(middle);
            weights_.push_back(std::exp(-x * x / (2 * kSigma * kSigma)));
            sum += weights_.back();
        }
        for (double& weight : weights_) weight /= sum;
    }

    // `quantity(i)` is the value of pixel i.
    template <class Quantity> std::vector<double> operator()(Quantity quantity) const {
        const std::size_t columns = width_ - weights_.size() + 1;
        const std::size_t rows = height_ - weights_.size() + 1;
        std::vector<double> line(width_), across(columns * height_), mean(columns * rows);
        for (std::size_t y = 0; y < height_; ++y) {
            for (std::size_t x = 0; x < width_; ++x) line[x] = quantity(y * width_ + x);
            for (std::size_t x = 0; x < columns; ++x)
                for (std::size_t k = 0; k < weights_.size(); ++k)
                    across[y * columns + x] += weights_[k] * line[x + k];
        }
        for (std::size_t y = 0; y < rows; ++y)
            for (std::size_t k = 0; k < weights_.size(); ++k)
                for (std::size_t x = 0; x < columns; ++x)
                    mean[y * columns + x] += weights_[k] * across[(y + k) * columns + x];
        return mean;
    }

private:
    std::size_t width_, height_;
    std::vector<double> weights_;
};

constexpr Metric kMetrics[] = {
    {"rmse", "root mean square error of linear values", rmse, false},
    {"mae", "mean absolute error of linear values", mae, false},
    {"psnr", "peak signal-to-noise ratio in dB, peak 1, of linear values", psnr, true},
    {"ssim", "structural similarity of the sRGB luma (Wang 2004), 1 when equal", ssim, true},
    {"flip", "LDR-FLIP (Andersson 2020): what the eye sees when flipping, 0 to 1", flip, false},
};

} // namespace

void checkSameSize(const Image& a, const Image& b) {
    if (a.width() == b.width() && a.height() == b.height()) return;
    fail(ErrorKind::Input, cat("error: the pictures differ in size: ", a.width(), "x", a.height(),
                               " and ", b.width(), "x", b.height(), "; both must have the same"));
}

double rmse(const Image& a, const Image& b) {
    return std::sqrt(meanOver(a, b, [](double difference) { return difference * difference; }));
}

double mae(const Image& a, const Image& b) {
    return meanOver(a, b, [](double difference) { return std::fabs(difference); });
}

double psnr(const Image& a, const Image& b) { return -20 * std::log10(rmse(a, b)); }

double ssim(const Image& a, const Image& b) {
    checkSameSize(a, b);
    const std::vector<double> p = encodedLuma(a), q = encodedLuma(b);
    const WindowMean mean(a);
    const auto meanP = mean([&](std::size_t i) { return p[i]; });
    const auto meanQ = mean([&](std::size_t i) { return q[i]; });
    const auto meanPP = mean([&](std::size_t i) { return p[i] * p[i]; });
    const auto meanQQ = mean([&](std::size_t i) { return q[i] * q[i]; });
    const auto meanPQ = mean([&](std::size_t i) { return p[i] * q[i]; });
    constexpr double c1 = 0.01 * 0.01, c2 = 0.03 * 0.03;
    double sum = 0;
    for (std::size_t i = 0; i < meanP.size(); ++i) {
        const double u = meanP[i], v = meanQ[i];
        const double covariance = meanPQ[i] - u * v;
        const double variances = meanPP[i] - u * u + meanQQ[i] - v * v;
        sum += (2 * u * v + c1) * (2 * covariance + c2) / ((u * u + v * v + c1) * (variances + c2));
    }
    return sum / static_cast<double>(meanP.size());
}

Image differenceImage(const Image& a, const Image& b) {
    checkSameSize(a, b);
    Image difference(a.width(), a.height());
    for (std::size_t i = 0; i < a.pixels().size(); ++i) {
        const Rgb d = a.pixels()[i] - b.pixels()[i];
        difference.pixels()[i] = {std::fabs(d.r), std::fabs(d.g), std::fabs(d.b)};
    }
    return difference;
}

std::span<const Metric> metrics() { return kMetrics; }
