// NameTable: which thing has a name, for many names that are looked up once or twice each.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

// An open table with linear probing: one line of memory per look-up, and no allocation per name as
// in std::unordered_map. The names must outlive it.
class NameTable {
public:
    // Grows beyond `expected` names at some cost.
    explicit NameTable(std::size_t expected = 0) {
        std::size_t size = 16;
        while (size < 2 * expected) size *= 2; // at least half stays empty
        slots_.resize(size);
    }

    // Remembers the number, unless the name was there already; then says the number that it has.
    std::optional<std::uint32_t> insert(std::string_view name, std::uint32_t number) {
        const std::uint32_t hash = hashOf(name);
        std::size_t place = placeOf(name, hash);
        if (!slots_[place].isEmpty()) return slots_[place].number;
        if (2 * ++used_ > slots_.size()) {
            grow();
            place = placeOf(name, hash);
        }
        slots_[place] = {name, number, hash};
        return {};
    }
    std::optional<std::uint32_t> find(std::string_view name) const {
        const Slot& slot = slots_[placeOf(name, hashOf(name))];
        if (slot.isEmpty()) return {};
        return slot.number;
    }

private:
    struct Slot {
        std::string_view name; // data() is null where there is none
        std::uint32_t number = 0, hash = 0;
        bool isEmpty() const { return name.data() == nullptr; }
    };
    static std::uint32_t hashOf(std::string_view name) {
        return static_cast<std::uint32_t>(std::hash<std::string_view>{}(name));
    }
    // Where the name is, or where it would be.
    std::size_t placeOf(std::string_view name, std::uint32_t hash) const {
        const std::size_t mask = slots_.size() - 1;
        std::size_t i = hash & mask;
        while (!slots_[i].isEmpty() && (slots_[i].hash != hash || slots_[i].name != name))
            i = (i + 1) & mask;
        return i;
    }
    void grow() {
        const std::size_t mask = 4 * slots_.size() - 1;
        std::vector<Slot> larger(mask + 1);
        for (const Slot& slot : slots_) {
            if (slot.isEmpty()) continue;
            std::size_t i = slot.hash & mask;
            while (!larger[i].isEmpty()) i = (i + 1) & mask;
            larger[i] = slot;
        }
        slots_ = std::move(larger);
    }

    std::vector<Slot> slots_;
    std::size_t used_ = 0;
};
