// SameNames: the blocks that have the name of one in front of them, found by several threads. Names
// are spread over small tables by their hashes, so that each table stays in a cache.
#pragma once

#include "base/for_each.h"
#include "desc/name_table.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

class SameNames {
public:
    SameNames(std::size_t count, std::size_t together)
        : together_(together), seen_(count), parts_((count + together - 1) / together) {}

    // Each block once; parts of `together` blocks by different threads, each sorted when all of its
    // names were seen. The names must stay.
    void see(std::size_t i, std::string_view name) {
        seen_[i] = {NameTable::hashOf(name), static_cast<std::uint32_t>(i)};
    }
    void sort(std::size_t first) {
        Part& part = parts_[first / together_];
        const std::span<Seen> seen =
            std::span(seen_).subspan(first, std::min(together_, seen_.size() - first));
        std::array<std::uint32_t, kTables + 1> count{};
        for (const Seen& s : seen) ++count[tableOf(s) + 1];
        for (std::size_t t = 0; t < kTables; ++t) count[t + 1] += count[t];
        part.begin = count;
        part.sorted.resize(seen.size());
        for (const Seen& s : seen) part.sorted[count[tableOf(s)]++] = s;
    }

    struct Pair {
        std::uint32_t first, second; // with the same name, and nobody before or in between
    };
    // By their second ones; nameOf(i) is the name of block i.
    template <class NameOf> std::vector<Pair> find(const NameOf& nameOf, int threads) const {
        std::array<std::vector<Pair>, kTables> found;
        forEachOn(seen_.size() < kMany ? 1 : threads, kTables, [&](std::size_t t) {
            std::size_t names = 0;
            for (const Part& part : parts_) names += part.begin[t + 1] - part.begin[t];
            if (names < 2) return;
            NameTable table(names);
            for (const Part& part : parts_)
                for (std::uint32_t at = part.begin[t]; at < part.begin[t + 1]; ++at) {
                    const auto [hash, i] = part.sorted[at];
                    if (const auto first = table.insert(nameOf(i), hash, i))
                        found[t].push_back({*first, i});
                }
        });
        std::vector<Pair> all;
        for (const auto& some : found) all.insert(all.end(), some.begin(), some.end());
        std::sort(all.begin(), all.end(),
                  [](const Pair& a, const Pair& b) { return a.second < b.second; });
        return all;
    }

private:
    struct Seen {
        std::uint32_t hash, number;
    };
    static constexpr std::size_t kTables = 64, kMany = 1 << 13;
    // Not by the bits that the tables use.
    static std::size_t tableOf(const Seen& s) { return s.hash >> 26; }
    struct Part {
        std::array<std::uint32_t, kTables + 1> begin{}; // of the tables' names
        std::vector<Seen> sorted;
    };
    std::size_t together_;
    std::vector<Seen> seen_;
    std::vector<Part> parts_;
};
