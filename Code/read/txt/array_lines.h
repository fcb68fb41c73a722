// The arrays of a mesh as programs write them, a group of numbers on each line: threads can read
// such lines at the same time, because lines are counted quickly.
#pragma once

#include "base/for_each.h"
#include "desc/range.h"
#include "desc/scene_desc.h"
#include "read/line_chunks.h"
#include "read/number.h"
#include "read/txt/scanner.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

// How a number of an array is read, and how many make a group.
template <class Group> struct GroupOf;
template <> struct GroupOf<Vec3d> {
    static constexpr std::size_t kSize = 3;
    static constexpr double kLargest = kLargestLength;
    static NumberRead<double> read(const char* p) { return readDouble(p); }
    static double& number(Vec3d& v, std::size_t i) { return v[i]; }
};
template <> struct GroupOf<Vec3> {
    static constexpr std::size_t kSize = 3;
    static constexpr float kLargest = 1e15f; // its square is far from the end of float
    static NumberRead<float> read(const char* p) { return readFloat(p); }
    static float& number(Vec3& v, std::size_t i) { return v[i]; }
};
template <> struct GroupOf<Vec2> {
    static constexpr std::size_t kSize = 2;
    static constexpr float kLargest = 1e15f;
    static NumberRead<float> read(const char* p) { return readFloat(p); }
    static float& number(Vec2& v, std::size_t i) { return i == 0 ? v.x : v.y; }
};
template <> struct GroupOf<MeshDesc::Corners> {
    static constexpr std::size_t kSize = 3;
    static NumberRead<std::uint32_t> read(const char* p) { return readUnsigned(p); }
    static std::uint32_t& number(MeshDesc::Corners& c, std::size_t i) { return c[i]; }
};
template <> struct GroupOf<std::uint32_t> {
    static constexpr std::size_t kSize = 1;
    static NumberRead<std::uint32_t> read(const char* p) { return readUnsigned(p); }
    static std::uint32_t& number(std::uint32_t& n, std::size_t) { return n; }
};

// Behind the end of the line, if nothing else is left of it; else nullptr.
inline const char* behindLineEnd(const char* p) {
    while (*p == ' ' || *p == '\t') ++p;
    if (*p == '\r') ++p;
    return *p == '\n' ? p + 1 : nullptr;
}

struct LinesRead {
    const char* end = nullptr; // behind the last number
    std::uint32_t largestIndex = 0;
};

// One group of numbers. Returns what is behind it; nullptr when there is something else.
template <class Group>
const char* readLine(const char* p, Group& group, std::uint32_t& largestIndex) {
    using Of = GroupOf<Group>;
    for (std::size_t i = 0; i < Of::kSize; ++i) {
        while (*p == ' ' || *p == '\t') ++p;
        const auto number = Of::read(p);
        if (number.fault != NumberFault::None || !Scanner::endsNumber(*number.end)) return nullptr;
        if constexpr (requires { Of::kLargest; }) {
            if (!(std::fabs(number.value) <= Of::kLargest)) return nullptr;
        } else {
            largestIndex = std::max(largestIndex, number.value);
        }
        Of::number(group, i) = number.value;
        p = number.end;
    }
    return p;
}

template <class Group>
std::optional<LinesRead> readChunk(const LineChunk& chunk, std::span<Group> groups) {
    LinesRead read;
    const char* p = chunk.first;
    for (Group& group : groups.subspan(chunk.before, chunk.lines)) {
        read.end = readLine(p, group, read.largestIndex);
        p = read.end ? behindLineEnd(read.end) : nullptr;
        if (!p) return {};
    }
    return read;
}

// `text` is behind the count of the array. Nothing when the array is small, or not written as said
// above, or wrong: who reads it number by number finds out.
template <class Group>
std::optional<LinesRead> readLines(const char* text, const char* end, std::span<Group> groups,
                                   int threads) {
    constexpr std::size_t kWorthThreads = 10'000;
    const char* const first = behindLineEnd(text);
    if (!first || threads <= 1 || groups.size() < kWorthThreads) return {};
    const std::vector<LineChunk> chunks = chunksOfLines(first, end, groups.size(), threads);
    if (chunks.empty() || chunks.back().before + chunks.back().lines < groups.size()) return {};
    std::vector<std::optional<LinesRead>> read(chunks.size());
    forEachOn(threads, chunks.size(),
              [&](std::size_t c) { read[c] = readChunk(chunks[c], groups); });
    LinesRead all;
    for (const auto& some : read) {
        if (!some) return {};
        all = {some->end, std::max(all.largestIndex, some->largestIndex)};
    }
    return all;
}
