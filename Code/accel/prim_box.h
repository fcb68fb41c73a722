// PrimBox: a primitive while builders of trees sort it.
#pragma once

#include <array>
#include <bit>
#include <cstdint>

// The upper corner is negated: growing a box is one minimum over all lanes. The fourth lane of lo
// is the number of the primitive, kept as a normal float since arithmetic on denormal ones is slow;
// that of negHi is free.
struct alignas(32) PrimBox {
    std::array<float, 4> lo, negHi;
    static constexpr std::uint32_t kNormal = 0x40000000u;
    std::uint32_t id() const { return std::bit_cast<std::uint32_t>(lo[3]) & ~kNormal; }
};
static_assert(sizeof(PrimBox) == 32);
