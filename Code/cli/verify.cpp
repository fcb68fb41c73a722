#include "cli/verify.h"

#include "base/file.h"
#include "base/parallel.h"
#include "base/text.h"
#include "cli/help.h"
#include "cli/output.h"
#include "cli/version.h"
#include "verify/report.h"

#include <algorithm>
#include <chrono>

namespace {

using battery::Finding;
using battery::Row;

double secondsSince(std::chrono::steady_clock::time_point start) {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

std::vector<Row> chosenRows(const VerifyOptions& options) {
    std::vector<Row> chosen;
    std::vector<std::string> known;
    for (const Row& row : battery::rows()) {
        known.emplace_back(row.id);
        const bool named =
            std::find(options.tests.begin(), options.tests.end(), row.id) != options.tests.end();
        if (named || (options.tests.empty() && (options.all || row.quick))) chosen.push_back(row);
    }
    for (const std::string& name : options.tests)
        if (std::find(known.begin(), known.end(), name) == known.end())
            failUsage("unknown test " + unknownName(name, known));
    return chosen;
}

std::string page(const VerifyOptions& options, std::span<const Finding> findings) {
    return cat("# The stress battery\n\n"
               "Made by `make stress` (raytracer ",
               kVersion, ", effort ", shortest(options.effort),
               "). \"Found\" counts broken rules first, then the worst distance from the truth "
               "in its unit; \"mark\" is what may be found. \"Others\" are measurements of other "
               "programs with the same kind of rays, where there are any.\n\n",
               battery::markdownTable(findings));
}

} // namespace

std::vector<Flag> verifyFlags(VerifyOptions& o) {
    const std::string group = "options";
    return {
        {.name = "--effort",
         .alias = "-e",
         .argument = "X",
         .help = "how many cases: X times those of make test (4)",
         .group = group,
         .set = [&o](const FlagValue& v) { o.effort = v.number(0.01, 1e6); },
         .value = Flag::Value::Required,
         .example = "0.01"},
        {.name = "--threads",
         .alias = "-t",
         .argument = "N",
         .help = "0: all that the machine has; the findings are the same (0)",
         .group = group,
         .set = [&o](const FlagValue& v) { o.threads = v.whole(0, 1024); },
         .value = Flag::Value::Required,
         .example = "2"},
        {.name = "--all",
         .help = "also the tests that take long",
         .group = group,
         .set = [&o](const FlagValue&) { o.all = true; }},
        {.name = "--list",
         .help = "names the tests and runs none",
         .group = group,
         .set = [&o](const FlagValue&) { o.list = true; }},
        {.name = "--markdown",
         .argument = "FILE",
         .help = "writes the table as a page as well",
         .group = group,
         .set = [&o](const FlagValue& v) { o.markdown = v.nonEmpty("the name of a file"); },
         .value = Flag::Value::Required,
         .files = Flag::Files::Any,
         .example = "STRESS.md"},
        {.name = "--help",
         .alias = "-h",
         .help = "this text",
         .group = group,
         .set = [&o](const FlagValue&) { o.help = true; }},
    };
}

VerifyOptions parseVerifyOptions(std::span<const std::string> arguments) {
    VerifyOptions options;
    options.tests = parseFlags(verifyFlags(options), arguments);
    return options;
}

ExitCode verify(const VerifyOptions& options) {
    if (options.help) {
        writeStdout(verifyHelpText());
        return ExitCode::Ok;
    }
    const std::vector<Row> rows = chosenRows(options);
    if (options.list) {
        for (const Row& row : rows) writeStdout(cat(row.id, "  ", row.what, "\n"));
        return ExitCode::Ok;
    }
    if (!options.markdown.empty()) checkWritable(options.markdown);
    const battery::Effort effort{options.effort,
                                 options.threads > 0 ? options.threads : hardwareThreads()};
    writeStdout(battery::reportHeading());
    std::vector<Finding> findings;
    std::size_t failures = 0;
    for (const Row& row : rows) {
        const auto start = std::chrono::steady_clock::now();
        findings.push_back({row, row.run(effort)});
        const battery::Tally& tally = findings.back().tally;
        if (!battery::passed(row, tally)) ++failures;
        writeStdout(battery::reportLine(row, tally, secondsSince(start)));
    }
    writeStdout(cat(rows.size() - failures, " passed, ", failures, " failed\n"));
    if (!options.markdown.empty()) {
        const std::string text = page(options, findings);
        writeFileAtomically(options.markdown,
                            {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()});
    }
    return failures == 0 ? ExitCode::Ok : ExitCode::Internal;
}
