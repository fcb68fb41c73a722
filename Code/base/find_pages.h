// The memory behind addresses, before someone waits for it. Where memory is virtual twice the host
// may have to find it first, 1 to 2 ms for each page of 2 MB, and a program that fills one array
// after the other spends them on one thread. What is found is what a first touch finds: zeros.
#pragma once

#include <cstddef>

// Of this memory, by so many threads together. Returns when it is there.
void findPages(void* memory, std::size_t bytes, int threads);

// Of what malloc will hand out next, about so many bytes; useLargePages() has made the room. A
// thread of its own does that and this one goes on. To be called by one thread at a time; does
// nothing after the first call.
void findRoomAhead(std::size_t bytes);
