// From the parts that the threads of the builder have made to one binary tree of boxes.
#pragma once

#include "accel/kernels/build/build.h"
#include "accel/kernels/build/write_tree.h"
#include "base/parallel.h"

#include <span>
#include <vector>

namespace kernels::build {

// The nodes of all growers, those of a single one where they are, and the top behind them. `top`
// and `subtrees` are as for writeTree(); what is `grown` is used up.
SinglesTree joinSingles(std::span<const BinaryNode> top, std::span<const SubtreeRange> subtrees,
                        std::vector<Grown>& grown, ThreadPool& pool);

} // namespace kernels::build
