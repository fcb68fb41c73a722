// Unpacks PIZ blocks (the OpenEXR library, ImfPizCompressor and ImfWav): 16-bit numbers that were
// numbered without gaps, transformed by a two-dimensional Haar wavelet and packed by a Huffman
// code.
#include "image/exr_blocks.h"

#include "base/text.h"
#include "image/bits.h"

#include <algorithm>
#include <bit>
#include <utility>

namespace {

// A plane is 16-bit numbers in columns and rows: a HALF channel, or one half of each FLOAT.
struct ExrPlane {
    std::span<std::uint16_t> values;
    std::size_t columns = 0, rows = 0;
    std::size_t first = 0, columnStep = 0, rowStep = 0; // places in `values`

    std::uint16_t& at(std::size_t x, std::size_t y) const {
        return values[first + x * columnStep + y * rowStep];
    }
};

// Both structures undo the wavelet of two numbers: `low` is their mean, `high` their difference.
struct ExrSignedPair { // for numbers below 2^14, where nothing overflows
    static void undo(std::uint16_t& low, std::uint16_t& high) {
        const int mean = static_cast<std::int16_t>(low);
        const int difference = static_cast<std::int16_t>(high);
        const int a = mean + (difference & 1) + (difference >> 1);
        low = static_cast<std::uint16_t>(a);
        high = static_cast<std::uint16_t>(a - difference);
    }
};
struct ExrModuloPair { // for all others: modulo 2^16
    static void undo(std::uint16_t& low, std::uint16_t& high) {
        const int mean = low, difference = high;
        const int b = (mean - (difference >> 1)) & 0xFFFF;
        low = static_cast<std::uint16_t>(difference + b - 0x8000);
        high = static_cast<std::uint16_t>(b);
    }
};

// Undoes the wavelet from the coarsest level to the finest: squares of 2 x 2 numbers that are
// `step` apart, and pairs where a column or a row is left over.
template <class Pair> void undoExrWavelet(const ExrPlane& plane) {
    const std::size_t side = std::min(plane.columns, plane.rows);
    for (std::size_t step = std::bit_floor(side) / 2; step >= 1; step /= 2) {
        const std::size_t wholeColumns = plane.columns / (2 * step) * (2 * step);
        const std::size_t wholeRows = plane.rows / (2 * step) * (2 * step);
        for (std::size_t y = 0; y < wholeRows; y += 2 * step) {
            for (std::size_t x = 0; x < wholeColumns; x += 2 * step) {
                std::uint16_t& a = plane.at(x, y);
                std::uint16_t& b = plane.at(x + step, y);
                std::uint16_t& c = plane.at(x, y + step);
                std::uint16_t& d = plane.at(x + step, y + step);
                Pair::undo(a, c);
                Pair::undo(b, d);
                Pair::undo(a, b);
                Pair::undo(c, d);
            }
            if ((plane.columns & step) != 0)
                Pair::undo(plane.at(wholeColumns, y), plane.at(wholeColumns, y + step));
        }
        if ((plane.rows & step) != 0)
            for (std::size_t x = 0; x < wholeColumns; x += 2 * step)
                Pair::undo(plane.at(x, wholeRows), plane.at(x + step, wholeRows));
    }
}

// PIZ numbers those of the 65536 possible numbers that occur without gaps. A set of bits says which
// they are; zero counts as one of them.
class ExrNumbering {
public:
    // Reads the first and the last byte of the bits that is not zero, and the bytes from the first
    // to the last, which are missing when the first is behind the last. `packed` loses them.
    ExrNumbering(Bytes& packed, const std::string& name) {
        if (packed.size() < 4) brokenPiz(name, "it ends in the middle of its header");
        const std::size_t first = loadLittle<std::uint16_t>(packed.data());
        const std::size_t last = loadLittle<std::uint16_t>(packed.data() + 2);
        packed = packed.subspan(4);
        constexpr std::size_t kBytes = 8192;
        if (first >= kBytes || last >= kBytes) brokenPiz(name, "its set of numbers is too large");
        Bytes bits;
        if (first <= last) {
            if (last - first + 1 > packed.size())
                brokenPiz(name, "it ends in the middle of its numbers");
            bits = packed.first(last - first + 1);
            packed = packed.subspan(bits.size());
        }
        for (std::size_t i = 0; i < 8 * bits.size(); ++i) {
            const std::size_t number = 8 * first + i;
            if (number != 0 && (bits[i / 8] >> i % 8 & 1) != 0)
                numbers_.push_back(static_cast<std::uint16_t>(number));
        }
    }

    // Damaged files have places behind the last one; zero is there.
    std::uint16_t operator[](std::uint16_t place) const {
        return place < numbers_.size() ? numbers_[place] : std::uint16_t{0};
    }
    std::size_t last() const { return numbers_.size() - 1; } // the largest place

private:
    std::vector<std::uint16_t> numbers_ = {0};
};

} // namespace

void brokenPiz(const std::string& name, std::string_view what) {
    failPicture(name, cat("broken PIZ data: ", what, "; the file is damaged"));
}

std::vector<std::uint8_t> unpackExrPiz(const ExrBlock& block, Bytes packed,
                                       const std::string& name) {
    const ExrNumbering numbering(packed, name);
    if (packed.size() < 4) brokenPiz(name, "it has no codes");
    const std::size_t length = loadLittle<std::uint32_t>(packed.data());
    packed = packed.subspan(4);
    if (length > packed.size())
        brokenPiz(name, cat(packed.size(), " bytes of codes instead of ", length));
    std::vector<std::uint16_t> words(block.bytes() / 2); // one channel after the other
    unpackExrHuffman(packed.first(length), words, name);

    std::size_t first = 0;
    for (const ExrChannel& channel : block.channels) {
        const std::size_t perValue = channel.bytes() / 2, perRow = perValue * block.columns;
        for (std::size_t half = 0; half < perValue; ++half) {
            const ExrPlane plane{words, block.columns, block.rows, first + half, perValue, perRow};
            if (numbering.last() < 0x4000)
                undoExrWavelet<ExrSignedPair>(plane);
            else
                undoExrWavelet<ExrModuloPair>(plane);
        }
        first += perRow * block.rows;
    }

    std::vector<std::uint8_t> out(block.bytes());
    std::uint8_t* to = out.data();
    for (std::size_t y = 0; y < block.rows; ++y) {
        const std::uint16_t* from = words.data();
        for (const ExrChannel& channel : block.channels) {
            const std::size_t perRow = channel.bytes() / 2 * block.columns;
            for (std::size_t i = 0; i < perRow; ++i, to += 2)
                storeLittle(to, numbering[from[y * perRow + i]]);
            from += perRow * block.rows;
        }
    }
    return out;
}
