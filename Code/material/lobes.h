// The list of all lobes. A new one is its file in lobes/ and its word here.
#pragma once

#include "material/lobes/ashikhmin.h"
#include "material/lobes/blinn.h"
#include "material/lobes/coat.h"
#include "material/lobes/conductor.h"
#include "material/lobes/dielectric.h"
#include "material/lobes/diffuse.h"
#include "material/lobes/glossy_dielectric.h"
#include "material/lobes/mirror.h"
#include "material/lobes/oren_nayar.h"
#include "material/lobes/phong.h"
#include "material/lobes/refraction.h"
#include "material/lobes/schlick_mirror.h"
#include "material/lobes/sheen.h"
#include "material/lobes/translucent.h"

#include <utility>

LANES_BEGIN

template <class... L> struct LobeList {};
using Lobes = LobeList<Diffuse, OrenNayar, Translucent, Sheen, Blinn, Phong, Ashikhmin, Mirror,
                       SchlickMirror, Conductor, GlossyDielectric, Coat, Dielectric, Refraction>;

// Calls fn.template operator()<L>() for lobe number `kind` of the list.
template <class Fn, class... L> void forLobe(LobeList<L...>, std::uint32_t kind, Fn&& fn) {
    std::uint32_t number = 0;
    ((number++ == kind ? fn.template operator()<L>() : void()), ...);
}
template <class Fn> void forLobe(std::uint32_t kind, Fn&& fn) {
    forLobe(Lobes{}, kind, std::forward<Fn>(fn));
}

LANES_END
