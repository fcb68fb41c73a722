// Memory that is found ahead: it is there, holds what it held, and more than there is does no harm.
#include "base/find_pages.h"

#include "base/zeroed.h"
#include "check.h"

#include <algorithm>

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <memory>
#include <vector>
#if defined(__linux__)
#include <sys/mman.h>
#endif

namespace {

constexpr std::size_t kBytes = std::size_t{5} << 20;

// Of the small pages of some memory, how many are there; all of them where nobody can tell.
std::size_t pagesOf([[maybe_unused]] const std::vector<std::byte, ZeroedAllocator<std::byte>>& v) {
    std::size_t count = kBytes >> 12;
#if defined(MADV_POPULATE_WRITE)
    const auto page = std::uintptr_t{1} << 12;
    auto* const first = reinterpret_cast<void*>(
        (reinterpret_cast<std::uintptr_t>(v.data()) + page - 1) / page * page);
    std::vector<unsigned char> isThere(kBytes / page - 1);
    const bool isKnown = madvise(first, page, MADV_POPULATE_WRITE) == 0;
    if (!isKnown || mincore(first, isThere.size() * page, isThere.data()) != 0) return count;
    count = 0;
    for (const unsigned char there : isThere) count += there & 1;
#endif
    return count;
}

} // namespace

TEST(find_pages_are_there_and_zero) {
    for (const int threads : {1, 3}) {
        ZeroedVector<std::byte> v(kBytes);
        v[12345] = std::byte{7};
        findPages(v.data(), v.size(), threads);
        CHECK_INFO(pagesOf(v) >= (kBytes >> 12) - 2, threads << " threads: " << pagesOf(v));
        std::size_t others = 0;
        for (const std::byte b : v) others += b != std::byte{0};
        CHECK_EQUAL(others, 1u);
        CHECK(v[12345] == std::byte{7});
    }
}

TEST(find_pages_of_little_or_nothing) {
    std::vector<std::byte> v(100, std::byte{3});
    findPages(v.data(), v.size(), 2);
    findPages(nullptr, 0, 2);
    for (const std::byte b : v) CHECK(b == std::byte{3});
}

// More than the heap has, and again: what malloc hands out is as good as before.
TEST(find_pages_room_ahead) {
    const std::unique_ptr<char, decltype(&std::free)> old(static_cast<char*>(std::malloc(3000)),
                                                          &std::free);
    std::fill_n(old.get(), 3000, 'x');
    findRoomAhead(std::size_t{1} << 40);
    findRoomAhead(1);
    std::vector<std::vector<int>> arrays;
    for (int i = 0; i < 50; ++i) arrays.emplace_back(20000, i);
    int wrong = 0;
    for (int i = 0; i < 50; ++i)
        for (const int x : arrays[static_cast<std::size_t>(i)]) wrong += x != i;
    CHECK_EQUAL(wrong, 0);
    CHECK_EQUAL(std::count(old.get(), old.get() + 3000, 'x'), 3000);
}
