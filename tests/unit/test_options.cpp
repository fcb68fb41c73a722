#include "accel/kernels/kernels.h"
#include "check.h"

#include "base/error.h"
#include "cli/command.h"
#include "cli/options.h"
#include "cli/output.h"
#include "cli/settings_from.h"

#include <algorithm>
#include <limits>
#include <set>

namespace test_options {

namespace {

Options parsed(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), "scene_#.txt");
    return parseOptions(arguments);
}

RenderSettings settings(const SceneDesc& desc, const std::vector<std::string>& arguments) {
    return settingsFrom(desc, parsed(arguments));
}

std::vector<std::string> withValue(const Flag& flag) {
    if (flag.value == Flag::Value::None) return {flag.name};
    return {flag.name + "=" + flag.example};
}

int exitCodeOf(const std::vector<std::string>& arguments) {
    try {
        parseOptions(arguments);
    } catch (const Error& error) {
        return static_cast<int>(error.kind());
    }
    return 0;
}

} // namespace

TEST(options_table_is_sound) {
    Options options;
    std::set<std::string> names;
    for (const Flag& flag : renderFlags(options)) {
        CHECK_INFO(flag.name.starts_with("--") && flag.name.size() > 2, flag.name);
        CHECK_INFO(flag.alias.empty() || (flag.alias.size() == 2 && flag.alias[0] == '-'),
                   flag.name);
        CHECK_INFO(!flag.help.empty() && !flag.group.empty() && flag.set, flag.name);
        CHECK_INFO(flag.argument.empty() == (flag.value == Flag::Value::None), flag.name);
        CHECK_INFO(flag.argument.empty() == flag.example.empty(), flag.name);
    }
    for (const std::string& name : flagNames(renderFlags(options)))
        CHECK_INFO(names.insert(name).second, name << " is there twice");
}

TEST(options_every_flag_takes_its_example) {
    Options unused;
    for (const Flag& flag : renderFlags(unused)) {
        const auto withEquals = withValue(flag);
        CHECK_INFO(check::thrown([&] { parsed(withEquals); }).empty(),
                   flag.name << ": " << check::thrown([&] { parsed(withEquals); }));
        if (flag.value == Flag::Value::Required) {
            CHECK_EQUAL(check::thrown([&] { parsed({flag.name, flag.example}); }), "");
            if (!flag.alias.empty()) {
                CHECK_EQUAL(check::thrown([&] { parsed({flag.alias, flag.example}); }), "");
                CHECK_EQUAL(check::thrown([&] { parsed({flag.alias + flag.example}); }), "");
                CHECK_EQUAL(check::thrown([&] { parsed({flag.alias + "=" + flag.example}); }), "");
            }
        }
        if (flag.negatable) CHECK_EQUAL(check::thrown([&] { parsed({flag.negatedName()}); }), "");
    }
}

TEST(options_every_flag_says_what_it_expects) {
    Options unused;
    for (const Flag& flag : renderFlags(unused)) {
        if (flag.value == Flag::Value::None) {
            CHECK_THROWS(parsed({flag.name + "=x"}), flag.name + " takes no value, got 'x'");
            continue;
        }
        if (flag.value == Flag::Value::Required) {
            CHECK_THROWS(parsed({flag.name}), flag.name + " expects ");
            CHECK_THROWS(parsed({flag.name}), "got nothing");
            CHECK_THROWS(parsed({flag.name + "="}), "got nothing");
            CHECK_THROWS(parsed({flag.name, "--quiet"}), flag.name + " expects ");
        }
        // Any text is the name of some camera or file.
        if (flag.name == "--camera" || flag.name == "--output") continue;
        CHECK_THROWS(parsed({flag.name + "=\x01?"}), flag.name + " expects ");
        CHECK_THROWS(parsed({flag.name + "=\x01?"}), "got '\x01?'");
    }
    CHECK_THROWS(parsed({"--spp", "x"}),
                 "--spp expects a whole number from 1 to 16777216, got 'x'");
    CHECK_THROWS(parsed({"-s", "0"}), "-s expects a whole number from 1 to 16777216, got '0'");
    CHECK_THROWS(parsed({"--spp", "99999999999999999999"}), "--spp expects a whole number");
    CHECK_THROWS(parsed({"--sampler", "soboll"}), "did you mean 'sobol'?");
    CHECK_THROWS(parsed({"--crop", "1,2,3"}), "--crop expects x0,y0,x1,y1");
    CHECK_THROWS(parsed({"--crop", "3,0,3,1"}), "--crop expects x0,y0,x1,y1");
    CHECK_THROWS(parsed({"--crop", "0,0,99999999999,1"}), "--crop expects x0,y0,x1,y1");
    CHECK_THROWS(parsed({"--resolution", "0x5"}), "--resolution expects WIDTHxHEIGHT");
    CHECK_THROWS(parsed({"--background", "1,nan,0"}), "--background expects r,g,b");
    CHECK_THROWS(parsed({"--filter", "tent,0"}), "--filter expects NAME or NAME,WIDTH");
    CHECK_THROWS(parsed({"--seed", "4294967296"}), "from 0 to 4294967295");
    CHECK_THROWS(parsed({"--no-shadows=1"}), "--no-shadows takes no value");
}

