// Sums of the samples of two pixels at a time: in one alone each addition waits for the one before.
// What Film::addNumbers() does, for samples of which it would leave none out.
#pragma once

#include "base/vec.h"

#include <cstddef>
#include <cstdint>
#include <cstring>

namespace two_sums {

static_assert(sizeof(Rgb) == 3 * sizeof(float));

// Is every one of them so small that three are no infinity together? Then all are numbers.
inline bool areSmall(const Rgb* values, std::size_t count) {
    constexpr std::size_t kLanes = 4;
    using Floats __attribute__((vector_size(kLanes * sizeof(float)))) = float;
    using Bits __attribute__((vector_size(kLanes * sizeof(float)))) = std::int32_t;
    constexpr float kLarge = 0x1p126f;
    const float* const all = &values->r;
    const std::size_t size = 3 * count;
    Bits small = ~Bits{};
    std::size_t i = 0;
    for (; i + kLanes <= size; i += kLanes) {
        Floats some;
        std::memcpy(&some, all + i, sizeof some);
        small &= (some < kLarge) & (some > -kLarge); // not so of what is no number
    }
    std::int32_t are = small[0] & small[1] & small[2] & small[3];
    for (; i < size; ++i) are &= all[i] < kLarge && all[i] > -kLarge ? -1 : 0;
    return are != 0;
}

// Adds `count` samples to each sum in their order, the second one's behind the first one's.
inline void add(Vec3d& first, Vec3d& second, const Rgb* values, std::size_t count) {
    using Pair __attribute__((vector_size(2 * sizeof(double)))) = double;
    using Floats __attribute__((vector_size(2 * sizeof(float)))) = float;
    struct Sum {
        explicit Sum(const Vec3d& from) : rg{from.x, from.y}, b(from.z) {}
        void add(const Rgb& value) {
            Floats pair;
            std::memcpy(&pair, &value, sizeof pair);
            rg += __builtin_convertvector(pair, Pair);
            b += static_cast<double>(value.b);
        }
        Vec3d vec() const { return {rg[0], rg[1], b}; }
        Pair rg;
        double b;
    } a(first), b(second);
    for (std::size_t i = 0; i < count; ++i) a.add(values[i]), b.add(values[count + i]);
    first = a.vec(), second = b.vec();
}

} // namespace two_sums
