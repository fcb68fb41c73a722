// The processors that threads can run on.
#pragma once

// Returns how many of them this program may use at once, at least 1: those that the system lets it
// run on, and no more than the time that its control group is given.
int processorCount();
