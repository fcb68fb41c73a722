// ByKernel: what each instruction set has a version of its own of, by the kernel that is in use.
#pragma once

#include "accel/kernels/kernels.h"

#include <string_view>

template <class T> struct ByKernel {
    T avx512{}, avx2{}, sse{};

    // nullptr for kernels without lanes.
    const T* of(const Kernel& kernel) const {
        const std::string_view name = kernel.name;
        return name == "avx512" ? &avx512 : name == "avx2" ? &avx2 : name == "sse" ? &sse : nullptr;
    }
};

// declare(isa) for each of them, and a table of the values row(isa). Where there are none, no
// kernel asks for a row.
#define DECLARE_BY_KERNEL(declare) declare(avx512) declare(avx2) declare(sse)
#if defined(__x86_64__)
#define BY_KERNEL(row)                                                                             \
    { row(avx512), row(avx2), row(sse) }
#else
#define BY_KERNEL(row)                                                                             \
    {}
#endif
