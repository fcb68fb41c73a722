// The processors that threads can run on.
#pragma once

// How many of them this program may use at once, at least 1.
int processorCount();
