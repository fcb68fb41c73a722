// All that reading a text gives, so that ways to read it can be compared.
#pragma once

#include "check.h"
#include "desc/properties.h"
#include "read/read_context.h"
#include "unit/damage.h"

#include <cstdint>
#include <filesystem>
#include <initializer_list>
#include <string>
#include <utility>
#include <vector>

namespace check {

struct ReadOutcome {
    SceneDesc desc;
    std::vector<std::uint32_t> places; // two places always compare equal in a desc
    std::string said;
    std::vector<std::string> warnings;
    bool operator==(const ReadOutcome&) const = default;
};

// read(diagnostics) gives a scene.
template <class Read> ReadOutcome outcomeOf(const Read& read) {
    ReadOutcome out;
    Diagnostics diagnostics;
    out.said = thrown([&] { out.desc = read(diagnostics); });
    forEachBlock(out.desc, [&](const auto& block) { out.places.push_back(block.loc.offset); });
    out.warnings = std::move(diagnostics.warnings);
    return out;
}

// With so many threads, in parts of so many bytes.
using PartsWay = std::pair<int, std::size_t>;

// readWith(threads, partBytes) gives `one` in each of the ways.
template <class ReadWith>
void checkParts(const ReadOutcome& one, std::initializer_list<PartsWay> ways,
                const std::string& what, const ReadWith& readWith) {
    for (const auto& [threads, partBytes] : ways) {
        const ReadOutcome other = readWith(threads, partBytes);
        CHECK_INFO(other == one, what << ": " << threads << " threads, parts of " << partBytes
                                      << "; '" << other.said << "' instead of '" << one.said
                                      << "'");
    }
}

// use(text, name) for each file of the folders with that extension; how many there are.
template <class Use>
int forEachFile(std::initializer_list<const char*> folders, const std::string& extension,
                const Use& use) {
    int count = 0;
    for (const char* folder : folders)
        for (const auto& entry : std::filesystem::directory_iterator(folder)) {
            if (entry.path().extension() != extension) continue;
            use(damage::contentOf(entry.path()), entry.path().string());
            ++count;
        }
    return count;
}

} // namespace check
