// NameTable: which thing has a name, for many names that are looked up once or twice each.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string_view>
#include <vector>

// An open table with linear probing: one line of memory per look-up, and no allocation per name as
// in std::unordered_map. The names must outlive it.
class NameTable {
public:
    // For at most `count` names.
    explicit NameTable(std::size_t count) {
        std::size_t size = 16;
        while (size < 2 * count) size *= 2; // at least half stays empty
        slots_.resize(size);
    }

    // Remembers the number, unless the name was there already; then says the number that it has.
    std::optional<std::uint32_t> insert(std::string_view name, std::uint32_t number) {
        Slot& slot = slots_[placeOf(name)];
        if (slot.name.data() != nullptr) return slot.number;
        slot = {name, number};
        return {};
    }
    std::optional<std::uint32_t> find(std::string_view name) const {
        const Slot& slot = slots_[placeOf(name)];
        if (slot.name.data() == nullptr) return {};
        return slot.number;
    }

private:
    struct Slot {
        std::string_view name; // data() is null where there is none
        std::uint32_t number = 0;
    };
    // Where the name is, or where it would be.
    std::size_t placeOf(std::string_view name) const {
        const std::size_t mask = slots_.size() - 1;
        std::size_t i = std::hash<std::string_view>{}(name)&mask;
        while (slots_[i].name.data() != nullptr && slots_[i].name != name) i = (i + 1) & mask;
        return i;
    }
    std::vector<Slot> slots_;
};
