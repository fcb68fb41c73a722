// A file that is a text header and then values of one size: what PPM and PFM share when writing.
// Private to image/.
#pragma once

#include "base/for_each.h"
#include "base/in_order.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <utility>

// `count` items of `itemBytes` each; encode(first, count, out) writes some of them. The pieces are
// made on many threads and used in their order.
template <class Encode>
void makeRawFile(std::string_view header, std::size_t count, std::size_t itemBytes, int threads,
                 ByteSink use, const Encode& encode) {
    constexpr std::size_t kPieceBytes = std::size_t{1} << 17;
    const std::size_t perPiece = std::max<std::size_t>(1, kPieceBytes / itemBytes);
    const std::size_t pieces = (count + perPiece - 1) / perPiece;
    use({reinterpret_cast<const std::uint8_t*>(header.data()), header.size()});
    InOrder inOrder(pieces, use);
    forEachOn(threads, pieces, [&](std::size_t piece) {
        const std::size_t first = piece * perPiece, items = std::min(perPiece, count - first);
        InOrder::Bytes bytes = inOrder.buffer();
        bytes.resize(items * itemBytes);
        encode(first, items, bytes);
        inOrder.put(piece, std::move(bytes));
    });
}
