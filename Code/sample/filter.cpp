#include "sample/filter.h"

#include "base/math.h"
#include "sample/filter_in_lanes.h"

#include <algorithm>
#include <array>

namespace {

// They are even in sqrt(1 - share), which spreads out the tails.
constexpr int kSteps = Filter::kSteps;

double radiusOf(FilterKind kind, double width) {
    switch (kind) {
    case FilterKind::Box:
    case FilterKind::Tent: return 0.5 * width;
    case FilterKind::Gaussian: return 1.5 * width;
    case FilterKind::BlackmanHarris: return width;
    }
    return 0;
}

// Of Blackman and Harris from the cosine of pi x, x in radii from the middle. Constants as in
// Cycles' film.cpp, where x counts from the edge.
double blackmanHarris(double cosine) {
    const double twice = 2 * sqr(cosine) - 1, thrice = cosine * (2 * twice - 1); // of so many pi x
    return 0.35875 + 0.48829 * cosine + 0.14128 * twice + 0.01168 * thrice;
}

// The densities on [-1,1] of the radius, 1 in the middle.
double shape(FilterKind kind, double x) {
    if (std::fabs(x) > 1) return 0;
    switch (kind) {
    case FilterKind::Box: return 1;
    case FilterKind::Tent: return 1 - std::fabs(x);
    case FilterKind::Gaussian: return exact::exp(-18 * x * x);
    case FilterKind::BlackmanHarris: return blackmanHarris(exact::cos(kPi * x));
    }
    return 0;
}

// shape() at i / kCount radii, for all i up to kCount: their cosines come from those of some angles
// by the addition theorem, which is ten times as fast.
class ShapeAt {
public:
    static constexpr std::size_t kCount = 2048;

    explicit ShapeAt(FilterKind kind) : kind_(kind) {
        if (kind != FilterKind::BlackmanHarris) return;
        for (std::size_t i = 0; i < coarse_.size(); ++i) coarse_[i] = at(i * kFine);
        for (std::size_t i = 0; i < kFine; ++i) fine_[i] = at(i);
    }
    double operator()(std::size_t i) const {
        if (kind_ != FilterKind::BlackmanHarris)
            return shape(kind_, static_cast<double>(i) / kCount);
        const CosSin a = coarse_[i / kFine], b = fine_[i % kFine];
        return blackmanHarris(a.cosine * b.cosine - a.sine * b.sine);
    }

private:
    static constexpr std::size_t kFine = 64;
    struct CosSin {
        double cosine, sine;
    };
    static CosSin at(std::size_t i) {
        const double angle = kPi * static_cast<double>(i) / kCount;
        return {exact::cos(angle), exact::sin(angle)};
    }

    FilterKind kind_;
    std::array<CosSin, kCount / kFine + 1> coarse_;
    std::array<CosSin, kFine> fine_;
};

// A part of the upper half on which a parabola is the density, as in Simpson's rule. It is 1 long.
class Piece {
public:
    Piece(double before, double start, double middle, double end)
        : before_(before), start_(start), slope_(4 * middle - 3 * start - end),
          bend_(2 * (start - 2 * middle + end)) {}

    // What lies between the centre and the place s in [0,1] of this piece.
    double cdf(double s) const {
        return before_ + s * (start_ + s * (slope_ / 2 + s * (bend_ / 3)));
    }
    // Where cdf() is that, which is so in this piece. The densities at its ends differ by a
    // twentieth at most, so that a step of Newton's leaves 1e-6 where the chord is 6e-3 off.
    double placeOf(double wanted) const {
        const double s = (wanted - before_) / (cdf(1) - before_);
        return s - (cdf(s) - wanted) / density(s);
    }

private:
    double density(double s) const { return start_ + s * (slope_ + s * bend_); }

    double before_, start_, slope_, bend_;
};

// Entry i is the x in [0,1] where the share of the upper half that lies between 0 and x is
// 1 - (i / kSteps)^2.
std::vector<float> inverseOfCdf(FilterKind kind) {
    constexpr std::size_t kPieces = ShapeAt::kCount / 2;
    const ShapeAt shapeAt(kind);
    std::vector<Piece> pieces;
    pieces.reserve(kPieces);
    double all = 0, start = shapeAt(0);
    for (std::size_t i = 0; i < kPieces; ++i) {
        const double middle = shapeAt(2 * i + 1), end = shapeAt(2 * i + 2);
        all = pieces.emplace_back(all, start, middle, end).cdf(1);
        start = end;
    }
    std::vector<float> inverse{1}; // it is right to as many digits
    inverse.reserve(kSteps + 1);
    std::size_t piece = kPieces - 1;
    for (int i = 1; i < kSteps; ++i) {
        const double wanted = all * (1 - sqr(static_cast<double>(i) / kSteps));
        while (pieces[piece].cdf(0) > wanted) --piece;
        const double x = (static_cast<double>(piece) + pieces[piece].placeOf(wanted)) / kPieces;
        inverse.push_back(static_cast<float>(x));
    }
    inverse.push_back(0);
    return inverse;
}

} // namespace

Filter::Filter(FilterKind kind, double width)
    : kind_(kind), width_(max(width, 0.0)), radius_(radiusOf(kind, width_)) {
    if (kind == FilterKind::Gaussian || kind == FilterKind::BlackmanHarris)
        inverse_ = inverseOfCdf(kind);
}

double Filter::value(double offset) const {
    return radius_ > 0 ? shape(kind_, offset / radius_) : 0;
}

Vec2 Filter::sample(Vec2 u) const {
    using kernels::one::offsetOf;
    return {offsetOf(spread(), u.x).v, offsetOf(spread(), u.y).v};
}
