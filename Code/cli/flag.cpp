#include "cli/flag.h"

#include "base/error.h"
#include "cli/command.h"

#include <algorithm>
#include <filesystem>
#include <optional>

namespace {

std::vector<std::string> splitAt(std::string_view text, std::string_view separator) {
    std::vector<std::string> parts;
    while (true) {
        const std::size_t end = text.find(separator);
        parts.emplace_back(text.substr(0, end));
        if (end == std::string_view::npos) return parts;
        text.remove_prefix(end + separator.size());
    }
}

// What one argument asks for. `attached`: the value in --flag=value, -fvalue or -f=value.
struct Match {
    const Flag* flag = nullptr;
    std::string written;
    bool on = true;
    std::optional<std::string> attached = {};
};

Match matchLong(std::span<const Flag> flags, const std::string& argument) {
    const std::size_t equals = argument.find('=');
    Match match{.written = argument.substr(0, equals)};
    if (equals != std::string::npos) match.attached = argument.substr(equals + 1);
    for (const Flag& flag : flags) {
        if (match.written == flag.name) match.flag = &flag;
        if (flag.negatable && match.written == flag.negatedName())
            match.flag = &flag, match.on = false;
    }
    return match;
}

Match matchShort(std::span<const Flag> flags, const std::string& argument) {
    Match match{.written = argument.substr(0, 2)};
    for (const Flag& flag : flags)
        if (match.written == flag.alias) match.flag = &flag;
    if (argument.size() > 2) match.attached = argument.substr(argument[2] == '=' ? 3 : 2);
    // "-spp 4" means --spp, not -s with the value "pp".
    if (matchLong(flags, "-" + argument).flag) match.flag = nullptr;
    if (match.flag && match.flag->value == Flag::Value::None && match.attached)
        match.flag = nullptr;
    if (!match.flag) match.written = argument.substr(0, argument.find('='));
    return match;
}

[[noreturn]] void failUnknown(std::span<const Flag> flags, const std::string& written) {
    const std::vector<std::string> known = flagNames(flags);
    std::string what = cat("unknown option '", written, "'");
    const bool twoDashes = written.starts_with("--");
    // "-j4" is -j with a value.
    const auto ours =
        ourWordsFor(twoDashes ? written : written.substr(0, written.find_first_of("0123456789")));
    const bool isHere =
        ours && std::any_of(known.begin(), known.end(), [&](const auto& name) {
            return !ours->starts_with("-") || (name.starts_with("--") && ours->starts_with(name));
        });
    if (isHere)
        what += cat("; here it is ", *ours);
    else if (const auto near = nearestWord(twoDashes ? written : "-" + written, known))
        what += cat("; did you mean '", *near, "'?");
    failUsage(what);
}

// What stands behind a flag with an optional folder is SCENE, OUTPUT or an option, unless it can be
// none of them.
void checkNoFolderMeant(const std::string& flag, const std::string& next) {
    const std::filesystem::path path(next);
    std::error_code ignored;
    if (next.starts_with('-') || path.has_extension() || std::filesystem::exists(path, ignored))
        return;
    failUsage(cat("there is no folder '", next, "' for ", flag));
}

} // namespace

void failUsage(const std::string& what) { fail(ErrorKind::Usage, cat("raytracer: error: ", what)); }

void FlagValue::wrong(std::string_view expected) const {
    failUsage(
        cat(flag, " expects ", expected, ", got ", text.empty() ? "nothing" : cat("'", text, "'")));
}

int FlagValue::whole(int least, int most) const {
    const auto value = parseInteger(text);
    if (!value || *value < least || *value > most)
        wrong(cat("a whole number from ", least, " to ", most));
    return static_cast<int>(*value);
}

double FlagValue::number(double least, double most) const {
    const auto value = parseDouble(text);
    if (!value || *value < least || *value > most)
        wrong(cat("a number from ", shortest(least), " to ", shortest(most)));
    return *value;
}

std::vector<double> FlagValue::numbers(std::size_t count, std::string_view expected) const {
    std::vector<double> values;
    for (const std::string& part : splitAt(text, ",")) {
        const auto value = parseDouble(part);
        if (!value) wrong(expected);
        values.push_back(*value);
    }
    if (values.size() != count) wrong(expected);
    return values;
}

