// The ways to pack bytes, of which one pays: to look for what comes again takes more time than all
// else and, in most rendered pictures once their rows are filtered, spares next to nothing.
// Private to image/.
#pragma once

#include <cstdint>
#include <span>

enum class Packing {
    ZeroWords, // words of zeros and single bytes, by codes for a sample: zero_words.h
    ZeroRuns,  // single bytes and runs of zeros: zero_runs.h
    Runs,      // and runs of any byte: run_finder.h
    Matches,   // and whatever comes again: matcher.h
};

// Not ZeroWords, which is for drafts. By a sample of the bytes. The same everywhere, as what files
// are depends on it.
Packing choosePacking(std::span<const std::uint8_t> bytes);
