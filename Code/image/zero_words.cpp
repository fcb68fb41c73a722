#include "image/zero_words.h"

#include "image/byte_lanes.h"
#include "image/word_codes.h"

#include <algorithm>

namespace {

constexpr std::size_t kPiece = WordList::kMost * kWordBytes;
constexpr std::size_t kPiecesPerSample = 4; // pieces, of which one is counted
static_assert(kLeastOfZeroWords >= 2 * kPiecesPerSample * kPiece);

std::span<const std::uint8_t> pieceAt(std::span<const std::uint8_t> bytes, std::size_t at) {
    return bytes.subspan(at, std::min(kPiece, bytes.size() - at));
}

} // namespace

bool putZeroWords(BitWriter& out, std::span<const std::uint8_t> bytes, bool last) {
    if (bytes.size() < kLeastOfZeroWords) return false;
    const auto inWords = bytes.first(bytes.size() / kWordBytes * kWordBytes);
    WordCounts counts;
    WordList words;
    std::size_t counted = 0;
    for (std::size_t at = kPiecesPerSample / 2 * kPiece; at < inWords.size();
         at += kPiecesPerSample * kPiece) {
        words.find(pieceAt(inWords, at), 0);
        counts.add(words);
        counted += pieceAt(inWords, at).size();
    }
    const SymbolCounts symbols = counts.symbols();
    const DynamicCodes dynamic(symbols, WordCodes::kLongest);
    const WordCodes codes(dynamic);

    const BitWriter::Place start = out.place();
    // The header, and what the sample promises with a twentieth more.
    out.makeRoom(dynamic.bits(symbols) * (20 + 21 * bytes.size() / counted) / 20);
    dynamic.putHeader(out, last);
    std::size_t zeroWords = 0;
    for (std::size_t at = 0; at < inWords.size(); at += kPiece) {
        words.find(pieceAt(inWords, at), zeroWords);
        out.makeRoom(WordCodes::mostBits(words, zeroWords));
        byteLanes().putWords(out, words, codes);
        zeroWords = words.zeroWordsBehind();
    }
    codes.putEnd(out, zeroWords, bytes.subspan(inWords.size()));
    if (out.bitsSince(start) <= 8 * bytes.size()) return true;
    out.goBackTo(start);
    return false;
}
