// What the program needs of the file system beside <cstdio> and <filesystem>.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <span>
#include <string>
#include <string_view>

// Why this process may not write to the file, or into the folder, of that name, in the words of the
// system; empty where it may. Says nothing of the room on the disk, and leaves both as they are.
std::string whyNotWritable(const std::string& name);

// The bytes of a file from `first` on. Several threads may read one file at once; where the stream
// stands afterwards is left open. Returns how many bytes came: fewer than asked for at the end of
// the file and after an error, none where the system has no such call.
std::size_t readAt(std::FILE* file, std::uint64_t first, std::span<char> to);

// A number that no other running program of this machine has, the same at every call: for the names
// of temporary files.
unsigned long processNumber();

// Large pages, and how much memory the program has had.

// Asks the system for its largest pages where whole ones lie in this memory, before its first
// touch: that is fewer faults then, and fewer misses of address translation later. Does nothing
// where the memory is too small or the system has no such call.
void preferLargePages(void* memory, std::size_t bytes);

// The most memory that the program has had at once so far, in bytes; 0 where the system can't tell.
std::uint64_t peakBytes();

// Requests that the program ends, from its user or its system.

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

// What stderr is connected to, and how large it is.

struct Terminal {
    bool present = false;        // a terminal that knows the control sequences of ECMA-48
    int columns = 80, rows = 24; // the usual ones where there is none or it does not tell
};
Terminal terminalOfStderr();

// The processors that threads can run on.

// Returns how many of them this program may use at once, at least 1: those that the system lets it
// run on, and no more than the time that its control group is given.
int processorCount();
