// A file that is a text header and then values of one size: what PPM and PFM share when writing.
// Private to image/.
#pragma once

#include "base/for_each.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

// `count` items of `itemBytes` each; encode(first, count, out) writes some of them.
template <class Encode>
std::vector<std::uint8_t> rawFile(std::string_view header, std::size_t count, std::size_t itemBytes,
                                  int threads, const Encode& encode) {
    constexpr std::size_t kPartBytes = std::size_t{1} << 18;
    std::vector<std::uint8_t> file(header.size() + count * itemBytes);
    std::copy(header.begin(), header.end(), file.begin());
    const std::span<std::uint8_t> body = std::span(file).subspan(header.size());
    const std::size_t perPart = std::max<std::size_t>(1, kPartBytes / itemBytes);
    forEachOn(threads, (count + perPart - 1) / perPart, [&](std::size_t part) {
        const std::size_t first = part * perPart, items = std::min(perPart, count - first);
        encode(first, items, body.subspan(first * itemBytes, items * itemBytes));
    });
    return file;
}
