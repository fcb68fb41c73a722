// How the heap gets its memory from the system.
#pragma once

// Call once, before much is allocated. Reading and preparing a scene of some thousand shapes takes
// a dozen megabytes in small pieces; the first touches of so many pages of 4 KB, and giving them
// back in between, are a tenth of its picture.
void growHeapInLargeSteps();