TEST(options_unknown_flag_is_answered_with_the_nearest) {
    CHECK_THROWS(parsed({"--spq"}), "unknown option '--spq'; did you mean '--spp'?");
    CHECK_THROWS(parsed({"--spq=4"}), "unknown option '--spq'; did you mean '--spp'?");
    CHECK_THROWS(parsed({"-spp", "4"}), "unknown option '-spp'; did you mean '--spp'?");
    CHECK_THROWS(parsed({"--no-shadow"}), "did you mean '--no-shadows'?");
    // What other renderers call it.
    const std::pair<const char*, const char*> others[] = {
        {"--samples", "unknown option '--samples'; here it is --spp N"},
        {"--samples=16", "unknown option '--samples'; here it is --spp N"},
        {"--width", "here it is --resolution WIDTHxHEIGHT"},
        {"--height", "here it is --resolution WIDTHxHEIGHT"},
        {"-W", "unknown option '-W'; here it is --resolution WIDTHxHEIGHT"},
        {"-H", "here it is --resolution WIDTHxHEIGHT"},
        {"-j4", "here it is --threads N"},
        {"--depth", "here it is --max-depth N"},
        {"--bounces", "here it is --max-depth N"},
        {"--gamma", "here it is --transfer srgb or linear"},
        {"--region", "here it is --crop x0,y0,x1,y1"},
        {"--quality", "here it is --spp N, or --error E"},
        {"--antialiasing", "here it is --spp N"},
        {"--no-antialiasing", "here it is --no-aa"},
        {"--input", "here it is SCENE as the first word"},
    };
    for (const auto& other : others) CHECK_THROWS(parsed({other.first}), other.second);
    CHECK_THROWS(parsed({"-Z"}), "unknown option '-Z'");
    CHECK_THROWS(parsed({"-qv"}), "unknown option '-qv'");
    CHECK_THROWS(parsed({"--no-spp"}), "unknown option '--no-spp'");
}

TEST(options_names) {
    CHECK_EQUAL(parseOptions(std::vector<std::string>{"a.txt"}).scene, "a.txt");
    CHECK_EQUAL(parseOptions(std::vector<std::string>{"a.txt", "b.png"}).output, "b.png");
    CHECK_EQUAL(parseOptions(std::vector<std::string>{"-", "-"}).scene, "-");
    CHECK_EQUAL(parseOptions(std::vector<std::string>{"-q", "--", "-q"}).scene, "-q");
    CHECK_EQUAL(parsed({"--exposure", "-2.5"}).exposureEv.value_or(0), -2.5);
    CHECK_EQUAL(parsed({"-o-"}).output, "-");
    CHECK_THROWS(parseOptions({}), "no scene; usage: raytracer SCENE");
    CHECK_THROWS(parsed({"b.png", "c.png"}), "too many names: 'c.png'");
    CHECK_THROWS(parsed({"b.png", "-o", "c.png"}), "two outputs: 'b.png' and --output 'c.png'");
    CHECK_THROWS(parsed({"b.jpg"}), "must end in .ppm, .png, .pfm or .exr");
    CHECK_THROWS(parsed({"b.pfm", "--bits", "8"}), "--bits is for");
    CHECK_THROWS(parsed({"-", "--stats=json"}), "cannot both go to stdout");
    CHECK_THROWS(parsed({"-", "--aov", "id"}), "--aov writes files");
    CHECK_THROWS(parsed({"b.png", "--check"}), "no picture is rendered");
    CHECK_THROWS(parsed({"--check", "--info"}), "cannot be combined");
    CHECK_EQUAL(exitCodeOf({}), 1);
    CHECK_EQUAL(exitCodeOf({"a", "--check"}), 0);
    CHECK_EQUAL(exitCodeOf({"--check", "--help"}), 0);
    CHECK_EQUAL(exitCodeOf({"--version"}), 0);
}

