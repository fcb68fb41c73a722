// The steps of the tree builder for the instruction set of this unit.
#pragma once

#include "accel/kernels/build/subtree.h"

LANES_BEGIN
namespace build {

constexpr TreeBuilder treeBuilder() {
    return {makePrims,    takeBoxes, gridOver,     fillBins,      mergeBins,  chooseSplit,
            makeChildren, divide,    growSubtree8, growSubtree16, growSingles};
}

} // namespace build
LANES_END
