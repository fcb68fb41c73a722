// InOrder: numbered pieces that are made on several threads in any order, and used in theirs.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <mutex>
#include <span>
#include <utility>
#include <vector>

using ByteSink = std::function<void(std::span<const std::uint8_t>)>;

class InOrder {
public:
    using Bytes = std::vector<std::uint8_t>;

    InOrder(std::size_t pieces, const ByteSink& use) : waiting_(pieces), use_(use) {}

    // A buffer of any content that a piece can be made in.
    Bytes buffer() {
        const std::lock_guard lock(mutex_);
        if (free_.empty()) return {};
        Bytes bytes = std::move(free_.back());
        free_.pop_back();
        return bytes;
    }
    // Piece `number`, from 0. Nobody waits: if it is its turn, this thread uses it and those behind
    // it that are there; else whoever brings what is missing does. What use() throws arrives
    // here, and then no more is used.
    void put(std::size_t number, Bytes piece) {
        std::unique_lock lock(mutex_);
        waiting_[number] = {std::move(piece), true};
        if (inUse_) return;
        inUse_ = true;
        while (next_ < waiting_.size() && waiting_[next_].isThere) {
            Bytes bytes = std::move(waiting_[next_++].bytes);
            lock.unlock();
            use_(bytes);
            lock.lock();
            free_.push_back(std::move(bytes));
        }
        inUse_ = false;
    }

private:
    struct Piece {
        Bytes bytes;
        bool isThere = false;
    };
    std::mutex mutex_; // of all but use_()
    std::vector<Piece> waiting_;
    std::vector<Bytes> free_;
    std::size_t next_ = 0;
    bool inUse_ = false;
    const ByteSink& use_;
};
