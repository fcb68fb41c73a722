// NffSurfaceTable: which fills are equal.
#pragma once

#include "desc/name_table.h"
#include "read/nff/terms.h"

#include <array>
#include <cstdint>
#include <deque>
#include <optional>

class NffSurfaceTable {
public:
    // Remembers the number, unless an equal fill was there already; then says the number of that.
    std::optional<std::uint32_t> insert(const NffFill& fill, std::uint32_t number) {
        const auto [r, g, b] = fill.color;
        Numbers& numbers = fills_.emplace_back(Numbers{r, g, b, fill.diffuse, fill.specular,
                                                       fill.shine, fill.transmittance, fill.ior});
        for (double& value : numbers) value += 0.0; // -0 becomes 0: bytes tell fills apart
        const auto first =
            table_.insert({reinterpret_cast<const char*>(numbers.data()), sizeof numbers}, number);
        if (first) fills_.pop_back();
        return first;
    }

private:
    using Numbers = std::array<double, 8>;
    std::deque<Numbers> fills_; // which stay where they are
    NameTable table_;
};
