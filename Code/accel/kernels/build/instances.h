// The builder's steps in every instruction set, for the table in choose_build.cpp.
#pragma once

#include "accel/kernels/build/build.h"

namespace kernels::build {

#define BUILD_FUNCTIONS(isa)                                                                       \
    namespace isa {                                                                                \
    void makePrims(const BuildInput&, std::uint32_t, std::uint32_t, PrimBox&, PrimBox&);           \
    void takeBoxes(const BuildInput&, std::uint32_t, std::uint32_t, PrimBox&, PrimBox&);           \
    BinGrid gridOver(const PrimBox&, std::uint32_t);                                               \
    void fillBins(const BinGrid&, const PrimBox*, std::uint32_t, Bins&);                           \
    void mergeBins(Bins&, const Bins&, std::uint32_t);                                             \
    void chooseSplit(BuildRange&, const Bins&);                                                    \
    void makeChildren(const BuildRange&, BuildRange&, BuildRange&);                                \
    void divide(const BuildInput&, const BuildRange&, const BinGrid*, const PrimBox*,              \
                std::uint32_t, PrimBox*, PrimBox*, Bins (&)[2]);                                   \
    void growSubtree8(const BuildInput&, const BuildRange&, Grown&);                               \
    void growSubtree16(const BuildInput&, const BuildRange&, Grown&);                              \
    void growSingles(const BuildInput&, const BuildRange&, Grown&);                                \
    }
BUILD_FUNCTIONS(sse)
BUILD_FUNCTIONS(avx2)
#undef BUILD_FUNCTIONS

} // namespace kernels::build
