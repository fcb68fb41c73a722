#include "material/energy_tables.h"

#include "base/math.h"

#include <array>
#include <atomic>
#include <bit>
#include <cmath>
#include <cstddef>
#include <mutex>

namespace energy {

namespace {

constexpr double kLeastAlpha = 1e-3; // as narrow as any, where places are Ggx::tablePlace()
// The most that linear interpolation is too low: tables say so much more, so that no surface sends
// on more light than it gets. kFacetMargin is relative; kGlassMargin is absolute and comes on top
// of it for glass, which sends on little near the horizon. There, below 2 degrees, glass with an
// eta within 1 % of 1 still gains up to 2 %, as what it sends on rises tenfold between two nodes.
constexpr double kFacetMargin = 1.003, kGlassMargin = 0.001;

// Points in the unit square (a Fibonacci lattice), the second coordinate as an angle up to pi.
template <int N, int Generator> struct Lattice {
    struct Point {
        double u, cos, sin;
    };
    std::array<Point, N> points;
    Lattice() {
        for (int i = 0; i < N; ++i) {
            const double v = (i * Generator % N + 0.5) / N;
            const auto [sin, cos] = exact::sinCos(kPi * (1 - std::fabs(2 * v - 1)));
            points[static_cast<std::size_t>(i)] = {(i + 0.5) / N, cos, sin};
        }
    }
};

// Fresnel's part of what is reflected, and the cosine on the other side.
struct Fresnel {
    double part = 1, cosOut = 0;
    Fresnel(double c, double eta) {
        const double cos2 = (1 - eta) * (1 + eta) + sqr(eta * c);
        if (!(cos2 > 0)) return;
        cosOut = std::sqrt(cos2);
        const double a = c + eta * cosOut, b = eta * c + cosOut; // by one division, for speed
        part = 0.5 * (sqr((c - eta * cosOut) * b) + sqr((eta * c - cosOut) * a)) / sqr(a * b);
    }
};

// The eye above isotropic facets, in the plane of x and z.
class Facets {
public:
    Facets(double cosEye, double alpha)
        : alpha_(alpha), z_(cosEye), x_(std::sqrt(max(1 - sqr(cosEye), 0.0))),
          length_(std::sqrt(sqr(z_) + sqr(alpha * x_))) {}

