// LDR-FLIP: Andersson, Nilsson, Akenine-Moller, Oskarsson, Astrom, Fairchild, "FLIP: A Difference
// Evaluator for Alternating Images", HPG 2020. Section numbers below are those of the paper.
#include "base/vec.h"
#include "image/colour.h"
#include "image/compare.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <vector>

namespace {

constexpr double kPi = 3.14159265358979323846;

// Linear sRGB to XYZ, exact for the primaries and the white D65 of the standard; and its inverse.
constexpr std::array<Vec3d, 3> kXyzFromRgb{
    {{10135552.0 / 24577794, 8788810.0 / 24577794, 4435075.0 / 24577794},
     {2613072.0 / 12288897, 8788810.0 / 12288897, 887015.0 / 12288897},
     {1425312.0 / 73733382, 8788810.0 / 73733382, 70074185.0 / 73733382}}};
constexpr Vec3d product(const std::array<Vec3d, 3>& rows, Vec3d v) {
    return {dot(rows[0], v), dot(rows[1], v), dot(rows[2], v)};
}
constexpr auto kRgbFromXyz = [] {
    const auto& [x, y, z] = kXyzFromRgb;
    const Vec3d c0 = cross(y, z), c1 = cross(z, x), c2 = cross(x, y);
    const double determinant = dot(x, c0);
    return std::array<Vec3d, 3>{Vec3d{c0.x, c1.x, c2.x} / determinant,
                                Vec3d{c0.y, c1.y, c2.y} / determinant,
                                Vec3d{c0.z, c1.z, c2.z} / determinant};
}();
constexpr Vec3d kWhite = product(kXyzFromRgb, {1, 1, 1});

Vec3d relativeXyz(Vec3d rgb) {
    const Vec3d xyz = product(kXyzFromRgb, rgb);
    return {xyz.x / kWhite.x, xyz.y / kWhite.y, xyz.z / kWhite.z};
}

// The linearised Lab space YyCxCz, in which the eye's contrast sensitivity is known.
Vec3d opponentFromRgb(Vec3d rgb) {
    const Vec3d t = relativeXyz(rgb);
    return {116 * t.y - 16, 500 * (t.x - t.y), 200 * (t.y - t.z)};
}
Vec3d rgbFromOpponent(Vec3d c) {
    const double y = (c.x + 16) / 116;
    return product(kRgbFromXyz,
                   {(y + c.y / 500) * kWhite.x, y * kWhite.y, (y - c.z / 200) * kWhite.z});
}

// CIELab with the Hunt effect: colours look weaker where it is dark (4.1.3).
Vec3d huntLab(Vec3d rgb) {
    const auto f = [](double t) {
        constexpr double delta = 6.0 / 29;
        return t > delta * delta * delta ? std::cbrt(t) : t / (3 * delta * delta) + 4.0 / 29;
    };
    const Vec3d t = relativeXyz(rgb);
    const double lightness = 116 * f(t.y) - 16;
    return {lightness, 0.01 * lightness * 500 * (f(t.x) - f(t.y)),
            0.01 * lightness * 200 * (f(t.y) - f(t.z))};
}
double hyab(Vec3d a, Vec3d b) { return std::fabs(a.x - b.x) + std::hypot(a.y - b.y, a.z - b.z); }

// A filter along one axis, from -radius to radius.
using Taps = std::vector<double>;

template <class F> Taps tapsOf(int radius, F f) {
    Taps taps;
    for (int i = -radius; i <= radius; ++i) taps.push_back(f(static_cast<double>(i)));
    return taps;
}
// Makes the positive weights sum to 1 and the negative ones to -1.
Taps balanced(Taps taps) {
    double positive = 0, negative = 0;
    for (const double tap : taps) (tap > 0 ? positive : negative) += std::fabs(tap);
    for (double& tap : taps) tap /= tap > 0 ? positive : negative > 0 ? negative : 1;
    return taps;
}

struct Plane {
    int width, height;
    std::vector<double> values;

