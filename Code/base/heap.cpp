#include "base/heap.h"

#include <cstdlib> // says __GLIBC__

#if defined(__GLIBC__)
#include <malloc.h>

void prepareHeap() {
    constexpr int kBytes = 32 << 20; // as large as glibc lets the threshold be
    mallopt(M_MMAP_THRESHOLD, kBytes);
    mallopt(M_TOP_PAD, 1 << 20);
    mallopt(M_TRIM_THRESHOLD, 2 * kBytes);
}
#else
void prepareHeap() {}
#endif
