// Integer hashes: the same numbers on every machine, no state.
// Knows nothing about samples.
#pragma once

#include <cstdint>

// The finaliser of splitmix64 (Stafford's mix 13): every input bit flips each output bit with a
// probability of 1/2 within 1 %.
constexpr std::uint64_t mixBits(std::uint64_t x) {
    x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
    x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
    return x ^ (x >> 31);
}

// 2^64 over the golden ratio: steps by it are spread evenly (Weyl).
inline constexpr std::uint64_t kHashStep = 0x9e3779b97f4a7c15u;

// The step to the number that `c` leads to.
constexpr std::uint64_t hashStepOf(std::uint32_t c) { return (std::uint64_t{c} + 1) * kHashStep; }

// Several 32-bit numbers to 64 bits; the order matters. The added step keeps
// zeros from mapping to zero.
constexpr std::uint64_t hash(std::uint32_t a, std::uint32_t b) {
    return mixBits(((std::uint64_t{a} << 32) | b) + kHashStep);
}
constexpr std::uint64_t hash(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    return mixBits(hash(a, b) + hashStepOf(c));
}
constexpr std::uint32_t low32(std::uint64_t x) { return static_cast<std::uint32_t>(x); }
constexpr std::uint32_t high32(std::uint64_t x) { return static_cast<std::uint32_t>(x >> 32); }

// The 24 upper bits as a float in [0,1), on a grid of 2^-24.
constexpr float unitFloat(std::uint32_t bits) { return static_cast<float>(bits >> 8) * 0x1p-24f; }
