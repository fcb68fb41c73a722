// The functions of every instruction set, for the table in choose.cpp.
#pragma once

#include "accel/kernels/kernels.h"

#define KERNEL_FUNCTIONS(isa)                                                                      \
    namespace kernels::isa {                                                                       \
    void closest(const WideMesh&, const RaySpan&, std::span<const std::uint32_t>,                  \
                 const HitLists&);                                                                 \
    void any(const WideMesh&, const RaySpan&, std::span<const std::uint32_t>, std::uint8_t*);      \
    void closestFromPoint(const WideMesh&, const RaySpan&, std::span<const std::uint32_t>,         \
                          const HitLists&);                                                        \
    void anyFromPoint(const WideMesh&, const RaySpan&, std::span<const std::uint32_t>,             \
                      std::uint8_t*);                                                              \
    }
KERNEL_FUNCTIONS(sse)
KERNEL_FUNCTIONS(avx2)
KERNEL_FUNCTIONS(avx512)
#undef KERNEL_FUNCTIONS
