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
        const bool isNew = handles_.try_emplace(name, handle).second;
        if (isNew && known_.size() < kKnown && name.size() <= kLength) known_.push_back(name);
        return isNew;
    }
    Handle find(const std::string& name) const {
        const auto found = handles_.find(name);
        return found == handles_.end() ? kNone : found->second;
    }
    // For messages; the nearest name is looked for among so many and so short ones that it cannot
    // take long.
    const std::vector<std::string>& known() const { return known_; }

private:
    static constexpr std::size_t kKnown = 1000, kLength = 100;
    std::unordered_map<std::string, Handle> handles_;
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
