#include "base/text.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <numeric>
#include <vector>

namespace {

template <class T> std::string shortestOf(T value) {
    char buffer[32];
    const auto end = std::to_chars(buffer, buffer + sizeof buffer, value).ptr;
    return {buffer, end};
}

// Levenshtein distance where a swap of two neighbours counts as one change.
std::size_t editDistance(std::string_view a, std::string_view b) {
    std::vector<std::size_t> before(b.size() + 1), previous(b.size() + 1), current(b.size() + 1);
    std::iota(previous.begin(), previous.end(), std::size_t{0});
    for (std::size_t i = 1; i <= a.size(); ++i) {
        current[0] = i;
        for (std::size_t j = 1; j <= b.size(); ++j) {
            const std::size_t replaced = previous[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
            current[j] = std::min({replaced, previous[j] + 1, current[j - 1] + 1});
            if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
                current[j] = std::min(current[j], before[j - 2] + 1);
        }
        before = previous;
        previous = current;
    }
    return previous[b.size()];
}

// from_chars takes no plus sign; "+-5" is no number.
std::string_view withoutPlus(std::string_view text) {
    if (text.starts_with('+') && !text.starts_with("+-")) text.remove_prefix(1);
    return text;
}

} // namespace

void appendWhole(std::string& out, long long value) { out += shortestOf(value); }
void appendWhole(std::string& out, unsigned long long value) { out += shortestOf(value); }
void appendNumber(std::string& out, double value) {
    char buffer[32];
    out.append(
        buffer,
        std::to_chars(buffer, buffer + sizeof buffer, value, std::chars_format::general, 6).ptr);
}

std::string shortest(double value) { return shortestOf(value); }
std::string shortest(float value) { return shortestOf(value); }
std::string significant(double value) {
    char buffer[32];
    const auto end =
        std::to_chars(buffer, buffer + sizeof buffer, value, std::chars_format::general, 3).ptr;
    return {buffer, end};
}

std::optional<double> parseDouble(std::string_view text) {
    text = withoutPlus(text);
    double value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (end != text.data() + text.size()) return {};
    // from_chars does not say whether it is too large or too small; what is too small is 0.
    if (error == std::errc::result_out_of_range)
        value = std::strtod(std::string(text).c_str(), nullptr);
    else if (error != std::errc{})
        return {};
    if (!std::isfinite(value)) return {};
    return value;
}

std::optional<long long> parseInteger(std::string_view text) {
    text = withoutPlus(text);
    long long value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc{} || end != text.data() + text.size()) return {};
    return value;
}

std::string afterLast(std::string_view text, std::string_view characters) {
    const std::size_t last = text.find_last_of(characters);
    return std::string(last == std::string_view::npos ? text : text.substr(last + 1));
}

std::string lowerExtension(const std::string& fileName) {
    std::string extension = std::filesystem::path(fileName).extension().string();
    for (char& c : extension)
        if (c >= 'A' && c <= 'Z') c = static_cast<char>(c + 32);
    return extension;
}

std::string join(std::span<const std::string> words, std::string_view separator) {
    std::string out;
    for (std::size_t i = 0; i < words.size(); ++i) {
        if (i > 0) out += separator;
        out += words[i];
    }
    return out;
}

std::optional<std::string> nearestWord(std::string_view word, std::span<const std::string> known) {
    constexpr std::size_t kShortestPrefix = 3;
    std::optional<std::string> best;
    std::size_t bestDistance = std::max<std::size_t>(1, word.size() / 3) + 1;
    for (const std::string& candidate : known) {
        const std::size_t distance = editDistance(word, candidate);
        if (distance < bestDistance) {
            bestDistance = distance;
            best = candidate;
        }
    }
    if (best || word.size() < kShortestPrefix) return best;
    for (const std::string& candidate : known)
        if (candidate.starts_with(word)) return candidate;
    return best;
}

std::string unknownName(std::string_view word, std::span<const std::string> known) {
    constexpr std::size_t kListed = 12;
    std::string out = cat("'", word, "'");
    if (const auto near = nearestWord(word, known))
        out += cat("; did you mean '", *near, "'?");
    else
        out += ";";
    if (known.empty()) return out + " there are none";
    out += " known: " + join(known.first(std::min(known.size(), kListed)));
    if (known.size() > kListed) out += cat(" and ", known.size() - kListed, " more");
    return out;
}
