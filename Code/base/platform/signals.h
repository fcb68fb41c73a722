// Requests that the program ends, from its user or its system.
#pragma once

#include <string_view>

// From now on calls onRequest() at each such request: SIGINT, SIGTERM and SIGHUP where there are
// such signals. What was ignored before, as nohup and shells with jobs in the background have it,
// stays ignored. The call may come in any thread, in the middle of anything: it may use lock-free
// atomics and endProgram(), and nothing else. System calls that it interrupts go on after it.
// Besides, to write into a closed pipe or beyond the limit of a file's size fails from now on, with
// an error of the call that writes; it would end the program without a word.
void handleEndRequests(void (*onRequest)());

// For onRequest(): removes the file of that name (nullptr: none), writes the text to stderr and
// ends the program at once, without destructors.
[[noreturn]] void endProgram(const char* fileToRemove, std::string_view text, int exitCode);
