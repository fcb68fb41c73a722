// Reads the tables of a JPEG file: quantisation (ITU-T T.81, B.2.4.1) and Huffman codes (B.2.4.2).
#include "base/text.h"
#include "image/jpeg_parts.h"

#include <numeric>

void readJpegSteps(Bytes segment, JpegTables& tables, const std::string& name) {
    while (!segment.empty()) {
        const unsigned number = segment[0] & 15, wide = segment[0] >> 4;
        if (number >= kJpegTables || wide > 1)
            failPicture(name, cat("a quantisation table has the number ", number,
                                  " and the precision ", wide, "; 0 to 3 and 0 or 1"));
        const std::size_t bytes = wide + 1, size = kJpegZigzag.size() * bytes;
        if (segment.size() < 1 + size)
            failPicture(name, cat("the quantisation table ", number, " has ", segment.size() - 1,
                                  " bytes; ", size));
        JpegSteps& steps = tables.steps[number];
        steps.isDefined = true;
        for (std::size_t i = 0; i < kJpegZigzag.size(); ++i) {
            const Bytes value = segment.subspan(1 + i * bytes, bytes);
            const int step = wide != 0 ? value[0] << 8 | value[1] : value[0];
            if (step == 0)
                failPicture(name, cat("a step of the quantisation table ", number,
                                      " is 0; it must be at least 1"));
            steps.values[kJpegZigzag[i]] = static_cast<std::uint16_t>(step);
        }
        segment = segment.subspan(1 + size);
    }
}

void readJpegHuffman(Bytes segment, JpegTables& tables, const std::string& name) {
    constexpr std::size_t kHeader = 1 + JpegHuffman::kLongest, kMostSymbols = 256;
    while (!segment.empty()) {
        const unsigned number = segment[0] & 15, use = segment[0] >> 4;
        if (number >= kJpegTables || use > 1)
            failPicture(name, cat("a Huffman table has the number ", number, " and the class ", use,
                                  "; 0 to 3 and 0 or 1"));
        if (segment.size() < kHeader)
            failPicture(name, cat("the Huffman table ", number, " has ", segment.size(),
                                  " bytes; at least ", kHeader));
        const Bytes counts = segment.subspan(1, JpegHuffman::kLongest);
        const std::size_t size = std::accumulate(counts.begin(), counts.end(), std::size_t{0});
        if (size > kMostSymbols || size > segment.size() - kHeader)
            failPicture(name, cat("the Huffman table ", number, " has ", size, " codes, but ",
                                  segment.size() - kHeader, " bytes for them; one each, at most ",
                                  kMostSymbols));
        JpegHuffman& table = (use == 0 ? tables.dc : tables.ac)[number];
        if (!table.define(counts, segment.subspan(kHeader, size)))
            failPicture(name, cat("the Huffman table ", number,
                                  " has more short codes than there can be; the file is damaged"));
        segment = segment.subspan(kHeader + size);
    }
}
