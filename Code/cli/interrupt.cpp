#include "cli/interrupt.h"

#include "base/file_text.h"
#include "base/platform/platform.h"
#include "cli/command.h"

namespace {

std::atomic<bool> stopRequested = false;
std::atomic<bool> someoneListens = false;
static_assert(std::atomic<bool>::is_always_lock_free);

void onRequest() {
    if (someoneListens && !stopRequested.exchange(true)) return;
    endProgram(pendingTemporaryFile(), "\nraytracer: interrupted; nothing is written\n",
               static_cast<int>(ExitCode::Interrupted));
}

} // namespace

void handleInterrupts() { handleEndRequests(onRequest); }

StopOnInterrupt::StopOnInterrupt() {
    stopRequested = false;
    someoneListens = true;
}

StopOnInterrupt::~StopOnInterrupt() { someoneListens = false; }

const std::atomic<bool>* StopOnInterrupt::flag() const { return &stopRequested; }
