#include "light/sky/sky_table.h"

#include "base/math.h"
#include "base/parallel.h"

#include <algorithm>

namespace {

// Random numbers are multiples of 2^-24: so are the borders between cells, and each is chosen as
// often as it says.
constexpr double kGrid = 0x1p24;

// out[i] is the part of the sum that lies before number i; out[count] is 1. Numbers above 0 get a
// step each, if that leaves enough.
void writeParts(std::span<const double> numbers, float* out) {
    double sum = 0;
    std::size_t lit = 0;
    for (const double number : numbers) sum += number, lit += number > 0 ? 1 : 0;
    double below = 0, steps = 0;
    // The rest of the grid is shared out by the numbers.
    const double rest = kGrid - static_cast<double>(lit);
    for (std::size_t i = 0; i < numbers.size(); ++i) {
        out[i] = static_cast<float>((std::floor(rest * min(below / sum, 1.0)) + steps) / kGrid);
        below += numbers[i], steps += numbers[i] > 0 ? 1 : 0;
    }
    out[numbers.size()] = 1;
}

} // namespace

SkyTable::SkyTable(int width, int height, std::span<const float> luminance, bool compensated,
                   SkyPlace place, int threads)
    : width_(static_cast<std::uint32_t>(width)), height_(static_cast<std::uint32_t>(height)),
      place_(place) {
    const std::size_t columns = width_, rows = height_;
    for (std::size_t j = 0; j <= rows; ++j) {
        const double part = static_cast<double>(j) / static_cast<double>(rows);
        borders_.push_back(j == rows ? 1 : j == 0 ? -1 : -exact::cos(kPi * part));
    }
    const auto share = [&](std::size_t j) { return (borders_[j + 1] - borders_[j]) / 2; };
    ThreadPool pool(threads);
    std::vector<double> ofRows(rows);
    const auto sumUp = [&](const auto& weight) {
        pool.run(rows, [&](std::size_t j, int) {
            double sum = 0;
            for (std::size_t i = 0; i < columns; ++i) sum += weight(luminance[j * columns + i]);
            ofRows[j] = sum / static_cast<double>(columns) * share(j);
        });
        double sum = 0;
        for (const double row : ofRows) sum += row;
        return sum;
    };
    mean_ = sumUp([](float l) { return static_cast<double>(l); });
    double less = compensated ? mean_ : 0, more = compensated ? 0 : mean_ * 1e-3;
    const auto weight = [&](float l) { return max(static_cast<double>(l) - less, 0.0) + more; };
    // A sky of one brightness is nowhere brighter than its mean, but for rounding.
    if (!(sumUp(weight) > mean_ * 1e-6)) {
        less = 0, more = mean_ > 0 ? mean_ * 1e-3 : 1;
        sumUp(weight);
    }
    rows_.resize(rows + 1), columns_.resize(rows * (columns + 1));
    writeParts(ofRows, rows_.data());
    pool.run(rows, [&](std::size_t j, int) {
        std::vector<double> numbers(columns);
        for (std::size_t i = 0; i < columns; ++i) numbers[i] = weight(luminance[j * columns + i]);
        if (ofRows[j] > 0) writeParts(numbers, columns_.data() + j * (columns + 1));
    });
}
