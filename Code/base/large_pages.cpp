#include "base/large_pages.h"

#include <cstdint>
#if defined(__linux__)
#include <sys/mman.h>
#endif

void adviseLargePages([[maybe_unused]] void* memory, [[maybe_unused]] std::size_t bytes) {
#if defined(__linux__)
    constexpr std::uintptr_t kPage = std::uintptr_t{1} << 21;
    const auto start = reinterpret_cast<std::uintptr_t>(memory);
    const std::uintptr_t inside = (kPage - start % kPage) % kPage;
    if (bytes < inside + kPage) return;
    madvise(static_cast<char*>(memory) + inside, (bytes - inside) / kPage * kPage, MADV_HUGEPAGE);
#endif
}
