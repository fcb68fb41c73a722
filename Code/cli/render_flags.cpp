// The table of options of `raytracer SCENE [OUTPUT]`: a new option is a new row here.
#include "cli/options.h"

#include "cli/method_names.h"
#include "desc/properties.h"
#include "image/image.h"

#include <algorithm>
#include <filesystem>

namespace {

using Action = Options::Action;
constexpr Flag::Value kRequired = Flag::Value::Required;
constexpr int kMostThreads = 1024;
constexpr int kLastFrame = 99999999;

template <class E>
std::vector<std::string> namesOf() {
    return {kNamesByValue<E>.begin(), kNamesByValue<E>.end()};
}

template <class E>
E enumValue(const FlagValue& value) {
    return static_cast<E>(value.choice(namesOf<E>()));
}

// "a|b|c", as --help shows what an option can be.
template <class E>
std::string alternatives() {
    return join(namesOf<E>(), "|");
}

// What the same number may be in a scene file.
Range rangeOf(std::string_view keyword) {
    const auto row = std::find_if(kSettingsProperties.begin(), kSettingsProperties.end(),
                                  [&](const auto& property) { return property.keyword == keyword; });
    return row->range;
}

int wholeLike(std::string_view keyword, const FlagValue& value) {
    const Range range = rangeOf(keyword);
    return value.whole(static_cast<int>(range.lo), static_cast<int>(range.hi));
}

// Two different things to do do not fit together; --help wins over everything.
void setAction(Options& o, Action action, const FlagValue& value) {
    if (o.action == Action::Help) return;
    if (action != Action::Help && o.action != Action::Render && o.action != action)
        failUsage(cat(value.flag, " cannot be combined with another option of the group 'instead of "
                                  "a picture'"));
    o.action = action;
}

void setResolution(Options& o, const FlagValue& value) {
    const std::string expected =
        cat("WIDTHxHEIGHT, each from 1 to ", Image::kMaxSide, " (such as 1920x1080)");
    const std::vector<int> sides = value.wholes(2, "x", expected);
    for (const int side : sides)
        if (side < 1 || side > Image::kMaxSide) value.wrong(expected);
    o.resolution = {sides[0], sides[1]};
}

void setCrop(Options& o, const FlagValue& value) {
    constexpr std::string_view kExpected =
        "x0,y0,x1,y1 in pixels from the top left with 0 <= x0 < x1 and 0 <= y0 < y1";
    const std::vector<int> edges = value.wholes(4, ",", kExpected);
    if (edges[0] < 0 || edges[1] < 0 || edges[2] <= edges[0] || edges[3] <= edges[1])
        value.wrong(kExpected);
    o.crop = {edges[0], edges[1], edges[2], edges[3]};
}

void setBackground(Options& o, const FlagValue& value) {
    constexpr std::string_view kExpected = "r,g,b, each at least 0 (such as 0.1,0.2,0.4)";
    const std::vector<double> rgb = value.numbers(3, kExpected);
    for (const double channel : rgb)
        if (!kColor.contains(channel)) value.wrong(kExpected);
    o.background = {rgb[0], rgb[1], rgb[2]};
}

// NAME or NAME,WIDTH
void setFilter(Options& o, const FlagValue& value) {
    using Filter = SettingsDesc::Filter;
    const std::size_t comma = value.text.find(',');
    o.filter = enumValue<Filter>({value.flag, value.text.substr(0, comma)});
    o.filterWidth.reset();
    if (comma == std::string_view::npos) return;
    const Range range = rangeOf("filter");
    const auto width = parseDouble(value.text.substr(comma + 1));
    if (!width || !range.contains(*width))
        value.wrong(cat("NAME or NAME,WIDTH with a width above ", shortest(range.lo), " and up to ",
                        shortest(range.hi), " pixels"));
    o.filterWidth = width;
}

// NAME,NAME,...
void setAovs(Options& o, const FlagValue& value) {
    o.aovs.clear();
    std::string_view rest = value.text;
    while (true) {
        const std::size_t comma = rest.find(',');
        const Aov aov = enumValue<Aov>({value.flag, rest.substr(0, comma)});
        if (std::find(o.aovs.begin(), o.aovs.end(), aov) == o.aovs.end()) o.aovs.push_back(aov);
        if (comma == std::string_view::npos) return;
        rest.remove_prefix(comma + 1);
    }
}

void addPictureFlags(std::vector<Flag>& flags, Options& o) {
    const std::string group = "picture";
    flags.push_back({.name = "--resolution", .alias = "-r", .argument = "WxH",
                     .help = "size in pixels", .group = group,
                     .set = [&o](const FlagValue& v) { setResolution(o, v); },
                     .value = kRequired, .example = "12x8"});
    flags.push_back({.name = "--scale", .argument = "PCT",
                     .help = "percentage of the resolution, rounded down", .group = group,
                     .set = [&o](const FlagValue& v) { o.scalePercent = v.number(0.01, 10000); },
                     .value = kRequired, .example = "50"});
    flags.push_back({.name = "--crop", .argument = "x0,y0,x1,y1",
                     .help = "only these pixels of the scaled picture, from the top left; x1 and y1 "
                             "are the first ones outside",
                     .group = group, .set = [&o](const FlagValue& v) { setCrop(o, v); },
                     .value = kRequired, .example = "1,1,3,3"});
    flags.push_back({.name = "--crop-pad",
                     .help = "a cropped picture keeps the full size, black around the crop",
                     .group = group, .set = [&o](const FlagValue&) { o.cropPad = true; }});
    flags.push_back({.name = "--camera", .argument = "NAME",
                     .help = "camera of the scene to look through (the first one)", .group = group,
                     .set = [&o](const FlagValue& v) { o.camera = v.nonEmpty("the name of a camera"); },
                     .value = kRequired, .example = "main"});
    flags.push_back({.name = "--frame", .argument = "N",
                     .help = "replaces the last run of # in SCENE and OUTPUT by N, padded with zeros",
                     .group = group,
                     .set = [&o](const FlagValue& v) { o.frame = v.whole(0, kLastFrame); },
                     .value = kRequired, .example = "7"});
    flags.push_back({.name = "--exposure", .argument = "EV",
                     .help = "brightness in stops: the written picture times 2^EV", .group = group,
                     .set = [&o](const FlagValue& v) {
                         const Range range = rangeOf("exposure");
                         o.exposureEv = v.number(range.lo, range.hi);
                     },
                     .value = kRequired, .example = "-1"});
    flags.push_back({.name = "--transfer", .argument = alternatives<SettingsDesc::Transfer>(),
                     .help = "encoding of .ppm and .png (.pfm is always linear)", .group = group,
                     .set = [&o](const FlagValue& v) {
                         o.transfer = enumValue<SettingsDesc::Transfer>(v);
                     },
                     .value = kRequired, .choices = namesOf<SettingsDesc::Transfer>(),
                     .example = "linear"});
    flags.push_back({.name = "--bits", .argument = "8|16", .help = "bits per channel of .ppm and .png (8)",
                     .group = group,
                     .set = [&o](const FlagValue& v) {
                         o.bits = v.choice(std::vector<std::string>{"8", "16"}) == 0 ? 8 : 16;
                     },
                     .value = kRequired, .choices = {"8", "16"}, .example = "16"});
    flags.push_back({.name = "--background", .argument = "r,g,b",
                     .help = "radiance where no surface is, instead of the scene's", .group = group,
                     .set = [&o](const FlagValue& v) { setBackground(o, v); },
                     .value = kRequired, .example = "0.1,0.2,0.4"});
}

void addFeatureFlags(std::vector<Flag>& flags, Options& o) {
    const auto add = [&](const char* name, bool Switches::* member, const char* help) {
        flags.push_back({.name = name, .help = help, .group = kFeatureGroup,
                         .set = [&o, member](const FlagValue& v) { o.switches.*member = v.on; },
                         .negatable = true});
    };
    add("--shadows", &Switches::shadows, "surfaces keep light from others");
    add("--soft-shadows", &Switches::softShadows, "lights have a size; off: they shine from their centre");
    add("--reflection", &Switches::reflection, "mirrors");
    add("--refraction", &Switches::refraction, "glass");
    add("--glossy", &Switches::glossy, "rough mirrors and glass; off: they are sharp");
    flags.push_back({.name = "--textures", .argument = "DIR",
                     .help = "pictures on surfaces and around the scene; a folder after it is searched "
                             "after the scene's own",
                     .group = kFeatureGroup,
                     .set = [&o](const FlagValue& v) {
                         o.switches.textures = v.on;
                         if (v.text.empty()) return;
                         if (!std::filesystem::is_directory(v.text)) v.wrong("a folder");
                         o.textureFolder = v.text;
                     },
                     .value = Flag::Value::Optional, .negatable = true,
                     .files = Flag::Files::Folders, .example = "."});
    add("--dof", &Switches::dof, "depth of field; off: a pinhole camera");
    add("--motion-blur", &Switches::motionBlur, "things move while the shutter is open");
    add("--fresnel", &Switches::fresnel, "reflection depends on the angle");
    add("--aa", &Switches::aa, "antialiasing; off: one sample in the centre of each pixel");
}

void addQualityFlags(std::vector<Flag>& flags, Options& o) {
    const std::string group = "quality";
    flags.push_back({.name = "--spp", .alias = "-s", .argument = "N",
                     .help = "samples per pixel; powers of two are best", .group = group,
                     .set = [&o](const FlagValue& v) { o.samplesPerPixel = wholeLike("samples", v); },
                     .value = kRequired, .example = "4"});
    flags.push_back({.name = "--light-samples", .argument = "N",
                     .help = "shadow rays per soft light and hit", .group = group,
                     .set = [&o](const FlagValue& v) { o.lightSamples = wholeLike("light_samples", v); },
                     .value = kRequired, .example = "2"});
    flags.push_back({.name = "--max-depth", .alias = "-d", .argument = "N",
                     .help = "bounces after the camera ray", .group = group,
                     .set = [&o](const FlagValue& v) { o.maxDepth = wholeLike("max_depth", v); },
                     .value = kRequired, .example = "3"});
    flags.push_back({.name = "--sampler", .argument = alternatives<SettingsDesc::Sampler>(),
                     .help = "how samples are spread", .group = group,
                     .set = [&o](const FlagValue& v) { o.sampler = enumValue<SettingsDesc::Sampler>(v); },
                     .value = kRequired, .choices = namesOf<SettingsDesc::Sampler>(),
                     .example = "random"});
    flags.push_back({.name = "--jitter", .help = "samples are moved at random in their cells",
                     .group = group, .set = [&o](const FlagValue& v) { o.jitter = v.on; },
                     .negatable = true});
    flags.push_back({.name = "--seed", .argument = "N", .help = "another seed gives other noise",
                     .group = group,
                     .set = [&o](const FlagValue& v) {
                         const auto seed = parseInteger(v.text);
                         if (!seed || !kAnyUnsigned.contains(static_cast<double>(*seed)))
                             v.wrong("a whole number from 0 to 4294967295");
                         o.seed = static_cast<std::uint32_t>(*seed);
                     },
                     .value = kRequired, .example = "5"});
    flags.push_back({.name = "--filter", .argument = "NAME[,WIDTH]",
                     .help = alternatives<SettingsDesc::Filter>() + ", and its width in pixels",
                     .group = group, .set = [&o](const FlagValue& v) { setFilter(o, v); },
                     .value = kRequired, .choices = namesOf<SettingsDesc::Filter>(),
                     .example = "tent,2"});
}

void addMethodFlags(std::vector<Flag>& flags, Options& o) {
    const std::string group = "method";
    flags.push_back({.name = "--integrator", .alias = "-i", .argument = alternatives<IntegratorKind>(),
                     .help = "what a pixel shows", .group = group,
                     .set = [&o](const FlagValue& v) { o.integrator = enumValue<IntegratorKind>(v); },
                     .value = kRequired, .choices = namesOf<IntegratorKind>(), .example = "normal"});
    flags.push_back({.name = "--accel", .argument = alternatives<AccelKind>(),
                     .help = "how hits are searched; the picture is the same", .group = group,
                     .set = [&o](const FlagValue& v) { o.accel = enumValue<AccelKind>(v); },
                     .value = kRequired, .choices = namesOf<AccelKind>(), .example = "none"});
    flags.push_back({.name = "--bvh", .help = "the same as --accel bvh and --accel none", .group = group,
                     .set = [&o](const FlagValue& v) { o.accel = v.on ? AccelKind::Bvh : AccelKind::None; },
                     .negatable = true});
    const std::vector<std::string> kernels = {"auto", "scalar"};
    flags.push_back({.name = "--kernel", .argument = join(kernels, "|"),
                     .help = "machine code for the search; the picture is the same", .group = group,
                     .set = [&o, kernels](const FlagValue& v) { o.kernel = kernels[v.choice(kernels)]; },
                     .value = kRequired, .choices = kernels, .example = "scalar"});
    flags.push_back({.name = "--threads", .alias = "-t", .argument = "N",
                     .help = "0: all that the machine has (0)", .group = group,
                     .set = [&o](const FlagValue& v) { o.threads = v.whole(0, kMostThreads); },
                     .value = kRequired, .example = "2"});
}

void addOutputFlags(std::vector<Flag>& flags, Options& o) {
    const std::string group = "output";
    flags.push_back({.name = "--output", .alias = "-o", .argument = "FILE",
                     .help = "the same as OUTPUT: .ppm, .png or .pfm; - is a PPM on stdout "
                             "(Output/SCENE.ppm)",
                     .group = group,
                     .set = [&o](const FlagValue& v) { o.output = v.nonEmpty("the name of a file"); },
                     .value = kRequired, .files = Flag::Files::Any, .example = "-"});
    flags.push_back({.name = "--aov", .argument = "NAME,...",
                     .help = alternatives<Aov>() + ": more pictures, beside OUTPUT as OUTPUT.NAME.pfm",
                     .group = group, .set = [&o](const FlagValue& v) { setAovs(o, v); },
                     .value = kRequired, .choices = namesOf<Aov>(), .example = "depth,id"});
    flags.push_back({.name = "--stats", .argument = "json",
                     .help = "times and counters on stderr; with =json as JSON, alone on stdout",
                     .group = group,
                     .set = [&o](const FlagValue& v) {
                         if (!v.text.empty()) v.choice(std::vector<std::string>{"json"});
                         o.stats = v.text.empty() ? Options::StatsFormat::Table
                                                  : Options::StatsFormat::Json;
                     },
                     .value = Flag::Value::Optional, .choices = {"json"}, .example = "json"});
    flags.push_back({.name = "--quiet", .alias = "-q", .help = "no progress, nothing but warnings and errors",
                     .group = group, .set = [&o](const FlagValue&) { o.quiet = true; }});
    flags.push_back({.name = "--progress", .argument = alternatives<Options::Progress>(),
                     .help = "auto: a bar on a terminal, else plain: a line per 10 %", .group = group,
                     .set = [&o](const FlagValue& v) { o.progress = enumValue<Options::Progress>(v); },
                     .value = kRequired, .choices = namesOf<Options::Progress>(), .example = "plain"});
    flags.push_back({.name = "--preview", .alias = "-p", .help = "also shows the picture in the terminal (stderr)",
                     .group = group, .set = [&o](const FlagValue&) { o.preview = true; }});
    flags.push_back({.name = "--strict", .help = "a warning about the scene ends the program, exit code 3",
                     .group = group, .set = [&o](const FlagValue&) { o.strict = true; }});
}

void addActionFlags(std::vector<Flag>& flags, Options& o) {
    const std::string group = "instead of a picture";
    const auto add = [&](const char* name, const char* alias, Action action, const char* help) {
        flags.push_back({.name = name, .alias = alias, .help = help, .group = group,
                         .set = [&o, action](const FlagValue& v) { setAction(o, action, v); }});
    };
    add("--check", "-c", Action::Check, "reads and checks the scene and its textures");
    add("--info", "", Action::Info, "tells what the scene contains");
    flags.push_back({.name = "--convert", .argument = "FILE.txt",
                     .help = "writes the scene in the native format, with the options given here; - is "
                             "stdout",
                     .group = group,
                     .set = [&o](const FlagValue& v) {
                         o.convertTo = v.nonEmpty("the name of a .txt file, or -");
                         if (o.convertTo != "-" && !o.convertTo.ends_with(".txt"))
                             v.wrong("the name of a .txt file, or -");
                         setAction(o, Action::Convert, v);
                     },
                     .value = kRequired, .files = Flag::Files::Any, .example = "-"});
    add("--list-features", "", Action::ListFeatures, "lists the features that can be switched on and off");
    add("--help", "-h", Action::Help, "this text");
    add("--version", "-v", Action::Version, "the version");
    const std::vector<std::string> shells = {"bash", "zsh", "fish"};
    flags.push_back({.name = "--completion", .argument = join(shells, "|"),
                     .help = "prints a script that completes options in that shell", .group = group,
                     .set = [&o, shells](const FlagValue& v) {
                         o.shell = shells[v.choice(shells)];
                         setAction(o, Action::Completion, v);
                     },
                     .value = kRequired, .choices = shells, .example = "bash"});
}

} // namespace

std::vector<Flag> renderFlags(Options& options) {
    std::vector<Flag> flags;
    addPictureFlags(flags, options);
    addFeatureFlags(flags, options);
    addQualityFlags(flags, options);
    addMethodFlags(flags, options);
    addOutputFlags(flags, options);
    addActionFlags(flags, options);
    return flags;
}