    // A visible facet: its cosine to the eye, and the height of its normal.
    struct Facet {
        double cosIn, z;
    };
    template <class Point> Facet facet(const Point& p) const {
        const double up = 1 + z_ / length_, h = p.u * up, sine = std::sqrt(h * (2 - h));
        const double x = alpha_ * (sine * p.cos + alpha_ * x_ / length_);
        const double y = alpha_ * (sine * p.sin), z = (1 - p.u) * up;
        const double scale = 1 / std::sqrt(sqr(x) + sqr(y) + sqr(z));
        return {(x_ * x + z_ * z) * scale, z * scale};
    }
    // What of the light that a facet sends to a direction of height z is neither shadowed before
    // nor behind it.
    double leaves(double z) const {
        if (!(z > 0)) return 0;
        const double length = std::sqrt(sqr(z) + sqr(alpha_) * max(1 - sqr(z), 0.0));
        return z * (z_ + length_) / (z * length_ + z_ * length);
    }
    double reflectedLeaves(const Facet& f) const { return leaves(2 * f.cosIn * f.z - z_); }
    double refractedLeaves(const Facet& f, double cosOut, double eta) const {
        return leaves((cosOut - eta * f.cosIn) * f.z + eta * z_);
    }

private:
    double alpha_, z_, x_, length_;
};

double alphaOf(int column, int columns) {
    return max(sqr(static_cast<double>(column) / (columns - 1)), kLeastAlpha);
}
// The cosine at a row: the inverse of Ggx::tablePlace().
double cosineAt(int row, int rows, double alpha) {
    const double t = static_cast<double>(row) / (rows - 1);
    const double up = sqr(t), stretched = up / (up + sqr(1 - t)); // the cosine there
    const double z2 = sqr(stretched);
    return stretched * alpha / std::sqrt((1 - z2) + z2 * sqr(alpha));
}

std::uint32_t stored(double x) { return std::bit_cast<std::uint32_t>(static_cast<float>(x)); }
double loaded(std::uint32_t bits) { return std::bit_cast<float>(bits); }

void makeFacets(FacetTables& tables) {
    const Lattice<377, 233> lattice;
    for (int row = 0; row < kPlaces; ++row)
        for (int column = 0; column < kRoughs; ++column) {
            const double alpha = alphaOf(column, kRoughs);
            const Facets facets(cosineAt(row, kPlaces, alpha), alpha);
            double all = 0, rise = 0, bend = 0;
            for (const auto& point : lattice.points) {
                const auto facet = facets.facet(point);
                const double part = facets.reflectedLeaves(facet), m = 1 - facet.cosIn;
                const double m5 = sqr(sqr(m)) * m * part;
                all += part, rise += m5, bend += m5 * m * facet.cosIn;
            }
            constexpr double count = std::tuple_size_v<decltype(lattice.points)>;
            const int at = row * kRoughs + column;
            tables.all[at] = stored(min(all / count * kFacetMargin, 1.0));
            tables.rise[at] = stored(rise / count), tables.bend[at] = stored(bend / count);
        }
    // The mean: 2 E cos d(cos), by trapezoids between the rows.
    for (int column = 0; column < kRoughs; ++column) {
        const double alpha = alphaOf(column, kRoughs);
        double mean = 0;
        for (int row = 0; row + 1 < kPlaces; ++row) {
            const double a = cosineAt(row, kPlaces, alpha), b = cosineAt(row + 1, kPlaces, alpha);
            const int at = row * kRoughs + column;
            mean += 0.5 * (loaded(tables.all[at]) + loaded(tables.all[at + kRoughs])) *
                    (sqr(b) - sqr(a));
        }
        tables.mean[column] = stored(mean);
    }
}

double etaOf(int slice) {
    const double part = static_cast<double>(slice % kSlices) / (kSlices - 1);
    const double w = min(sqr(sqr(part)), 0.98);
    return slice < kSlices ? (1 - w) / (1 + w) : (1 + w) / (1 - w);
}

constexpr int kSentOnRows = 40, kReflectedRows = 16;

void makeSentOn(std::uint32_t* column, double eta, double alpha) {
    static const Lattice<610, 377> lattice;
    for (int row = 0; row < kSentOnRows; ++row) {
        const Facets facets(cosineAt(row, kSentOnRows, std::sqrt(alpha)), alpha);
        double sum = 0;
        for (const auto& point : lattice.points) {
            const auto facet = facets.facet(point);
            const Fresnel f(facet.cosIn, eta);
            sum += f.part * facets.reflectedLeaves(facet);
            if (f.part < 1) sum += (1 - f.part) * facets.refractedLeaves(facet, f.cosOut, eta);
        }
        const double mean = sum / static_cast<double>(lattice.points.size());
        column[row] = stored(min(mean * kFacetMargin + kGlassMargin, 1.0));
    }
}

void makeReflected(std::uint32_t* column, double eta, double alpha) {
    static const Lattice<233, 144> lattice;
    for (int row = 0; row < kReflectedRows; ++row) {
        const Facets facets(sqr(static_cast<double>(row) / (kReflectedRows - 1)), alpha);
        double all = 0, reflected = 0;
        for (const auto& point : lattice.points) {
            const auto facet = facets.facet(point);
            const double part = facets.reflectedLeaves(facet);
            all += part, reflected += part * Fresnel(facet.cosIn, eta).part;
        }
        column[row] = stored(reflected / all);
    }
}

template <int kRows> struct SliceMemory {
    static constexpr int kColumns = 2 * kSlices * kSliceRoughs;
    std::uint32_t words[kRows * kColumns];
    std::atomic<bool> columnIsMade[kColumns];
};
SliceMemory<kSentOnRows> sentOn;
SliceMemory<kReflectedRows> reflected;
std::mutex columnMutex;

} // namespace

const FacetTables& facetTables() {
    static const FacetTables tables = [] {
        FacetTables made;
        makeFacets(made);
        return made;
    }();
    return tables;
}

constinit const SliceTable kSentOn{kSentOnRows, makeSentOn, sentOn.words, sentOn.columnIsMade};
constinit const SliceTable kReflected{kReflectedRows, makeReflected, reflected.words,
                                      reflected.columnIsMade};

void SliceTable::need(int slice, int column) const {
    const int number = slice * kSliceRoughs + column;
    if (columnIsMade[number].load(std::memory_order_acquire)) return;
    const std::lock_guard lock(columnMutex);
    if (columnIsMade[number].load(std::memory_order_relaxed)) return;
    makeColumn(words + std::ptrdiff_t{rows} * number, etaOf(slice), alphaOf(column, kSliceRoughs));
    columnIsMade[number].store(true, std::memory_order_release);
}

const std::uint32_t* sliceMeans() {
    static const auto means = [] {
        constexpr int kSteps = 256;
        std::array<std::uint32_t, std::size_t{2} * kSlices> made{};
        for (int slice = 0; slice < 2 * kSlices; ++slice) {
            double sum = 0; // over the squares of cosines
            for (int i = 0; i < kSteps; ++i)
                sum += Fresnel(std::sqrt((i + 0.5) / kSteps), etaOf(slice)).part;
            made[static_cast<std::size_t>(slice)] = stored(sum / kSteps);
        }
        return made;
    }();
    return means.data();
}

} // namespace energy
