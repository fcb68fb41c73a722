// Computes the inverse discrete cosine transform of JPEG's 8 x 8 blocks in integers.
#include "image/jpeg_parts.h"

#include <algorithm>

namespace {

// The matrices hold sqrt(2) cos(k pi / 16) with 13 bits behind the point. Each number is the sum of
// the rounded factors by which the transform of Loeffler, Ligtenberg and Moschytz (ICASSP 1989)
// multiplies a coefficient on its way to a sample. Common decoders work that way, and this one
// gives the same samples; some numbers are 1 / 8192 off for that.
constexpr int kJpegCosineBits = 13;
constexpr std::int64_t kJpegOne = 1 << kJpegCosineBits;
constexpr std::int64_t kJpegEven[2][2] = {{10703, 4433}, {4433, -10704}}; // of coefficients 2, 6
constexpr std::int64_t kJpegOdd[4][4] = {{11363, 9633, 6437, 2260}, // of coefficients 1, 3, 5, 7
                                         {9633, -2259, -11362, -6436},
                                         {6437, -11362, 2261, 9633},
                                         {2260, -6436, 9633, -11363}};

// Transforms eight numbers; the result is sqrt(8) times as large as A.3.3 says for a direction.
// Each sum of even and each of odd coefficients serves two samples.
std::array<std::int64_t, kJpegSide> jpegCosineSums(const std::array<std::int64_t, kJpegSide>& x) {
    const auto even = [&](int i) { return kJpegEven[i][0] * x[2] + kJpegEven[i][1] * x[6]; };
    const auto odd = [&](int i) {
        const auto& row = kJpegOdd[i];
        return row[0] * x[1] + row[1] * x[3] + row[2] * x[5] + row[3] * x[7];
    };
    const std::int64_t sum = kJpegOne * (x[0] + x[4]), difference = kJpegOne * (x[0] - x[4]);
    const std::int64_t outer = even(0), inner = even(1);
    const std::int64_t evens[] = {sum + outer, difference + inner, difference - inner, sum - outer};
    const std::int64_t odds[] = {odd(0), odd(1), odd(2), odd(3)};
    return {evens[0] + odds[0], evens[1] + odds[1], evens[2] + odds[2], evens[3] + odds[3],
            evens[3] - odds[3], evens[2] - odds[2], evens[1] - odds[1], evens[0] - odds[0]};
}

std::int64_t jpegRounded(std::int64_t value, int bits) {
    return (value + (std::int64_t{1} << (bits - 1))) >> bits;
}

} // namespace

void inverseJpegTransform(const JpegBlock& block, const JpegSteps& steps, std::uint8_t* samples,
                          std::size_t stride) {
    // After the columns two bits stay behind the point, as in other decoders: more would not be
    // wrong, but another picture than theirs. A coefficient has up to 32 bits here, a sum of both
    // passes less than 60.
    constexpr int kKeptBits = 2;
    std::array<std::array<std::int64_t, kJpegSide>, kJpegSide> rows;
    for (std::size_t x = 0; x < kJpegSide; ++x) {
        std::array<std::int64_t, kJpegSide> column;
        std::int64_t other = 0; // is not zero if any coefficient but the first is not
        for (std::size_t y = 0; y < kJpegSide; ++y) {
            const std::size_t i = y * kJpegSide + x;
            column[y] = std::int64_t{block[i]} * steps.values[i];
            if (y > 0) other |= column[y];
        }
        if (other == 0) {
            for (auto& row : rows) row[x] = column[0] << kKeptBits;
            continue;
        }
        const auto sums = jpegCosineSums(column);
        for (std::size_t y = 0; y < kJpegSide; ++y)
            rows[y][x] = jpegRounded(sums[y], kJpegCosineBits - kKeptBits);
    }
    constexpr int kScaleBits = 3; // sqrt(8) twice
    constexpr std::int64_t kMiddle = 128;
    for (const auto& row : rows) {
        const auto sums = jpegCosineSums(row);
        for (std::size_t x = 0; x < kJpegSide; ++x)
            samples[x] = static_cast<std::uint8_t>(std::clamp<std::int64_t>(
                kMiddle + jpegRounded(sums[x], kJpegCosineBits + kKeptBits + kScaleBits), 0, 255));
        samples += stride;
    }
}

void transformJpegComponent(JpegComponent& component) {
    component.samples.resize(kJpegSide * component.storedRows * component.stride());
    const JpegBlock* block = component.coefficients.data();
    for (std::size_t row = 0; row < component.storedRows; ++row)
        for (std::size_t column = 0; column < component.storedColumns; ++column)
            inverseJpegTransform(*block++, component.steps, component.blockSamples(column, row),
                                 component.stride());
    ZeroedVector<JpegBlock>().swap(component.coefficients);
    ZeroedVector<std::uint8_t>().swap(component.ends);
}
