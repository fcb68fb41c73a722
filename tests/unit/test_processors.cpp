// Threads of a pool sleep so that they are not woken where their caller is, and may run anywhere
// while they work.
#include "base/parallel.h"
#include "check.h"

#if defined(__linux__)

#include <atomic>
#include <chrono>
#include <sched.h>
#include <thread>
#include <unistd.h>

namespace test_processors {

namespace {

cpu_set_t processorsOf(pid_t thread) {
    cpu_set_t set;
    CPU_ZERO(&set);
    CHECK_EQUAL(sched_getaffinity(thread, sizeof set, &set), 0);
    return set;
}

// Says whether it happened within seconds.
template <class Condition> bool comesTrue(const Condition& condition) {
    using namespace std::chrono;
    const auto end = steady_clock::now() + seconds(10);
    while (!condition()) {
        if (steady_clock::now() > end) return false;
        std::this_thread::sleep_for(milliseconds(1));
    }
    return true;
}

} // namespace

TEST(processors_sleepers_keep_away) {
    const cpu_set_t all = processorsOf(0);
    if (CPU_COUNT(&all) < 2) return;
    ThreadPool pool(2);
    std::atomic<pid_t> helper{0};
    cpu_set_t atWork;
    const auto work = [&] {
        std::atomic<int> inside{0};
        pool.run(2, [&](std::size_t, int worker) {
            if (worker == 1) atWork = processorsOf(helper = gettid());
            ++inside;
            while (inside < 2) std::this_thread::yield(); // each of the two has one job
        });
    };
    for (int here = 0; here < CPU_SETSIZE; ++here) {
        if (!CPU_ISSET(here, &all)) continue;
        cpu_set_t onlyHere;
        CPU_ZERO(&onlyHere);
        CPU_SET(here, &onlyHere);
        CHECK_EQUAL(sched_setaffinity(0, sizeof onlyHere, &onlyHere), 0);
        work();
        CHECK_INFO(CPU_EQUAL(&atWork, &all), "with the caller on " << here);
        const bool keepsAway = comesTrue([&] {
            const cpu_set_t asleep = processorsOf(helper);
            return !CPU_ISSET(here, &asleep);
        });
        CHECK_INFO(keepsAway, "the caller is on " << here);
    }
    CHECK_EQUAL(sched_setaffinity(0, sizeof all, &all), 0);
}

// Also where there are more threads than processors.
TEST(processors_all_for_work) {
    const cpu_set_t all = processorsOf(0);
    const int threads = 2 * CPU_COUNT(&all) + 1;
    ThreadPool pool(threads);
    std::atomic<int> inside{0};
    std::atomic<int> free{0};
    pool.run(static_cast<std::size_t>(threads), [&](std::size_t, int) {
        const cpu_set_t mine = processorsOf(0);
        if (CPU_EQUAL(&mine, &all)) ++free;
        ++inside;
        while (inside < threads) std::this_thread::yield();
    });
    CHECK_EQUAL(free.load(), threads);
}

} // namespace test_processors

#endif
