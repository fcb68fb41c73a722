// Numbered jobs on as many threads as there are jobs for.
#pragma once

#include "base/parallel.h"

#include <algorithm>
#include <cstddef>

// Calls job(i) for i = 0 .. count-1, each once, on at most `threads` threads (0: as many as the
// machine has); returns when all are done. Which thread does which is left open. Of several
// exceptions the one of the lowest i arrives here, as if the jobs were done in order.
template <class Job> void forEachOn(int threads, std::size_t count, const Job& job) {
    const auto wanted = static_cast<std::size_t>(threads > 0 ? threads : hardwareThreads());
    if (wanted == 1 || count <= 1) {
        for (std::size_t i = 0; i < count; ++i) job(i);
        return;
    }
    ThreadPool pool(static_cast<int>(std::min(wanted, count)));
    pool.run(count, [&](std::size_t i, int) { job(i); });
}

// The same for 0 .. count-1 in parts of `together` or, at the end, fewer: job(first, last).
template <class Job>
void forEachPart(int threads, std::size_t count, std::size_t together, const Job& job) {
    forEachOn(threads, (count + together - 1) / together, [&](std::size_t part) {
        job(part * together, std::min(count, (part + 1) * together));
    });
}
