// WholeSum: a sum of colours in whole numbers, so that it is the same for any order and any
// division of its samples (Code/README.md, P1).
#pragma once

#include "base/math.h"
#include "base/vec.h"

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>

// Values are told in units, a power of two. A sample is rounded to 2^-40 units, to the nearest,
// ties to even, and taken as kMost units where it has more: floats of 2^-16 units and above are
// exact. A sum is right up to 2^52 units.
class WholeSum {
public:
    static constexpr float kMost = 0x1p36f;
    // More samples than these may not come at a time.
    static constexpr std::size_t kTogether = 4096;

    // Whole numbers of 2^-10 units, and 0 to 2^30 - 1 times 2^-40 units: one form for each value.
    using Wholes = std::array<std::int64_t, 3>;
    Wholes coarse{}, fine{};
    bool operator==(const WholeSum&) const = default;

    // `perUnit`, a power of two: so many units are 1.
    void add(Rgb value, double perUnit) {
        Wholes c{}, f{};
        addTo(c, f, value, perUnit);
        take(c, f);
    }
    void add(const WholeSum& other) { take(other.coarse, other.fine); }
    // The same sum `times` times, up to 2^32.
    void addTimes(const WholeSum& other, std::uint32_t times) {
        Wholes c{}, f{};
        for (std::size_t i = 0; i < 3; ++i)
            c[i] = other.coarse[i] * times, f[i] = other.fine[i] * times;
        take(c, f);
    }
    Vec3d value() const { return {valueOf(0), valueOf(1), valueOf(2)}; }

    // What a sum of this sample alone is; float to float.
    static Rgb rounded(Rgb value, double perUnit) {
        const auto isKept = [&](float v) {
            const double size = std::fabs(static_cast<double>(v) * perUnit);
            return (size >= 0x1p-16 && size <= static_cast<double>(kMost)) || v == 0;
        };
        if (isKept(value.r) && isKept(value.g) && isKept(value.b))
            return {value.r + 0.0f, value.g + 0.0f, value.b + 0.0f}; // no -0
        WholeSum one;
        one.add(value, perUnit);
        const Vec3 v = toFloat(one.value() / perUnit);
        return {v.x, v.y, v.z};
    }

    // Are all of them below 2^10 units in size, and numbers?
    static bool areSmall(std::span<const Rgb> values, double perUnit) {
        using Floats __attribute__((vector_size(16))) = float;
        using Bits __attribute__((vector_size(16))) = std::int32_t;
        const float large = static_cast<float>(0x1p10 / perUnit);
        const float* const all = &values.data()->r;
        const std::size_t size = 3 * values.size();
        Bits small = ~Bits{};
        std::size_t i = 0;
        for (; i + 4 <= size; i += 4) {
            Floats some;
            std::memcpy(&some, all + i, sizeof some);
            small &= (some < large) & (some > -large); // not so of what is no number
        }
        std::int32_t are = small[0] & small[1] & small[2] & small[3];
        for (; i < size; ++i) are &= all[i] < large && all[i] > -large ? -1 : 0;
        return are != 0;
    }
    // Adds samples of which areSmall() is true, at most kTogether.
    void addSmall(std::span<const Rgb> values, double perUnit) {
        // Doubles at 2^52 and above have no digits behind the point: adding 1.5 * 2^52 rounds, and
        // the bits of the sum are those of 1.5 * 2^52 plus the whole number.
        using Pair __attribute__((vector_size(16))) = double;
        using Wide __attribute__((vector_size(16))) = std::int64_t;
        using Floats __attribute__((vector_size(8))) = float;
        constexpr std::size_t kSamples = 4, kPairs = 3 * kSamples / 2;
        const double toFine = kFine * perUnit;
        const Pair scale{toFine, toFine}, magic{kMagic, kMagic};
        Wide sums[kPairs] = {};
        const float* at = &values.data()->r;
        std::size_t left = values.size();
        for (; left >= kSamples; left -= kSamples, at += 3 * kSamples)
#pragma GCC unroll 6
            for (std::size_t k = 0; k < kPairs; ++k) {
                Floats pair;
                std::memcpy(&pair, at + 2 * k, sizeof pair);
                sums[k] +=
                    std::bit_cast<Wide>(__builtin_convertvector(pair, Pair) * scale + magic) -
                    std::bit_cast<Wide>(magic);
            }
        Wholes f{};
        for (std::size_t n = 0; n < 3 * kSamples; ++n) f[n % 3] += sums[n / 2][n % 2];
        for (std::size_t n = 0; n < 3 * left; ++n)
            f[n % 3] += rounded(static_cast<double>(at[n]) * toFine);
        take({}, f);
    }

private:
    static constexpr double kMagic = 0x1.8p52, kFine = 0x1p40, kCoarse = 0x1p10;
    static constexpr int kCarry = 30;

    // To the nearest whole number, below 2^51 in size.
    static std::int64_t rounded(double v) {
        return std::bit_cast<std::int64_t>(v + kMagic) - std::bit_cast<std::int64_t>(kMagic);
    }
    static void addTo(Wholes& c, Wholes& f, Rgb value, double perUnit) {
        for (std::size_t i = 0; i < 3; ++i) {
            const float one = i == 0 ? value.r : i == 1 ? value.g : value.b;
            const double most = kMost;
            const double v = min(max(static_cast<double>(one) * perUnit, -most), most);
            const std::int64_t large = rounded(v * kCoarse);
            c[i] += large;
            f[i] += rounded((v - static_cast<double>(large) / kCoarse) * kFine);
        }
    }
    void take(const Wholes& c, const Wholes& f) {
        for (std::size_t i = 0; i < 3; ++i) {
            const std::int64_t sum = fine[i] + f[i];
            coarse[i] += c[i] + (sum >> kCarry);
            fine[i] = sum & ((std::int64_t{1} << kCarry) - 1);
        }
    }
    double valueOf(std::size_t i) const {
        return static_cast<double>(coarse[i]) / kCoarse + static_cast<double>(fine[i]) / kFine;
    }
};
