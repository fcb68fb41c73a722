// For the tests of readers of foreign formats: folders of bad files, and random damage.
#pragma once

#include "base/source.h"
#include "base/text.h"
#include "check.h"

#include <filesystem>
#include <fstream>
#include <random>
#include <sstream>
#include <string>
#include <vector>

inline std::string contentOf(const std::filesystem::path& path) {
    std::ifstream file(path, std::ios::binary);
    std::ostringstream text;
    text << file.rdbuf();
    return text.str();
}

// Each file of the folder with this extension must be refused with what NAME.expect says: a line
// "line:col words" per error. Returns how many there are.
template <class Read>
std::size_t checkCorpus(const std::string& folder, const std::string& extension, Read read) {
    std::size_t count = 0;
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
        if (entry.path().extension() != extension) continue;
        ++count;
        std::filesystem::path expectPath = entry.path();
        std::ifstream expectations(expectPath.replace_extension(".expect"));
        const std::string name = entry.path().string();
        std::string message;
        try {
            read(SourceFile{name, contentOf(name)});
        } catch (const Error& error) {
            message = error.what();
            CHECK(error.kind() == ErrorKind::Input);
        }
        std::size_t expected = 0;
        for (std::string line; std::getline(expectations, line); ++expected) {
            const std::size_t blank = line.find(' ');
            const std::string words =
                cat(name, ":", line.substr(0, blank), ": error: ", line.substr(blank + 1));
            CHECK_INFO(message.find(words) != std::string::npos, "expected '" << words << "' in\n"
                                                                              << message);
        }
        CHECK_INFO(expected > 0, expectPath << " is missing or empty");
    }
    return count;
}

// The text with one to three random injuries: pieces put in, bytes taken out, changed, copied.
inline std::string damaged(std::string text, const std::vector<std::string>& pieces,
                           std::uint32_t seed) {
    std::mt19937 random(seed);
    const auto place = [&] { return random() % (text.size() + 1); };
    for (auto damages = 1 + random() % 3; damages > 0; --damages) {
        const std::size_t at = place(), length = random() % 20;
        switch (random() % 5) {
        case 0: text.insert(at, pieces[random() % pieces.size()]); break;
        case 1: text.erase(at, length); break;
        case 2:
            if (at < text.size()) text[at] = static_cast<char>(random());
            break;
        case 3: text.insert(place(), text.substr(at, length)); break;
        default:
            if (at < text.size()) text[at] = static_cast<char>(text[at] ^ (1 << random() % 8));
            break;
        }
    }
    return text;
}
