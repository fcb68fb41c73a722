// The list of all kinds of lights. A new one is its file in kinds/ and its word here.
#pragma once

#include "light/kinds/disk.h"
#include "light/kinds/rectangle.h"
#include "light/kinds/round.h"
#include "light/kinds/sphere.h"
#include "light/kinds/sun.h"
#include "light/kinds/triangle.h"

#include <utility>

LANES_BEGIN

template <class... L> struct LightList {};
using Lights = LightList<PointEmitter, SpotEmitter, SunEmitter, RectangleEmitter, DiskEmitter,
                         SphereEmitter, TriangleEmitter>;

// Calls fn.template operator()<L>() for light number `kind` of the list.
template <class Fn, class... L> void forLight(LightList<L...>, std::uint32_t kind, Fn&& fn) {
    std::uint32_t number = 0;
    ((number++ == kind ? fn.template operator()<L>() : void()), ...);
}
template <class Fn> void forLight(std::uint32_t kind, Fn&& fn) {
    forLight(Lights{}, kind, std::forward<Fn>(fn));
}

LANES_END
