#include "sample/filter.h"

#include "base/math.h"

#include <algorithm>

namespace {

// Steps that are even in sqrt(1 - share) spread out the tails.
constexpr int kSteps = Filter::Inverse::kSteps;

double radiusOf(FilterKind kind, double width) {
    switch (kind) {
    case FilterKind::Box:
    case FilterKind::Tent: return 0.5 * width;
    case FilterKind::Gaussian: return 1.5 * width;
    case FilterKind::BlackmanHarris: return width;
    }
    return 0;
}

// The densities on [-1,1] of the radius, 1 in the middle. Constants as in Cycles' film.cpp.
double shape(FilterKind kind, double x) {
    if (std::fabs(x) > 1) return 0;
    switch (kind) {
    case FilterKind::Box: return 1;
    case FilterKind::Tent: return 1 - std::fabs(x);
    case FilterKind::Gaussian: return exact::exp(-18 * x * x);
    case FilterKind::BlackmanHarris: {
        const double v = kPi * (x + 1);
        return 0.35875 - 0.48829 * exact::cos(v) + 0.14128 * exact::cos(2 * v) -
               0.01168 * exact::cos(3 * v);
    }
    }
    return 0;
}

// Entry i is the x in [0,1] where the share of the upper half that lies between 0 and x is
// 1 - (i / kSteps)^2.
std::vector<double> inverseOfCdf(FilterKind kind, ThreadPool* pool) {
    constexpr std::size_t kPieces = 16384, kPerJob = 2048;
    constexpr double h = 1.0 / kPieces;
    std::vector<double> ends(kPieces + 1, shape(kind, 0)), middles(kPieces);
    const auto fill = [&](std::size_t job, int) {
        for (std::size_t i = job * kPerJob; i < (job + 1) * kPerJob; ++i) {
            const double x = static_cast<double>(i) * h;
            ends[i + 1] = shape(kind, x + h);
            middles[i] = shape(kind, x + 0.5 * h);
        }
    };
    constexpr std::size_t kJobs = kPieces / kPerJob;
    if (pool)
        pool->run(kJobs, fill);
    else
        for (std::size_t job = 0; job < kJobs; ++job) fill(job, 0);
    std::vector<double> cdf(kPieces + 1, 0.0);
    for (std::size_t i = 0; i < kPieces; ++i) // Simpson on each piece
        cdf[i + 1] = cdf[i] + (ends[i] + 4 * middles[i] + ends[i + 1]) * (h / 6);
    std::vector<double> inverse{1}; // floats, as many as that is right to
    std::size_t piece = kPieces - 1;
    for (int i = 1; i < kSteps; ++i) {
        const double wanted = cdf.back() * (1 - sqr(static_cast<double>(i) / kSteps));
        while (cdf[piece] > wanted) --piece;
        const double s = (wanted - cdf[piece]) / (cdf[piece + 1] - cdf[piece]);
        const double x = (static_cast<double>(piece) + s) / kPieces;
        inverse.push_back(static_cast<double>(static_cast<float>(x)));
    }
    inverse.push_back(0);
    return inverse;
}

} // namespace

Filter::Filter(FilterKind kind, double width, ThreadPool* pool)
    : kind_(kind), width_(max(width, 0.0)), radius_(radiusOf(kind, width_)) {
    if (kind == FilterKind::Gaussian || kind == FilterKind::BlackmanHarris)
        inverse_ = inverseOfCdf(kind, pool);
}

double Filter::value(double offset) const {
    return radius_ > 0 ? shape(kind_, offset / radius_) : 0;
}

template <FilterKind kKind> float Filter::offsetAt(float u) const {
    const double place = 2 * static_cast<double>(u) - 1, size = std::fabs(place);
    double x = size; // Box
    if constexpr (kKind == FilterKind::Tent) {
        // 1 - sqrt(1 - size) without cancellation
        x = size / (1 + std::sqrt(1 - size));
    } else if constexpr (kKind != FilterKind::Box) {
        const double at = std::sqrt(1 - size) * kSteps;
        const int i = std::min(static_cast<int>(at), kSteps - 1);
        const double* step = inverse_.data() + i;
        x = lerp(step[0], step[1], at - i);
    }
    return static_cast<float>(std::copysign(x * radius_, place));
}

template <FilterKind kKind> void Filter::sampleAs(std::span<Vec2> u) const {
    for (Vec2& both : u) both = {offsetAt<kKind>(both.x), offsetAt<kKind>(both.y)};
}

void Filter::sample(std::span<Vec2> u) const {
    switch (kind_) {
    case FilterKind::Box: return sampleAs<FilterKind::Box>(u);
    case FilterKind::Tent: return sampleAs<FilterKind::Tent>(u);
    case FilterKind::Gaussian: return sampleAs<FilterKind::Gaussian>(u);
    case FilterKind::BlackmanHarris: return sampleAs<FilterKind::BlackmanHarris>(u);
    }
}
