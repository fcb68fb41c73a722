// How many processors the time amounts to that a control group of Linux is given.
#pragma once

#include <string_view>

// Rounds up: "200000 100000" of microseconds per period is 2. 0 where there is no limit
// ("max 100000", "-1 100000") and where it is no such text.
int processorsOfQuota(std::string_view quota);
