// Keeps the threads of the program off each other's processors. Systems that save power, or that
// share the machine with others, start and wake a thread on the processor of the one that does it,
// though others are idle; there it waits for the next tick, which is as long as reading a mesh
// takes. Threads may be moved at any time: this is about where they come to be, no more. Where the
// system has no calls for it, or there are more threads than processors, nothing happens.
#pragma once

#include <atomic>
#include <thread>

// This thread is at work where it runs now; others are to keep away from there until it says so
// again, or leaves.
void takeProcessor();
void leaveProcessor();

// Moves a thread that was just started, and may be waiting for the processor of this one.
void startApart(std::thread& thread, const std::atomic<bool>& hasBegun);
// The first thing that it does itself.
void beginApart(std::atomic<bool>& hasBegun);

// While there is one, its thread is only woken on processors that no other one has taken.
class WokenApart {
public:
    WokenApart();
    ~WokenApart();
    WokenApart(const WokenApart&) = delete;
    WokenApart& operator=(const WokenApart&) = delete;

private:
    bool isConfined_ = false;
};
