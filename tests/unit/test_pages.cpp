// Arrays on large pages: they behave as vectors, small or large.
#include "base/pages.h"
#include "base/zeroed.h"
#include "check.h"

#include <algorithm>
#include <cstdint>
#include <numeric>

namespace test_pages {

TEST(pages_vectors_keep_what_they_hold) {
    PageVector<std::uint32_t> v;
    // From the usual memory to large pages and on, by growth.
    constexpr std::uint32_t kCount = 3u << 20;
    for (std::uint32_t i = 0; i < kCount; ++i) v.push_back(i * 7);
    std::uint32_t wrong = 0;
    for (std::uint32_t i = 0; i < kCount; ++i) wrong += v[i] != i * 7;
    CHECK_EQUAL(wrong, 0u);
    const std::uint32_t* const at = v.data();
    PageVector<std::uint32_t> moved = std::move(v);
    CHECK(moved.data() == at); // no copy
    moved.resize(10), moved.shrink_to_fit();
    CHECK_EQUAL(std::accumulate(moved.begin(), moved.end(), 0u), 45u * 7);
}

// What they leave of their last page is little to them; smaller arrays begin where there is room.
TEST(pages_large_arrays_start_on_one) {
    for (const std::size_t bytes : {8 * kLargePage, 8 * kLargePage + 1, 11 * kLargePage - 3}) {
        PageVector<std::byte> v(bytes);
        CHECK_EQUAL(reinterpret_cast<std::uintptr_t>(v.data()) % kLargePage, 0u);
    }
    CHECK(!PageAllocator<std::byte>::beginsAPage(8 * kLargePage - 1));
}

// New elements are left as the memory is, those that are asked for are not.
TEST(pages_vectors_are_not_zeroed) {
    PageVector<std::uint32_t> v(1000, 5);
    v.clear(), v.resize(1000);
    std::uint32_t fives = 0;
    for (const std::uint32_t x : v) fives += x == 5;
    CHECK_EQUAL(fives, 1000u);
}

// Small ones and large ones, with little and with much behind their last whole page.
TEST(pages_zeroed_arrays_are_zero_and_start_on_one) {
    for (const std::size_t bytes : {kLargePage / 2, kLargePage, kLargePage + 1, 5 * kLargePage - 3})
        for (int again = 0; again < 2; ++again) { // where the first one was
            ZeroedVector<std::uint8_t> v(bytes);
            if (bytes >= kLargePage)
                CHECK_EQUAL(reinterpret_cast<std::uintptr_t>(v.data()) % kLargePage, 0u);
            CHECK_EQUAL(std::count(v.begin(), v.end(), 0), static_cast<std::ptrdiff_t>(bytes));
            std::fill(v.begin(), v.end(), std::uint8_t{7});
        }
}

} // namespace test_pages