TEST(options_frame_replaces_the_last_run) {
    const auto named = [](const std::string& scene, const std::string& output, const char* frame) {
        return parseOptions(std::vector<std::string>{scene, output, "--frame", frame});
    };
    CHECK_EQUAL(named("a_####.txt", "b##.png", "7").scene, "a_0007.txt");
    CHECK_EQUAL(named("a_####.txt", "b##.png", "123").output, "b123.png");
    CHECK_EQUAL(named("#1/a#.txt", "b.png", "5").scene, "#1/a5.txt");
    CHECK_EQUAL(named("###.txt", "b.png", "5").scene, "005.txt");
    CHECK_EQUAL(named("a.txt", "b##.png", "5").output, "b05.png");
    CHECK_THROWS(named("a.txt", "b.png", "5"), "--frame needs a run of #");
    CHECK_EQUAL(parsed({"b#.png"}).output, "b#.png");
    CHECK_THROWS(parsed({"b##.png"}), "OUTPUT 'b##.png' has a run of #");
}

TEST(options_switches) {
    CHECK(parsed({}).switches == Switches{});
    CHECK(!parsed({"--no-dof"}).switches.dof);
    CHECK(parsed({"--no-dof", "--dof"}).switches.dof);
    CHECK(parsed({"--no-bvh"}).accel == AccelKind::None);
    CHECK(parsed({"--no-bvh", "--accel", "bvh"}).accel == AccelKind::Bvh);
    CHECK(!parsed({"--no-textures"}).switches.textures);
    CHECK_EQUAL(parsed({"--textures", "/"}).textureFolder, "/");
    CHECK_EQUAL(parsed({"--textures=/"}).textureFolder, "/");
    CHECK_THROWS(parsed({"--textures=/does/not/exist"}), "--textures expects a folder");
    CHECK_EQUAL(parsed({"--textures"}).textureFolder, "");
    const Options aovs = parsed({"--aov", "depth,id,depth"});
    CHECK((aovs.aovs == std::vector<Aov>{Aov::Depth, Aov::Id}));
}

TEST(settings_command_line_wins_over_scene) {
    SceneDesc desc;
    desc.settings.samplesPerPixel = 3;
    desc.settings.maxDepth = 5;
    desc.settings.filter = SettingsDesc::Filter::Gaussian;
    desc.settings.filterWidth = 3;
    CHECK(settings(desc, {}).picture == desc.settings);
    const SettingsDesc p =
        settings(desc, {"--spp=7", "--sampler=grid", "--no-jitter", "--exposure=2"}).picture;
    CHECK_EQUAL(p.samplesPerPixel, 7);
    CHECK_EQUAL(p.maxDepth, 5);
    CHECK(p.sampler == SettingsDesc::Sampler::Grid && !p.jitter);
    CHECK_EQUAL(p.exposureEv, 2);
    CHECK_EQUAL(p.filterWidth, 3);
    CHECK_EQUAL(settings(desc, {"--filter=box"}).picture.filterWidth, 1);
    CHECK_EQUAL(settings(desc, {"--filter=tent,4"}).picture.filterWidth, 4);
    CHECK_EQUAL(settings(desc, {"--no-aa"}).picture.samplesPerPixel, 1);
    CHECK_EQUAL(settings(desc, {"--no-aa", "--spp=4"}).picture.samplesPerPixel, 4);
    CHECK_EQUAL(settings(desc, {"--no-aa"}).picture.filterWidth, 0);
    CHECK_EQUAL(settings(desc, {"--threads=3"}).threads, 3);
    CHECK(settings(desc, {"--threads=0"}).threads >= 1);
    CHECK(settings(desc, {}).isa == &bestIsa());
    desc.cameras.resize(2);
    desc.cameras[0].name = "front", desc.cameras[1].name = "top";
    CHECK_EQUAL(settings(desc, {"--camera=top"}).camera, "top");
    CHECK_THROWS(settings(desc, {"--camera=tip"}), "unknown camera 'tip'; did you mean 'top'?");
    const SceneDesc seenFromTop = withSettings(desc, settings(desc, {"--camera=top"}));
    CHECK_EQUAL(seenFromTop.cameras[0].name, "top");
}

