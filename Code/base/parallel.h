// A pool of threads that works through numbered jobs.
// Which thread does which job is left open: jobs must not depend on it.
#pragma once

#include "base/function_ref.h"

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

// How many threads of this program the machine runs at once, at least 1.
int hardwareThreads();

// Floating point stays as the standard has it in all threads: round to nearest, denormals kept
// (no FTZ/DAZ), so that no result depends on which thread made it. The workers set that; the
// caller's own modes are left as they are.
//
// A pool's threads go on to the next one: starting a thread costs more than many a run, and where
// there are 64 nobody but the caller could start them.
class ThreadPool {
public:
    using Job = FunctionRef<void(std::size_t, int)>;

    // 0 means hardwareThreads(). The caller of run() is worker 0, so it has threads - 1 others, or
    // as many as the system gives.
    explicit ThreadPool(int threads = 0);
    ~ThreadPool();
    ThreadPool(const ThreadPool&) = delete;
    ThreadPool& operator=(const ThreadPool&) = delete;

    int threads() const;

    // Calls job(index, worker) for index = 0 .. count-1, each once, handed out in ascending order;
    // worker in [0, threads) tells whose scratch memory to use. Returns when all are done. With
    // one thread everything runs in place. An exception stops the handing out and is thrown again
    // here; of several the one of the lowest index, which is the same in every run. When *stop
    // becomes true no further index is handed out; returns false when some were left out that way.
    // One run at a time, no nesting.
    bool run(std::size_t count, Job job, const std::atomic<bool>* stop = nullptr);

private:
    struct Helper;
    class Crew;
    struct State;
    State* state_;
};

// InOrder: numbered pieces that are made on several threads in any order, and used in theirs.

using ByteSink = FunctionRef<void(std::span<const std::uint8_t>)>;

class InOrder {
public:
    using Bytes = std::vector<std::uint8_t>;

    InOrder(std::size_t pieces, ByteSink use);
    ~InOrder();
    InOrder(const InOrder&) = delete;
    InOrder& operator=(const InOrder&) = delete;

    // A buffer of any content that a piece can be made in.
    Bytes buffer();
    // Piece `number`, from 0. No thread waits: if it is its turn, this thread uses it and those
    // behind it that are there; else whoever brings what is missing does. What use() throws arrives
    // here, and then no more is used.
    void put(std::size_t number, Bytes piece);

private:
    struct State;
    State* state_;
};
