#include "cli/command.h"

#include "cli/options.h"

#include <algorithm>
#include <sstream>

namespace {

constexpr std::size_t kColumns = 100;
constexpr std::size_t kHelpColumn = 34, kFeatureColumn = 16;

std::string heading(const Flag& flag) {
    std::string text = flag.alias.empty() ? "    " : flag.alias + ", ";
    text += flag.negatable ? "--[no-]" + flag.name.substr(2) : flag.name;
    if (flag.value == Flag::Value::Required) text += " " + flag.argument;
    if (flag.value == Flag::Value::Optional)
        text += flag.files == Flag::Files::Folders ? " [" + flag.argument + "]"
                                                   : "[=" + flag.argument + "]";
    return text;
}

// `line` and the words of the text after it, wrapped at kColumns; lines after the first begin with
// as many blanks as `column`.
std::string wrapped(std::string line, const std::string& text, std::size_t column) {
    std::string out;
    line.resize(column, ' ');
    std::istringstream words(text);
    std::string word;
    bool first = true;
    while (words >> word) {
        if (!first && line.size() + 1 + word.size() > kColumns) {
            out += line + "\n";
            line = std::string(column, ' ');
            first = true;
        }
        line += (first ? "" : " ") + word;
        first = false;
    }
    return out + line + "\n";
}

// "left" and the words of `right` in a column of their own.
std::string twoColumns(const std::string& left, const std::string& right) {
    const std::string line = "  " + left;
    if (line.size() + 2 <= kHelpColumn) return wrapped(line, right, kHelpColumn);
    return line + "\n" + wrapped("", right, kHelpColumn);
}

// Groups in the order in which the table has them.
std::string flagsText(std::span<const Flag> flags) {
    std::string out, group;
    for (const Flag& flag : flags) {
        if (flag.group != group) out += "\n" + flag.group + ":\n";
        group = flag.group;
        out += twoColumns(heading(flag), flag.help);
    }
    return out;
}

std::string exitCodesText() {
    std::string out = "\nexit codes:\n";
    for (const ExitCodeText& row : kExitCodes)
        out += twoColumns(std::to_string(static_cast<int>(row.code)), std::string(row.meaning));
    return out;
}

std::string usage(const Command& command) {
    return cat("raytracer ", command.name, " ", command.arguments, " [options]");
}

// Each line of the text wrapped by itself; blanks that it begins with are kept.
std::string paragraphs(std::string_view text) {
    std::string out;
    while (!text.empty()) {
        const std::string_view line = text.substr(0, text.find('\n'));
        out += wrapped("", std::string(line), line.find_first_not_of(' '));
        text.remove_prefix(std::min(line.size() + 1, text.size()));
    }
    return out;
}

std::string commandLines() {
    std::string out;
    for (const Command& command : commands())
        out += twoColumns(usage(command),
                          cat(command.help, "; see raytracer ", command.name, " --help"));
    return out;
}

} // namespace

std::string helpText() {
    Options unused;
    std::string out = cat(
        "raytracer ", kVersion, ": renders a scene file to a picture\n\n", "usage:\n",
        "  raytracer SCENE [OUTPUT] [options]\n", commandLines(), "\n",
        "SCENE is a .txt file in the native format (- for such text on stdin), a COMP 557 scene\n"
        "(.json), a Neutral File Format scene (.nff), or a mesh by itself (.obj, .ply). OUTPUT is\n"
        "a .ppm, .png, .pfm or .exr file, or - for a PPM on stdout; left out, it is SCENE.png in the\n"
        "working folder.\n"
        "What an option leaves open comes from the scene. --flag value and --flag=value are the\n"
        "same; -- ends the options.\n");
    out += flagsText(renderFlags(unused));
    out += exitCodesText();
    out +=
        "\nexamples:\n"
        "  raytracer ASCII/showcase.txt                          renders to showcase.png\n"
        "  raytracer room.txt room.png --scale 50 --spp 4        a quick look\n"
        "  raytracer room.txt room.pfm --aov depth,normal        with a file per extra picture\n"
        "  raytracer walk_####.txt walk_####.png --frame 12      one frame of an animation\n"
        "  raytracer room.txt - --quiet | display                straight into another program\n"
        "  raytracer room.txt a.png --no-dof --stats=json        counters for a script on stdout\n"
        "  raytracer diff a.png b.png --metric psnr --tol 40     exit code 5 when below 40 dB\n"
        "  raytracer --completion bash > ~/.local/share/bash-completion/completions/raytracer\n";
    return out;
}

std::string commandHelpText(const Command& command) {
    return commandHelpText(usage(command), command.about, command.flags());
}

std::string commandHelpText(std::string_view usage, std::string_view about,
                            std::span<const Flag> flags) {
    return cat("usage: ", usage, "\n\n", paragraphs(about), flagsText(flags), exitCodesText());
}

std::string featureListText() {
    Options unused;
    std::string out;
    for (const Flag& flag : renderFlags(unused))
        if (flag.group == kFeatureGroup)
            out += wrapped(flag.name.substr(2), flag.help, kFeatureColumn);
    return out;
}
