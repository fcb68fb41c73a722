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
    // The hits that are not behind the best ones so far, in the order of the rays, into a list with
    // room for all rays. Returns how many.
    std::size_t (*closest)(const StillPlane& plane, const RaySpan& rays, std::span<const Hit> best,
                           PlaneHit* found);
    // hidden[i] becomes 1 where the plane is in (tMin, tMax).
    void (*any)(const StillPlane& plane, const RaySpan& rays, std::uint8_t* hidden);
};
// Null for the scalar kernel.
const PlaneKernel* planeKernel(const Kernel& kernel);