TEST(settings_of_light_transport) {
    SceneDesc desc;
    desc.settings.integrator = IntegratorKind::Depth;
    desc.settings.glossyDepth = 7;
    desc.settings.caustics = false;
    CHECK(settings(desc, {}).picture == desc.settings);
    const SettingsDesc p =
        settings(desc, {"--integrator=whitted", "--diffuse-depth=1", "--transmission-depth=0",
                        "--transparent-depth=1024", "--clamp-indirect=2.5", "--filter-glossy=0.5",
                        "--caustics"})
            .picture;
    CHECK(p.integrator == IntegratorKind::Whitted && p.caustics);
    CHECK_EQUAL(p.diffuseDepth, 1);
    CHECK_EQUAL(p.glossyDepth, 7);
    CHECK_EQUAL(p.transmissionDepth, 0);
    CHECK_EQUAL(p.transparentDepth, 1024);
    CHECK_EQUAL(p.clampIndirect, 2.5);
    CHECK_EQUAL(p.filterGlossy, 0.5);
    CHECK(settings(desc, {"--texture-filter=none"}).picture.textureFilter ==
          SettingsDesc::TextureFilter::None);
    CHECK_EQUAL(settings(desc, {"--glossy-depth=3"}).picture.glossyDepth, 3);
    CHECK(!settings({}, {"--no-caustics"}).picture.caustics);
    CHECK_THROWS(parsed({"--diffuse-depth=1025"}), "expects a whole number from 0 to 1024");
    CHECK_THROWS(parsed({"--clamp-indirect=-1"}), "expects a number from 0 to");
    // What --convert writes has them.
    CHECK(withSettings(desc, settings(desc, {"--integrator=uv"})).settings.integrator ==
          IntegratorKind::Uv);
}

TEST(settings_picture_size) {
    SceneDesc desc;
    desc.settings.width = 101, desc.settings.height = 50;
    const SettingsDesc half = settings(desc, {"--scale=50"}).picture;
    CHECK_EQUAL(half.width, 50);
    CHECK_EQUAL(half.height, 25);
    CHECK_EQUAL(settings(desc, {"--scale=1"}).picture.height, 1);
    CHECK_EQUAL(settings(desc, {"--resolution=64x32", "--scale=200"}).picture.width, 128);
    CHECK_THROWS(settings(desc, {"--resolution=65535x1", "--scale=200"}), "at most 65535");
    CHECK_THROWS(settings(desc, {"--crop=0,0,102,50"}), "but the picture has 101x50 pixels");
    CHECK((settings(desc, {"--crop=0,0,101,50"}).picture.crop == std::array{0, 0, 101, 50}));
    // The scene's crop goes along with the resolution.
    desc.settings.width = 100;
    desc.settings.crop = {10, 10, 55, 50};
    CHECK((settings(desc, {"--scale=50"}).picture.crop == std::array{5, 5, 28, 25}));
    CHECK((settings(desc, {"--crop=1,2,3,4"}).picture.crop == std::array{1, 2, 3, 4}));
}

