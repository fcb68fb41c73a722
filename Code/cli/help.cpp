#include "cli/help.h"

#include "cli/bench.h"
#include "cli/diff.h"
#include "cli/exit_codes.h"
#include "cli/options.h"
#include "cli/verify.h"
#include "cli/version.h"

#include <algorithm>
#include <sstream>

namespace {

constexpr std::size_t kColumns = 100;
constexpr std::size_t kHelpColumn = 34;

std::string heading(const Flag& flag) {
    std::string text = flag.alias.empty() ? "    " : flag.alias + ", ";
    text += flag.negatable ? "--[no-]" + flag.name.substr(2) : flag.name;
    if (flag.value == Flag::Value::Required) text += " " + flag.argument;
    if (flag.value == Flag::Value::Optional)
        text += flag.files == Flag::Files::Folders ? " [" + flag.argument + "]"
                                                   : "[=" + flag.argument + "]";
    return text;
}

// "left" and the words of `right` in a column of their own, wrapped at kColumns.
std::string twoColumns(const std::string& left, const std::string& right) {
    std::string out, line = "  " + left;
    if (line.size() + 2 > kHelpColumn) {
        out = line + "\n";
        line.clear();
    }
    line.resize(kHelpColumn, ' ');
    std::istringstream words(right);
    std::string word;
    bool first = true;
    while (words >> word) {
        if (!first && line.size() + 1 + word.size() > kColumns) {
            out += line + "\n";
            line = std::string(kHelpColumn, ' ');
            first = true;
        }
        line += (first ? "" : " ") + word;
        first = false;
    }
    return out + line + "\n";
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

} // namespace

std::string helpText() {
    Options unused;
    std::string out = cat(
        "raytracer ", kVersion, ": renders a scene file to a picture\n\n", "usage:\n",
        "  raytracer SCENE [OUTPUT] [options]\n",
        twoColumns("raytracer diff A B [options]",
                   "compares two pictures; see raytracer diff --help"),
        twoColumns("raytracer verify [TEST...] [options]",
                   "tests the numbers behind the pictures on this machine; see raytracer verify "
                   "--help"),
        twoColumns("raytracer bench MESH [options]",
                   "measures tree and rays of a mesh; see raytracer bench --help"),
        "\n",
        "SCENE is a .txt file in the native format (- for such text on stdin), a COMP 557 scene\n"
        "(.json), a Neutral File Format scene (.nff), or a mesh by itself (.obj, .ply). OUTPUT is\n"
        "a .ppm, .png or .pfm file, or - for a PPM on stdout; left out, it is Output/SCENE.ppm.\n"
        "What an option leaves open comes from the scene. --flag value and --flag=value are the\n"
        "same; -- ends the options.\n");
    out += flagsText(renderFlags(unused));
    out += exitCodesText();
    out +=
        "\nexamples:\n"
        "  raytracer ASCII/showcase.txt                          renders to Output/showcase.ppm\n"
        "  raytracer room.txt room.png --scale 50 --spp 4        a quick look\n"
        "  raytracer room.txt room.pfm --aov depth,normal        with a file per extra picture\n"
        "  raytracer walk_####.txt walk_####.png --frame 12      one frame of an animation\n"
        "  raytracer room.txt - --quiet | display                straight into another program\n"
        "  raytracer room.txt a.png --no-dof --stats=json        counters for a script on stdout\n"
        "  raytracer diff a.png b.png --metric psnr --tol 40     exit code 5 when below 40 dB\n"
        "  raytracer --completion bash > ~/.local/share/bash-completion/completions/raytracer\n";
    return out;
}

std::string diffHelpText() {
    DiffOptions unused;
    return cat(
        "usage: raytracer diff A B [options]\n\n"
        "Compares two pictures (.ppm, .png, .pfm) of the same size and prints how far they are "
        "apart.\n",
        flagsText(diffFlags(unused)), exitCodesText());
}

std::string benchHelpText() {
    BenchOptions unused;
    return cat(
        "usage: raytracer bench MESH [options]\n\n"
        "Builds the tree of a mesh (.obj, .ply, or a scene with meshes) and traces rays through "
        "it with\none thread. Comma-separated lines:\n"
        "  BUILD,mesh,engine,quality,exactness,threads,kernel,ms (median, least, of the "
        "processor),\n        bytes per triangle\n"
        "  mesh,engine,quality,exactness,threads,kernel,set,rays,hits,million rays per second "
        "(median,\n        least, most, of the processor)\n"
        "Sets: primary (nearest), shadow (any, from a point light), bounce (diffuse "
        "directions, nearest),\nbounceany (the same, any).\n",
        flagsText(benchFlags(unused)), exitCodesText());
}

std::string verifyHelpText() {
    VerifyOptions unused;
    return cat(
        "usage: raytracer verify [TEST...] [options]\n\n"
        "Runs the stress battery on this machine: rays against closed meshes, shapes against "
        "wide\narithmetic, lamps and materials against formulas. A line per test; exit code ",
        static_cast<int>(ExitCode::Internal),
        " when\none does not keep its mark. Without "
        "TEST all quick ones; the same cases on every machine.\n",
        flagsText(verifyFlags(unused)), exitCodesText());
}

std::string featureListText() {
    Options unused;
    std::string out;
    for (const Flag& flag : renderFlags(unused))
        if (flag.group == kFeatureGroup)
            out += twoColumns(flag.name.substr(2), flag.help).substr(2);
    return out;
}
