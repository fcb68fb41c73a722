// One operation of lanes as test_simd_lanes.cpp compares it between the sets of instructions.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace simd_ops {

inline constexpr std::size_t kNumbers = 16; // as many as the widest registers have

// What operations are given: as many numbers of each kind as there are in the widest registers.
struct Numbers {
    alignas(64) float a[kNumbers], b[kNumbers], c[kNumbers];
    alignas(64) double x[kNumbers], y[kNumbers];
    alignas(64) std::uint32_t i[kNumbers], j[kNumbers];
    unsigned chosen; // bits of lanes
};

// What must be alike of two results.
enum class Alike {
    Bits,
    Float,  // bits of a float, or both NaN
    Double, // the same of a double
};

struct Op {
    const char* name;
    Alike alike;
    // Writes what becomes of as many numbers as there are lanes, from `first` on, to out[first] ...
    void (*run)(const Numbers& in, std::size_t first, std::uint64_t* out);
    // Another result for this number that is right, too; null where there is none.
    std::uint64_t (*other)(const Numbers& in, std::size_t number) = nullptr;
};

// The same operations, in the same order; these run only on machines that have the instructions.
std::span<const Op> sse();
std::span<const Op> avx2();
std::span<const Op> avx512();

} // namespace simd_ops
