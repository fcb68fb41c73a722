// Memory for large things, of which the first touches would cost more than what is done with them.
#pragma once

#include <cstddef>

// Of so much memory on it is worth trying whether large pages are dear: where they are, the trial
// takes as long as all small pages of less together, and where they are not, those take as long.
inline constexpr std::size_t kWorthATrial = std::size_t{1} << 24;

// How much will be written in all, as far as one can say. If that is less than kWorthATrial, none
// of what follows asks for large pages but for an array that is as large as that by itself.
void foreseeMemory(std::size_t bytes);

// Before the first touch: asks the system for its largest pages. Memory that is too small for one
// is left as it is.
void adviseLargePages(void* memory, std::size_t bytes);
// The same for what holds nothing yet and is to be written from its start on: writes to the first
// page. If that takes too long, small amounts of memory are left as they are from then on.
void tryLargePages(void* memory, std::size_t bytes);
// Has one taken too long?
bool largePagesAreDear();

// The same for what malloc will hand out next, to the main thread: about so many bytes in small and
// large pieces. They stay with the program when they are freed.
// foreseen: so many of them will be written, as far as one can say. Their first large pages are
// tried like that.
// inThreads: others may do so for themselves, which takes room from the last megabytes there are.
void useLargePages(std::size_t bytes, std::size_t foreseen, bool inThreads);
// Then, for the first megabytes of what malloc will hand out to this thread, which is another one
// and has not asked for any. What it is to write belongs to it from the first touch on.
void useLargePagesInThread();

// Zeros that nobody has written, in such pages; nullptr when there is no memory.
void* zeroedMemory(std::size_t bytes);
void freeZeroedMemory(void* memory, std::size_t bytes);

// Room for so many elements, in such pages.
template <class Vector> void reserveInLargePages(Vector& vector, std::size_t count) {
    vector.reserve(count);
    adviseLargePages(vector.data(), count * sizeof(typename Vector::value_type));
}
