// What disk_lanes.inl asks of AVX2.
constexpr std::size_t kSobolLanes = 8;

// In each 16 bytes: those of `from` that the lower half of the bytes of `at` name.
template <class Bits> inline Bits pickBytes(Bits from, Bits at) {
    return reinterpret_cast<Bits>(
        _mm256_shuffle_epi8(reinterpret_cast<__m256i>(from), reinterpret_cast<__m256i>(at)));
}

#include "render/waves/disk_lanes.inl"
