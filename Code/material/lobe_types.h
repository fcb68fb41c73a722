// LobeType: what scenes and scene builders know of a lobe of the list in lobes.h.
#pragma once

#include "material/lobe.h"

#include <span>

struct LobeType {
    const char* name;
    std::span<const LobeField> fields;
    std::uint32_t flags;

    // What the switches for reflection and refraction are about: lobes that show surroundings on
    // the side of the eye alone, and boundaries.
    bool isMirror() const {
        return (flags & (kReflects | kTransmits | kSpawnsRays | kDiffuse)) ==
               (kReflects | kSpawnsRays);
    }
    bool isGlass() const { return (flags & kHasSides) != 0; }
};
// In the order of the list: a lobe's kind is its number in it.
std::span<const LobeType> lobeTypes();
