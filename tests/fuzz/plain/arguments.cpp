#include "fuzz/plain/arguments.h"

#include <charconv>
#include <stdexcept>

namespace fuzz {

namespace {

template <class Number> Number numberIn(const std::string& word, const std::string& value) {
    Number number = 0;
    const char* const end = value.data() + value.size();
    const auto [stop, error] = std::from_chars(value.data(), end, number);
    if (error != std::errc() || stop != end) throw std::runtime_error("no number in " + word);
    return number;
}

} // namespace

Arguments parseArguments(const std::vector<std::string>& words) {
    if (words.empty()) throw std::runtime_error("usage: fuzz READER [-FLAG=VALUE...] [PATH...]");
    Arguments arguments;
    arguments.reader = words[0];
    for (std::size_t i = 1; i < words.size(); ++i) {
        const std::string& word = words[i];
        const std::size_t equals = word.find('=');
        if (word[0] != '-' || equals == std::string::npos) {
            arguments.paths.push_back(word);
            continue;
        }
        const std::string flag = word.substr(1, equals - 1), value = word.substr(equals + 1);
        if (flag == "runs")
            arguments.runs = numberIn<std::size_t>(word, value);
        else if (flag == "max_total_time")
            arguments.seconds = numberIn<std::size_t>(word, value);
        else if (flag == "timeout")
            arguments.timeout = numberIn<std::size_t>(word, value);
        else if (flag == "max_len")
            arguments.maxSize = numberIn<std::size_t>(word, value);
        else if (flag == "seed")
            arguments.seed = numberIn<std::uint32_t>(word, value);
        else if (flag == "dict")
            arguments.dictionary = value;
        else if (flag == "artifact_prefix")
            arguments.artifactPrefix = value;
        // libFuzzer's own: here the limits of memory are fixed.
        else if (flag != "rss_limit_mb" && flag != "malloc_limit_mb")
            throw std::runtime_error("unknown flag " + word);
    }
    return arguments;
}

} // namespace fuzz
