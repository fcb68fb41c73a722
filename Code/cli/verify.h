// `raytracer verify`: the stress battery on the user's own machine.
#pragma once

#include "cli/exit_codes.h"
#include "cli/flag.h"

#include <optional>
#include <span>
#include <string>
#include <vector>

struct VerifyOptions {
    double effort = 4;
    int threads = 0;          // 0: all that the machine has
    std::optional<int> batch; // this one of each test only
    bool all = false, list = false, help = false;
    std::string markdown;           // a page with the table is written there
    std::vector<std::string> tests; // ids; empty: all that are quick
};

// The table of its options; the setters write into `options`, which must outlive the table.
std::vector<Flag> verifyFlags(VerifyOptions& options);
// The ids of all tests.
std::vector<std::string> verifyTests();

// Everything after "verify". Fails with ErrorKind::Usage.
VerifyOptions parseVerifyOptions(std::span<const std::string> arguments);

// Prints a line per test as it ends; Internal when one does not keep its mark.
ExitCode verify(const VerifyOptions& options);
