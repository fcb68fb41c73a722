// Keeps threads off the processor of the one that wakes them. Systems that save power, or that
// share the machine with others, start and wake a thread where the one runs that does it, though
// others are idle; there it waits for the next tick, which is as long as reading a mesh takes.
// Threads may be moved at any time: this is about where they come to be, no more. Where the system
// has no calls for it, or there is one processor only, nothing happens.
#pragma once

#include <atomic>
#include <thread>

// This thread is going to wake others, and to be at work where it runs now.
void takeProcessor();

// Moves a thread that was just started, and may be waiting for the processor of this one.
void startApart(std::thread& thread, const std::atomic<bool>& hasBegun);
// The first thing that it does itself.
void beginApart(std::atomic<bool>& hasBegun);

// While there is one, its thread is not woken on the processor that was taken last.
class WokenApart {
public:
    WokenApart();
    ~WokenApart();
    WokenApart(const WokenApart&) = delete;
    WokenApart& operator=(const WokenApart&) = delete;

private:
    bool isConfined_ = false;
};
