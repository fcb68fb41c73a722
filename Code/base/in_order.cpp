#include "base/in_order.h"

#include <mutex>
#include <utility>

struct InOrder::State {
    struct Piece {
        Bytes bytes;
        bool isThere = false;
    };
    std::vector<Piece> waiting;
    ByteSink use;
    std::mutex mutex{}; // of all but use()
    std::vector<Bytes> free{};
    std::size_t next = 0;
    bool inUse = false;
};

InOrder::InOrder(std::size_t pieces, ByteSink use)
    : state_(new State{std::vector<State::Piece>(pieces), use}) {}

InOrder::~InOrder() { delete state_; }

InOrder::Bytes InOrder::buffer() {
    const std::lock_guard lock(state_->mutex);
    if (state_->free.empty()) return {};
    Bytes bytes = std::move(state_->free.back());
    state_->free.pop_back();
    return bytes;
}

void InOrder::put(std::size_t number, Bytes piece) {
    State& s = *state_;
    std::unique_lock lock(s.mutex);
    s.waiting[number] = {std::move(piece), true};
    if (s.inUse) return;
    s.inUse = true;
    while (s.next < s.waiting.size() && s.waiting[s.next].isThere) {
        Bytes bytes = std::move(s.waiting[s.next++].bytes);
        lock.unlock();
        s.use(bytes);
        lock.lock();
        s.free.push_back(std::move(bytes));
    }
    s.inUse = false;
}