std::vector<int> FlagValue::wholes(std::size_t count, std::string_view separator,
                                   std::string_view expected) const {
    std::vector<int> values;
    for (const std::string& part : splitAt(text, separator)) {
        const auto value = parseInteger(part);
        if (!value || *value < std::numeric_limits<int>::min() ||
            *value > std::numeric_limits<int>::max())
            wrong(expected);
        values.push_back(static_cast<int>(*value));
    }
    if (values.size() != count) wrong(expected);
    return values;
}

std::size_t FlagValue::choice(std::span<const std::string> choices) const {
    const auto found = std::find(choices.begin(), choices.end(), text);
    if (found == choices.end()) {
        const auto near = nearestWord(text, choices);
        failUsage(cat(flag, " expects one of ", join(choices), ", got ",
                      text.empty() ? "nothing" : cat("'", text, "'"),
                      near ? cat("; did you mean '", *near, "'?") : ""));
    }
    return static_cast<std::size_t>(found - choices.begin());
}

std::string FlagValue::nonEmpty(std::string_view expected) const {
    if (text.empty()) wrong(expected);
    return std::string(text);
}

std::vector<FlagValue> FlagValue::words() const {
    std::vector<FlagValue> values;
    for (std::string_view rest = text;;) {
        const std::size_t comma = rest.find(',');
        values.push_back({flag, rest.substr(0, comma), on});
        if (comma == std::string_view::npos) return values;
        rest.remove_prefix(comma + 1);
    }
}

void FlagGroup::add(Flag flag) {
    flag.group = name_;
    if (!flag.argument.empty() && flag.value == Flag::Value::None)
        flag.value = Flag::Value::Required;
    flags_.push_back(std::move(flag));
}

std::vector<std::string> parseFlags(std::span<const Flag> flags,
                                    std::span<const std::string> arguments) {
    std::vector<std::string> others;
    for (std::size_t i = 0; i < arguments.size(); ++i) {
        const std::string& argument = arguments[i];
        if (argument == "--") {
            others.insert(others.end(), arguments.begin() + static_cast<std::ptrdiff_t>(i) + 1,
                          arguments.end());
            break;
        }
        if (argument.size() < 2 || argument[0] != '-') {
            others.push_back(argument);
            continue;
        }
        Match match = argument[1] == '-' ? matchLong(flags, argument) : matchShort(flags, argument);
        if (!match.flag) failUnknown(flags, match.written);
        const Flag& flag = *match.flag;
        if (match.attached && (flag.value == Flag::Value::None || !match.on))
            failUsage(cat(match.written, " takes no value, got '", *match.attached, "'"));
        if (!match.attached && flag.value == Flag::Value::Required && match.on) {
            const std::string next = i + 1 < arguments.size() ? arguments[i + 1] : "";
            // A value may begin with one dash (-1, -), but two are the next option.
            if (next.empty() || next.starts_with("--")) {
                flag.set({match.written, next}); // says exactly what it expects, unless all is fine
                failUsage(cat(match.written, " expects ", flag.argument, " before '", next, "'"));
            }
            match.attached = arguments[++i];
        }
        const bool folderFollows = flag.value == Flag::Value::Optional && match.on &&
                                   flag.files == Flag::Files::Folders && i + 1 < arguments.size() &&
                                   std::filesystem::is_directory(arguments[i + 1]);
        if (!match.attached && folderFollows) match.attached = arguments[++i];
        if (!match.attached && flag.files == Flag::Files::Folders && match.on &&
            i + 1 < arguments.size())
            checkNoFolderMeant(match.written, arguments[i + 1]);
        flag.set(
            {match.written, match.attached ? std::string_view(*match.attached) : "", match.on});
    }
    return others;
}

std::vector<std::string> flagNames(std::span<const Flag> flags) {
    std::vector<std::string> names;
    for (const Flag& flag : flags) {
        names.push_back(flag.name);
        if (flag.negatable) names.push_back(flag.negatedName());
        if (!flag.alias.empty()) names.push_back(flag.alias);
    }
    return names;
}
