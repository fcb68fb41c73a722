// Flag: one row of an option table. The parser, --help, --completion and the tests walk such
// tables and nothing else. Knows nothing about what an option means.
#pragma once

#include "base/text.h"

#include <array>
#include <functional>
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

// Fails with ErrorKind::Usage: "raytracer: error: what"; run() adds where to find help.
[[noreturn]] void failUsage(const std::string& what);

// What follows a flag on the command line. The readers fail with "--spp expects a whole number from
// 1 to 65536, got 'x'".
struct FlagValue {
    std::string_view flag; // as the user wrote it
    std::string_view text;
    bool on = true; // false for --no-x

    [[noreturn]] void wrong(std::string_view expected) const;
    int whole(int least, int most) const;
    double number(double least, double most) const;
    // Numbers with commas between them; `expected` describes them in the message.
    std::vector<double> numbers(std::size_t count, std::string_view expected) const;
    std::vector<int> wholes(std::size_t count, std::string_view separator,
                            std::string_view expected) const;
    // Position in the list of choices.
    std::size_t choice(std::span<const std::string> choices) const;
    std::string nonEmpty(std::string_view expected) const;
    // Of WORD,WORD,... each word, as a value of the same flag.
    std::vector<FlagValue> words() const;
};

struct Flag {
    // Optional: as --flag=value; a folder may also follow as --flag folder, since a folder is
    // never what else could stand there.
    enum class Value { None, Required, Optional };
    enum class Files { None, Any, Folders }; // for completion of the value

    std::string name = {};     // "--spp"
    std::string alias = {};    // "-s", or empty
    std::string argument = {}; // as --help shows it, "N"; empty: there is none
    std::string help = {};
    std::string group = {};
    std::function<void(const FlagValue&)> set = {};
    Value value = Value::None;
    bool negatable = false; // --no-x exists too
    Files files = Files::None;
    std::vector<std::string> choices = {}; // the words that the value can be, or can begin with
    std::string example = {};              // a right value; tests use every flag with it

    std::string negatedName() const { return "--no-" + name.substr(2); }
};

// Adds rows to one group of --help. An argument is required unless the row says otherwise.
class FlagGroup {
public:
    FlagGroup(std::vector<Flag>& flags, std::string name) : flags_(flags), name_(std::move(name)) {}
    void add(Flag flag);

private:
    std::vector<Flag>& flags_;
    std::string name_;
};

// Calls the setters in the order of the arguments and returns what is no option. "--" ends the
// options, "-" alone is no option. The last of two contradicting options wins.
// Fails with ErrorKind::Usage; an unknown option is answered with the nearest known one.
std::vector<std::string> parseFlags(std::span<const Flag> flags,
                                    std::span<const std::string> arguments);

// Every name that can be written: --x, --no-x, -x.
std::vector<std::string> flagNames(std::span<const Flag> flags);
