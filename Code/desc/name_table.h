// NameTable: which thing has a name, for many names that are looked up once or twice each.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

// An open table with linear probing: eight bytes per place, so that tables of many names stay in a
// cache, and no allocation per name as in std::unordered_map. The names must outlive it.
class NameTable {
public:
    // Grows beyond `expected` names at some cost.
    explicit NameTable(std::size_t expected = 0) {
        std::size_t size = 16;
        while (size < 2 * expected) size *= 2; // at least half stays empty
        places_.resize(size);
        names_.reserve(expected);
    }

    // Remembers the number, unless the name was there already; then says the number that it has.
    std::optional<std::uint32_t> insert(std::string_view name, std::uint32_t number) {
        return insert(name, hashOf(name), number);
    }
    // Where the hash is known, most names themselves are not looked at.
    std::optional<std::uint32_t> insert(std::string_view name, std::uint32_t hash,
                                        std::uint32_t number) {
        std::size_t at = placeOf(name, hash);
        if (!places_[at].isEmpty()) return nameAt(places_[at]).number;
        if (2 * (names_.size() + 1) > places_.size()) {
            grow();
            at = placeOf(name, hash);
        }
        places_[at] = {hash, static_cast<std::uint32_t>(names_.size())};
        names_.push_back({name.data(), static_cast<std::uint32_t>(name.size()), number});
        return {};
    }
    // Fetches the memory that the look-up of a name with this hash, some names later, will need.
    void prepare(std::uint32_t hash) const {
        __builtin_prefetch(&places_[hash & (places_.size() - 1)]);
    }
    std::optional<std::uint32_t> find(std::string_view name) const {
        const Place& place = places_[placeOf(name, hashOf(name))];
        if (place.isEmpty()) return {};
        return nameAt(place).number;
    }

    // Eight bytes at a time, each mixed by a product (Fibonacci hashing, Knuth) whose upper half is
    // folded down. Most names are shorter than a call of the library's hash is worth.
    static std::uint32_t hashOf(std::string_view name) {
        constexpr std::uint64_t kGolden = 0x9e3779b97f4a7c15u;
        std::uint64_t hash = name.size();
        const auto mix = [&](std::uint64_t bytes) {
            hash = (hash ^ bytes) * kGolden;
            hash ^= hash >> 32;
        };
        const auto load = [&](std::size_t at, auto bytes) -> std::uint64_t {
            std::memcpy(&bytes, name.data() + at, sizeof bytes);
            return bytes;
        };
        const std::size_t size = name.size();
        if (size >= 8) {
            for (std::size_t at = 0; at + 8 < size; at += 8) mix(load(at, std::uint64_t{}));
            mix(load(size - 8, std::uint64_t{})); // may overlap the one before
        } else if (size >= 4) {
            mix(load(0, std::uint32_t{}) << 32 | load(size - 4, std::uint32_t{}));
        } else if (size > 0) {
            mix(load(0, std::uint8_t{}) << 16 | load(size / 2, std::uint8_t{}) << 8 |
                load(size - 1, std::uint8_t{}));
        }
        mix(0); // the last bytes reach all bits
        return static_cast<std::uint32_t>(hash);
    }

private:
    struct Name {
        const char* first = nullptr;
        std::uint32_t size = 0, number = 0; // files are smaller than 4 GiB
        std::string_view text() const { return {first, size}; }
    };
    struct Place {
        static constexpr std::uint32_t kEmpty = 0xffffffffu;
        std::uint32_t hash = 0, index = kEmpty; // in names_
        bool isEmpty() const { return index == kEmpty; }
    };
    const Name& nameAt(const Place& place) const { return names_[place.index]; }
    // Where the name is, or where it would be.
    std::size_t placeOf(std::string_view name, std::uint32_t hash) const {
        const std::size_t mask = places_.size() - 1;
        std::size_t i = hash & mask;
        while (!places_[i].isEmpty() &&
               (places_[i].hash != hash || nameAt(places_[i]).text() != name))
            i = (i + 1) & mask;
        return i;
    }
    void grow() {
        const std::size_t mask = 4 * places_.size() - 1;
        std::vector<Place> larger(mask + 1);
        for (const Place& place : places_) {
            if (place.isEmpty()) continue;
            std::size_t i = place.hash & mask;
            while (!larger[i].isEmpty()) i = (i + 1) & mask;
            larger[i] = place;
        }
        places_ = std::move(larger);
    }

    std::vector<Place> places_;
    std::vector<Name> names_; // in the order in which they came
};
