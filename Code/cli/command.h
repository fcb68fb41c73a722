// The program as a command: exit codes, sub-commands with their options, help, completion, version.
#pragma once

#include "cli/flag.h"

#include <array>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

// ---- exit codes, as --help lists them; scripts depend on the numbers

enum class ExitCode {
    Ok = 0,
    Usage = 1,
    Input = 2,
    StrictWarnings = 3,
    Output = 4,
    AboveTolerance = 5,
    Internal = 70,     // EX_SOFTWARE of sysexits.h
    Interrupted = 130, // 128 + SIGINT, as shells count
};

struct ExitCodeText {
    ExitCode code;
    std::string_view meaning;
};
inline constexpr std::array kExitCodes{
    ExitCodeText{ExitCode::Ok, "done"},
    ExitCodeText{ExitCode::Usage, "wrong option or argument"},
    ExitCodeText{ExitCode::Input, "error in the scene, a texture or another file that is read"},
    ExitCodeText{ExitCode::StrictWarnings, "warnings under --strict; no picture is written"},
    ExitCodeText{ExitCode::Output, "cannot write"},
    ExitCodeText{ExitCode::AboveTolerance, "diff: the pictures differ by more than --tol"},
    ExitCodeText{ExitCode::Internal, "error in the program itself"},
    ExitCodeText{ExitCode::Interrupted,
                 "stopped by SIGINT, SIGTERM or SIGHUP; no picture is written"},
};

// ---- run(): what the command line says, from the arguments to the exit code

// What the program is doing, for the message when memory runs out.
struct Step {
    std::string_view name = "reading the command line";
    ExitCode codeOutOfMemory = ExitCode::Input;
};

// arguments: without the program's name. Fails with Error; prints warnings and notes on stderr.
ExitCode run(std::span<const std::string> arguments, Step& step);

// ---- `raytracer diff A B`: how far two pictures are apart, for people and for test scripts

struct DiffOptions {
    std::string first, second;
    std::vector<std::string> metrics{"rmse"};
    std::optional<double> tolerance;
    std::string output; // empty: no picture of the differences
    bool help = false;
};

// The table of its options; the setters write into `options`, which must outlive the table.
std::vector<Flag> diffFlags(DiffOptions& options);

// Everything after "diff". Fails with ErrorKind::Usage.
DiffOptions parseDiffOptions(std::span<const std::string> arguments);

// Prints a line "metric value" for each metric; AboveTolerance when the value is worse than --tol.
ExitCode diff(const DiffOptions& options);

// ---- `raytracer verify`: the stress battery on the user's own machine

struct VerifyOptions {
    double effort = 4;
    int threads = 0;          // 0: all that the machine has
    std::optional<int> batch; // this one of each test only
    bool all = false, list = false, help = false;
    std::string markdown;           // a page with the table is written there
    std::vector<std::string> tests; // ids; empty: all that are quick
};

// The table of its options; the setters write into `options`, which must outlive the table.
std::vector<Flag> verifyFlags(VerifyOptions& options);
// The ids of all tests.
std::vector<std::string> verifyTests();

// Everything after "verify". Fails with ErrorKind::Usage.
VerifyOptions parseVerifyOptions(std::span<const std::string> arguments);

// Prints a line per test as it ends; Internal when one does not keep its mark.
ExitCode verify(const VerifyOptions& options);

// ---- the sub-commands, `raytracer NAME ...`

// They are one row each. run(), --help, --completion and the tests
// walk this table and nothing else.

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

// ---- texts that describe the command line, made from the tables of options

std::string helpText();                              // raytracer --help
std::string commandHelpText(const Command& command); // raytracer NAME --help
// Makes the text of what has no row in the table of sub-commands.
std::string commandHelpText(std::string_view usage, std::string_view about,
                            std::span<const Flag> flags);
std::string featureListText(); // raytracer --list-features

// Returns a script that completes the command line in a shell.
// shell: "bash", "zsh" or "fish".
std::string completionScript(const std::string& shell);

// ---- what other renderers call an option of ours, for the message about an unknown one

// Returns what to write here instead of another program's "--samples" or "-W", such as "--spp";
// nothing where no other program is known to use that name.
std::optional<std::string_view> ourWordsFor(std::string_view theirs);

// --version prints it.
inline constexpr const char* kVersion = "0.1.0";
