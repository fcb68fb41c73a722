// Planes without end that stand still, met by a register of rays at a time with the bits of
// shape/infinite_plane.cpp. They have no box, so that every ray of a scene with a floor asks them.
#pragma once

#include "accel/kernels/kernels.h"
#include "accel/solid_form.h"

#include <cstdint>
#include <span>

// Where a ray meets a plane: t and u of Hit.
struct PlaneHit {
    std::uint32_t ray;
    float t, u;
};

struct PlaneKernel {
    // All hits, of rays that nothing else was asked for yet.
    void (*first)(const StillPlane& plane, std::uint32_t number, const RaySpan& rays, Hit* hits);
    // Hits in front of the best ones so far become the best. Those that are as far as the best one
    // go into a list with room for all rays, in their order: somebody else decides. Returns how
    // many.
    std::size_t (*closest)(const StillPlane& plane, std::uint32_t number, const RaySpan& rays,
                           Hit* best, PlaneHit* asFar);
    // hidden[i] becomes 1 where the plane is in (tMin, tMax).
    void (*any)(const StillPlane& plane, const RaySpan& rays, std::uint8_t* hidden);
};
