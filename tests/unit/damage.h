// Random damage to the text of a file, for the tests of readers.
#pragma once

#include "base/error.h"
#include "check.h"

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <random>
#include <sstream>
#include <string>
#include <vector>

namespace damage {

inline std::string contentOf(const std::filesystem::path& path) {
    std::ifstream file(path, std::ios::binary);
    std::ostringstream text;
    text << file.rdbuf();
    return text.str();
}

// The text with one to three random injuries: pieces put in, bytes taken out, changed, copied.
inline std::string damaged(std::string text, const std::vector<std::string>& pieces,
                           std::uint32_t seed) {
    std::mt19937 random(seed);
    const auto place = [&] { return random() % (text.size() + 1); };
    for (auto damages = 1 + random() % 3; damages > 0; --damages) {
        const std::size_t at = place(), length = random() % 20;
        switch (random() % 6) {
        case 0: text.insert(at, pieces[random() % pieces.size()]); break;
        case 1: text.erase(at, length); break;
        case 2:
            if (at < text.size()) text[at] = static_cast<char>(random());
            break;
        case 3: text.insert(place(), text.substr(at, length)); break;
        case 4: { // another number for one that is there
            const std::size_t digit = text.find_first_of("0123456789", at);
            if (digit != std::string::npos) text[digit] = static_cast<char>('0' + random() % 10);
            break;
        }
        default:
            if (at < text.size()) text[at] = static_cast<char>(text[at] ^ (1 << random() % 8));
            break;
        }
    }
    return text;
}

// False when reading fails with an Error, as it may.
template <class Read> bool isRead(const Read& read) {
    try {
        read();
    } catch (const Error&) {
        return false;
    }
    return true;
}

// How often a damaged text was read after all, and how often it was refused with an Error.
struct Outcomes {
    int read = 0, refused = 0;
};

// Calls read(text, seed) with `cases` (times STRESS) damaged texts; anything but an Error that it
// throws fails the test.
template <class Read>
Outcomes inflict(const std::string& whole, const std::vector<std::string>& pieces,
                 std::uint32_t cases, const Read& read) {
    Outcomes outcomes;
    for (std::uint32_t seed = 0; seed < check::scaled(cases); ++seed) {
        try {
            read(damaged(whole, pieces, seed), seed);
            ++outcomes.read;
        } catch (const Error&) {
            ++outcomes.refused;
        } catch (const std::exception& error) {
            CHECK_INFO(false, "seed " << seed << " threw " << error.what());
        }
    }
    return outcomes;
}

} // namespace damage
