#include "texture/footprint.h"

#include "texture/footprint_in_lanes.h"

UvFootprint footprintOn(float width, Vec3 dir, Vec3 n, const SurfaceDerivatives& d) {
    using namespace kernels::one;
    const auto of = [](Vec3 v) { return Floats3{v.x, v.y, v.z}; };
    const FootprintLanes found = footprintsOn(width, of(dir), of(n), of(d.dpdu), of(d.dpdv));
    return {{found.along.u.v, found.along.v.v}, {found.across.u.v, found.across.v.v}};
}
