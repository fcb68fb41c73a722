// Names in a scene in JSON: how things find each other, and how each thing gets a name of its own.
#pragma once

#include "base/text.h"
#include "desc/scene_desc.h"

#include <cstddef>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

// From names to places in a vector of SceneDesc.
class JsonNames {
public:
    // False when the name is there already; then the first one counts.
    bool add(const std::string& name, Handle handle) {
        const auto [entry, isNew] = entries_.try_emplace(name, Entry{handle, 0});
        ++entry->second.uses;
        if (isNew && known_.size() < kKnown && name.size() <= kLength) known_.push_back(name);
        return isNew;
    }
    Handle find(const std::string& name) const {
        const auto found = entries_.find(name);
        return found == entries_.end() ? kNone : found->second.handle;
    }
    // How often it was added.
    std::size_t uses(const std::string& name) const {
        const auto found = entries_.find(name);
        return found == entries_.end() ? 0 : found->second.uses;
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
    std::unordered_map<std::string, Entry> entries_;
    std::vector<std::string> known_;
};

// The native description wants names that are unique; JSON scenes repeat them, or have none.
class UniqueNames {
public:
    // "box", "box.2", "box.3"
    std::string of(const std::string& wanted) {
        std::size_t& count = counts_[wanted];
        if (++count == 1) return wanted;
        while (true) {
            const std::string name = cat(wanted, ".", count);
            if (counts_.try_emplace(name, 1).second) return name;
            ++count;
        }
    }

private:
    std::unordered_map<std::string, std::size_t> counts_;
};
