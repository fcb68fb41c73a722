#include "cli/command.h"

#include "cli/output.h"

#include <algorithm>
#include <array>

namespace {

template <class O, std::vector<Flag> (*table)(O&)> std::vector<Flag> flagsOf() {
    static O unused;
    return table(unused);
}

// Reads the options, and answers --help in place of the command itself.
template <class O, O (*parse)(std::span<const std::string>), ExitCode (*act)(const O&)>
ExitCode parseAndRun(const Command& self, std::span<const std::string> arguments) {
    const O options = parse(arguments);
    if (!options.help) return act(options);
    writeStdout(commandHelpText(self));
    return ExitCode::Ok;
}

std::vector<std::string> fileNames() { return {}; }

constexpr std::array kCommands{
    Command{
        .name = "diff",
        .arguments = "A B",
        .help = "compares two pictures",
        .about =
            "Compares two pictures (.ppm, .png, .pfm, .exr) of the same size and prints how far "
            "they are apart.",
        .step = {"comparing the pictures", ExitCode::Input},
        .flags = flagsOf<DiffOptions, diffFlags>,
        .words = fileNames,
        .run = parseAndRun<DiffOptions, parseDiffOptions, diff>},
    Command{.name = "verify",
            .arguments = "[TEST...]",
            .help = "tests the numbers behind the pictures on this machine",
            .about = "Runs the stress battery on this machine: rays against closed meshes, shapes "
                     "against wide arithmetic, lamps and materials against formulas. A line per "
                     "test; the exit code is 70 when one does not keep its mark. Without TEST all "
                     "quick ones, in less than a minute. Every machine gets the same cases.",
            .step = {"verifying", ExitCode::Internal},
            .flags = flagsOf<VerifyOptions, verifyFlags>,
            .words = verifyTests,
            .run = parseAndRun<VerifyOptions, parseVerifyOptions, verify>},
};

} // namespace

std::span<const Command> commands() { return kCommands; }

const Command* commandNamed(std::string_view name) {
    const auto found = std::find_if(kCommands.begin(), kCommands.end(),
                                    [&](const Command& command) { return command.name == name; });
    return found == kCommands.end() ? nullptr : &*found;
}
