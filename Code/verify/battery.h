// The stress battery: the promises of the program as numbers that anybody can make again, one row a
// test. `raytracer verify` runs the quick rows on the user's machine, `make test` all of them at a
// small size, `make stress` at full size. Truth comes from outside the code under test: exact or
// wider arithmetic, brute force, closed forms.
#pragma once

#include "base/function_ref.h"
#include "verify/meshes.h"

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace battery {

// How hard to try: 1 is the share of `make test`, some tenths of a second a row.
struct Effort {
    double factor = 1;
    int threads = 1;
    std::optional<std::size_t> batch = {}; // runs this one only: a case that was found, again
};

// What a test found. Failures are cases that break a rule; the worst is a measured distance from
// the truth, in the unit of the row. Each keeps a case that shows it, with the seed that makes it
// again.
struct Tally {
    std::uint64_t cases = 0, failures = 0;
    double worst = 0;
    std::string failedCase, worstCase;

    // The text is made only for the case that is kept: the first failure, the worst value.
    template <class MakeText> void fail(MakeText&& text) {
        if (failures++ == 0) failedCase = text();
    }
    template <class MakeText> void measure(double value, MakeText&& text) {
        if (!isWorse(value)) return;
        worst = value;
        worstCase = text();
    }
    // Than what was found so far. NaN is worse than any number.
    bool isWorse(double value) const { return worst == worst && !(value <= worst); }
    Tally& operator+=(const Tally& other);
};

struct Row {
    const char* id;   // "T1"; two rows of one subject are "T1a", "T1b"
    const char* what; // "rays from inside closed meshes"
    const char* unit; // of Tally::worst, "" when only failures count
    double limit;     // of Tally::worst: the pass mark
    bool quick;       // a second or less at effort 1, so that `raytracer verify` may run it
    Tally (*run)(const Effort&);
    const char* peers = ""; // what was measured of other programs
    const char* open = "";  // why the program does not keep the mark yet: a failure is no news
    bool timed = false; // `worst` is a time: one of sanitizers or of a busy machine says nothing
};
std::vector<Row> rows(); // of all groups (groups.h), in the order of their ids: T2, T10, T10b

// Nothing failed, something was tried, and nothing is farther from the truth than the mark.
inline bool passed(const Row& row, const Tally& tally) {
    return tally.cases > 0 && tally.failures == 0 && tally.worst <= row.limit;
}

// Runs `batches * effort.factor` batches (at least one) on the threads, each with random numbers of
// its own that follow from `seed` and its number alone, and sums up in their order: the result does
// not depend on the threads, and batch i is the same at every effort. With effort.batch that one
// alone, whatever the number of batches.
Tally inBatches(const Effort& effort, std::uint64_t seed, double batches,
                FunctionRef<void(meshes::Random&, Tally&)> batch);

} // namespace battery
