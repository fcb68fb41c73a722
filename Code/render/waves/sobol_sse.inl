// What disk_lanes.inl asks of SSE4.2.
constexpr std::size_t kSobolLanes = 4;

// In each 16 bytes: those of `from` that the lower half of the bytes of `at` name.
template <class Bits> inline Bits pickBytes(Bits from, Bits at) {
    return reinterpret_cast<Bits>(
        _mm_shuffle_epi8(reinterpret_cast<__m128i>(from), reinterpret_cast<__m128i>(at)));
}

// Two roundings, which change nothing that disk_lanes.inl says.
inline Doubles fma(const Doubles& a, const Doubles& b, const Doubles& c) { return a * b + c; }
inline Doubles nearQuotient(const Doubles& a, const Doubles& b) { return a / b; }
// Lanes within 2^-40 of the middle between two floats.
inline unsigned nearMiddle(const Doubles& a) {
    const Doubles up = a * Doubles(1 + 0x1p-40), down = a * Doubles(1 - 0x1p-40);
    return bits(up.toFloats() == down.toFloats()) ^ ((1u << W) - 1);
}

#include "render/waves/disk_lanes.inl"
