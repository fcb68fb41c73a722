// UniqueNames: names that a scene may have, from names that a foreign file has.
#pragma once

#include "base/text.h"
#include "desc/names.h"

#include <string>
#include <string_view>
#include <unordered_map>

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
        // An entry is the number that the name had last, 1 without any.
        if (last_.try_emplace(good, 1).second) return good;
        while (true) {
            std::string numbered = cat(good, ".", ++last_[good]);
            if (last_.try_emplace(numbered, 1).second) return numbered;
        }
    }

private:
    std::unordered_map<std::string, std::size_t> last_;
};
