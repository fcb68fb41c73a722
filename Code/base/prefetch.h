// Memory asked for ahead of its use.
#pragma once

#include <cstddef>

// All lines of the cache that an object aligned to them lies in; of others the last may be missing.
template <class T> inline void prefetch(const T& what) {
    const auto* const bytes = reinterpret_cast<const std::byte*>(&what);
    for (std::size_t at = 0; at < sizeof what; at += 64) __builtin_prefetch(bytes + at);
}
