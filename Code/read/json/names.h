// Names in a scene in JSON: how things find each other.
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
