// Opens and closes a region whose functions are compiled for more than plain x86-64. The region
// starts after the last #include: what headers define stays plain and may be shared by the linker.
#pragma once

#define KERNEL_PRAGMA(text) _Pragma(#text)
#if defined(__clang__)
#define KERNEL_REGION_BEGIN(isa)                                                                   \
    KERNEL_PRAGMA(clang attribute push(__attribute__((target(isa))), apply_to = function))
#define KERNEL_REGION_END KERNEL_PRAGMA(clang attribute pop)
#else
#define KERNEL_REGION_BEGIN(isa) KERNEL_PRAGMA(GCC push_options) KERNEL_PRAGMA(GCC target(isa))
#define KERNEL_REGION_END KERNEL_PRAGMA(GCC pop_options)
#endif
