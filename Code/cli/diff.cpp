#include "cli/command.h"

#include "base/error.h"
#include "base/text.h"
#include "cli/output.h"
#include "image/compare.h"

#include <algorithm>

namespace {

std::vector<std::string> metricNames() {
    std::vector<std::string> names;
    for (const Metric& metric : metrics()) names.emplace_back(metric.name);
    return names;
}

// NAME,NAME,...
void setMetrics(DiffOptions& o, const FlagValue& value) {
    o.metrics.clear();
    const std::vector<std::string> names = metricNames();
    for (const FlagValue& word : value.words()) o.metrics.push_back(names[word.choice(names)]);
}

const Metric& metricNamed(const std::string& name) {
    const auto all = metrics();
    return *std::find_if(all.begin(), all.end(),
                         [&](const Metric& metric) { return metric.name == name; });
}

void setOutput(DiffOptions& o, const FlagValue& value) {
    o.output = value.nonEmpty("the name of a file");
    if (!hasPictureExtension(o.output)) value.wrong("a name that ends in .ppm, .png or .pfm");
}

std::string metricsHelp() {
    std::string out;
    for (const Metric& metric : metrics())
        out += cat(out.empty() ? "" : "; ", metric.name, ": ", metric.help);
    return out + " (rmse)";
}

} // namespace

// clang-format off
std::vector<Flag> diffFlags(DiffOptions& o) {
    std::vector<Flag> flags;
    FlagGroup group(flags, "options");
    group.add({.name = "--metric", .alias = "-m", .argument = "NAME,...", .help = metricsHelp(),
               .set = [&o](const FlagValue& v) { setMetrics(o, v); },
               .choices = metricNames(), .example = "psnr"});
    group.add({.name = "--tol", .alias = "-t", .argument = "X",
               .help = "exit code 5 when the metric is worse than X: above it, or below it where "
                       "more is better",
               .set = [&o](const FlagValue& v) { o.tolerance = v.number(-1e9, 1e9); },
               .example = "0.5"});
    group.add({.name = "--output", .alias = "-o", .argument = "FILE",
               .help = "writes |A - B| as .ppm, .png or .pfm",
               .set = [&o](const FlagValue& v) { setOutput(o, v); },
               .files = Flag::Files::Any, .example = "diff.png"});
    group.add({.name = "--help", .alias = "-h", .help = "this text",
               .set = [&o](const FlagValue&) { o.help = true; }});
    return flags;
}
// clang-format on

DiffOptions parseDiffOptions(std::span<const std::string> arguments) {
    DiffOptions options;
    const std::vector<std::string> names = parseFlags(diffFlags(options), arguments);
    if (options.help) return options;
    if (names.size() != 2)
        failUsage(
            cat("diff expects two pictures, got ", names.size(), "; usage: raytracer diff A B"));
    if (options.tolerance && options.metrics.size() > 1)
        failUsage("--tol is for one metric, and " + join(options.metrics) + " were asked for");
    options.first = names[0];
    options.second = names[1];
    return options;
}

ExitCode diff(const DiffOptions& options) {
    if (!options.output.empty()) checkWritable(options.output);
    const Image a(options.first), b(options.second);
    if (a.width() != b.width() || a.height() != b.height())
        fail(ErrorKind::Input, cat("raytracer: error: the pictures differ in size: ", options.first,
                                   " has ", a.width(), "x", a.height(), " pixels, ", options.second,
                                   " has ", b.width(), "x", b.height()));
    ExitCode code = ExitCode::Ok;
    for (const std::string& name : options.metrics) {
        const Metric& metric = metricNamed(name);
        const double value = metric.measure(a, b);
        writeStdout(cat(name, " ", shortest(value), "\n"));
        if (!options.tolerance) continue;
        // A value that is not a number is never good enough.
        const bool isGood =
            metric.isLargerBetter ? value >= *options.tolerance : value <= *options.tolerance;
        if (!isGood) code = ExitCode::AboveTolerance;
    }
    if (!options.output.empty()) differenceImage(a, b).write(options.output);
    return code;
}
