#include "base/large_pages.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <memory>
#include <span>
#if defined(__linux__)
#include <sys/mman.h>
#endif
#if defined(__GLIBC__)
#include <malloc.h>
#include <unistd.h>
#endif

namespace {

[[maybe_unused]] constexpr std::size_t kPage = std::size_t{1} << 21;

// What a thread's heap begins with.
[[maybe_unused]] constexpr std::size_t kThreadHeap = std::size_t{1} << 23;
[[maybe_unused]] std::atomic<bool> threadsHaveLargePages{false};

// Of a heap, by thread; tools that look for leaks find it here.
[[maybe_unused]] thread_local void* filler = nullptr;

#if defined(__linux__)

// What is smaller comes from malloc. Where the heap has grown ahead of it calloc writes the zeros,
// all of them in the thread that calls it.
constexpr std::size_t kOfItsOwn = std::size_t{1} << 16;

// The last page is a large one if so much of it is needed: it costs as much as some 60 small ones.
constexpr std::size_t kWorthAPage = std::size_t{1} << 18;

// Once some were dear: of how much memory on they are still asked for. In less, small ones make
// rays lose less time than that.
constexpr std::size_t kWorthDearPages = std::size_t{1} << 28;

// Of how much memory on they are asked for.
std::atomic<std::size_t> fewestBytes{0};

bool areWorthIt(std::size_t bytes) { return bytes >= fewestBytes; }

std::size_t inPages(std::size_t bytes) { return (bytes + kPage - 1) / kPage * kPage; }

// Whole pages of it, if they are asked for. foreseen: of all bytes, so many will be written.
std::span<char> advise(void* memory, std::size_t bytes, std::size_t foreseen) {
    const auto start = reinterpret_cast<std::uintptr_t>(memory);
    const std::uintptr_t before = (kPage - start % kPage) % kPage;
    if (bytes < before + kPage || !areWorthIt(foreseen)) return {};
    const std::span<char> pages(static_cast<char*>(memory) + before,
                                (bytes - before) / kPage * kPage);
    madvise(pages.data(), pages.size(), MADV_HUGEPAGE);
    return pages;
}

// Touches the first ones, which hold nothing or zeros and will be written anyway. A host of virtual
// machines takes pages back that are free for some seconds, large ones only, and with the next
// touch each costs 3 to 5 ms, 20 times what it takes to write it. After the first such page the
// others become small ones, for which there are pieces of pages in use.
void tryPages(std::span<char> pages, std::size_t count, std::size_t foreseen) {
    using Clock = std::chrono::steady_clock;
    constexpr std::chrono::milliseconds kDear{1};
    for (std::size_t at = kPage; at <= std::min(pages.size(), count * kPage); at += kPage) {
        const Clock::time_point start = Clock::now();
        *static_cast<volatile char*>(&pages[at - kPage]) = 0;
        if (Clock::now() - start < kDear) continue;
        fewestBytes = kWorthDearPages;
        if (!areWorthIt(foreseen)) madvise(pages.data() + at, pages.size() - at, MADV_NOHUGEPAGE);
        return;
    }
}

void* mapBytes(std::size_t bytes) {
    void* const memory =
        mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    return memory == MAP_FAILED ? nullptr : memory;
}

// From the start of a page on, so that none is lost at the ends.
void* mapPages(std::size_t bytes) {
    const std::size_t size = inPages(bytes);
    if (size < bytes || size + kPage < size) return nullptr;
    void* const memory = mapBytes(size + kPage);
    if (!memory) return nullptr;
    char* const all = static_cast<char*>(memory);
    const std::size_t before = kPage - reinterpret_cast<std::uintptr_t>(memory) % kPage;
    munmap(all, before);
    if (before < kPage) munmap(all + before + size, kPage - before);
    tryLargePages(all + before, inPages(bytes - kWorthAPage));
    return all + before;
}

#endif

} // namespace

void foreseeMemory([[maybe_unused]] std::size_t bytes) {
#if defined(__linux__)
    if (!largePagesAreDear()) fewestBytes = bytes < kWorthATrial ? kWorthATrial : 0;
#endif
}

void adviseLargePages([[maybe_unused]] void* memory, [[maybe_unused]] std::size_t bytes) {
#if defined(__linux__)
    advise(memory, bytes, bytes);
#endif
}

