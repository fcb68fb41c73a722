#include "base/parallel.h"

#include <cfenv>
#include <new>
#include <system_error>
#include <utility>

int hardwareThreads() {
    const unsigned count = std::thread::hardware_concurrency(); // 0 when unknown
    return count > 0 ? static_cast<int>(count) : 1;
}

ThreadPool::ThreadPool(int threads) {
    const int count = threads > 0 ? threads : hardwareThreads();
    // Now, not between two starts: an exception there would find threads that nobody joins.
    workers_.reserve(static_cast<std::size_t>(count) - 1);
    try {
        for (int worker = 1; worker < count; ++worker)
            workers_.emplace_back([this, worker] { workerLoop(worker); });
    } catch (const std::system_error&) {
        // The system gives no more threads: those that run do all the work.
    } catch (const std::bad_alloc&) {
        // Nor memory for one.
    }
}

ThreadPool::~ThreadPool() {
    {
        const std::lock_guard lock(mutex_);
        quit_ = true;
    }
    wake_.notify_all();
    for (std::thread& worker : workers_) worker.join();
}

bool ThreadPool::run(std::size_t count, const std::function<void(std::size_t, int)>& job,
                     const std::atomic<bool>* stop) {
    {
        const std::lock_guard lock(mutex_);
        job_ = &job;
        stop_ = stop;
        count_ = count;
        next_ = 0;
        finished_ = 0;
        failed_ = false;
        error_ = nullptr;
        busy_ = static_cast<int>(workers_.size());
        ++generation_;
    }
    wake_.notify_all();
    work(0);
    std::unique_lock lock(mutex_);
    done_.wait(lock, [this] { return busy_ == 0; });
    job_ = nullptr;
    if (error_) std::rethrow_exception(std::exchange(error_, nullptr));
    return finished_ == count;
}

void ThreadPool::workerLoop(int worker) {
    std::fesetenv(FE_DFL_ENV); // threads inherit the modes of whoever started them
    std::uint64_t seen = 0;
    for (;;) {
        {
            std::unique_lock lock(mutex_);
            wake_.wait(lock, [&] { return quit_ || generation_ != seen; });
            if (quit_) return;
            seen = generation_;
        }
        work(worker);
        const std::lock_guard lock(mutex_);
        if (--busy_ == 0) done_.notify_one();
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
