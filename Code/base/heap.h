// The heap of the whole program.
#pragma once

// Asks for memory as a renderer uses it: much, at once, and until the end. The first touch of every
// 4 KB page costs up to 2 us where memory is virtual, a tenth of the time of a small picture; so
// the heap's beginning comes in pages of 2 MB, what is freed there stays for others, and arrays of
// some megabytes come from there, too. To be called first in main(); where it is unknown nothing
// changes.
void prepareHeap();
