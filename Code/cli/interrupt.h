// Requests that the program ends (SIGINT, SIGTERM, SIGHUP). While something can stop by itself (a
// render), the first signal asks it to stop; at any other time, and the second time, the program
// ends at once with exit code 130. A temporary file is removed in both cases, so no half-written
// picture is left.
#pragma once

#include <atomic>

// Call once, at the start of the program: see handleEndRequests(), which also makes errors of what
// would end the program without a word.
void handleInterrupts();

// While one exists, the first signal sets the flag instead of ending the program. One at a time.
class StopOnInterrupt {
public:
    StopOnInterrupt();
    ~StopOnInterrupt();
    StopOnInterrupt(const StopOnInterrupt&) = delete;
    StopOnInterrupt& operator=(const StopOnInterrupt&) = delete;

    const std::atomic<bool>* flag() const;
    bool stopped() const { return *flag(); }
};
