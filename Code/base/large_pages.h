// Memory for large things, of which the first touches would cost more than what is done with them.
#pragma once

#include <cstddef>

// Before the first touch: asks the system for its largest pages. Memory that is too small for one
// is left as it is.
void adviseLargePages(void* memory, std::size_t bytes);
