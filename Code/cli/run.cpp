#include "cli/command.h"

#include "base/error.h"
#include "base/file_text.h"
#include "base/platform/platform.h"
#include "base/text.h"
#include "cli/output.h"
#include "cli/interrupt.h"
#include "cli/messages.h"
#include "cli/options.h"
#include "cli/progress.h"
#include "cli/settings_from.h"
#include "cli/stats_output.h"
#include "desc/write_txt.h"
#include "read/load.h"
#include "scene/texture_files.h"
#include "render/render.h"
#include "scene/scene.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>

namespace {

double secondsNow() {
    const std::chrono::duration<double> since = std::chrono::steady_clock::now().time_since_epoch();
    return since.count();
}

// Seconds since the last call.
class Stopwatch {
public:
    double lap() {
        const double before = last_;
        last_ = secondsNow();
        return last_ - before;
    }
    double total() const { return secondsNow() - start_; }

private:
    double start_ = secondsNow(), last_ = start_;
};

Progress::Style progressStyle(const Options& options, const Terminal& terminal) {
    if (options.quiet || options.progress == Options::Progress::None) return Progress::Style::None;
    const bool bar = options.progress == Options::Progress::Auto && terminal.present;
    return bar ? Progress::Style::Bar : Progress::Style::Plain;
}

// The size of the picture that is written, checked before memory is taken for it.
PictureSize checkedSize(const SettingsDesc& picture, bool cropPad) {
    PictureSize size{picture.width, picture.height};
    if (picture.crop && !cropPad)
        size = {(*picture.crop)[2] - (*picture.crop)[0], (*picture.crop)[3] - (*picture.crop)[1]};
    if (static_cast<long long>(size.width) * size.height > Image::kMaxPixels)
        failUsage(cat("a picture of ", size.width, "x", size.height,
                      " pixels is too large; at most ", Image::kMaxPixels,
                      " pixels are possible, --crop renders a part"));
    return size;
}

// Returns about how long it takes until a picture of this size is written once its samples are there: 30 ns per
// pixel as PNG, the slowest kind, as much for each AOV, and 1.8 us of one thread for its noise to be taken out.
double secondsToFinish(const RenderSettings& settings, const PictureSize& size) {
    const double pixels = static_cast<double>(size.width) * size.height;
    const double denoising = settings.picture.denoise ? 1.8e-6 * pixels / settings.threads : 0;
    return 0.005 + 30e-9 * pixels * (1 + static_cast<double>(settings.aovs.size())) + denoising;
}

// `watch` has run since the program began to read the scene.
Picture renderPicture(const Scene& scene, const RenderSettings& settings, const Options& options,
                      const Stopwatch& watch, Stats& stats, bool& stopped) {
    const Terminal terminal = terminalOfStderr();
    const StopOnInterrupt interrupt;
    Progress progress(progressStyle(options, terminal), terminal.columns, writeStderr, secondsNow,
                      options.progress == Options::Progress::Auto ? 1 : 0);
    const auto update = [&](double part) { progress.update(part); };
    const double toFinish =
        secondsToFinish(settings, checkedSize(settings.picture, options.cropPad));
    const auto secondsLeft = [&] { return *options.seconds - watch.total() - toFinish; };
    RenderControl control{update, interrupt.flag()};
    if (options.seconds) control.secondsLeft = secondsLeft;
    Picture picture = render(scene, settings, control, stats);
    stopped = interrupt.stopped() || !picture.finished;
    return picture;
}

// An OUTPUT that the scene is made of would be lost, also by way of a link.
void checkNoInput(const std::string& output, const std::vector<std::string>& inputs) {
    for (const std::string& input : inputs) {
        std::error_code ignored;
        if (std::filesystem::equivalent(output, input, ignored))
            failUsage(cat("OUTPUT '", output, "' is a file that the scene is made of ('", input,
                          "'); name another"));
    }
}

std::vector<std::string> namesOfOutputs(const Options& options, const RenderSettings& settings) {
    if (options.action == Options::Action::Convert) return {options.convertTo};
    if (options.action != Options::Action::Render || options.output == "-") return {};
    return filesOf(options.output.empty() ? defaultOutput(options.scene) : options.output,
                   settings.aovs);
}

// Prints what a scene without some of its pictures has to say.
Diagnostics told(const Scene& scene) {
    Diagnostics diagnostics;
    diagnostics.warnings.assign(scene.warnings().begin(), scene.warnings().end());
    printWarnings(diagnostics);
    return diagnostics;
}

void describePictures(const LoadedScene& loaded, const RenderSettings& settings,
                      const Options& options, Stats& stats) {
    std::vector<std::size_t> used;
    if (settings.switches.textures) used = usedTextures(loaded.desc, !settings.background);
    const PictureBytes bytes =
        pictureBytes(loaded.desc, used, loaded.source.name, options.textureFolder);
    stats.readPictureBytes = bytes.shown, stats.unreadPictureBytes = bytes.unshown;
}

ExitCode renderScene(LoadedScene loaded, PictureReader& pictures, RenderSettings settings,
                     const Options& options, Stopwatch& watch, Stats& stats, Step& step) {
    const PictureSize size = checkedSize(settings.picture, options.cropPad);
    const std::string output =
        options.output.empty() ? defaultOutput(options.scene) : options.output;
    const std::vector<std::string> files = filesOf(output, settings.aovs);
    if (output != "-") std::for_each(files.begin(), files.end(), checkWritable);
    settings.onlyCodes = needsOnlyCodes(settings, options, output);
    printAdvice(settings, options);

    step = {"building the scene", ExitCode::Input};
    // What else is to be told of places in the text is of pictures that can't be read.
    if (loaded.desc.textures.empty()) loaded.source.text = {};
    if (options.stats != Options::StatsFormat::None)
        describePictures(loaded, settings, options, stats);
    const Scene scene(std::move(loaded.desc), loaded.source, settings, &pictures);
    if (isTooStrict(options, told(scene))) return ExitCode::StrictWarnings;
    scene.describe(stats);
    stats.threads = settings.threads;
    stats.kernel = settings.isa->name;
    stats.buildSeconds = watch.lap();

    step = {"rendering", ExitCode::Input};
    bool stopped = false;
    Picture picture = renderPicture(scene, settings, options, watch, stats, stopped);
    if (stopped && !options.partial) {
        writeStderr("raytracer: interrupted; nothing is written\n");
        return ExitCode::Interrupted;
    }
    if (stopped) writeStderr("raytracer: interrupted; what is done is written\n");
    stats.renderSeconds = watch.lap();
    stats.mipBytes = scene.mipBytes(), stats.unmadeMipBytes = scene.unmadeMipBytes();
    if (!stopped) {
        printShortfall(stats, settings, options);
        printExposure(picture, scene, settings, output);
    }

    step = {"writing the picture", ExitCode::Output};
    if (options.preview) printPreview(picture, settings);
    watch.lap();
    writePicture(std::move(picture), settings, options, output);
    stats.writeSeconds = watch.lap();
    stats.totalSeconds = watch.total();
    stats.peakBytes = peakBytes();
    if (!options.quiet && output != "-") {
        const std::string samples = stats.samplesMin == stats.samplesMax
                                        ? shortest(stats.samplesMean)
                                        : cat("about ", significant(stats.samplesMean));
        const std::string error =
            stats.error && std::isfinite(stats.error->estimate)
                ? cat(", error ", significant(stats.error->estimate))
                : "";
        writeStderr(cat("wrote ", join(files), " (", size.width, "x", size.height, ", ", samples,
                        samples == "1" ? " sample" : " samples", " per pixel", error, ", ",
                        stats.denoisedError ? cat("denoised, estimated error ",
                                                  significant(*stats.denoisedError), ", ")
                                            : std::string(),
                        durationText(stats.totalSeconds), ")\n"));
    }
    printStats(stats, {options.scene, output, size, options.arguments}, options);
    return stopped ? ExitCode::Interrupted : ExitCode::Ok;
}

std::filesystem::path folderOf(const std::string& name) {
    return std::filesystem::absolute(name).lexically_normal().parent_path();
}

// Pictures that lie beside a scene are to be found from its new folder as well; those that are
// found in --textures or ./Textures keep their names.
void moveTextures(SceneDesc& desc, const std::filesystem::path& from,
                  const std::filesystem::path& to) {
    if (from == to) return;
    for (TextureDesc& texture : desc.textures) {
        const std::filesystem::path path = from / texture.file;
        std::error_code ignored;
        if (std::filesystem::path(texture.file).is_relative() &&
            std::filesystem::is_regular_file(path, ignored))
            texture.file = path.lexically_normal().lexically_relative(to).string();
    }
}

ExitCode convert(const LoadedScene& loaded, const Options& options) {
    // Switches are no part of a scene; --no-aa must not turn into a filter without width.
    Options written = options;
    written.switches = {};
    SceneDesc desc = withSettings(loaded.desc, settingsFrom(loaded.desc, written));
    if (options.convertTo != "-" && options.scene != "-")
        moveTextures(desc, folderOf(options.scene), folderOf(options.convertTo));
    const std::string text = writeTxt(desc);
    if (options.convertTo == "-") {
        writeStdout(text);
        return ExitCode::Ok;
    }
    writeFileAtomically(options.convertTo,
                        {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()});
    if (!options.quiet) writeStderr(cat("wrote ", options.convertTo, "\n"));
    return ExitCode::Ok;
}

// Everything that reads a scene.
ExitCode runScene(const Options& options, Step& step) {
    using Action = Options::Action;
    // What can be known now must not be found out after an hour of rendering.
    if (!options.output.empty() && options.output != "-") checkWritable(options.output);
    if (options.action == Action::Convert && options.convertTo != "-")
        checkWritable(options.convertTo);

    step = {"reading the scene", ExitCode::Input};
    Stopwatch watch;
    Stats stats;
    Diagnostics diagnostics;
    ReadOptions read = options.read;
    read.threads = options.threads; // both take 0 for what the machine has
    PictureReader pictures(options.textureFolder, options.threads);
    const auto foreseen = [&](const SceneDesc& desc, const std::string& sceneFile) {
        if (options.action != Action::Convert && options.switches.textures)
            pictures.begin(desc, usedTextures(desc, !options.background), sceneFile);
    };
    LoadedScene loaded = load(options.scene, diagnostics, read,
                              pictures.hasThreads() ? Foreseen(foreseen) : Foreseen());
    stats.parseSeconds = watch.lap();
    printWarnings(diagnostics);
    RenderSettings settings = settingsFrom(loaded.desc, options);
    settings.picturesMayMiss = loaded.picturesMayMiss;
    if (isTooStrict(options, diagnostics)) return ExitCode::StrictWarnings;
    std::vector<std::string> inputs = std::move(diagnostics.filesRead);
    for (const TextureDesc& texture : loaded.desc.textures)
        if (auto file = findPicture(texture.file, loaded.source.name, options.textureFolder))
            inputs.push_back(std::move(*file));
    for (const std::string& output : namesOfOutputs(options, settings))
        checkNoInput(output, inputs);
    if (options.action == Action::Convert) return convert(loaded, options);
    if (options.action == Action::Render)
        return renderScene(std::move(loaded), pictures, std::move(settings), options, watch, stats,
                           step);

    step = {"building the scene", ExitCode::Input};
    settings.accel = AccelKind::None; // nothing is traced
    const Scene scene(loaded.desc, loaded.source, settings, &pictures);
    if (isTooStrict(options, told(scene))) return ExitCode::StrictWarnings;
    if (options.action == Action::Info)
        writeStdout(infoText(loaded.source, loaded.desc, settings, scene));
    else
        writeStdout(cat(options.scene, ": ok (", summaryText(loaded.desc), ")\n"));
    return ExitCode::Ok;
}

// A first word that is no file, but nearly the name of a sub-command.
void checkForCommand(const std::string& first) {
    std::vector<std::string> names;
    for (const Command& command : commands()) names.emplace_back(command.name);
    std::error_code ignored;
    const std::filesystem::path path(first);
    if (first.starts_with('-') || path.has_extension() || std::filesystem::exists(path, ignored))
        return;
    if (const auto near = nearestWord(first, names))
        failUsage(cat("there is no file and no sub-command '", first, "'; did you mean 'raytracer ",
                      *near, "'?"));
}

// "help", unless there is a scene of that name.
bool isHelpWord(const std::string& first) {
    std::error_code ignored;
    return first == "help" && !std::filesystem::exists(first, ignored);
}

ExitCode runOptions(std::span<const std::string> arguments, Step& step) {
    if (!arguments.empty() && isHelpWord(arguments[0])) {
        const Command* const command = arguments.size() > 1 ? commandNamed(arguments[1]) : nullptr;
        writeStdout(command ? commandHelpText(*command) : helpText());
        return ExitCode::Ok;
    }
    if (!arguments.empty()) checkForCommand(arguments[0]);
    const Options options = parseOptions(arguments);
    switch (options.action) {
    case Options::Action::Help: writeStdout(helpText()); return ExitCode::Ok;
    case Options::Action::Version:
        writeStdout(cat("raytracer ", kVersion, "\n"));
        return ExitCode::Ok;
    case Options::Action::ListFeatures: writeStdout(featureListText()); return ExitCode::Ok;
    case Options::Action::Completion:
        writeStdout(completionScript(options.shell));
        return ExitCode::Ok;
    case Options::Action::Render:
    case Options::Action::Check:
    case Options::Action::Info:
    case Options::Action::Convert: break;
    }
    return runScene(options, step);
}

} // namespace

ExitCode run(std::span<const std::string> arguments, Step& step) {
    handleInterrupts();
    const Command* const command = arguments.empty() ? nullptr : commandNamed(arguments[0]);
    try {
        if (!command) return runOptions(arguments, step);
        step = command->step;
        return command->run(*command, arguments.subspan(1));
    } catch (const Error& error) {
        if (error.kind() != ErrorKind::Usage) throw;
        fail(ErrorKind::Usage,
             cat(error.what(), "\nraytracer: 'raytracer ", command ? command->name : "",
                 command ? " " : "", "--help' lists all options"));
    }
}
