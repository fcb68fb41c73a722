#include "cli/command.h"

#include "base/file_text.h"
#include "base/parallel.h"
#include "base/text.h"
#include "cli/output.h"
#include "verify/report.h"

#include <algorithm>
#include <chrono>
#include <iterator>

namespace {

using battery::Finding;
using battery::Row;

double secondsSince(std::chrono::steady_clock::time_point start) {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

// By its id, or with T19 for all of T19a, T19b ...
bool isNamed(const Row& row, std::string_view name) {
    const std::string_view id = row.id;
    if (name.size() < 2 || !id.starts_with(name)) return false;
    return id.size() == name.size() || id[name.size()] < '0' || id[name.size()] > '9';
}

std::vector<Row> chosenRows(const VerifyOptions& options) {
    const std::vector<Row> all = battery::rows();
    for (const std::string& name : options.tests)
        if (std::none_of(all.begin(), all.end(),
                         [&](const Row& row) { return isNamed(row, name); }))
            failUsage("unknown test " + unknownName(name, verifyTests()));
    std::vector<Row> chosen;
    std::copy_if(all.begin(), all.end(), std::back_inserter(chosen), [&](const Row& row) {
        if (options.tests.empty()) return row.quick || options.all || options.list;
        return std::any_of(options.tests.begin(), options.tests.end(),
                           [&](const std::string& name) { return isNamed(row, name); });
    });
    return chosen;
}

} // namespace

// clang-format off
std::vector<Flag> verifyFlags(VerifyOptions& o) {
    std::vector<Flag> flags;
    FlagGroup group(flags, "options");
    group.add({.name = "--effort", .alias = "-e", .argument = "X",
               .help = "how many cases: X times those of make test (4)",
               .set = [&o](const FlagValue& v) { o.effort = v.number(0.01, 1e6); },
               .example = "0.01"});
    group.add({.name = "--threads", .alias = "-t", .argument = "N",
               .help = "0: all that the machine has; the findings are the same (0)",
               .set = [&o](const FlagValue& v) { o.threads = v.whole(0, 1024); },
               .example = "2"});
    group.add({.name = "--batch", .alias = "-b", .argument = "N",
               .help = "only batch N of each TEST, as the line of a case names it",
               .set = [&o](const FlagValue& v) { o.batch = v.whole(0, 1'000'000'000); },
               .example = "7"});
    group.add({.name = "--all", .help = "also the tests that take long",
               .set = [&o](const FlagValue&) { o.all = true; }});
    group.add({.name = "--list", .help = "names the tests and runs none",
               .set = [&o](const FlagValue&) { o.list = true; }});
    group.add({.name = "--markdown", .argument = "FILE",
               .help = "writes the table as a page as well",
               .set = [&o](const FlagValue& v) { o.markdown = v.nonEmpty("the name of a file"); },
               .files = Flag::Files::Any, .example = "STRESS.md"});
    group.add({.name = "--help", .alias = "-h", .help = "this text",
               .set = [&o](const FlagValue&) { o.help = true; }});
    return flags;
}
// clang-format on

std::vector<std::string> verifyTests() {
    std::vector<std::string> ids;
    for (const Row& row : battery::rows()) ids.emplace_back(row.id);
    return ids;
}

VerifyOptions parseVerifyOptions(std::span<const std::string> arguments) {
    VerifyOptions options;
    options.tests = parseFlags(verifyFlags(options), arguments);
    if (options.batch && options.tests.empty()) failUsage("--batch is for a TEST; name one");
    return options;
}

ExitCode verify(const VerifyOptions& options) {
    const std::vector<Row> rows = chosenRows(options);
    if (options.list) {
        for (const Row& row : rows)
            writeStdout(cat(row.id, "  ", row.what, row.quick ? "" : " (--all)", "\n"));
        return ExitCode::Ok;
    }
    if (!options.markdown.empty()) checkWritable(options.markdown);
    battery::Effort effort{options.effort,
                           options.threads > 0 ? options.threads : hardwareThreads()};
    if (options.batch) effort.batch = static_cast<std::size_t>(*options.batch);
    writeStdout(battery::reportHeading());
    std::vector<Finding> findings;
    std::size_t failures = 0, open = 0;
    for (const Row& row : rows) {
        const auto start = std::chrono::steady_clock::now();
        findings.push_back({row, row.run(effort)});
        const battery::Tally& tally = findings.back().tally;
        if (!battery::passed(row, tally)) ++(*row.open ? open : failures);
        writeStdout(battery::reportLine(row, tally, secondsSince(start)));
    }
    if (open > 0) writeStdout(cat(open, " marks are not reached yet (OPEN)\n"));
    writeStdout(cat(rows.size() - failures - open, " passed, ", failures, " failed\n"));
    if (!options.markdown.empty()) {
        const std::string text = battery::markdownPage(findings, kVersion, options.effort);
        writeFileAtomically(options.markdown,
                            {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()});
    }
    return failures == 0 ? ExitCode::Ok : ExitCode::Internal;
}
