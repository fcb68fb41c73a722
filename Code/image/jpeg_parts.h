// The parts of the JPEG reader share this: the picture as its frame header describes it, and the
// steps from a file's bytes to pixels. Clauses are those of ITU-T T.81.
// Private to image/.
#pragma once

#include "base/raw_vector.h"
#include "image/formats.h"
#include "image/jpeg_bits.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

inline constexpr std::size_t kJpegSide = 8; // a block has 8 x 8 samples, or as many coefficients
using JpegBlock = std::array<std::int16_t, kJpegSide * kJpegSide>; // row by row

// This says where the coefficients of a block are, in the order of the file (figure A.6).
constexpr std::array<std::uint8_t, kJpegSide * kJpegSide> kJpegZigzag{
    0,  1,  8,  16, 9,  2,  3,  10, 17, 24, 32, 25, 18, 11, 4,  5,  12, 19, 26, 33, 40, 48,
    41, 34, 27, 20, 13, 6,  7,  14, 21, 28, 35, 42, 49, 56, 57, 50, 43, 36, 29, 22, 15, 23,
    30, 37, 44, 51, 58, 59, 52, 45, 38, 31, 39, 46, 53, 60, 61, 54, 47, 55, 62, 63};

// A quantisation table says what each coefficient is multiplied by, row by row like a block.
struct JpegSteps {
    std::array<std::uint16_t, kJpegSide * kJpegSide> values{};
    bool isDefined = false;
};

// A component is one of the planes of which a picture is made: Y, Cb, Cr or another colour.
struct JpegComponent {
    unsigned id = 0;
    std::size_t horizontal = 1, vertical = 1;      // sampling factors H and V
    std::size_t table = 0;                         // of quantisation
    std::size_t width = 0, height = 0;             // in samples
    std::size_t columns = 0, rows = 0;             // in blocks, without those that only fill an MCU
    std::size_t storedColumns = 0, storedRows = 0; // in blocks, filled up to whole MCUs

    bool hasScan = false;
    JpegSteps steps;                      // as they were before its first scan
    ZeroedVector<JpegBlock> coefficients; // of a progressive picture: storedColumns * storedRows
    ZeroedVector<std::uint8_t> ends;      // for each of those: from this number on all are 0
    // In a progressive picture this is the lowest bit that each coefficient, in zigzag order, has
    // so far.
    static constexpr int kNoBit = -1;
    std::array<int, kJpegSide * kJpegSide> lowestBit{};
    ZeroedVector<std::uint8_t> samples; // rows of stride()

    std::size_t stride() const { return kJpegSide * storedColumns; }
    std::uint8_t* blockSamples(std::size_t column, std::size_t row) {
        return samples.data() + kJpegSide * (row * stride() + column);
    }
};

struct JpegFrame {
    std::size_t width = 0, height = 0;
    std::size_t mostHorizontal = 1, mostVertical = 1; // of the sampling factors
    std::size_t mcuColumns = 0, mcuRows = 0; // MCUs of a scan that has more than one component
    bool isProgressive = false;
    std::vector<JpegComponent> components; // 1 or 3
};

// This is what a scan header says (B.2.3), and the tables that are in force.
struct JpegScan {
    struct Part {
        JpegComponent* component = nullptr;
        const JpegHuffman *dc = nullptr, *ac = nullptr; // defined where this scan needs them
    };
    std::vector<Part> parts;
    unsigned spectralStart = 0, spectralEnd = 0; // Ss, Se
    int highBit = 0, lowBit = 0;                 // Ah, Al
    std::size_t restartInterval = 0;             // in MCUs; 0: there are no restart markers
};

// Returns the frame that a SOF0, SOF1 or SOF2 segment describes, without any samples. `left` is how
// many bytes the file has after the segment; a picture that cannot fit into them is refused.
JpegFrame readJpegFrame(Bytes segment, bool isProgressive, std::size_t left,
                        const std::string& name);

// These read the tables of a DQT and of a DHT segment (B.2.4); each replaces the one of the same
// number. They fail when the segment is too short or its tables cannot be.
inline constexpr std::size_t kJpegTables = 4;
struct JpegTables {
    std::array<JpegSteps, kJpegTables> steps;
    std::array<JpegHuffman, kJpegTables> dc, ac;
};
void readJpegSteps(Bytes segment, JpegTables& tables, const std::string& name);
void readJpegHuffman(Bytes segment, JpegTables& tables, const std::string& name);

// Decodes the entropy-coded data of a scan, which start at the byte `at`: into samples, or into
// coefficients where the frame is progressive. Returns where the next marker may be looked for.
std::size_t decodeJpegScan(const JpegScan& scan, const JpegFrame& frame, Bytes file, std::size_t at,
                           const std::string& name);

// Computes the samples of a block from its quantised coefficients (A.3.3, A.3.4), eight in each of
// eight rows that are `stride` bytes apart.
void inverseJpegTransform(const JpegBlock& block, const JpegSteps& steps, std::uint8_t* samples,
                          std::size_t stride);
// Fills the samples of a progressive picture's component and frees its coefficients.
void transformJpegComponent(JpegComponent& component);

// Makes the picture of all samples. Without `isYcc` three components are RGB.
StoredImage jpegPicture(const JpegFrame& frame, bool isYcc);
