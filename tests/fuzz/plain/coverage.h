// Which code an input has reached, by g++'s -fsanitize-coverage=trace-pc.
#pragma once

#include <cstddef>

namespace fuzz {

// Forgets what was reached since the call before.
void startCoverage();
// Of what was reached since then: how much is new in this process. A place counts again when it is
// passed about twice as often as ever before, so that loops that run longer are found, too.
std::size_t newCoverage();
// Places reached in this process.
std::size_t placesCovered();

} // namespace fuzz
