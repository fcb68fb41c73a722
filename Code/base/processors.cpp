#include "base/processors.h"

#if defined(__linux__)

#include <pthread.h>
#include <sched.h>

namespace {

std::atomic<int> taken{-1};

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

bool confine(pthread_t thread) {
    cpu_set_t left = allProcessors();
    if (const int processor = taken; processor >= 0) CPU_CLR(processor, &left);
    return setProcessors(thread, left);
}
void release(pthread_t thread) { setProcessors(thread, allProcessors()); }

} // namespace

void takeProcessor() { taken = sched_getcpu(); }

void startApart(std::thread& thread, const std::atomic<bool>& hasBegun) {
    takeProcessor();
    // Whatever comes first, in the end it is free.
    if (confine(thread.native_handle()) && hasBegun) release(thread.native_handle());
}
void beginApart(std::atomic<bool>& hasBegun) {
    hasBegun = true;
    confine(pthread_self());
    release(pthread_self());
}

WokenApart::WokenApart() : isConfined_(confine(pthread_self())) {}
WokenApart::~WokenApart() {
    if (isConfined_) release(pthread_self());
}

#else

void takeProcessor() {}
void startApart(std::thread&, const std::atomic<bool>&) {}
void beginApart(std::atomic<bool>&) {}
WokenApart::WokenApart() = default;
WokenApart::~WokenApart() = default;

#endif
