#include "base/parallel.h"
#include "check.h"

#include <cfenv>
#include <chrono>
#include <mutex>
#include <set>
#include <stdexcept>
#include <string>
#include <thread>

namespace test_parallel {

TEST(parallel_each_index_once) {
    for (const int threads : {1, 2, 3, 8}) {
        ThreadPool pool(threads);
        CHECK_EQUAL(pool.threads(), threads);
        for (const std::size_t count : {0u, 1u, 7u, 10000u}) { // the pool is used again
            std::vector<std::atomic<int>> calls(count);
            std::atomic<bool> workersInRange{true};
            const bool all = pool.run(count, [&](std::size_t index, int worker) {
                ++calls[index];
                if (worker < 0 || worker >= threads) workersInRange = false;
            });
            CHECK(all);
            CHECK(workersInRange);
            for (const std::atomic<int>& n : calls) CHECK_EQUAL(n.load(), 1);
        }
    }
    CHECK(hardwareThreads() >= 1);
    CHECK_EQUAL(ThreadPool(0).threads(), hardwareThreads());
}

TEST(parallel_one_thread_runs_in_place) {
    ThreadPool pool(1);
    std::vector<std::size_t> order;
    const std::thread::id here = std::this_thread::get_id();
    pool.run(100, [&](std::size_t index, int worker) {
        CHECK(std::this_thread::get_id() == here);
        CHECK_EQUAL(worker, 0);
        order.push_back(index);
    });
    for (std::size_t i = 0; i < order.size(); ++i) CHECK_EQUAL(order[i], i);
}

// Two jobs of one worker never overlap: scratch memory per worker needs no lock.
TEST(parallel_worker_scratch) {
    ThreadPool pool(4);
    std::vector<std::atomic<int>> inside(4);
    std::atomic<bool> overlapped{false};
    pool.run(2000, [&](std::size_t, int worker) {
        auto& mine = inside[static_cast<std::size_t>(worker)];
        if (++mine != 1) overlapped = true;
        std::this_thread::yield();
        --mine;
    });
    CHECK(!overlapped);
}

TEST(parallel_exceptions) {
    for (const int threads : {1, 4}) {
        ThreadPool pool(threads);
        for (int repeat = 0; repeat < 50; ++repeat) {
            // The lowest index that throws is reported, whoever is first.
            CHECK_THROWS(pool.run(1000,
                                  [](std::size_t index, int) {
                                      if (index % 10 == 7)
                                          throw std::runtime_error("job " + std::to_string(index) +
                                                                   "!");
                                  }),
                         "job 7!");
        }
        std::atomic<int> calls{0}; // and the pool still works
        CHECK(pool.run(100, [&](std::size_t, int) { ++calls; }));
        CHECK_EQUAL(calls.load(), 100);
    }
}

// Also when the lower index throws last: job 0 waits until job 1 has thrown.
TEST(parallel_lowest_exception) {
    ThreadPool pool(2);
    std::atomic<bool> thrown{false};
    const auto job = [&](std::size_t index, int) {
        if (index == 1) {
            thrown = true;
            throw std::runtime_error("job 1");
        }
        while (!thrown) std::this_thread::yield();
        std::this_thread::sleep_for(std::chrono::milliseconds(20));
        throw std::runtime_error("job 0");
    };
    CHECK_THROWS(pool.run(2, job), "job 0");
}

TEST(parallel_stop) {
    for (const int threads : {1, 4}) {
        ThreadPool pool(threads);
        std::atomic<bool> stop{false};
        std::atomic<int> calls{0};
        const bool all = pool.run(
            100000,
            [&](std::size_t index, int) {
                ++calls;
                if (index == 50) stop = true;
            },
            &stop);
        CHECK(!all);
        CHECK(calls >= 51 && calls < 100000);
        calls = 0;
        CHECK(!pool.run(
            10, [&](std::size_t, int) { ++calls; }, &stop));
        CHECK_EQUAL(calls.load(), 0);
        stop = false;
        CHECK(pool.run(
            10, [&](std::size_t, int) { ++calls; }, &stop));
    }
}

// Threads inherit the rounding of their maker; the workers must not.
TEST(parallel_rounding_is_default) {
    std::fesetround(FE_UPWARD);
    ThreadPool pool(3);
    std::fesetround(FE_TONEAREST);
    std::atomic<int> wrong{0};
    pool.run(3000, [&](std::size_t, int) {
        volatile float denormal = 0x1p-149f, one = 1;
        if (std::fegetround() != FE_TONEAREST || denormal * one == 0) ++wrong;
        std::this_thread::yield();
    });
    CHECK_EQUAL(wrong.load(), 0);
}

// A pool's threads go on to the next one: a hundred pools need no more of them than one.
TEST(parallel_threads_are_kept) {
    std::mutex mutex;
    std::set<std::thread::id> seen;
    const int repeats = 100;
    for (int repeat = 0; repeat < repeats; ++repeat) {
        ThreadPool pool(2);
        std::atomic<int> there{0};
        pool.run(2, [&](std::size_t, int) {
            ++there;
            while (there < 2) std::this_thread::yield(); // so that both have one job
            const std::lock_guard lock(mutex);
            seen.insert(std::this_thread::get_id());
        });
    }
    // Other tests may leave some that take turns.
    CHECK(seen.size() < repeats / 2);
}

// Jobs may have pools of their own, and pools may be there at the same time.
TEST(parallel_pools_in_jobs) {
    std::atomic<int> calls{0};
    ThreadPool outer(4);
    for (int repeat = 0; repeat < 20; ++repeat)
        outer.run(8, [&](std::size_t, int) {
            ThreadPool inner(3), other(2);
            inner.run(10, [&](std::size_t, int) { ++calls; });
            other.run(5, [&](std::size_t, int) { ++calls; });
        });
    CHECK_EQUAL(calls.load(), 20 * 8 * 15);
}

// Whoever wakes up late finds the run over, or the next one open, but never jobs of the last one.
TEST(parallel_short_runs) {
    ThreadPool pool(8);
    std::size_t wrong = 0;
    for (int repeat = 0; repeat < check::scaled(20000); ++repeat) {
        std::vector<std::atomic<int>> calls(static_cast<std::size_t>(1 + repeat % 5));
        const std::size_t count = calls.size();
        pool.run(count, [&](std::size_t index, int) { ++calls[index]; });
        for (const std::atomic<int>& n : calls)
            if (n != 1) ++wrong;
    }
    CHECK_EQUAL(wrong, 0u);
}

} // namespace test_parallel
