// run(): what the command line asks for, from the arguments to the exit code.
#pragma once

#include "cli/exit_codes.h"

#include <span>
#include <string>
#include <string_view>

// What the program is doing, for the message when memory runs out.
struct Step {
    std::string_view name = "reading the command line";
    ExitCode codeOutOfMemory = ExitCode::Input;
};

// arguments: without the program's name. Fails with Error; prints warnings and notes on stderr.
ExitCode run(std::span<const std::string> arguments, Step& step);
