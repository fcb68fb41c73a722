// One lane, for every machine: the instance of the formulas of shading that is the scalar code.
#include "isa/instances.h"
#include "render/path/path_in_lanes.h"

constexpr PathKernel kOnePath{kernels::one::scatterBlock};
