#include "base/parallel.h"

#include "base/large_pages.h"
#include "base/processors.h"

#include <cfenv>
#include <iterator>
#include <new>
#include <system_error>
#include <thread>
#include <utility>

#if defined(__SSE2__)
#include <emmintrin.h>
#endif

namespace {

// What comes next is often a few microseconds away, and waking up takes 50: a thread that has a
// processor of its own stays awake for that long. Says whether the value is not `old` any more.
bool changesSoon(const std::atomic<std::uint32_t>& value, std::uint32_t old, bool staysAwake) {
    for (int i = staysAwake ? 2000 : 0; i > 0; --i) {
        if (value.load() != old) return true;
#if defined(__SSE2__)
        _mm_pause();
#endif
    }
    return false;
}

// Waits until the value is not `old` any more.
std::uint32_t changed(const std::atomic<std::uint32_t>& value, std::uint32_t old, bool staysAwake) {
    if (!changesSoon(value, old, staysAwake)) value.wait(old);
    return value.load();
}
// The same for a helper, whom somebody wakes that goes on working.
std::uint32_t changedApart(const std::atomic<std::uint32_t>& value, std::uint32_t old,
                           bool staysAwake) {
    if (!changesSoon(value, old, staysAwake)) {
        const WokenApart apart;
        value.wait(old);
    }
    return value.load();
}

bool haveOwnProcessors(int threads) { return threads <= hardwareThreads(); }

} // namespace

int hardwareThreads() {
    // Asked once: a thread that is confined for a while would get another answer.
    static const int count = static_cast<int>(std::thread::hardware_concurrency());
    return count > 0 ? count : 1; // 0: unknown
}

// A thread that serves one pool after the other.
struct ThreadPool::Helper {
    Helper() : thread([this] { live(); }) { startApart(thread, hasBegun); }
    ~Helper() {
        hire(nullptr, 0);
        thread.join();
    }
    Helper(const Helper&) = delete;
    Helper& operator=(const Helper&) = delete;

    void hire(ThreadPool* by, int as) {
        pool = by;
        worker = as;
        ++turn;
        turn.notify_one();
    }
    void awaitFree() const {
        for (std::uint32_t now = turn; now % 2 == 1;) now = changed(turn, now, true);
    }
    void live() {
        beginApart(hasBegun);
        useLargePagesInThread();
        for (;;) {
            std::uint32_t now = turn;
            while (now % 2 == 0) now = changedApart(turn, now, haveOwnProcessors(2));
            if (!pool) return;
            pool->serve(worker);
            ++turn;
            turn.notify_one();
        }
    }

    std::atomic<std::uint32_t> turn{0}; // odd: it belongs to a pool
    ThreadPool* pool = nullptr;         // nullptr: the end
    int worker = 0;
    std::atomic<bool> hasBegun{false};
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

private:
    std::mutex mutex_;
    std::vector<std::unique_ptr<Helper>> free_; // the next one to be taken is the last
};

ThreadPool::Crew& ThreadPool::crew() {
    static Crew all;
    return all;
}

ThreadPool::ThreadPool(int threads) {
    const int processors = hardwareThreads(), count = threads > 0 ? threads : processors;
    if (count == 1) return;
    takeProcessor();
    helpers_ = crew().take(static_cast<std::size_t>(count) - 1);
    int worker = 0;
    for (const auto& helper : helpers_) helper->hire(this, ++worker);
}

ThreadPool::~ThreadPool() {
    if (helpers_.empty()) return;
    quit_ = true;
    generation_ += 2;
    generation_.notify_all();
    for (const auto& helper : helpers_) helper->awaitFree();
    crew().giveBack(std::move(helpers_));
}

bool ThreadPool::run(std::size_t count, const std::function<void(std::size_t, int)>& job,
                     const std::atomic<bool>* stop) {
    job_ = &job;
    stop_ = stop;
    count_ = count;
    next_ = 0;
    finished_ = 0;
    failed_ = false;
    error_ = nullptr;
    const bool alone = helpers_.empty() || count <= 1;
    if (!alone) {
        takeProcessor();
        ++generation_;
        generation_.notify_all();
    }
    work(0);
    if (!alone) {
        ++generation_;
        for (std::uint32_t in = inside_; in > 0;)
            in = changed(inside_, in, haveOwnProcessors(threads()));
    }
    job_ = nullptr;
    if (error_) std::rethrow_exception(std::exchange(error_, nullptr));
    return finished_ == count;
}

void ThreadPool::serve(int worker) {
    std::fesetenv(FE_DFL_ENV); // threads inherit the modes of whoever started them
    const bool staysAwake = haveOwnProcessors(threads());
    std::uint32_t seen = 0;
    while (!quit_) {
        if (seen % 2 == 1) {
            ++inside_;
            if (generation_ == seen) work(worker);
            if (--inside_ == 0) inside_.notify_one();
        }
        seen = changedApart(generation_, seen, staysAwake);
    }
}

void ThreadPool::work(int worker) {
    std::size_t finished = 0;
    while (!failed_.load(std::memory_order_relaxed) &&
           !(stop_ && stop_->load(std::memory_order_relaxed))) {
        const std::size_t index = next_.fetch_add(1, std::memory_order_relaxed);
        if (index >= count_) break;
        try {
            (*job_)(index, worker);
            ++finished;
        } catch (...) {
            const std::lock_guard lock(mutex_);
            if (!error_ || index < errorIndex_) {
                error_ = std::current_exception();
                errorIndex_ = index;
            }
            failed_ = true;
        }
    }
    finished_ += finished;
}
