#include "cli/options.h"

#include "base/error.h"
#include "cli/output.h"

namespace {

// The last run of # becomes the number with at least as many digits; false when there is none.
bool replaceFrame(std::string& name, int frame) {
    const std::size_t end = name.find_last_of('#');
    if (end == std::string::npos) return false;
    const std::size_t before = name.find_last_not_of('#', end);
    const std::size_t start = before == std::string::npos ? 0 : before + 1;
    const std::size_t width = end + 1 - start;
    std::string digits = std::to_string(frame);
    if (digits.size() < width) digits.insert(0, width - digits.size(), '0');
    name.replace(start, width, digits);
    return true;
}

// A run of # that nothing replaces would become the name of a file.
void checkForFrame(std::string_view what, const std::string& name) {
    if (name.find("##") == std::string::npos) return;
    failUsage(
        cat(what, " '", name, "' has a run of # for the number of a frame; --frame N names it"));
}

void setFrame(Options& options) {
    if (!options.frame) {
        checkForFrame("SCENE", options.scene);
        checkForFrame("OUTPUT", options.output);
        return checkForFrame("--convert", options.convertTo);
    }
    const bool inScene = replaceFrame(options.scene, *options.frame);
    const bool inOutput = replaceFrame(options.output, *options.frame);
    const bool inConvert = replaceFrame(options.convertTo, *options.frame);
    if (!inScene && !inOutput && !inConvert)
        failUsage("--frame needs a run of # in SCENE or OUTPUT, such as scene_####.txt");
}

// SCENE [OUTPUT]
void setNames(Options& options, std::span<const std::string> names) {
    if (names.empty()) failUsage("no scene; usage: raytracer SCENE [OUTPUT] [options]");
    options.scene = names[0];
    if (options.scene.empty()) failUsage("SCENE is empty; name a file, or - for stdin");
    if (names.size() > 2)
        failUsage(cat("too many names: '", names[2], "' after SCENE '", names[0], "' and OUTPUT '",
                      names[1], "'"));
    if (names.size() < 2) return;
    if (!options.output.empty())
        failUsage(cat("two outputs: '", names[1], "' and --output '", options.output, "'"));
    options.output = names[1];
    if (options.output.empty())
        failUsage(cat("OUTPUT is empty; name a file, or leave it out for ",
                      defaultOutput(options.scene)));
}

void checkCombinations(const Options& options) {
    if (options.action != Options::Action::Render) {
        if (!options.output.empty())
            failUsage(cat("no picture is rendered, so OUTPUT '", options.output, "' has no use"));
        return;
    }
    const bool toStdout = options.output == "-", toDevice = isDevice(options.output);
    if (toStdout && options.stats == Options::StatsFormat::Json)
        failUsage("the picture and --stats=json cannot both go to stdout; name an OUTPUT file");
    if ((toStdout || toDevice) && !options.aovs.empty())
        failUsage(cat("--aov writes files beside OUTPUT; name an OUTPUT file instead of ",
                      options.output));
    const bool isFile = !options.output.empty() && !toStdout && !toDevice;
    if (isFile && !hasPictureExtension(options.output))
        failUsage(cat("OUTPUT '", options.output, "' must end in .ppm, .png, .pfm or .exr"));
    const std::string extension = lowerExtension(options.output);
    if (options.bits && extension == ".pfm")
        failUsage("--bits is for .ppm, .png and .exr; a .pfm file stores floats");
    if (options.bits == 8 && extension == ".exr")
        failUsage("an .exr file stores numbers of 16 or 32 bits, not 8");
    if (options.bits == 32 && extension != ".exr")
        failUsage("--bits 32 is for .exr; .ppm and .png store 8 or 16 bits");
}

} // namespace

Options parseOptions(std::span<const std::string> arguments) {
    Options options;
    options.arguments.assign(arguments.begin(), arguments.end());
    const std::vector<Flag> flags = renderFlags(options);
    const std::vector<std::string> names = parseFlags(flags, arguments);
    using Action = Options::Action;
    switch (options.action) {
    case Action::ListFeatures:
    case Action::Help:
    case Action::Version:
    case Action::Completion: return options;
    case Action::Render:
    case Action::Check:
    case Action::Info:
    case Action::Convert: break;
    }
    setNames(options, names);
    setFrame(options);
    checkCombinations(options);
    return options;
}
