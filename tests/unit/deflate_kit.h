// Bytes to pack.
#pragma once

#include "image/zlib.h"

#include <cstdint>
#include <vector>

using Buffer = std::vector<std::uint8_t>;

inline std::uint32_t nextRandom(std::uint32_t& state) { // Numerical Recipes
    state = state * 1664525u + 1013904223u;
    return state >> 8;
}

inline void add(Buffer& to, const Buffer& more) { to.insert(to.end(), more.begin(), more.end()); }

// A whole stream.
inline Buffer packedAs(Packing packing, const Buffer& bytes) {
    Buffer packed = deflatePiece(bytes, true, packing, {kZlibHeader.begin(), kZlibHeader.end()});
    const auto end = zlibEnd(adler32(bytes));
    packed.insert(packed.end(), end.begin(), end.end());
    return packed;
}
