// The sub-commands, `raytracer NAME ...`: one row each. run(), --help, --completion and the tests
// walk this table and nothing else.
#pragma once

#include "cli/exit_codes.h"
#include "cli/flag.h"
#include "cli/run.h"

#include <span>
#include <string>
#include <string_view>
#include <vector>

struct Command {
    std::string_view name;      // "diff"
    std::string_view arguments; // as --help shows them, "A B"
    std::string_view help;      // one line
    std::string_view about;     // what its own --help begins with: some sentences
    Step step;                  // what it does, for the message when memory runs out
    // The table of its options, to be described; the setters write into a place of its own.
    std::vector<Flag> (*flags)();
    // The words that its arguments can be, for completion. None: they are names of files.
    std::vector<std::string> (*words)();
    // Everything after the name, --help among it. Fails with Error.
    ExitCode (*run)(const Command& self, std::span<const std::string> arguments);
};

std::span<const Command> commands();
const Command* commandNamed(std::string_view name); // null: there is none
