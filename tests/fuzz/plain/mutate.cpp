#include "fuzz/plain/mutate.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <sstream>
#include <stdexcept>
#include <string_view>

namespace fuzz {

namespace {

// Where conversions and products go over.
constexpr auto kNumbers = std::to_array<std::string_view>({"0",
                                                           "-1",
                                                           "1",
                                                           "255",
                                                           "256",
                                                           "65535",
                                                           "65536",
                                                           "2147483647",
                                                           "2147483648",
                                                           "-2147483648",
                                                           "4294967295",
                                                           "4294967296",
                                                           "9223372036854775807",
                                                           "18446744073709551616",
                                                           "1e-400",
                                                           "1e999",
                                                           "-0.0",
                                                           "nan",
                                                           "0.1e308",
                                                           "1e60",
                                                           "1e15",
                                                           ".",
                                                           "1e",
                                                           "00"});
constexpr auto kBytes = std::to_array<unsigned char>({0, 1, 9, 10, 13, 32, 127, 128, 254, 255});

class Mutation {
public:
    Mutation(std::string file, const std::string& other, std::span<const std::string> words,
             std::mt19937& random)
        : file_(std::move(file)), other_(other), words_(words), random_(random) {}

    std::string result() && { return std::move(file_); }

    void change() {
        switch (below(12)) {
        case 0: return changeByte([&](char c) { return c ^ 1 << below(8); });
        case 1: return changeByte([&](char) { return kBytes[below(kBytes.size())]; });
        case 2: return changeByte([&](char c) { return c + static_cast<int>(below(33)) - 16; });
        case 3: return erase(place(), 1 + below(below(4) == 0 ? 100 : 8));
        case 4: return file_.resize(place());
        case 5: return insert(piece(file_));
        case 6: return insert(piece(other_));
        case 7: return insert(repeated(piece(file_, 6)));
        case 8: return replaceNumber();
        case 9: return insert(word());
        case 10: return replaceWord();
        default: return changeLines();
        }
    }

private:
    std::size_t below(std::size_t count) { return count > 0 ? random_() % count : 0; }
    // Often near the start, where headers are.
    std::size_t place() {
        return below(1 + (below(3) == 0 ? std::min<std::size_t>(file_.size(), 64) : file_.size()));
    }
    std::string word() {
        if (words_.empty() || below(4) == 0) return std::string(kNumbers[below(kNumbers.size())]);
        return words_[below(words_.size())];
    }
    std::string piece(const std::string& from, std::size_t longest = 64) {
        return from.substr(below(from.size() + 1), 1 + below(longest));
    }
    std::string repeated(const std::string& text) {
        std::string all;
        for (std::size_t times = 2u << below(8); times > 0; --times) all += text;
        return all;
    }
    void insert(const std::string& text) { file_.insert(place(), text); }
    void erase(std::size_t at, std::size_t count) { file_.erase(at, count); }
    template <class Change> void changeByte(Change changed) {
        if (file_.empty()) return insert(word());
        char& byte = file_[std::min(place(), file_.size() - 1)];
        byte = static_cast<char>(changed(byte));
    }
    // The first run of such characters from a random place on.
    void replaceRun(std::string_view characters, const std::string& text) {
        const std::size_t begin = file_.find_first_of(characters, place());
        if (begin == std::string::npos) return insert(text);
        const std::size_t end = file_.find_first_not_of(characters, begin);
        file_.replace(begin, std::min(end, file_.size()) - begin, text);
    }
    void replaceNumber() {
        replaceRun("0123456789.-+eE", std::string(kNumbers[below(kNumbers.size())]));
    }
    void replaceWord() {
        replaceRun("abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ_", word());
    }
    // One line away, twice, or to another place.
    void changeLines() {
        const std::size_t begin = file_.rfind('\n', place()) + 1; // 0 when there is none
        const std::size_t end = std::min(file_.find('\n', begin), file_.size() - 1) + 1;
        if (begin >= end) return insert("\n");
        const std::string line = file_.substr(begin, end - begin);
        const std::size_t what = below(3);
        if (what != 0) erase(begin, line.size());
        if (what != 1) file_.insert(std::min(file_.rfind('\n', place()) + 1, file_.size()), line);
    }

    std::string file_;
    const std::string& other_;
    const std::span<const std::string> words_;
    std::mt19937& random_;
};

std::string unescaped(std::string_view text) {
    std::string out;
    for (std::size_t i = 0; i < text.size(); ++i) {
        if (text[i] != '\\') {
            out += text[i];
        } else if (const std::string_view rest = text.substr(i + 1);
                   rest.starts_with('\\') || rest.starts_with('"')) {
            out += text[++i];
        } else {
            unsigned byte = 0;
            const char* const digits = rest.data() + 1;
            if (rest.size() < 3 || rest[0] != 'x' ||
                std::from_chars(digits, digits + 2, byte, 16).ptr != digits + 2)
                throw std::runtime_error("expected \\\\, \\\" or \\xNN");
            out += static_cast<char>(byte);
            i += 3;
        }
    }
    return out;
}

} // namespace

std::string mutated(std::string file, const std::string& other, std::span<const std::string> words,
                    std::size_t maxSize, std::mt19937& random) {
    Mutation mutation(std::move(file), other, words, random);
    for (auto changes = 1 + random() % 4; changes > 0; --changes) mutation.change();
    std::string result = std::move(mutation).result();
    result.resize(std::min(result.size(), maxSize));
    return result;
}

std::vector<std::string> parseDictionary(const std::string& text) {
    std::vector<std::string> words;
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);) {
        if (line.empty() || line[0] == '#') continue;
        const std::size_t open = line.find('"'), close = line.rfind('"');
        if (open == std::string::npos || close <= open)
            throw std::runtime_error("expected \"WORD\", got " + line);
        words.push_back(unescaped(std::string_view(line).substr(open + 1, close - open - 1)));
    }
    return words;
}

} // namespace fuzz
