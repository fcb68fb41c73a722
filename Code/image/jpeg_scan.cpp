// Decodes the entropy-coded data of a JPEG scan, which is sequential (ITU-T T.81, annex F) or
// progressive (annex G).
#include "base/text.h"
#include "image/jpeg_parts.h"

#include <algorithm>
#include <limits>

namespace {

class JpegScanDecoder {
public:
    JpegScanDecoder(const JpegScan& scan, const JpegFrame& frame, Bytes file, std::size_t at,
                    const std::string& name)
        : scan_(scan), frame_(frame), name_(name), bits_(file, at, name) {}

    std::size_t decode() {
        if (!frame_.isProgressive)
            walk([this](const Place& place) { sequential(place); });
        else if (scan_.spectralStart == 0 && scan_.highBit == 0)
            walk([this](const Place& place) { firstDc(place); });
        else if (scan_.spectralStart == 0)
            walk([this](const Place& place) { refineDc(place); });
        else if (scan_.highBit == 0)
            walk([this](const Place& place) { firstAc(place); });
        else
            walk([this](const Place& place) { refineAc(place); });
        return bits_.position();
    }

private:
    struct Place { // where a block is
        std::size_t part, column, row;
    };

    // Calls decodeBlock(Place) for each block in the order of the scan (A.2), and steps over the
    // restart markers.
    template <class DecodeBlock> void walk(DecodeBlock decodeBlock) {
        const JpegComponent& first = *scan_.parts[0].component;
        const bool isSingle = scan_.parts.size() == 1;
        const std::size_t columns = isSingle ? first.columns : frame_.mcuColumns;
        const std::size_t rows = isSingle ? first.rows : frame_.mcuRows;
        std::size_t untilRestart = scan_.restartInterval;
        unsigned restarts = 0;
        for (std::size_t row = 0; row < rows; ++row)
            for (std::size_t column = 0; column < columns; ++column) {
                if (scan_.restartInterval != 0 && untilRestart == 0) {
                    restart(restarts++ % 8);
                    untilRestart = scan_.restartInterval;
                }
                if (scan_.restartInterval != 0) --untilRestart;
                if (isSingle)
                    decodeBlock(Place{0, column, row});
                else
                    walkMcu(column, row, decodeBlock);
            }
    }
    template <class DecodeBlock>
    void walkMcu(std::size_t column, std::size_t row, DecodeBlock decodeBlock) {
        for (std::size_t part = 0; part < scan_.parts.size(); ++part) {
            const JpegComponent& component = *scan_.parts[part].component;
            for (std::size_t v = 0; v < component.vertical; ++v)
                for (std::size_t h = 0; h < component.horizontal; ++h)
                    decodeBlock(
                        {part, column * component.horizontal + h, row * component.vertical + v});
        }
    }
    void restart(unsigned number) {
        bits_.restart(number);
        predictions_ = {};
        endOfBandRun_ = 0;
    }

    // The DC coefficient is coded as the difference from the one before (F.2.2.1).
    std::int16_t nextDc(std::size_t part, int scale) {
        constexpr unsigned kMostBits = 15;
        const unsigned size = bits_.symbol(*scan_.parts[part].dc);
        if (size > kMostBits)
            failPicture(name_, cat("a DC coefficient has ", size, " bits; at most ", kMostBits));
        predictions_[part] += bits_.takeSigned(size);
        return scaled(predictions_[part], scale);
    }
    std::int16_t scaled(int value, int scale) const {
        const int product = value * scale; // it fits: 17 bits times 2^13
        constexpr int kMost = std::numeric_limits<std::int16_t>::max();
        if (product < -kMost || product > kMost)
            failPicture(name_, cat("a coefficient is ", product, "; at most ", kMost));
        return static_cast<std::int16_t>(product);
    }

    void sequential(const Place& place) {
        const JpegScan::Part& part = scan_.parts[place.part];
        JpegBlock block{};
        block[0] = nextDc(place.part, 1);
        for (unsigned k = 1; k < block.size(); ++k) {
            const unsigned symbol = bits_.symbol(*part.ac);
            const unsigned zeros = symbol >> 4, size = symbol & 15;
            if (size == 0 && zeros < kZeroRun) break; // the block ends
            k += zeros;
            if (size == 0) continue;
            checkIndex(k, block.size() - 1);
            block[kJpegZigzag[k]] = static_cast<std::int16_t>(bits_.takeSigned(size));
        }
        JpegComponent& component = *part.component;
        inverseJpegTransform(block, component.steps,
                             component.blockSamples(place.column, place.row), component.stride());
    }
    void checkIndex(std::size_t index, std::size_t last) const {
        if (index > last)
            failPicture(name_, cat("a block has a coefficient with the number ", index,
                                   "; at most ", last, " in this scan"));
    }