void tryLargePages([[maybe_unused]] void* memory, [[maybe_unused]] std::size_t bytes) {
#if defined(__linux__)
    tryPages(advise(memory, bytes, bytes), 1, bytes);
#endif
}

bool largePagesAreDear() {
#if defined(__linux__)
    return fewestBytes == kWorthDearPages;
#else
    return false;
#endif
}

void* zeroedMemory(std::size_t bytes) {
#if defined(__linux__)
    if (bytes >= kPage) return mapPages(bytes);
    if (bytes >= kOfItsOwn) return mapBytes(bytes);
#endif
    return std::calloc(1, std::max<std::size_t>(1, bytes));
}

void freeZeroedMemory(void* memory, [[maybe_unused]] std::size_t bytes) {
#if defined(__linux__)
    if (bytes >= kOfItsOwn) {
        munmap(memory, bytes >= kPage ? inPages(bytes) : bytes);
        return;
    }
#endif
    std::free(memory);
}

void useLargePages([[maybe_unused]] std::size_t bytes, [[maybe_unused]] std::size_t foreseen,
                   [[maybe_unused]] bool inThreads) {
#if defined(__GLIBC__)
    constexpr std::size_t kMost = std::size_t{1} << 30, kRecord = 256, kSome = 1 << 15;
    constexpr int kLargestArray = 1 << 22;
    const std::size_t room = std::min(bytes, kMost);
    const auto addressOf = [](const void* p) { return reinterpret_cast<std::uintptr_t>(p); };
    // Where the free end of the heap begins: what has been freed in front of it are smaller pieces.
    const std::unique_ptr<void, decltype(&std::free)> here(std::malloc(kSome), &std::free);
    const std::uintptr_t start = addressOf(here.get()) + kSome, before = addressOf(sbrk(0));
    // The heap is to grow at once by what is asked for, which the next piece makes it do. As long
    // as that lasts, arrays come from there, too; later only those of less than 4 MB.
    if (mallopt(M_MMAP_THRESHOLD, kLargestArray) == 0 ||
        mallopt(M_TRIM_THRESHOLD, std::numeric_limits<int>::max()) == 0 ||
        mallopt(M_TOP_PAD, static_cast<int>(room)) == 0)
        return;
    // That piece ends just in front of a page: malloc writes behind it, and a page of which
    // something was touched before the advice remains one of small ones.
    const std::uintptr_t page = (before + 2 * kRecord + kPage - 1) / kPage * kPage;
    // Tools that watch the memory have a malloc of their own, elsewhere.
    if (start < before && page - start < 2 * kPage) {
        filler = std::malloc(page - start - kRecord);
        const std::uintptr_t first = addressOf(filler), end = addressOf(sbrk(0));
        if (filler && start < first && first < page && page < end) {
#if defined(__linux__)
            // 0.2 ms for each that is not written after all.
            constexpr std::size_t kTried = 6;
            const std::size_t count = std::clamp<std::size_t>(foreseen / kPage, 1, kTried);
            tryPages(advise(filler, end - first, foreseen), count, foreseen);
#endif
        }
    }
    // What heaps get more than they need when they grow, or begin.
    const std::size_t pad = inThreads ? kThreadHeap : kPage / 2;
    threadsHaveLargePages = mallopt(M_TOP_PAD, static_cast<int>(pad)) != 0 && inThreads;
#endif
}

void useLargePagesInThread() {
#if defined(__GLIBC__)
    if (!threadsHaveLargePages) return;
    // With its first piece malloc gives a thread a heap of its own, which begins at a multiple of
    // the size that it may get. Its first page is touched then: another piece is to fill that.
    constexpr std::uintptr_t kHeap = std::uintptr_t{1} << 26, kStart = 1 << 13;
    constexpr std::size_t kSome = 1 << 12;
    void* const first = std::malloc(kSome);
    const auto address = reinterpret_cast<std::uintptr_t>(first), heap = address / kHeap * kHeap;
    // Tools that watch the memory have a malloc of their own.
    if (!first || address - heap > kStart) return std::free(first);
    filler = std::realloc(first, heap + kPage - address - kSome);
    if (reinterpret_cast<std::uintptr_t>(filler) != address) return; // it did not stay there
    adviseLargePages(static_cast<char*>(filler) + (heap + kPage - address), kThreadHeap - kPage);
#endif
}