    std::span<double> row(int y) { return std::span(values).subspan(rowStart(y), columns()); }
    std::span<const double> row(int y) const {
        return std::span(values).subspan(rowStart(y), columns());
    }

private:
    std::size_t columns() const { return static_cast<std::size_t>(width); }
    std::size_t rowStart(int y) const { return static_cast<std::size_t>(y) * columns(); }
};

// Both axes one after the other. The border pixels go on outside of the picture.
Plane filtered(const Plane& plane, const Taps& alongX, const Taps& alongY) {
    const Plane empty{plane.width, plane.height, std::vector<double>(plane.values.size())};
    Plane across = empty, result = empty;
    const std::size_t radiusX = alongX.size() / 2;
    for (int y = 0; y < plane.height; ++y) {
        const auto from = plane.row(y);
        const auto to = across.row(y);
        std::vector<double> padded(radiusX, from.front());
        padded.insert(padded.end(), from.begin(), from.end());
        padded.insert(padded.end(), radiusX, from.back());
        for (std::size_t k = 0; k < alongX.size(); ++k)
            for (std::size_t x = 0; x < to.size(); ++x) to[x] += alongX[k] * padded[x + k];
    }
    const int radiusY = static_cast<int>(alongY.size() / 2);
    for (int y = 0; y < plane.height; ++y) {
        const auto to = result.row(y);
        for (int k = 0; k <= 2 * radiusY; ++k) {
            const auto from = across.row(std::clamp(y + k - radiusY, 0, plane.height - 1));
            const double tap = alongY[static_cast<std::size_t>(k)];
            for (std::size_t x = 0; x < to.size(); ++x) to[x] += tap * from[x];
        }
    }
    return result;
}

// The contrast sensitivity of one channel as a sum of two gaussians (4.1.2, table 1).
struct Sensitivity {
    double a1, b1, a2, b2;
};
constexpr std::array<Sensitivity, 3> kSensitivity{
    {{1, 0.0047, 0, 1e-5}, {1, 0.0053, 0, 1e-5}, {34.1, 0.04, 13.5, 0.025}}};

Plane seen(const Plane& plane, const Sensitivity& s, double pixelsPerDegree) {
    constexpr double kWidest = 0.04; // the largest b: one radius for all channels
    const int radius =
        static_cast<int>(std::ceil(3 * std::sqrt(kWidest / (2 * kPi * kPi)) * pixelsPerDegree));
    const auto gaussian = [&](double b) {
        return tapsOf(radius, [&](double i) {
            const double x = i / pixelsPerDegree;
            return std::exp(-kPi * kPi * x * x / b);
        });
    };
    const auto sumOf = [](const Taps& taps) {
        double sum = 0;
        for (const double tap : taps) sum += tap;
        return sum;
    };
    const Taps g1 = gaussian(s.b1), g2 = gaussian(s.b2);
    const double w1 = s.a1 * std::sqrt(kPi / s.b1), w2 = s.a2 * std::sqrt(kPi / s.b2);
    const double whole = w1 * sumOf(g1) * sumOf(g1) + w2 * sumOf(g2) * sumOf(g2);
    Plane sum = filtered(plane, g1, g1);
    for (double& value : sum.values) value *= w1 / whole;
    if (w2 == 0) return sum;
    const Plane second = filtered(plane, g2, g2);
    for (std::size_t i = 0; i < sum.values.size(); ++i)
        sum.values[i] += w2 / whole * second.values[i];
    return sum;
}

// A picture as opponent colours, one plane each.
std::array<Plane, 3> opponentPlanes(const Image& image) {
    const Plane empty{image.width(), image.height(), std::vector<double>(image.pixels().size())};
    std::array<Plane, 3> planes{empty, empty, empty};
    for (std::size_t i = 0; i < image.pixels().size(); ++i) {
        const Rgb p = image.pixels()[i];
        const Vec3d colour =
            opponentFromRgb(toDouble({clampToUnit(p.r), clampToUnit(p.g), clampToUnit(p.b)}));
        for (std::size_t c = 0; c < 3; ++c) planes[c].values[i] = colour[c];
    }
    return planes;
}

// The picture as it is seen from the distance, in the space where colours are compared.
std::vector<Vec3d> seenColours(const std::array<Plane, 3>& planes, double pixelsPerDegree) {
    std::array<Plane, 3> blurred = planes;
    for (std::size_t c = 0; c < 3; ++c)
        blurred[c] = seen(planes[c], kSensitivity[c], pixelsPerDegree);
    std::vector<Vec3d> colours;
    for (std::size_t i = 0; i < blurred[0].values.size(); ++i) {
        const Vec3d rgb =
            rgbFromOpponent({blurred[0].values[i], blurred[1].values[i], blurred[2].values[i]});
        colours.push_back(huntLab({std::clamp(rgb.x, 0.0, 1.0), std::clamp(rgb.y, 0.0, 1.0),
                                   std::clamp(rgb.z, 0.0, 1.0)}));
    }
    return colours;
}

// How strong edges (first derivative) and points (second derivative) are (4.2).
struct Features {
    std::vector<double> edges, points;
};
Features featuresOf(const Plane& luminance, double pixelsPerDegree) {
    constexpr double kWidthDeg = 0.082; // of the filter, from experiments
    const double sigma = 0.5 * kWidthDeg * pixelsPerDegree;
    const int radius = static_cast<int>(std::ceil(3 * sigma));
    const auto gaussian = [&](double x) { return std::exp(-x * x / (2 * sigma * sigma)); };
    const Taps smooth = balanced(tapsOf(radius, gaussian));
    const Taps first = balanced(tapsOf(radius, [&](double x) { return -x * gaussian(x); }));
    const Taps second = balanced(
        tapsOf(radius, [&](double x) { return (x * x / (sigma * sigma) - 1) * gaussian(x); }));
    Plane grey = luminance;
    for (double& value : grey.values) value = (value + 16) / 116;
    const auto strength = [&](const Taps& taps) {
        const Plane x = filtered(grey, taps, smooth), y = filtered(grey, smooth, taps);
        std::vector<double> lengths;
        for (std::size_t i = 0; i < x.values.size(); ++i)
            lengths.push_back(std::hypot(x.values[i], y.values[i]));
        return lengths;
    };
    return {strength(first), strength(second)};
}

// Perceived colour difference as an error in [0,1] (4.1.4): large ones are compressed.
double colourError(double distance) {
    constexpr double kExponent = 0.7, kTurn = 0.4, kErrorAtTurn = 0.95;
    static const double most = std::pow(hyab(huntLab({0, 1, 0}), huntLab({0, 0, 1})), kExponent);
    const double powered = std::pow(distance, kExponent), turn = kTurn * most;
    if (powered < turn) return kErrorAtTurn / turn * powered;
    return kErrorAtTurn + (powered - turn) / (most - turn) * (1 - kErrorAtTurn);
}

} // namespace

double flip(const Image& reference, const Image& test, double pixelsPerDegree) {
    checkSameSize(reference, test);
    const auto planesA = opponentPlanes(reference), planesB = opponentPlanes(test);
    const auto coloursA = seenColours(planesA, pixelsPerDegree);
    const auto coloursB = seenColours(planesB, pixelsPerDegree);
    const Features featuresA = featuresOf(planesA[0], pixelsPerDegree);
    const Features featuresB = featuresOf(planesB[0], pixelsPerDegree);
    double sum = 0;
    for (std::size_t i = 0; i < coloursA.size(); ++i) {
        const double colour = colourError(hyab(coloursA[i], coloursB[i]));
        const double feature = std::max(std::fabs(featuresA.edges[i] - featuresB.edges[i]),
                                        std::fabs(featuresA.points[i] - featuresB.points[i]));
        // 4.3: a difference in features raises the colour error.
        sum += std::pow(colour, 1 - std::sqrt(feature / std::sqrt(2.0)));
    }
    return sum / static_cast<double>(coloursA.size());
}

double flip(const Image& reference, const Image& test) {
    return flip(reference, test, kFlipPixelsPerDegree);
}
