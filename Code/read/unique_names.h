// UniqueNames: names that a scene may have, from names that a foreign file has.
#pragma once

#include "base/text.h"
#include "desc/name_table.h"
#include "desc/names.h"

#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>
#include <string>
#include <string_view>

class UniqueNames {
public:
    // The name itself when it is new and good; else with bytes that are no text as '_' and a number
    // behind it: "wheel", "wheel.2". Time does not grow with how often a name was there.
    std::string of(std::string_view name) {
        std::string good;
        while (true) {
            const std::size_t bad = findBadText(name);
            good += name.substr(0, bad);
            if (bad == std::string_view::npos) break;
            good += '_';
            name.remove_prefix(bad + 1);
        }
        const auto first = numberOf(good);
        if (!first) return good;
        std::size_t& last = last_[*first];
        while (true) {
            std::string numbered = cat(good, ".", ++last);
            if (!numberOf(numbered)) return numbered;
        }
    }

private:
    // The number of a name that was there; nothing for a new one, which then has one.
    std::optional<std::uint32_t> numberOf(const std::string& name) {
        const auto first =
            table_.insert(names_.emplace_back(name), static_cast<std::uint32_t>(last_.size()));
        if (first)
            names_.pop_back();
        else
            last_.push_back(1);
        return first;
    }
    std::deque<std::string> names_; // which stay where they are
    NameTable table_;
    std::deque<std::size_t> last_; // the number that each name had last, 1 without any
};
