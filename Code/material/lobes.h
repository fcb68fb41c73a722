// The list of all lobes. A new one is its file in lobes/ and its word here.
#pragma once

#include "material/lobes/diffuse.h"

#include <utility>

LANES_BEGIN

template <class... L> struct LobeList {};
using Lobes = LobeList<Diffuse>;

// Calls fn.template operator()<L>() for lobe number `kind` of the list.
template <class Fn, class... L> void forLobe(LobeList<L...>, std::uint32_t kind, Fn&& fn) {
    std::uint32_t number = 0;
    ((number++ == kind ? fn.template operator()<L>() : void()), ...);
}
template <class Fn> void forLobe(std::uint32_t kind, Fn&& fn) {
    forLobe(Lobes{}, kind, std::forward<Fn>(fn));
}

LANES_END
