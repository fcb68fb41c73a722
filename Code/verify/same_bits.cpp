// T10, T11, T17: the picture and its AOVs depend on the scene, the settings and the seed only
// (promise P1). A scene is rendered in two ways that must not matter; hashes of all bits are
// compared.
#include "accel/kernels/kernels.h"
#include "base/text.h"
#include "render/scene.h"
#include "verify/groups.h"
#include "verify/scene_trials.h"
#include "verify/scenes.h"

#include <algorithm>
#include <array>

namespace battery {

namespace {

using meshes::Random;

// With all that a scene can be asked for.
std::uint64_t hashWith(const SceneDesc& desc, const scenes::Tweak& tweak = {}) {
    return scenes::hashOf(scenes::render(desc, [&](RenderSettings& s) {
        s.aovs = {Aov::Depth, Aov::Normal, Aov::Albedo, Aov::Position, Aov::Id, Aov::Samples};
        if (tweak) tweak(s);
    }));
}

using Check = std::function<void(const char* name, const SceneDesc&, Random&, Tally&)>;
Tally forScenes(const Effort& effort, std::uint64_t seed, const Check& check) {
    return inBatches(effort, seed, 1, [&](Random& random, Tally& tally) {
        for (const scenes::Maker& maker : scenes::makers())
            check(maker.name, maker.make(random), random, tally);
    });
}

std::vector<const char*> kernelsHere() {
    std::vector<const char*> names;
    for (const Kernel& kernel : allKernels())
        if (kernel.supported()) names.push_back(kernel.name);
    return names;
}

// ---- T10

Tally accelerators(const Effort& effort) {
    return forScenes(effort, 10, [](auto* name, auto& desc, Random&, Tally& tally) {
        const auto linear = [](RenderSettings& s) { s.accel = AccelKind::None; };
        const std::uint64_t hash = hashWith(desc, linear);
        for (const char* kernel : kernelsHere()) {
            ++tally.cases;
            if (hashWith(desc, [&](RenderSettings& s) { s.kernel = kernel; }) != hash)
                tally.fail([&] { return cat(name, ": trees with kernel ", kernel); });
        }
    });
}

// ---- T11

Tally cuts(const Effort& effort) {
    return forScenes(effort, 11, [](auto* name, auto& desc, Random& random, Tally& tally) {
        const std::uint64_t hash = hashWith(desc);
        const auto pick = [&](const auto& list) { return list[random.below(list.size())]; };
        for (const int threads : {1, 2, 3, 8}) {
            const int tile = pick(std::array{1, 7, 16, 64}); // 64: the whole picture
            const int chunk = pick(std::array{64, 100, 1024, 4096, 65536});
            const char* kernel = pick(kernelsHere());
            ++tally.cases;
            const std::uint64_t other = hashWith(desc, [&](RenderSettings& s) {
                s.threads = threads;
                s.tileSide = tile;
                s.chunkSamples = chunk;
                s.kernel = kernel;
            });
            if (other != hash)
                tally.fail([&] {
                    return cat(name, ": ", threads, " threads, tiles of ", tile, ", chunks of ",
                               chunk, ", kernel ", kernel);
                });
        }
    });
}

Tally runs(const Effort& effort) {
    return forScenes(effort, 111, [](auto* name, auto& desc, Random&, Tally& tally) {
        const auto onThreads = [](RenderSettings& s) { s.threads = 3; };
        const std::uint64_t hash = hashWith(desc, onThreads);
        for (int i = 1; i < 3; ++i) {
            ++tally.cases;
            if (hashWith(desc, onThreads) != hash)
                tally.fail([&] { return cat(name, ": run ", i, " is unlike the first"); });
        }
    });
}

// Instances as instances, as copies, and some as these and some as those.
Tally copies(const Effort& effort) {
    return forScenes(effort, 112, [](auto* name, auto& desc, Random& random, Tally& tally) {
        const auto upTo = [](std::uint64_t triangles) {
            return [triangles](RenderSettings& s) { s.copiedTriangles = triangles; };
        };
        const std::uint64_t hash = hashWith(desc, upTo(0));
        for (const std::uint64_t triangles :
             {std::uint64_t{random.below(3000)}, ~std::uint64_t{}}) {
            ++tally.cases;
            if (hashWith(desc, upTo(triangles)) != hash)
                tally.fail(
                    [&] { return cat(name, ": copies of up to ", triangles, " triangles"); });
        }
    });
}

// ---- T17

struct NamedSwitch {
    const char* feature; // as features.h calls it
    bool Switches::*member;
};
constexpr std::array kSwitches = {
    NamedSwitch{"shadows", &Switches::shadows},
    NamedSwitch{"soft-shadows", &Switches::softShadows},
    NamedSwitch{"reflection", &Switches::reflection},
    NamedSwitch{"refraction", &Switches::refraction},
    NamedSwitch{"glossy", &Switches::glossy},
    NamedSwitch{"textures", &Switches::textures},
    NamedSwitch{"dof", &Switches::dof},
    NamedSwitch{"motion-blur", &Switches::motionBlur},
    NamedSwitch{"fresnel", &Switches::fresnel},
};

// What --stats calls skipped may be switched off without a trace.
Tally unusedFeatures(const Effort& effort) {
    return forScenes(effort, 17, [](auto* name, auto& desc, Random&, Tally& tally) {
        RenderSettings settings;
        settings.picture = desc.settings;
        const Scene scene(desc, {"scene", ""}, settings);
        const std::uint64_t hash = hashWith(desc);
        for (const NamedSwitch& off : kSwitches) {
            const bool isNeeded = std::any_of(
                scene.features().begin(), scene.features().end(), [&](const Feature& f) {
                    return f.needed && std::string_view(f.name) == off.feature;
                });
            if (isNeeded) continue;
            ++tally.cases;
            if (hashWith(desc, [&](RenderSettings& s) { s.switches.*off.member = false; }) != hash)
                tally.fail([&] { return cat(name, " without ", off.feature); });
        }
    });
}

constexpr Row kRows[] = {
    {"T10", "pictures without trees, with, any kernel: the same bits", "", 0, true, accelerators},
    {"T11a", "1, 2, 3, 8 threads, tiles, chunks: the same bits", "", 0, true, cuts},
    {"T11b", "a picture again, on three threads: the same bits", "", 0, true, runs},
    {"T11c", "instances kept, or copied into one mesh: the same bits", "", 0, true, copies},
    {"T17", "unused features switched off: the same bits", "", 0, true, unusedFeatures},
};

} // namespace

std::span<const Row> sameBitsRows() { return kRows; }

} // namespace battery
