// The instruction set that --kernel names.
#pragma once

#include "isa/isa.h"

#include <string>
#include <string_view>
#include <vector>

// The names of all, the best first.
std::vector<std::string> kernelNames();
// By name; "auto" is the best that the CPU has. Fails for a name that there is not or that this CPU
// can't run, and says which it can.
const Isa& chooseKernel(std::string_view name);
