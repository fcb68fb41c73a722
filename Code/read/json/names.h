// Names in a scene in JSON: how things find each other.
#pragma once

#include "base/text.h"
#include "desc/name_table.h"
#include "desc/names.h"
#include "desc/scene_desc.h"

#include <cstddef>
#include <cstdint>
#include <deque>
#include <string>
#include <string_view>
#include <vector>

// From names to places in a vector of SceneDesc.
class JsonNames {
public:
    // False when the name is there already; then the first one counts.
    bool add(std::string_view name, Handle handle) {
        const auto first =
            table_.insert(names_.emplace_back(name), static_cast<std::uint32_t>(entries_.size()));
        if (first) {
            names_.pop_back();
            ++entries_[*first].uses;
            return false;
        }
        entries_.push_back({handle, 1});
        if (known_.size() < kKnown && name.size() <= kLength) known_.push_back(shown(name));
        return true;
    }
    Handle find(std::string_view name) const {
        const auto found = table_.find(name);
        return found ? entries_[*found].handle : kNone;
    }
    // How often it was added.
    std::size_t uses(std::string_view name) const {
        const auto found = table_.find(name);
        return found ? entries_[*found].uses : 0;
    }
    // For messages; the nearest name is looked for among so many and so short ones that it cannot
    // take long.
    const std::vector<std::string>& known() const { return known_; }

private:
    static constexpr std::size_t kKnown = 1000, kLength = 100;
    struct Entry {
        Handle handle;
        std::size_t uses;
    };
    std::deque<std::string> names_; // which stay where they are
    NameTable table_;               // numbers of entries
    std::vector<Entry> entries_;
    std::vector<std::string> known_;
};
