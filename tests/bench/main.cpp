// The program build/release/bench, which measures one mesh: bench MESH [options]
#include "base/error.h"
#include "bench/bench.h"
#include "cli/settings_from.h"
#include "cli/command.h"
#include "cli/interrupt.h"
#include "cli/output.h"

#include <cstdio>
#include <exception>

namespace {

constexpr std::string_view kUsage = "bench MESH [options]";
constexpr std::string_view kAbout =
    "Builds the tree of a mesh (.obj, .ply, or a scene with meshes), traces rays through it and "
    "makes a picture of it. Comma-separated lines:\n"
    "  BUILD,mesh,engine,quality,exactness,threads,kernel,ms (median, least, of the "
    "processor),bytes per triangle\n"
    "  mesh,engine,quality,exactness,threads,kernel,set,rays,hits,million rays per second (median, "
    "least, most, of the processor),nodes and leaves of the tree that a ray visits\n"
    "  PICTURE,mesh,engine,quality,exactness,threads,kernel,size,ms (read, build, render, write, "
    "all)\n"
    "Sets: primary (nearest), shadow (any, from a point light), bounce (diffuse directions, "
    "nearest), bounceany (the same, any).";

// clang-format off
// The setters write into the options, which must outlive the table.
std::vector<Flag> flagsOf(BenchOptions& o) {
    std::vector<Flag> flags;
    FlagGroup group(flags, "options");
    std::vector<std::string> kernels = kernelNames();
    kernels.insert(kernels.begin(), "auto");
    group.add({.name = "--kernel", .argument = join(kernels, "|"),
               .help = "machine code for the search (auto)",
               .set = [&o, kernels](const FlagValue& v) { o.kernel = kernels[v.choice(kernels)]; },
               .choices = kernels, .example = "scalar"});
    group.add({.name = "--threads", .alias = "-t", .argument = "N",
               .help = "how many share the work (1)",
               .set = [&o](const FlagValue& v) { o.threads = v.whole(1, 1024); },
               .example = "2"});
    group.add({.name = "--runs", .argument = "N",
               .help = "timed runs of each set, behind one that is not timed (5)",
               .set = [&o](const FlagValue& v) { o.runs = v.whole(1, 1000); },
               .example = "3"});
    const std::vector<std::string> views = {"outside", "inside"}; // as BenchView
    group.add({.name = "--view", .argument = join(views, "|"),
               .help = "where the camera is: before the box around the mesh, or in it (outside)",
               .set = [&o, views](const FlagValue& v) {
                   o.view = static_cast<BenchView>(v.choice(views));
               },
               .choices = views, .example = "inside"});
    group.add({.name = "--uv",
               .help = "nearest hits a second time, with u and v as well as t and triangle",
               .set = [&o](const FlagValue&) { o.uv = true; }});
    group.add({.name = "--picture", .help = "a whole picture too, or not",
               .set = [&o](const FlagValue& v) { o.picture = v.on; }, .negatable = true});
    group.add({.name = "--write-rays", .argument = "FILE",
               .help = "writes mesh and rays for another program, and measures nothing",
               .set = [&o](const FlagValue& v) { o.raysFile = v.nonEmpty("the name of a file"); },
               .files = Flag::Files::Any, .example = "bunny.rays"});
    group.add({.name = "--help", .alias = "-h", .help = "this text",
               .set = [&o](const FlagValue&) { o.help = true; }});
    return flags;
}
// clang-format on

BenchOptions parsed(std::span<const std::string> arguments) {
    BenchOptions options;
    const std::vector<std::string> names = parseFlags(flagsOf(options), arguments);
    if (options.help) return options;
    if (names.size() != 1) failUsage(cat("bench needs one mesh; usage: ", kUsage));
    options.mesh = names[0];
    return options;
}

} // namespace

int main(int argc, char** argv) {
    try {
        handleInterrupts();
        const BenchOptions options =
            parsed(std::vector<std::string>(argv + (argc > 0), argv + argc));
        BenchOptions unused;
        if (options.help)
            writeStdout(commandHelpText(kUsage, kAbout, flagsOf(unused)));
        else
            bench(options);
        return 0;
    } catch (const Error& error) {
        static_cast<void>(std::fprintf(stderr, "%s\n", error.what()));
        return static_cast<int>(error.kind());
    } catch (const std::exception& error) {
        static_cast<void>(std::fprintf(stderr, "bench: error: %s\n", error.what()));
        return static_cast<int>(ExitCode::Internal);
    }
}
