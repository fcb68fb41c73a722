// What the operations of simd_ops.h are given and how what they make is taken apart, in the lanes
// of this unit.
#pragma once

#include "simd/lanes.h"
#include "unit/simd_op.h"

#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <type_traits>

LANES_BEGIN

using simd_ops::Alike;
using simd_ops::Numbers;
using simd_ops::Op;

struct Given {
    const Numbers& in;
    std::size_t first;
    unsigned chosen;
    Floats a, b, c;
    Doubles x, y;
    Ints i, j;
    Mask m;

    Given(const Numbers& n, std::size_t from)
        : in(n), first(from), chosen(n.chosen >> from & ((1u << W) - 1)),
          a(Floats::load(n.a + from)), b(Floats::load(n.b + from)), c(Floats::load(n.c + from)),
          x(Doubles::load(n.x + from)), y(Doubles::load(n.y + from)), i(Ints::load(n.i + from)),
          j(Ints::load(n.j + from)), m(maskOf(chosen)) {}
};

// What an operation made of W numbers, as bits.
struct Made {
    std::uint64_t of[W];

    Made(Floats a) {
        alignas(64) float all[W];
        a.store(all);
        for (int k = 0; k < W; ++k) of[k] = std::bit_cast<std::uint32_t>(all[k]);
    }
    Made(Ints a) {
        alignas(64) std::uint32_t all[W];
        a.store(all);
        for (int k = 0; k < W; ++k) of[k] = all[k];
    }
    Made(const Doubles& a) {
        alignas(64) double all[W];
        a.store(all);
        for (int k = 0; k < W; ++k) of[k] = std::bit_cast<std::uint64_t>(all[k]);
    }
    Made(Mask m) : Made(bits(m)) {}
    Made(unsigned lanes) {
        for (int k = 0; k < W; ++k) of[k] = lanes >> k & 1;
    }
    // fn(k) for each lane
    template <class Fn>
    requires std::is_invocable_r_v<std::uint64_t, Fn, std::size_t>
    explicit Made(const Fn& fn) {
        for (std::size_t k = 0; k < W; ++k) of[k] = fn(k);
    }
};

inline std::uint64_t both(std::uint32_t low, std::uint32_t high) {
    return std::uint64_t{high} << 32 | low;
}
inline std::uint64_t both(float low, float high) {
    return both(std::bit_cast<std::uint32_t>(low), std::bit_cast<std::uint32_t>(high));
}
// Words in one number that differs when one of them does.
inline std::uint64_t mixedWords(const void* words, std::size_t count) {
    std::uint64_t mixed = 0;
    for (std::size_t k = 0; k < count; ++k) {
        std::uint32_t word;
        std::memcpy(&word, static_cast<const char*>(words) + 4 * k, sizeof word);
        mixed = (mixed ^ word) * 1099511628211u;
    }
    return mixed;
}

inline Floats orOne(Floats a) { return select(a == a, a, Floats(1.0f)); } // for NaN
inline Floats fromOneToTwo(Floats a) {
    return fromBits(plus(masked(bitsOf(a), 0x7fffff), 0x3f800000));
}
inline unsigned allIf(bool is) { return is ? (1u << W) - 1 : 0; }

// What operations compute goes by their types: numbers may be any NaN.
template <class Fn>
constexpr Op op(const char* name, Fn, std::uint64_t (*other)(const Numbers&, std::size_t) = {}) {
    using Result = std::invoke_result_t<Fn, const Given&>;
    return {name,
            std::is_same_v<Result, Floats>    ? Alike::Float
            : std::is_same_v<Result, Doubles> ? Alike::Double
                                              : Alike::Bits,
            [](const Numbers& in, std::size_t first, std::uint64_t* out) {
                const Made made(Fn()(Given(in, first)));
                std::memcpy(out + first, made.of, sizeof made.of);
            },
            other};
}
// Where also the bits of NaN are those of an operand.
template <class Fn> constexpr Op exactOp(const char* name, Fn fn) {
    Op exact = op(name, fn);
    exact.alike = Alike::Bits;
    return exact;
}
inline std::uint64_t bitsOfFloat(float a) { return std::bit_cast<std::uint32_t>(a); }

// Tables to look up in, of which every word is another.
inline constexpr std::size_t kTable = 320;
struct Tables {
    alignas(64) float floats[kTable];
    alignas(64) double doubles[kTable];
    alignas(64) std::uint32_t words[kTable];
    std::uint8_t bytes[kTable];
};
inline constexpr Tables kTables = [] {
    Tables t{};
    for (std::uint32_t k = 0; k < kTable; ++k) {
        t.floats[k] = static_cast<float>(k) + 0.25f, t.doubles[k] = k + 0.5;
        t.words[k] = k * 0x9e3779b9u, t.bytes[k] = static_cast<std::uint8_t>(k * 0x9du);
    }
    return t;
}();

// Each lane's number of the chosen ones, which lie one behind the other in `packed`.
template <class Fn> Made unpacked(unsigned chosen, const Fn& packed) {
    return Made([&](std::size_t k) -> std::uint64_t {
        const auto before = static_cast<std::size_t>(std::popcount(chosen & ((1u << k) - 1)));
        return (chosen >> k & 1) != 0 ? packed(before) : 0;
    });
}

LANES_END
