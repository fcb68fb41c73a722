// The command line of the plain fuzzer: libFuzzer's flags, so that one script serves both.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

namespace fuzz {

struct Arguments {
    std::string reader;
    std::vector<std::string> paths;                             // files, or folders with files
    std::size_t runs = std::numeric_limits<std::size_t>::max(); // damaged files; 0: paths only
    std::size_t seconds = 0;                                    // 0: no limit
    std::size_t timeout = 5;                                    // seconds per file
    std::size_t maxSize = 4096;
    std::uint32_t seed = 1;
    std::string dictionary;
    std::string artifactPrefix = "./";
};

// Throws std::runtime_error for what it does not know.
Arguments parseArguments(const std::vector<std::string>& words);

} // namespace fuzz
