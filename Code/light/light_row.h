// LightRow: a light of the list in lights.h as plain data, what scenes keep of it.
#pragma once

#include "light/light_lanes.h"

#include <array>
#include <cstdint>
#include <span>

struct LightRow {
    std::uint32_t kind = 0; // its number in the list
    std::array<float, kLightNumbers> numbers{};
};

struct LightKind {
    const char* name;
    std::size_t numbers; // how many it has
};
// In the order of the list.
std::span<const LightKind> lightKinds();

// Makes the row of a light from its numbers by name, such as a PointRow.
template <class Row> LightRow lightRow(const Row& row);
