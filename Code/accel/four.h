// Four numbers at once by the vectors of g++ and clang++: every machine has them, as instructions
// or as a row of single ones, and each lane computes what a single number would.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>

using Four = float __attribute__((vector_size(16)));
using FourInts = std::int32_t __attribute__((vector_size(16)));

// `from` and `to` are multiples of 16 bytes.
inline Four loadFour(const float* from) {
    Four v;
    std::memcpy(&v, __builtin_assume_aligned(from, 16), sizeof v);
    return v;
}
template <class Numbers> void storeFour(const Numbers& v, void* to) {
    static_assert(sizeof v == 16);
    std::memcpy(__builtin_assume_aligned(to, 16), &v, sizeof v);
}
inline Four allFour(float x) { return Four{x, x, x, x}; }
// The second one where a number is NaN, as min() and max() of base/math.h.
inline Four least(Four a, Four b) { return a < b ? a : b; }
inline Four most(Four a, Four b) { return a > b ? a : b; }
