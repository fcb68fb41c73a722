// What PPM and PFM share: a text header, of words between white space and # comments up to the line
// end, and behind it values of one size.
// Private to image/.
#pragma once

#include "base/for_each.h"
#include "base/parallel.h"
#include "image/formats.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <utility>

class NetpbmHeader {
public:
    // The first two bytes are the magic number, as the caller has checked.
    NetpbmHeader(Bytes file, const std::string& name) : file_(file), name_(name) {}

    std::string_view magic() const { return text(0, 2); }
    // The next whole number (0 .. 10^9) or finite real number that is not zero. Fails with
    // "name:line:col" when there is none; `what` says which one is expected.
    long long number(std::string_view what);
    double real(std::string_view what);
    // The next whole number of a plain raster, at most `most`.
    std::uint32_t sample(std::uint32_t most);
    // The `size` bytes that follow the one white space after the header. Fails when there are less.
    Bytes data(std::size_t size);
    // Skips white space and comments; false at the end of the file.
    bool hasMore();
    // Bytes from the current place on.
    std::size_t left() const { return file_.size() - at_; }
    // Fails at the start of the word that was read last.
    [[noreturn]] void failHere(const std::string& what) const;

private:
    std::string_view text(std::size_t from, std::size_t count) const {
        return {reinterpret_cast<const char*>(file_.data()) + from, count};
    }
    std::string_view word(std::string_view what);
    void skipComment();

    Bytes file_;
    const std::string& name_;
    std::size_t at_ = 2; // after the letter and digit of the kind
    std::size_t wordStart_ = 0;
};

// Writes such a file: `count` items of `itemBytes` each; encode(first, count, out) writes some of
// them. The pieces are made on many threads and used in their order.
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
