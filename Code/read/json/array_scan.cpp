#include "read/json/array_scan.h"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <cstring>

#if defined(__SSE2__)
#include <emmintrin.h>
#endif

namespace {

constexpr std::size_t kBlock = 64;

// A bit for each byte of a block, the first one lowest.
struct Marks {
    std::uint64_t quotes = 0, backslashes = 0, opens = 0, closes = 0;
};

// '[' and '{', and ']' and '}', differ by this bit.
constexpr char kCurly = 0x20;

#if defined(__SSE2__)
Marks marksOf(const char* block) {
    Marks marks;
    const auto add = [](std::uint64_t& bits, __m128i bytes, char wanted, unsigned at) {
        const auto equal =
            static_cast<unsigned>(_mm_movemask_epi8(_mm_cmpeq_epi8(bytes, _mm_set1_epi8(wanted))));
        bits |= std::uint64_t{equal} << at;
    };
    for (unsigned at = 0; at < kBlock; at += 16) {
        const __m128i bytes = _mm_loadu_si128(reinterpret_cast<const __m128i*>(block + at));
        const __m128i curly = _mm_or_si128(bytes, _mm_set1_epi8(kCurly));
        add(marks.quotes, bytes, '"', at);
        add(marks.backslashes, bytes, '\\', at);
        add(marks.opens, curly, '{', at);
        add(marks.closes, curly, '}', at);
    }
    return marks;
}
#else
Marks marksOf(const char* block) {
    Marks marks;
    for (std::size_t i = 0; i < kBlock; ++i) {
        const char c = block[i], curly = static_cast<char>(c | kCurly);
        marks.quotes |= std::uint64_t{c == '"'} << i;
        marks.backslashes |= std::uint64_t{c == '\\'} << i;
        marks.opens |= std::uint64_t{curly == '{'} << i;
        marks.closes |= std::uint64_t{curly == '}'} << i;
    }
    return marks;
}
#endif

// What lies in texts, block after block: their opening quotes included, their closing ones not
// (Langdale, Lemire 2019).
class InTexts {
public:
    std::uint64_t next(const Marks& marks) {
        std::uint64_t inside = marks.quotes & ~escaped(marks.backslashes);
        for (int shift = 1; shift < 64; shift *= 2) inside ^= inside << shift;
        inside ^= wasInside_;
        wasInside_ = inside >> 63 ? ~std::uint64_t{0} : 0;
        return inside;
    }

private:
    // What stands behind a backslash that is not escaped itself. There are few.
    std::uint64_t escaped(std::uint64_t backslashes) {
        std::uint64_t out = wasEscaping_ ? 1 : 0;
        wasEscaping_ = false;
        for (; backslashes != 0; backslashes &= backslashes - 1) {
            const std::uint64_t one = std::uint64_t{1} << std::countr_zero(backslashes);
            if (out & one) continue;
            out |= one << 1;
            wasEscaping_ = one >> 63 != 0;
        }
        return out;
    }

    std::uint64_t wasInside_ = 0; // all bits
    bool wasEscaping_ = false;
};

} // namespace

JsonArrayScan scanJsonArray(const char* open, const char* end, std::size_t partBytes) {
    JsonArrayScan scan;
    InTexts inTexts;
    JsonPart part{open, open, '['};
    int depth = 0;
    for (const char* p = open; p < end; p += kBlock) {
        const auto left = static_cast<std::size_t>(end - p);
        char rest[kBlock] = {};
        if (left < kBlock) std::memcpy(rest, p, left);
        const Marks marks = marksOf(left < kBlock ? rest : p);
        std::uint64_t brackets = (marks.opens | marks.closes) & ~inTexts.next(marks);
        for (; brackets != 0; brackets &= brackets - 1) {
            const int at = std::countr_zero(brackets);
            if (marks.opens >> at & 1) {
                ++depth;
            } else if (--depth == 1) {
                ++scan.items;
                part.last = p + at + 1;
                if (static_cast<std::size_t>(part.last - part.first) < partBytes) continue;
                scan.parts.push_back(part);
                part = {part.last, part.last, ','};
            } else if (depth == 0) {
                if (part.last > part.first) scan.parts.push_back(part);
                scan.end = p + at + 1;
                return scan;
            }
        }
    }
    return scan;
}
