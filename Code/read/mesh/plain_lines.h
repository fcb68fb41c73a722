// Lines of OBJ files as nearly all programs write them: "v 1 2.5 -3", "f 7//7 8//8 9//9", one blank
// in front of each word and nothing behind the last. Such a line is read at once; what is written
// in any other way, and all that is wrong, is left to LineReader.
#pragma once

#include "read/mesh/mesh_builder.h"
#include "read/mesh/obj_chunks.h"
#include "read/plain_number.h"

#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <type_traits>

// The start of the next line, when this one ends here.
inline const char* behindLineEnd(const char* p) {
    if (*p == '\r') ++p;
    return *p == '\n' ? p + 1 : nullptr;
}

// The numbers behind a keyword, all of the line. Returns the next line, or nullptr.
template <class T, std::size_t kCount>
const char* readPlainNumbers(const char* p, const char* end, double largest,
                             std::array<T, kCount>& numbers) {
    for (T& number : numbers) {
        double value = 0;
        if (*p != ' ') return nullptr;
        p = readPlainNumber(p + 1, end, value);
        if (!p || !(std::fabs(value) <= largest)) return nullptr;
        if constexpr (std::is_same_v<T, float>)
            if (!roundsOnce(value)) return nullptr;
        number = static_cast<T>(value);
    }
    return behindLineEnd(p);
}

// A face of three or four corners, whose indices count from the start of the file.
struct PlainFace {
    std::array<MeshBuilder::Corner, 4> corners;
    std::size_t count = 0;
};

// A number from 1 that there is.
inline const char* readPlainIndex(const char* p, std::size_t total, std::uint32_t& index) {
    const EightDigits digits = digitsAt(p);
    if (digits.count == 8 || digits.value == 0 || digits.value > total) return nullptr;
    index = digits.value - 1;
    return p + digits.count;
}

// From behind the keyword. Returns the next line, or nullptr.
inline const char* readPlainFace(const char* p, const char* end, const ObjCounts& total,
                                 PlainFace& face) {
    constexpr std::ptrdiff_t kMostRead = 4 * 24 + 8; // " 1234567/1234567/1234567"
    if (std::endian::native != std::endian::little || end - p < kMostRead) return nullptr;
    bool hasUv = false, hasNormal = false;
    for (face.count = 0; *p == ' '; ++face.count) {
        if (face.count == face.corners.size()) return nullptr;
        MeshBuilder::Corner corner;
        p = readPlainIndex(p + 1, total.points, corner.point);
        if (p && *p == '/') {
            if (*++p != '/') p = readPlainIndex(p, total.uvs, corner.uv);
            if (p && *p == '/') p = readPlainIndex(p + 1, total.normals, corner.normal);
        }
        if (!p) return nullptr;
        const bool uv = corner.uv != MeshBuilder::kMissing,
                   normal = corner.normal != MeshBuilder::kMissing;
        if (face.count == 0) hasUv = uv, hasNormal = normal;
        if (uv != hasUv || normal != hasNormal) return nullptr;
        face.corners[face.count] = corner;
    }
    return face.count < 3 ? nullptr : behindLineEnd(p);
}

// The words up to the end of a line in which nothing joins lines or begins a comment, and the start
// of the next line; nullptr when the text ends before the line does.
struct CountedWords {
    std::size_t words = 0;
    const char* next = nullptr;
};
inline CountedWords wordsOfLine(const char* p, const char* end) {
    constexpr std::uint64_t kOnes = 0x0101010101010101u, kHighs = 0x80 * kOnes;
    if (std::endian::native != std::endian::little) return {};
    CountedWords out;
    std::uint64_t isInWord = 0; // the last byte, as a bit
    for (; end - p >= 8; p += 8) {
        std::uint64_t bytes = 0;
        std::memcpy(&bytes, p, sizeof bytes); // the first one lowest
        const std::uint64_t isAbove = (((bytes & ~kHighs) + (0x80 - '!') * kOnes) | bytes) & kHighs;
        const std::uint64_t found = bytes ^ '\n' * kOnes;              // zero where the line ends
        const std::uint64_t isEnd = (found - kOnes) & ~found & kHighs; // right up to the first
        const std::uint64_t inLine = isEnd != 0 ? (isEnd & (0 - isEnd)) - 1 : ~std::uint64_t{0};
        const std::uint64_t starts = isAbove & ~((isAbove << 8) | isInWord) & inLine;
        // One bit in eight: a product adds them up.
        out.words += ((starts >> 7) * kOnes) >> 56;
        if (isEnd != 0) {
            out.next = p + std::countr_zero(isEnd) / 8 + 1;
            return out;
        }
        isInWord = isAbove >> 56;
    }
    return {};
}
