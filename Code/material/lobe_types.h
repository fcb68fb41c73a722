// LobeType: what scenes and scene builders know of a lobe of the list in lobes.h.
#pragma once

#include "material/lobe.h"

#include <span>

struct LobeType {
    const char* name;
    std::span<const LobeField> fields;
    std::uint32_t flags;
};
// In the order of the list: a lobe's kind is its number in it.
std::span<const LobeType> lobeTypes();
