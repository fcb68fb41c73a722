// Pieces that are made in any order on any thread are used in their own, each once.
#include "base/parallel.h"
#include "check.h"

#include <stdexcept>

namespace test_in_order {

namespace {

InOrder::Bytes pieceOf(std::size_t number, InOrder::Bytes bytes) {
    bytes.assign(1 + number % 7, static_cast<std::uint8_t>(number));
    return bytes;
}

} // namespace

TEST(in_order_whatever_comes_first) {
    std::vector<std::uint8_t> used;
    const auto use = [&](std::span<const std::uint8_t> bytes) {
        used.insert(used.end(), bytes.begin(), bytes.end());
    };
    InOrder inOrder(4, use);
    inOrder.put(2, pieceOf(2, {}));
    inOrder.put(1, pieceOf(1, {}));
    CHECK(used.empty());
    inOrder.put(0, pieceOf(0, {}));
    CHECK(used == (std::vector<std::uint8_t>{0, 1, 1, 2, 2, 2}));
    CHECK(inOrder.buffer().capacity() > 0); // memory is used again
    inOrder.put(3, pieceOf(3, {}));
    CHECK_EQUAL(used.size(), 10u);
}

TEST(in_order_on_threads) {
    constexpr std::size_t kPieces = 500;
    for (const int threads : {1, 2, 7}) {
        std::vector<std::uint8_t> used, expected;
        int inside = 0;
        const auto use = [&](std::span<const std::uint8_t> bytes) {
            CHECK_EQUAL(++inside, 1); // one at a time
            used.insert(used.end(), bytes.begin(), bytes.end());
            --inside;
        };
        InOrder inOrder(kPieces, use);
        ThreadPool pool(threads);
        pool.run(kPieces,
                 [&](std::size_t i, int) { inOrder.put(i, pieceOf(i, inOrder.buffer())); });
        for (std::size_t i = 0; i < kPieces; ++i) {
            const InOrder::Bytes piece = pieceOf(i, {});
            expected.insert(expected.end(), piece.begin(), piece.end());
        }
        CHECK_INFO(used == expected, threads << " threads");
    }
}

// What use() throws arrives where the piece was put, and nothing is used after it.
TEST(in_order_stops_at_an_error) {
    int calls = 0;
    const auto use = [&](std::span<const std::uint8_t>) {
        if (++calls == 2) throw std::runtime_error("full");
    };
    InOrder inOrder(4, use);
    inOrder.put(1, {});
    bool thrown = false;
    try {
        inOrder.put(0, {});
    } catch (const std::runtime_error&) {
        thrown = true;
    }
    CHECK(thrown);
    inOrder.put(2, {});
    inOrder.put(3, {});
    CHECK_EQUAL(calls, 2);
}

} // namespace test_in_order
