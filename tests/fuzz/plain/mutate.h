// Damage: one file into another one that a reader has not seen yet.
#pragma once

#include <cstdint>
#include <random>
#include <span>
#include <string>
#include <vector>

namespace fuzz {

// A few random changes of bytes, numbers, words and lines. `other` gives pieces, `words` are those
// of the format. At most maxSize bytes.
std::string mutated(std::string file, const std::string& other, std::span<const std::string> words,
                    std::size_t maxSize, std::mt19937& random);

// The words of a dictionary in AFL's format: lines of name="value" or "value" with \\, \" and \xNN;
// # comments. Throws std::runtime_error with the line for others.
std::vector<std::string> parseDictionary(const std::string& text);

} // namespace fuzz
