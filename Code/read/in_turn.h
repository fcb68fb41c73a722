// Pieces that several threads make in any order, and that are used in theirs.
#pragma once

#include "base/for_each.h"

#include <cstddef>
#include <mutex>
#include <optional>
#include <utility>
#include <vector>

// use(make(i)) for i = 0 .. count-1. Nobody waits: a thread that has made a piece uses it if it is
// its turn, and those behind it that are there; else whoever makes what is missing does. An
// exception ends it all and arrives here.
template <class Piece, class Make, class Use>
void inTurn(int threads, std::size_t count, const Make& make, const Use& use) {
    std::mutex mutex; // of all but use()
    std::vector<std::optional<Piece>> waiting(count);
    std::size_t next = 0;
    bool inUse = false;
    forEachOn(threads, count, [&](std::size_t i) {
        Piece made = make(i);
        std::unique_lock lock(mutex);
        waiting[i] = std::move(made);
        if (inUse) return;
        inUse = true; // and stays so after an exception
        while (next < count && waiting[next]) {
            Piece piece = *std::exchange(waiting[next++], std::nullopt);
            lock.unlock();
            use(std::move(piece));
            lock.lock();
        }
        inUse = false;
    });
}