TEST(help_and_completion_have_every_flag) {
    Options options;
    const auto has = [](const std::string& text, const std::string& part) {
        return text.find(part) != std::string::npos;
    };
    const auto isListed = [&](const Flag& flag, const std::string& text) {
        return has(text, flag.negatable ? "--[no-]" + flag.name.substr(2) : flag.name) &&
               (flag.alias.empty() || has(text, flag.alias + ", "));
    };
    for (const Flag& flag : renderFlags(options)) CHECK_INFO(isListed(flag, helpText()), flag.name);
    for (const Command& command : commands()) {
        CHECK_INFO(has(helpText(), cat("raytracer ", command.name, " ")), command.name);
        for (const Flag& flag : command.flags())
            CHECK_INFO(isListed(flag, commandHelpText(command)), command.name << flag.name);
    }
    for (const std::string shell : {"bash", "zsh", "fish"}) {
        const std::string script = completionScript(shell);
        const auto isCompleted = [&](const Flag& flag) {
            const std::string name = shell == "fish" ? "-l " + flag.name.substr(2) : flag.name;
            const std::string off =
                shell == "fish" ? "-l no-" + flag.name.substr(2) : flag.negatedName();
            bool all = has(script, name) && (!flag.negatable || has(script, off));
            if (flag.value == Flag::Value::Required && !flag.choices.empty())
                all = all && has(script, join(flag.choices, " "));
            return all;
        };
        for (const Flag& flag : renderFlags(options))
            CHECK_INFO(isCompleted(flag), flag.name << shell);
        for (const Command& command : commands()) {
            CHECK_INFO(has(script, std::string(command.name)), command.name << shell);
            for (const Flag& flag : command.flags())
                CHECK_INFO(isCompleted(flag), command.name << flag.name << shell);
            for (const std::string& word : command.words())
                CHECK_INFO(has(script, word), command.name << word << shell);
        }
    }
    std::vector<std::string> texts = {helpText()};
    for (const Command& command : commands()) texts.push_back(commandHelpText(command));
    for (const std::string& text : texts) {
        std::size_t line = 0;
        for (const char c : text) {
            line = c == '\n' ? 0 : line + 1;
            CHECK(line <= 100);
        }
    }
    CHECK(has(featureListText(), "motion-blur"));
}

TEST(output_names_and_exposure) {
    CHECK_EQUAL(defaultOutput("a/room.v2.txt"), "room.v2.png");
    CHECK_EQUAL(defaultOutput("-"), "stdin.png");
    CHECK_EQUAL(aovFileName("a.b/out.png", Aov::Depth), "a.b/out.depth.pfm");
    Image image(2, 1);
    image.setPixel(0, 0, {0.5f, 3e38f, -3e38f});
    expose(image, 1);
    CHECK((image.pixel(0, 0) ==
           Rgb{1, std::numeric_limits<float>::max(), -std::numeric_limits<float>::max()}));
    SettingsDesc picture;
    picture.width = 4, picture.height = 3, picture.crop = {1, 1, 3, 2};
    const Image full = padded(image, picture);
    CHECK_EQUAL(full.width(), 4);
    CHECK((full.pixel(1, 1) == image.pixel(0, 0)) && isBlack(full.pixel(0, 0)));
}

TEST(diff_options) {
    const auto parse = [](std::vector<std::string> arguments) {
        return parseDiffOptions(arguments);
    };
    CHECK(parse({"a", "b"}).metrics == std::vector<std::string>{"rmse"});
    CHECK_EQUAL(parse({"a", "b", "--metric", "psnr,ssim"}).metrics.size(), 2u);
    CHECK_EQUAL(parse({"a", "b", "--tol=0.1"}).tolerance.value_or(0), 0.1);
    CHECK_THROWS(parse({"a"}), "diff expects two pictures, got 1");
    CHECK_THROWS(parse({"a", "b", "--metric", "psmr"}), "did you mean 'psnr'?");
    CHECK_THROWS(parse({"a", "b", "-m", "psnr,ssim", "--tol=1"}), "--tol is for one metric");
    CHECK_THROWS(parse({"a", "b", "-o", "d.jpg"}), ".ppm, .png or .pfm");
}

} // namespace test_options
