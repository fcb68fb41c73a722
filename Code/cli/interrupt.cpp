#include "cli/interrupt.h"

#include "base/file.h"
#include "cli/exit_codes.h"

#include <csignal>
#include <cstring>
#include <unistd.h>

namespace {

std::atomic<bool> stopRequested = false;
std::atomic<bool> someoneListens = false;
static_assert(std::atomic<bool>::is_always_lock_free);

// Only what POSIX allows in a signal handler: atomics, unlink(), write(), _exit().
void onSignal(int) {
    if (someoneListens && !stopRequested.exchange(true)) return;
    if (const char* name = pendingTemporaryFile()) unlink(name);
    constexpr const char* kMessage = "\nraytracer: interrupted; nothing is written\n";
    // Nothing can be done about a message that does not arrive.
    [[maybe_unused]] const auto written = write(STDERR_FILENO, kMessage, std::strlen(kMessage));
    _exit(static_cast<int>(ExitCode::Interrupted));
}

} // namespace

void handleInterrupts() {
    struct sigaction action {};
    action.sa_handler = onSignal;
    action.sa_flags = SA_RESTART; // reads and writes go on
    sigemptyset(&action.sa_mask);
    for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
        struct sigaction before {};
        // nohup and shells that start jobs in the background have it ignored on purpose.
        if (sigaction(signal, nullptr, &before) == 0 && before.sa_handler == SIG_IGN) continue;
        sigaction(signal, &action, nullptr);
    }
    // The call that writes fails with EPIPE or EFBIG instead. A render whose progress nobody reads
    // any more still writes its picture.
    for (const int signal : {SIGPIPE, SIGXFSZ}) static_cast<void>(std::signal(signal, SIG_IGN));
}

StopOnInterrupt::StopOnInterrupt() {
    stopRequested = false;
    someoneListens = true;
}

StopOnInterrupt::~StopOnInterrupt() { someoneListens = false; }

const std::atomic<bool>* StopOnInterrupt::flag() const { return &stopRequested; }
