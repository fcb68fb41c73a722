// Options: what the command line asks for, before the scene is read. settings_from.h joins it with
// the scene's own settings. Knows nothing about rendering.
#pragma once

#include "base/enum_names.h"
#include "cli/flag.h"
#include "desc/scene_desc.h"
#include "read/read_context.h"
#include "scene/settings.h"

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

struct Options {
    enum class Action { Render, Check, Info, Convert, ListFeatures, Help, Version, Completion };
    enum class StatsFormat { None, Table, Json };
    enum class Progress { Auto, Plain, None };

    std::string scene;                  // "-": native text on stdin
    std::string output;                 // "-": PPM on stdout; empty: defaultOutput()
    std::vector<std::string> arguments; // all of them as they were given
    Action action = Action::Render;
    std::string convertTo; // Convert: the file, "-" is stdout
    std::string shell;     // Completion

    // Picture; what is empty comes from the scene file.
    std::optional<std::array<int, 2>> resolution;
    double scalePercent = 100;
    std::optional<std::array<int, 4>> crop; // x0 y0 x1 y1 after scaling, x1 y1 exclusive
    bool cropPad = false;
    std::string camera;
    std::optional<int> frame;
    std::optional<double> exposureEv;
    std::optional<SettingsDesc::Transfer> transfer;
    std::optional<int> bits;
    std::optional<Rgbd> background;

    ReadOptions read;
    Switches switches;
    bool specialise = true;

    // Quality
    std::optional<int> samplesPerPixel, lightSamples, maxDepth;
    std::optional<int> diffuseDepth, glossyDepth, transmissionDepth, transparentDepth;
    std::optional<double> filterGlossy;
    std::optional<double> clampIndirect;
    std::optional<bool> caustics;
    std::optional<bool> denoise;
    // --error; samplesPerPixel is then the most, as with --time and --passes.
    std::optional<double> error;
    ErrorUnit errorUnit = ErrorUnit::Display;
    bool errorOfWorstBlock = false;
    std::optional<double> seconds; // --time
    std::optional<int> passes;
    std::optional<SettingsDesc::Sampler> sampler;
    std::optional<SettingsDesc::TextureFilter> textureFilter;
    std::optional<bool> jitter;
    std::optional<std::uint32_t> seed;
    std::optional<SettingsDesc::Filter> filter;
    std::optional<double> filterWidth; // pixels

    // Method
    std::optional<IntegratorKind> integrator;
    AccelKind accel = AccelKind::Bvh;
    std::string kernel = "auto";
    int threads = 0; // 0: all that the machine has

    // Output
    std::vector<Aov> aovs;
    StatsFormat stats = StatsFormat::None;
    bool quiet = false;
    Progress progress = Progress::Auto;
    bool preview = false;
    bool partial = false; // an interrupted render writes what is done

    bool strict = false;
    std::string textureFolder;
};

// The words on the command line for the enums of RenderSettings and Options.
constexpr auto wordsOf(AccelKind) { return words("bvh", "none"); }
constexpr auto wordsOf(Aov) {
    return words("depth", "normal", "albedo", "position", "id", "samples", "error");
}
constexpr auto wordsOf(ErrorUnit) { return words("display", "linear", "relative"); }
constexpr auto wordsOf(Options::Progress) { return words("auto", "plain", "none"); }

inline constexpr const char* kFeatureGroup = "features"; // the group of Switches

// The one table of options; the setters write into `options`, which must outlive the table.
std::vector<Flag> renderFlags(Options& options);

// Everything after the program's name. Fails with ErrorKind::Usage when the arguments are wrong or
// do not fit together. A run of # in both names is replaced when there is a frame number.
Options parseOptions(std::span<const std::string> arguments);
