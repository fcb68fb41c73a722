#include "render/denoised.h"

#include "base/math.h"
#include "base/parallel.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace {

// A place is what is so far around it each way, weighted as two boxes after each other.
constexpr int kReach = 8, kBoxes = 2;
// Squares of D fall by so much when samples double: independent ones by 2, those of smooth places by 8.
constexpr double kLeastGrowth = 2, kMostGrowth = 8;

// Errors count by the slope from R to S of what is measured, but of values that are so far apart at least.
constexpr double kLeastReach = 0x1p-12;

// Sums over channels and places, as the error is measured: of D^2, D H and (S - R)^2, and of D^2 now and
// two doublings before.
struct Squares {
    double noise = 0, kept = 0, change = 0, now = 0, before = 0;

    Squares& operator+=(const Squares& o) {
        noise += o.noise, kept += o.kept, change += o.change, now += o.now, before += o.before;
        return *this;
    }
};

class Blend {
public:
    Blend(const HalvedPicture& picture, const Image& past, const ErrorMeasure& measure, const Isa& isa,
          int threads)
        : raw_(picture.color), past_(past), measure_(measure), filtered_(denoise(picture, isa, threads)),
          pool_(threads), width_(raw_.mean.width()), height_(raw_.mean.height()),
          own_(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_)) {}

    DenoisedPicture run() {
        forEachRow([&](int y) {
            for (int x = 0; x < width_; ++x) own_[indexOf(x, y)] = squaresAt(x, y);
        });
        std::vector<Squares> around = own_;
        for (int box = 0; box < kBoxes; ++box) sumAround(around);

        DenoisedPicture out{Image(width_, height_)};
        std::vector<double> errors(static_cast<std::size_t>(height_));
        forEachRow([&](int y) {
            double& sum = errors[static_cast<std::size_t>(y)];
            for (int x = 0; x < width_; ++x) {
                const Squares &own = own_[indexOf(x, y)], &place = around[indexOf(x, y)];
                const double q = 1 / (growthOf(place) - 1);
                const double gain = q * (place.noise - place.kept);
                const double b = place.change > 0 ? clamp(gain / place.change, 0.0, 1.0) : 0;
                sum += q * own.noise - 2 * b * (q * own.noise - own.kept) + sqr(b) * own.change;
                const Rgb raw = raw_.mean.pixel(x, y);
                out.color.setPixel(x, y, raw + (filteredAt(x, y) - raw) * static_cast<float>(b));
            }
        });
        double sum = 0;
        for (const double error : errors) sum += error;
        out.error = std::sqrt(max(sum, 0.0) / (3.0 * width_ * height_));
        return out;
    }

private:
    template <class Fn> void forEachRow(const Fn& fn) {
        const auto row = [&](std::size_t y, int) { fn(static_cast<int>(y)); };
        pool_.run(static_cast<std::size_t>(height_), row);
    }
    std::size_t indexOf(int x, int y) const {
        return static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) +
               static_cast<std::size_t>(x);
    }
    static double growthOf(const Squares& place) {
        if (!(place.now > 0)) return 2;
        return clamp(std::sqrt(place.before / place.now), kLeastGrowth, kMostGrowth);
    }

    Rgb filteredAt(int x, int y) const {
        return (filtered_[0].pixel(x, y) + filtered_[1].pixel(x, y)) * 0.5f;
    }

    Squares squaresAt(int x, int y) const {
        const Rgb r = raw_.mean.pixel(x, y), d = raw_.difference.pixel(x, y);
        const Rgb f = filtered_[0].pixel(x, y), g = filtered_[1].pixel(x, y);
        Squares sum;
        const auto add = [&](double raw, double half, double first, double second) {
            const double change = (first + second) / 2 - raw, left = (first - second) / 2;
            const double reach = max(std::fabs(change) / 2, kLeastReach);
            const double slope = measure_.of(raw + change / 2, reach) / reach;
            sum.noise += sqr(slope * half);
            sum.kept += sqr(slope) * half * left;
            sum.change += sqr(slope * change);
        };
        add(r.r, d.r, f.r, g.r), add(r.g, d.g, f.g, g.g), add(r.b, d.b, f.b, g.b);
        const double all = d.r * d.r + d.g * d.g + d.b * d.b;
        const double scale = all > 0 ? sum.noise / all : 0; // of how D counts here
        const Rgb past = past_.pixel(x, y);
        sum.now = past.r * scale, sum.before = past.g * scale;
        return sum;
    }

    // Every place becomes the sum of those up to kReach away in its row, then in its column.
    void sumAround(std::vector<Squares>& places) {
        std::vector<Squares> rows(places.size());
        forEachRow([&](int y) {
            for (int x = 0; x < width_; ++x)
                for (int i = std::max(x - kReach, 0); i <= std::min(x + kReach, width_ - 1); ++i)
                    rows[indexOf(x, y)] += places[indexOf(i, y)];
        });
        forEachRow([&](int y) {
            for (int x = 0; x < width_; ++x) {
                Squares sum;
                for (int j = std::max(y - kReach, 0); j <= std::min(y + kReach, height_ - 1); ++j)
                    sum += rows[indexOf(x, j)];
                places[indexOf(x, y)] = sum;
            }
        });
    }

    const HalvedImage& raw_;
    const Image& past_;
    const ErrorMeasure& measure_;
    std::array<Image, 2> filtered_;
    ThreadPool pool_;
    int width_, height_;
    std::vector<Squares> own_;
};

} // namespace

DenoisedPicture denoisedPicture(const HalvedPicture& picture, const Image& past,
                                const ErrorMeasure& measure, const Isa& isa, int threads) {
    return Blend(picture, past, measure, isa, threads).run();
}
