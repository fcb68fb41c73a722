// Memory for large things, of which the first touches would cost more than what is done with them.
#pragma once

#include <cstddef>

// Before the first touch: asks the system for its largest pages. Memory that is too small for one
// is left as it is.
void adviseLargePages(void* memory, std::size_t bytes);

// Once, before anything else is allocated: small things come from large pages, too, as far as they
// fit into the first 64 MB, and none of that is given back in between. Scenes of 10^4 solids are
// read and built in half the time.
void startLargeHeap();