    JpegBlock& blockAt(const Place& place) {
        return scan_.parts[place.part].component->coefficients[indexOf(place)];
    }
    std::uint8_t& endAt(const Place& place) {
        return scan_.parts[place.part].component->ends[indexOf(place)];
    }
    std::size_t indexOf(const Place& place) const {
        return place.row * scan_.parts[place.part].component->storedColumns + place.column;
    }
    // Sets an AC coefficient that was 0.
    void put(const Place& place, unsigned k, std::int16_t value) {
        checkIndex(k, scan_.spectralEnd);
        blockAt(place)[kJpegZigzag[k]] = value;
        std::uint8_t& end = endAt(place);
        end = std::max(end, static_cast<std::uint8_t>(k + 1));
    }
    void firstDc(const Place& place) { blockAt(place)[0] = nextDc(place.part, unit()); }
    void refineDc(const Place& place) {
        std::int16_t& value = blockAt(place)[0];
        if (bits_.take(1) != 0) value = static_cast<std::int16_t>(value | unit());
    }

    // Decodes the first scan of a band of AC coefficients (G.1.2.2).
    void firstAc(const Place& place) {
        if (endOfBandRun_ > 0) {
            --endOfBandRun_;
            return;
        }
        for (unsigned k = scan_.spectralStart; k <= scan_.spectralEnd; ++k) {
            const unsigned symbol = bits_.symbol(*scan_.parts[0].ac);
            const unsigned zeros = symbol >> 4, size = symbol & 15;
            if (size == 0 && zeros < kZeroRun) {
                endOfBandRun_ = endOfBandRun(zeros) - 1;
                return;
            }
            k += zeros;
            if (size == 0) continue;
            put(place, k, scaled(bits_.takeSigned(size), unit()));
        }
    }
    // Returns how many blocks, with this one, have no more coefficients in this band.
    unsigned endOfBandRun(unsigned exponent) { return (1u << exponent) + bits_.take(exponent); }

    // Adds one bit to a band of AC coefficients (G.1.2.3): to those that are there, and new ones.
    void refineAc(const Place& place) {
        JpegBlock& block = blockAt(place);
        unsigned k = scan_.spectralStart;
        while (endOfBandRun_ == 0 && k <= scan_.spectralEnd) {
            const unsigned symbol = bits_.symbol(*scan_.parts[0].ac);
            const unsigned zeros = symbol >> 4, size = symbol & 15;
            if (size > 1)
                failPicture(name_, cat("a new coefficient has ", size, " bits; it must have 1"));
            if (size == 0 && zeros < kZeroRun) {
                endOfBandRun_ = endOfBandRun(zeros);
                break;
            }
            const int fresh = size == 0 ? 0 : bits_.take(1) != 0 ? unit() : -unit();
            k = refineUpToZero(block, k, zeros);
            if (fresh != 0) put(place, k, static_cast<std::int16_t>(fresh));
            ++k;
        }
        if (endOfBandRun_ == 0) return;
        // Many scans of nothing but zeros would take long otherwise.
        if (k < endAt(place)) refineUpToZero(block, k, kJpegZigzag.size());
        --endOfBandRun_;
    }
    // Takes the next bit of each coefficient that is not zero, from the number k on, until `zeros`
    // zeros have been passed. Returns the number of the zero after those, or one behind the band.
    unsigned refineUpToZero(JpegBlock& block, unsigned k, std::size_t zeros) {
        for (; k <= scan_.spectralEnd; ++k) {
            std::int16_t& value = block[kJpegZigzag[k]];
            if (value == 0) {
                if (zeros == 0) break;
                --zeros;
            } else if (bits_.take(1) != 0) {
                value = static_cast<std::int16_t>(value + (value > 0 ? unit() : -unit()));
            }
        }
        return k;
    }
    int unit() const { return 1 << scan_.lowBit; }

    static constexpr unsigned kZeroRun = 15; // without a coefficient it means 16 zeros

    const JpegScan& scan_;
    const JpegFrame& frame_;
    const std::string& name_;
    JpegBits bits_;
    std::array<int, 3> predictions_{}; // the last DC coefficient of each part
    unsigned endOfBandRun_ = 0;        // so many blocks more have no new coefficients
};

} // namespace

std::size_t decodeJpegScan(const JpegScan& scan, const JpegFrame& frame, Bytes file, std::size_t at,
                           const std::string& name) {
    return JpegScanDecoder(scan, frame, file, at, name).decode();
}
