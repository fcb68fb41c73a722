// One lane, for every machine: the instance of the formulas of shading that is the scalar code.
#include "isa/instances.h"
#include "integrate/shading_in_lanes.h"

constexpr ShadingKernel kOneShading = kernels::one::kShading;
