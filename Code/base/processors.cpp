#include "base/processors.h"

#if defined(__linux__)

#include <algorithm>
#include <array>
#include <cstddef>
#include <pthread.h>
#include <sched.h>

namespace {

// By thread: its processor, +1. Threads that are numbered higher are left to the system.
std::array<std::atomic<int>, 1024> taken;
std::atomic<std::size_t> threadCount = 0;

std::atomic<int>* placeOfThis() {
    thread_local const std::size_t number = threadCount++;
    return number < taken.size() ? &taken[number] : nullptr;
}

// Those of the program. Who asks first, for another thread, is not confined.
const cpu_set_t& allProcessors() {
    static const cpu_set_t all = [] {
        cpu_set_t set;
        CPU_ZERO(&set);
        if (sched_getaffinity(0, sizeof set, &set) != 0) CPU_ZERO(&set);
        return set;
    }();
    return all;
}

bool setProcessors(pthread_t thread, const cpu_set_t& set) {
    return CPU_COUNT(&set) > 0 && pthread_setaffinity_np(thread, sizeof set, &set) == 0;
}

// To what nobody but `itself` has taken, if anything is left.
bool confine(pthread_t thread, const std::atomic<int>* itself) {
    cpu_set_t left = allProcessors();
    const std::size_t count = std::min(threadCount.load(), taken.size());
    for (std::size_t i = 0; i < count; ++i)
        if (const int place = taken[i]; place > 0 && &taken[i] != itself) CPU_CLR(place - 1, &left);
    return setProcessors(thread, left);
}

void release(pthread_t thread) { setProcessors(thread, allProcessors()); }

} // namespace

void takeProcessor() {
    if (std::atomic<int>* const place = placeOfThis()) *place = sched_getcpu() + 1;
}
void leaveProcessor() {
    if (std::atomic<int>* const place = placeOfThis()) *place = 0;
}

void startApart(std::thread& thread, const std::atomic<bool>& hasBegun) {
    takeProcessor();
    // Whatever comes first, in the end it is free.
    if (confine(thread.native_handle(), nullptr) && hasBegun) release(thread.native_handle());
}
void beginApart(std::atomic<bool>& hasBegun) {
    hasBegun = true;
    confine(pthread_self(), placeOfThis());
    release(pthread_self());
    takeProcessor();
}

WokenApart::WokenApart() {
    if (const std::atomic<int>* const place = placeOfThis())
        isConfined_ = confine(pthread_self(), place);
}
WokenApart::~WokenApart() {
    if (isConfined_) release(pthread_self());
    takeProcessor();
}

#else

void takeProcessor() {}
void leaveProcessor() {}
void startApart(std::thread&, const std::atomic<bool>&) {}
void beginApart(std::atomic<bool>&) {}
WokenApart::WokenApart() = default;
WokenApart::~WokenApart() = default;

#endif
