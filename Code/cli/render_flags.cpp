// The table of options of `raytracer SCENE [OUTPUT]`: a new option is a new row here.
#include "cli/settings_from.h"
#include "cli/option_setters.h"
#include "cli/options.h"

namespace {

constexpr int kMostThreads = 1024;
constexpr int kLastFrame = 99999999;

// One row per option, not one line per member.
// clang-format off

void addPictureFlags(std::vector<Flag>& flags, Options& o) {
    FlagGroup group(flags, "picture");
    group.add({.name = "--resolution", .alias = "-r", .argument = "WxH", .help = "size in pixels",
               .set = [&o](const FlagValue& v) { setResolution(o, v); }, .example = "12x8"});
    group.add({.name = "--scale", .argument = "PCT",
               .help = "percentage of the resolution, rounded down",
               .set = [&o](const FlagValue& v) { setScale(o, v); },
               .example = "50"});
    group.add({.name = "--crop", .argument = "x0,y0,x1,y1",
               .help = "only these pixels of the scaled picture, from the top left; x1 and y1 are "
                       "the first ones outside",
               .set = [&o](const FlagValue& v) { setCrop(o, v); }, .example = "1,1,3,3"});
    group.add({.name = "--crop-pad",
               .help = "a cropped picture keeps the full size, black around the crop",
               .set = [&o](const FlagValue&) { o.cropPad = true; }});
    group.add({.name = "--camera", .argument = "NAME",
               .help = "camera of the scene to look through (the first one)",
               .set = [&o](const FlagValue& v) { o.camera = v.nonEmpty("the name of a camera"); },
               .example = "main"});
    group.add({.name = "--frame", .argument = "N",
               .help = "replaces the last run of # in SCENE and OUTPUT by N, padded with zeros",
               .set = [&o](const FlagValue& v) { o.frame = v.whole(0, kLastFrame); },
               .example = "7"});
    group.add({.name = "--exposure", .argument = "EV",
               .help = "brightness in stops: the written picture times 2^EV",
               .set = [&o](const FlagValue& v) { o.exposureEv = numberLike("exposure", v); },
               .example = "-1"});
    group.add({.name = "--transfer", .argument = alternatives<SettingsDesc::Transfer>(),
               .help = "encoding of .ppm and .png (.pfm and .exr are always linear)",
               .set = [&o](const FlagValue& v) {
                   o.transfer = enumValue<SettingsDesc::Transfer>(v);
               },
               .choices = namesOf<SettingsDesc::Transfer>(), .example = "linear"});
    const std::vector<std::string> bits = {"8", "16", "32"};
    group.add({.name = "--bits", .argument = join(bits, "|"),
               .help = "bits per channel: of .ppm and .png 8 or 16 (8), of .exr 16 or 32 (32)",
               .set = [&o, bits](const FlagValue& v) { o.bits = 8 << v.choice(bits); },
               .choices = bits, .example = "16"});
    group.add({.name = "--background", .argument = "r,g,b",
               .help = "radiance where no surface is, instead of the scene's",
               .set = [&o](const FlagValue& v) { setBackground(o, v); }, .example = "0.1,0.2,0.4"});
}

void addSceneFlags(std::vector<Flag>& flags, Options& o) {
    FlagGroup group(flags, "scene");
    group.add({.name = "--lenient",
               .help = "JSON: what is wrong or not known is left out with a warning instead of an error",
               .set = [&o](const FlagValue&) { o.read.lenient = true; }});
    const std::vector<std::string> ends = {"centers", "edges"};
    group.add({.name = "--nff-angle", .argument = join(ends, "|"),
               .help = "what an NFF view's angle spans: the centers of the first and the last row "
                       "of pixels, as its standard says, or the edges of the picture, as POV-Ray "
                       "has it (centers)",
               .set = [&o, ends](const FlagValue& v) {
                   o.read.nffAngleToEdges = v.choice(ends) == 1;
               },
               .choices = ends, .example = "edges"});
}

void addFeatureFlags(std::vector<Flag>& flags, Options& o) {
    FlagGroup group(flags, kFeatureGroup);
    const auto add = [&](const char* name, bool Switches::* member, const char* help) {
        group.add({.name = name, .help = help,
                   .set = [&o, member](const FlagValue& v) { o.switches.*member = v.on; },
                   .negatable = true});
    };
    add("--shadows", &Switches::shadows, "surfaces keep light from others");
    add("--soft-shadows", &Switches::softShadows,
        "lights have a size; off: they shine from their centre");
    add("--reflection", &Switches::reflection, "mirrors");
    add("--refraction", &Switches::refraction, "glass");
    add("--glossy", &Switches::glossy, "rough mirrors and glass; off: they are sharp");
    group.add({.name = "--textures", .argument = "DIR",
               .help = "pictures on surfaces and around the scene; a folder after it is searched "
                       "after the scene's own",
               .set = [&o](const FlagValue& v) { setTextures(o, v); },
               .value = Flag::Value::Optional, .negatable = true, .files = Flag::Files::Folders,
               .example = "."});
    add("--dof", &Switches::dof, "depth of field; off: a pinhole camera");
    add("--motion-blur", &Switches::motionBlur, "things move while the shutter is open");
    add("--fresnel", &Switches::fresnel, "reflection depends on the angle");
    add("--aa", &Switches::aa, "antialiasing; off: one sample in the centre of each pixel");
}

void addQualityFlags(std::vector<Flag>& flags, Options& o) {
    FlagGroup group(flags, "quality");
    group.add({.name = "--spp", .alias = "-s", .argument = "N",
               .help = "samples per pixel; powers of two are best",
               .set = [&o](const FlagValue& v) { o.samplesPerPixel = wholeLike("samples", v); },
               .example = "4"});
    group.add({.name = "--error", .argument = "[worst:]E[:UNIT]",
               .help = cat("samples where they are needed, until the error of the picture is below E with "
                           "95 % certainty: RMSE in units of ", alternatives<ErrorUnit>(),
                           " (display: as shown, 1 is full scale); worst: that of each block of 32 x 32 "
                           "pixels; --spp is then the most per pixel (65536)"),
               .set = [&o](const FlagValue& v) { setError(o, v); },
               .example = "0.01"});
    group.add({.name = "--time", .argument = "SECONDS",
               .help = "samples where they are needed, pass by pass, while the whole run takes no longer; "
                       "at least one pass of one sample",
               .set = [&o](const FlagValue& v) { o.seconds = v.number(1e-3, 1e9); },
               .example = "1"});
    group.add({.name = "--passes", .argument = "N",
               .help = "as many passes as a run with --time has told: the same picture, bit by bit",
               .set = [&o](const FlagValue& v) { o.passes = v.whole(1, 1000000); },
               .example = "3"});
    group.add({.name = "--light-samples", .argument = "N",
               .help = "shadow rays per soft light and hit",
               .set = [&o](const FlagValue& v) { o.lightSamples = wholeLike("light_samples", v); },
               .example = "2"});
    group.add({.name = "--max-depth", .alias = "-d", .argument = "N",
               .help = "bounces after the camera ray",
               .set = [&o](const FlagValue& v) { o.maxDepth = wholeLike("max_depth", v); },
               .example = "3"});
    const auto addDepth = [&](const char* name, const char* keyword,
                              std::optional<int> Options::*depth, const char* which) {
        group.add({.name = name, .argument = "N",
                   .help = cat("the most of them that are ", which, "; path tracing only"),
                   .set = [&o, keyword, depth](const FlagValue& v) { o.*depth = wholeLike(keyword, v); },
                   .example = "2"});
    };
    addDepth("--diffuse-depth", "diffuse_depth", &Options::diffuseDepth, "diffuse");
    addDepth("--glossy-depth", "glossy_depth", &Options::glossyDepth, "reflections");
    addDepth("--transmission-depth", "transmission_depth", &Options::transmissionDepth,
             "refractions");
    addDepth("--transparent-depth", "transparent_depth", &Options::transparentDepth,
             "straight on through what is not opaque");
    group.add({.name = "--filter-glossy", .argument = "R",
               .help = "reflections and glass that unlikely bounces meet are blurred, against bright "
                       "dots, as by Filter Glossy in Blender; path tracing only; 0: none",
               .set = [&o](const FlagValue& v) { o.filterGlossy = numberLike("filter_glossy", v); },
               .example = "1"});
    group.add({.name = "--texture-filter", .argument = alternatives<SettingsDesc::TextureFilter>(),
               .help = "mip: pictures and checkers are seen as their mean over what a sample stands "
                       "for, which needs fewer samples; none: as points, like Cycles",
               .set = [&o](const FlagValue& v) {
                   o.textureFilter = enumValue<SettingsDesc::TextureFilter>(v);
               },
               .choices = namesOf<SettingsDesc::TextureFilter>(), .example = "none"});
    group.add({.name = "--clamp-indirect", .argument = "V",
               .help = "the most light that a bounce may bring, against bright dots, which makes "
                       "the picture darker; path tracing only; 0: any",
               .set = [&o](const FlagValue& v) { o.clampIndirect = numberLike("clamp_indirect", v); },
               .example = "10"});
    group.add({.name = "--caustics",
               .help = "light that reaches what is diffuse by way of mirrors and glass; path "
                       "tracing only",
               .set = [&o](const FlagValue& v) { o.caustics = v.on; }, .negatable = true});
    group.add({.name = "--denoise",
               .help = "pixels become means of those around them that differ by no more than noise "
                       "explains; its error is estimated",
               .set = [&o](const FlagValue& v) { o.denoise = v.on; }, .negatable = true});
    group.add({.name = "--sampler", .argument = alternatives<SettingsDesc::Sampler>(),
               .help = "how samples are spread; corners: one ray through each corner of a pixel, "
                       "shared with its neighbours; zsobol: finer noise, for previews of few samples",
               .set = [&o](const FlagValue& v) { o.sampler = enumValue<SettingsDesc::Sampler>(v); },
               .choices = namesOf<SettingsDesc::Sampler>(), .example = "random"});
    group.add({.name = "--jitter", .help = "samples are moved at random in their cells",
               .set = [&o](const FlagValue& v) { o.jitter = v.on; }, .negatable = true});
    group.add({.name = "--seed", .argument = "N", .help = "another seed gives other noise",
               .set = [&o](const FlagValue& v) { setSeed(o, v); }, .example = "5"});
    group.add({.name = "--filter", .argument = "NAME[,WIDTH]",
               .help = alternatives<SettingsDesc::Filter>() + ", and its width in pixels",
               .set = [&o](const FlagValue& v) { setFilter(o, v); },
               .choices = namesOf<SettingsDesc::Filter>(), .example = "tent,2"});
}

void addMethodFlags(std::vector<Flag>& flags, Options& o) {
    FlagGroup group(flags, "method");
    group.add({.name = "--integrator", .alias = "-i", .argument = alternatives<IntegratorKind>(),
               .help = "what a pixel shows",
               .set = [&o](const FlagValue& v) { o.integrator = enumValue<IntegratorKind>(v); },
               .choices = namesOf<IntegratorKind>(), .example = "normal"});
    group.add({.name = "--accel", .argument = alternatives<AccelKind>(),
               .help = "how hits are searched; the picture is the same (bvh)",
               .set = [&o](const FlagValue& v) { o.accel = enumValue<AccelKind>(v); },
               .choices = namesOf<AccelKind>(), .example = "none"});
    group.add({.name = "--bvh", .help = "the same as --accel bvh and --accel none",
               .set = [&o](const FlagValue& v) {
                   o.accel = v.on ? AccelKind::Bvh : AccelKind::None;
               },
               .negatable = true});
    std::vector<std::string> kernels = kernelNames();
    kernels.insert(kernels.begin(), "auto");
    group.add({.name = "--kernel", .argument = join(kernels, "|"),
               .help = "machine code for the search; the picture is the same (auto)",
               .set = [&o, kernels](const FlagValue& v) { o.kernel = kernels[v.choice(kernels)]; },
               .choices = kernels, .example = "scalar"});
    group.add({.name = "--specialise",
               .help = "leave out what the scene does not need; the picture is the same (on)",
               .set = [&o](const FlagValue& v) { o.specialise = v.on; }, .negatable = true});
    group.add({.name = "--threads", .alias = "-t", .argument = "N",
               .help = "0: all that the machine has (0)",
               .set = [&o](const FlagValue& v) { o.threads = v.whole(0, kMostThreads); },
               .example = "2"});
}

void addOutputFlags(std::vector<Flag>& flags, Options& o) {
    FlagGroup group(flags, "output");
    group.add({.name = "--output", .alias = "-o", .argument = "FILE",
               .help = "the same as OUTPUT: .ppm, .png, .pfm or .exr; - is a PPM on stdout "
                       "(SCENE.png in the working folder)",
               .set = [&o](const FlagValue& v) { o.output = v.nonEmpty("the name of a file"); },
               .files = Flag::Files::Any, .example = "-"});
    group.add({.name = "--aov", .argument = "NAME,...",
               .help = alternatives<Aov>() + ": more pictures, beside OUTPUT as OUTPUT.NAME.pfm, or as "
                                         "layers of an .exr",
               .set = [&o](const FlagValue& v) { setAovs(o, v); },
               .choices = namesOf<Aov>(), .example = "depth,id"});
    const std::vector<std::string> formats = {"json"};
    group.add({.name = "--stats", .argument = join(formats, "|"),
               .help = "times and counters on stderr; with =json as JSON, alone on stdout",
               .set = [&o, formats](const FlagValue& v) {
                   o.stats = Options::StatsFormat::Table;
                   if (v.text.empty()) return;
                   v.choice(formats);
                   o.stats = Options::StatsFormat::Json;
               },
               .value = Flag::Value::Optional, .choices = formats, .example = "json"});
    group.add({.name = "--quiet", .alias = "-q",
               .help = "no progress, nothing but warnings and errors",
               .set = [&o](const FlagValue&) { o.quiet = true; }});
    group.add({.name = "--progress", .argument = alternatives<Options::Progress>(),
               .help = "auto: a bar on a terminal, else plain: a line per 10 %",
               .set = [&o](const FlagValue& v) { o.progress = enumValue<Options::Progress>(v); },
               .choices = namesOf<Options::Progress>(), .example = "plain"});
    group.add({.name = "--preview", .alias = "-p",
               .help = "also shows the picture in the terminal (stderr)",
               .set = [&o](const FlagValue&) { o.preview = true; }});
    group.add({.name = "--partial",
               .help = "a render that is interrupted (Ctrl-C) writes what is done, the rest black; "
                       "exit code 130 all the same",
               .set = [&o](const FlagValue&) { o.partial = true; }});
    group.add({.name = "--strict",
               .help = "a warning about the scene ends the program, exit code 3",
               .set = [&o](const FlagValue&) { o.strict = true; }});
}

void addActionFlags(std::vector<Flag>& flags, Options& o) {
    FlagGroup group(flags, kActionGroup);
    const auto add = [&](const char* name, const char* alias, Options::Action action, const char* help) {
        group.add({.name = name, .alias = alias, .help = help,
                   .set = [&o, action](const FlagValue& v) { setAction(o, action, v); }});
    };
    add("--check", "-c", Options::Action::Check, "reads and checks the scene and its textures");
    add("--info", "", Options::Action::Info, "tells what the scene contains");
    group.add({.name = "--convert", .argument = "FILE.txt",
               .help = "writes the scene in the native format, with the options given here; - is "
                       "stdout",
               .set = [&o](const FlagValue& v) { setConvert(o, v); },
               .files = Flag::Files::Any, .example = "-"});
    add("--list-features", "", Options::Action::ListFeatures, "lists what can be switched on and off");
    add("--help", "-h", Options::Action::Help, "this text");
    add("--version", "-v", Options::Action::Version, "the version");
    const std::vector<std::string> shells = {"bash", "zsh", "fish"};
    group.add({.name = "--completion", .argument = join(shells, "|"),
               .help = "prints a script that completes options in that shell",
               .set = [&o, shells](const FlagValue& v) {
                   o.shell = shells[v.choice(shells)];
                   setAction(o, Options::Action::Completion, v);
               },
               .choices = shells, .example = "bash"});
}

// clang-format on

} // namespace

std::vector<Flag> renderFlags(Options& options) {
    std::vector<Flag> flags;
    addPictureFlags(flags, options);
    addSceneFlags(flags, options);
    addFeatureFlags(flags, options);
    addQualityFlags(flags, options);
    addMethodFlags(flags, options);
    addOutputFlags(flags, options);
    addActionFlags(flags, options);
    return flags;
}
