// Pieces made on several threads are used one at a time and in order.
#include "read/in_turn.h"

#include "check.h"

#include <atomic>
#include <stdexcept>
#include <string>
#include <vector>

namespace test_in_turn {

TEST(in_turn_uses_pieces_in_order) {
    for (const int threads : {1, 2, 4, 9}) {
        constexpr std::size_t kPieces = 500;
        std::atomic<int> using_{0};
        std::vector<std::size_t> used;
        inTurn<std::vector<std::size_t>>(
            threads, kPieces, [](std::size_t i) { return std::vector<std::size_t>{i}; },
            [&](std::vector<std::size_t> piece) {
                CHECK(++using_ == 1);
                used.push_back(piece.at(0));
                --using_;
            });
        CHECK_EQUAL(used.size(), kPieces);
        for (std::size_t i = 0; i < used.size(); ++i)
            CHECK_INFO(used[i] == i, threads << " threads: " << used[i] << " as number " << i);
    }
}

// Nothing behind a piece that could not be made or used is used.
TEST(in_turn_ends_with_an_exception) {
    for (const int threads : {1, 3}) {
        std::vector<int> used;
        const auto use = [&](int piece) {
            if (piece == 20) throw std::runtime_error("use");
            used.push_back(piece);
        };
        CHECK_EQUAL(check::thrown([&] {
                        inTurn<int>(
                            threads, 50,
                            [](std::size_t i) {
                                if (i == 10) throw std::runtime_error("make");
                                return static_cast<int>(i);
                            },
                            use);
                    }),
                    "make");
        CHECK_INFO(used.size() <= 10, used.size());
        used.clear();
        CHECK_EQUAL(check::thrown([&] {
                        inTurn<int>(
                            threads, 50, [](std::size_t i) { return static_cast<int>(i); }, use);
                    }),
                    "use");
        CHECK_INFO(used.size() == 20 && used.back() == 19, used.size());
    }
}

} // namespace test_in_turn
