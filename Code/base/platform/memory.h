// Large pages, and how much memory the program has had.
#pragma once

#include <cstddef>
#include <cstdint>

// Asks the system for its largest pages where whole ones lie in this memory, before its first
// touch: that is fewer faults then, and fewer misses of address translation later. Does nothing
// where the memory is too small or the system has no such call.
void preferLargePages(void* memory, std::size_t bytes);

// The most memory that the program has had at once so far, in bytes; 0 where the system can't tell.
std::uint64_t peakBytes();
