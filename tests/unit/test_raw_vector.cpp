// RawVector and ZeroedVector behave as vectors, small or large.
#include "base/raw_vector.h"
#include "check.h"

#include <algorithm>
#include <cstdint>
#include <numeric>

namespace test_raw_vector {

TEST(raw_vectors_keep_what_they_hold) {
    RawVector<std::uint32_t> v;
    // From memory of small pages to such of large ones, by growth.
    constexpr std::uint32_t kCount = 3u << 20;
    for (std::uint32_t i = 0; i < kCount; ++i) v.push_back(i * 7);
    std::uint32_t wrong = 0;
    for (std::uint32_t i = 0; i < kCount; ++i) wrong += v[i] != i * 7;
    CHECK_EQUAL(wrong, 0u);
    const std::uint32_t* const at = v.data();
    RawVector<std::uint32_t> moved = std::move(v);
    CHECK(moved.data() == at); // no copy
    moved.resize(10), moved.shrink_to_fit();
    CHECK_EQUAL(std::accumulate(moved.begin(), moved.end(), 0u), 45u * 7);
    CHECK(moved == (std::vector<std::uint32_t>{0, 7, 14, 21, 28, 35, 42, 49, 56, 63}));
    CHECK(!(moved == std::vector<std::uint32_t>(10)));
}

// New elements are left as the memory is, those that are asked for are not; also where the type
// would be initialised.
TEST(raw_vectors_are_not_zeroed) {
    struct Number {
        std::uint32_t value = 9;
    };
    RawVector<Number> v(1000, Number{5});
    v.clear(), v.resize(1000);
    CHECK_EQUAL(std::count_if(v.begin(), v.end(), [](Number n) { return n.value == 5; }), 1000);
}

TEST(raw_vectors_align_what_asks_for_it) {
    struct alignas(64) Line {
        std::byte bytes[64];
    };
    for (const std::size_t count : {1u, 3u, 1u << 16}) {
        const RawVector<Line> lines(count);
        CHECK_EQUAL(reinterpret_cast<std::uintptr_t>(lines.data()) % 64, 0u);
    }
}

// Small ones and large ones, in memory that was given back.
TEST(zeroed_vectors_are_zero) {
    for (const std::size_t size : {std::size_t{1}, std::size_t{1000}, std::size_t{1} << 20,
                                   std::size_t{1} << 21, (std::size_t{10} << 20) - 3})
        for (int again = 0; again < 2; ++again) {
            ZeroedVector<std::uint8_t> v(size);
            CHECK_EQUAL(std::count(v.begin(), v.end(), 0), static_cast<std::ptrdiff_t>(size));
            std::fill(v.begin(), v.end(), std::uint8_t{255});
        }
    const ZeroedVector<int> copy(ZeroedVector<int>(3, 7));
    CHECK(copy.size() == 3 && copy[0] == 7 && copy[2] == 7);
}

} // namespace test_raw_vector
