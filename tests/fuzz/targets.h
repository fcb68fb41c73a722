// The readers as functions of a file's bytes, one row each: what the fuzzers call with every input.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

namespace fuzz {

using Bytes = std::span<const std::uint8_t>;

struct Target {
    std::string_view name; // of its seeds' folder, its regressions' folder and its dictionary, too
    void (*read)(Bytes file);
};
std::span<const Target> targets();
const Target* findTarget(std::string_view name);

// A reader gives something sound or throws an Error that says what is wrong with the input.
// Throws Unsound (sound.h) when it does something else; crashes are left to happen.
enum class Outcome { Read, Refused };
Outcome run(const Target& target, Bytes file);

} // namespace fuzz
