#include "base/parallel.h"

#include "base/platform/platform.h"

#include <cfenv>
#include <cstdint>
#include <emmintrin.h>
#include <exception>
#include <iterator>
#include <memory>
#include <mutex>
#include <new>
#include <system_error>
#include <thread>
#include <utility>
#include <vector>

#if defined(__SSE2__)
#endif

namespace {

// Waits until the value is not `old` any more, and returns what it is then. What comes next is
// often a few microseconds away, and waking up takes 50: a thread that has a processor of its own
// stays awake for that long.
std::uint32_t changed(const std::atomic<std::uint32_t>& value, std::uint32_t old, bool staysAwake) {
    for (int i = staysAwake ? 2000 : 0; i > 0 && value.load() == old; --i) {
#if defined(__SSE2__)
        _mm_pause();
#endif
    }
    value.wait(old);
    return value.load();
}

bool haveOwnProcessors(int threads) { return threads <= hardwareThreads(); }

} // namespace

int hardwareThreads() {
    static const int count = processorCount();
    return count;
}

struct ThreadPool::State {
    int threads() const { return static_cast<int>(helpers.size()) + 1; }
    void work(int worker);
    void serve(int worker);

    std::vector<std::unique_ptr<Helper>> helpers{};

    // Odd while a run is open: helpers go in, and are counted in inside before they look whether
    // they still may. Whoever wakes up after the last job was handed out is not waited for.
    std::atomic<std::uint32_t> generation{0}, inside{0};
    std::atomic<bool> quit{false};

    // The open run.
    Job job{};
    const std::atomic<bool>* stop = nullptr;
    std::size_t count = 0;
    std::atomic<std::size_t> next{0}, finished{0};
    std::mutex mutex{};
    std::exception_ptr error{}; // guarded by mutex
    std::size_t errorIndex = 0; // guarded by mutex
    std::atomic<bool> failed{false};
};

// A thread that serves one pool after the other.
struct ThreadPool::Helper {
    Helper() : thread([this] { live(); }) {}
    ~Helper() {
        hire(nullptr, 0);
        thread.join();
    }
    Helper(const Helper&) = delete;
    Helper& operator=(const Helper&) = delete;

    void hire(State* by, int as) {
        pool = by;
        worker = as;
        ++turn;
        turn.notify_one();
    }
    void awaitFree() const {
        for (std::uint32_t now = turn; now % 2 == 1;) now = changed(turn, now, true);
    }
    void live() {
        for (;;) {
            std::uint32_t now = turn;
            while (now % 2 == 0) now = changed(turn, now, haveOwnProcessors(2));
            if (!pool) return;
            pool->serve(worker);
            ++turn;
            turn.notify_one();
        }
    }

    std::atomic<std::uint32_t> turn{0}; // odd: it belongs to a pool
    State* pool = nullptr;              // nullptr: the end
    int worker = 0;
    std::thread thread; // last: it finds the rest ready
};

// Those that no pool has.
class ThreadPool::Crew {
public:
    // As many as the system gives, if it has to start any.
    std::vector<std::unique_ptr<Helper>> take(std::size_t count) {
        std::vector<std::unique_ptr<Helper>> taken;
        taken.reserve(count);
        {
            const std::lock_guard lock(mutex_);
            for (; taken.size() < count && !free_.empty(); free_.pop_back())
                taken.push_back(std::move(free_.back()));
        }
        try {
            while (taken.size() < count) taken.push_back(std::make_unique<Helper>());
        } catch (const std::system_error&) {
            // The system gives no more threads: those that run do all the work.
        } catch (const std::bad_alloc&) {
            // Nor memory for one.
        }
        return taken;
    }
    void giveBack(std::vector<std::unique_ptr<Helper>> helpers) {
        const std::lock_guard lock(mutex_);
        try {
            std::move(helpers.rbegin(), helpers.rend(), std::back_inserter(free_));
        } catch (const std::bad_alloc&) {
            // No memory for the list: the threads end with `helpers`.
        }
    }

    static Crew& all() {
        static Crew crew;
        return crew;
    }

private:
    std::mutex mutex_;
    std::vector<std::unique_ptr<Helper>> free_; // the next one to be taken is the last
};

ThreadPool::ThreadPool(int threads) {
    const int count = threads > 0 ? threads : hardwareThreads();
    auto state = std::make_unique<State>();
    if (count > 1) state->helpers = Crew::all().take(static_cast<std::size_t>(count) - 1);
    state_ = state.release();
    int worker = 0;
    for (const auto& helper : state_->helpers) helper->hire(state_, ++worker);
}

ThreadPool::~ThreadPool() {
    State& s = *state_;
    if (!s.helpers.empty()) {
        s.quit = true;
        s.generation += 2;
        s.generation.notify_all();
        for (const auto& helper : s.helpers) helper->awaitFree();
        Crew::all().giveBack(std::move(s.helpers));
    }
    delete state_;
}

int ThreadPool::threads() const { return state_->threads(); }

bool ThreadPool::run(std::size_t count, Job job, const std::atomic<bool>* stop) {
    State& s = *state_;
    s.job = job;
    s.stop = stop;
    s.count = count;
    s.next = 0;
    s.finished = 0;
    s.failed = false;
    s.error = nullptr;
    const bool alone = s.helpers.empty() || count <= 1;
    if (!alone) {
        ++s.generation;
        s.generation.notify_all();
    }
    s.work(0);
    if (!alone) {
        ++s.generation;
        for (std::uint32_t in = s.inside; in > 0;)
            in = changed(s.inside, in, haveOwnProcessors(s.threads()));
    }
    if (s.error) std::rethrow_exception(std::exchange(s.error, nullptr));
    return s.finished == count;
}

void ThreadPool::State::serve(int worker) {
    std::fesetenv(FE_DFL_ENV); // threads inherit the modes of whoever started them
    const bool staysAwake = haveOwnProcessors(threads());
    std::uint32_t seen = 0;
    while (!quit) {
        if (seen % 2 == 1) {
            ++inside;
            if (generation == seen) work(worker);
            if (--inside == 0) inside.notify_one();
        }
        seen = changed(generation, seen, staysAwake);
    }
}

void ThreadPool::State::work(int worker) {
    std::size_t done = 0;
    while (!failed.load(std::memory_order_relaxed) &&
           !(stop && stop->load(std::memory_order_relaxed))) {
        const std::size_t index = next.fetch_add(1, std::memory_order_relaxed);
        if (index >= count) break;
        try {
            job(index, worker);
            ++done;
        } catch (...) {
            const std::lock_guard lock(mutex);
            if (!error || index < errorIndex) {
                error = std::current_exception();
                errorIndex = index;
            }
            failed = true;
        }
    }
    finished += done;
}

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
