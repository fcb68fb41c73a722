// The instances that the units of this folder define, for choose.cpp.
#pragma once

#include "isa/isa.h"

struct PathKernel;
extern const Isa kSseIsa, kAvx2Isa, kAvx512Isa;
extern const PathKernel kOnePath, kSsePath, kAvx2Path, kAvx512Path;
namespace kernels::build {
extern const TreeBuilder kAvx2TreeBuilder;
}
