#include "render/waves/hidden_point.h"

#include "base/math.h"
#include "render/occluders.h"
#include "render/waves/hidden_lanes.h"
#include "render/waves/lamp_lanes.h"

bool mayHide(const Occluders& occluders, const HidingPlace& place, const LampBall& lamp) {
    LitBlock block;
    for (std::size_t axis = 0; axis < 3; ++axis)
        block.p[axis][0] = place.p[axis], block.lift[axis][0] = place.lift[axis];
    block.shape[0] = place.shape;
    block.used = 1, block.inside = place.inside;
    return kernels::one::hiddenPoints(occluders, block, lamp).maybe != 0;
}
