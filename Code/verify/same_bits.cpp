// T10, T11, T17: the picture and its AOVs depend on the scene, the settings and the seed only
// (promise P1). A scene is rendered in two ways that must not matter; hashes of all bits are
// compared.
#include "accel/kernels/kernels.h"
#include "base/text.h"
#include "desc/enum_tables.h"
#include "scene/scene.h"
#include "verify/anything.h"
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

// The numbers of each sampler are of another kind: Sobol's are multiples of 2^-24, others are not.
void sampleAnyhow(Random& random, SettingsDesc& settings) {
    settings.sampler = static_cast<SettingsDesc::Sampler>(
        random.below(kNamesByValue<SettingsDesc::Sampler>.size()));
    settings.jitter = random.chance(0.7);
    settings.filter =
        static_cast<SettingsDesc::Filter>(random.below(kNamesByValue<SettingsDesc::Filter>.size()));
}

using Check = FunctionRef<void(const char* name, SceneDesc&, Random&, Tally&)>;
Tally forScenes(const Effort& effort, std::uint64_t seed, Check check, double batches = 1) {
    return inBatches(effort, seed, batches, [&](Random& random, Tally& tally) {
        for (const scenes::Maker& maker : scenes::makers()) {
            SceneDesc desc = maker.make(random);
            if (random.chance(0.5)) sampleAnyhow(random, desc.settings);
            check(maker.name, desc, random, tally);
        }
        for (int i = 0; i < scenes::kAnythings; ++i) {
            SceneDesc desc = scenes::anything(random);
            sampleAnyhow(random, desc.settings);
            check("anything", desc, random, tally);
        }
    });
}

std::vector<const Isa*> isasHere() {
    std::vector<const Isa*> here;
    for (const Isa& isa : allIsas())
        if (isa.supported()) here.push_back(&isa);
    return here;
}

// ---- T10

Tally accelerators(const Effort& effort) {
    return forScenes(effort, 10, [](auto* name, auto& desc, Random&, Tally& tally) {
        const auto linear = [](RenderSettings& s) { s.accel = AccelKind::None; };
        const std::uint64_t hash = hashWith(desc, linear);
        for (const Isa* isa : isasHere()) {
            ++tally.cases;
            if (hashWith(desc, [&](RenderSettings& s) { s.isa = isa; }) != hash)
                tally.fail([&] { return cat(name, ": trees with kernel ", isa->name); });
        }
    });
}

// ---- T11

// Every number of threads, side of tiles and size of queues once, in other company each time.
Tally cuts(const Effort& effort) {
    return forScenes(effort, 11, [](auto* name, auto& desc, Random& random, Tally& tally) {
        constexpr std::array kThreads = {1, 2, 3, 8, 64};
        constexpr std::array kTiles = {1, 7, 16, 64, 1 << 15}; // the pictures have 32 x 24 pixels
        constexpr std::array kChunks = {64, 100, 1024, 4096, 65536};
        const std::uint64_t hash = hashWith(desc);
        const std::size_t tileShift = random.below(5), chunkShift = random.below(5);
        const std::vector<const Isa*> isas = isasHere();
        for (std::size_t i = 0; i < kThreads.size(); ++i) {
            const int threads = kThreads[i], tile = kTiles[(i + tileShift) % kTiles.size()];
            const int chunk = kChunks[(i + chunkShift) % kChunks.size()];
            const Isa* isa = isas[random.below(isas.size())];
            ++tally.cases;
            const std::uint64_t other = hashWith(desc, [&](RenderSettings& s) {
                s.threads = threads;
                s.tileSide = tile;
                s.chunkSamples = chunk;
                s.isa = isa;
            });
            if (other != hash)
                tally.fail([&] {
                    return cat(name, ": ", threads, " threads, tiles of ", tile, ", chunks of ",
                               chunk, ", kernel ", isa->name);
                });
        }
    });
}

// A quarter of the pixels and a tenth of the batches: what differs from run to run does so
// anywhere.
Tally runs(const Effort& effort) {
    const auto again = [](auto* name, auto& desc, Random&, Tally& tally) {
        desc.settings.width /= 2, desc.settings.height /= 2;
        const auto onThreads = [](RenderSettings& s) { s.threads = 3; };
        const std::uint64_t hash = hashWith(desc, onThreads);
        for (int i = 1; i < 20; ++i) {
            ++tally.cases;
            if (hashWith(desc, onThreads) != hash)
                tally.fail([&] { return cat(name, ": run ", i, " is unlike the first"); });
        }
    };
    return forScenes(effort, 111, again, 0.1);
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

// What is left out for a scene may be done all the same.
Tally generalForm(const Effort& effort) {
    return forScenes(effort, 171, [](auto* name, auto& desc, Random& random, Tally& tally) {
        const Isa* isa = isasHere()[random.below(isasHere().size())];
        const auto hash = [&](bool specialise) {
            return hashWith(desc, [&](RenderSettings& s) {
                s.isa = isa;
                s.specialise = specialise;
            });
        };
        ++tally.cases;
        if (hash(true) != hash(false))
            tally.fail([&] { return cat(name, " with kernel ", isa->name); });
    });
}

constexpr Row kSameBitsRows[] = {
    {"T10a", "pictures without trees, with, any kernel: the same bits", "", 0, true, accelerators},
    {"T11a", "1, 2, 3, 8, 64 threads, tiles, queues: the same bits", "", 0, true, cuts},
    {"T11b", "a picture 20 times on three threads: the same bits", "", 0, true, runs},
    {"T11c", "instances kept, or copied into one mesh: the same bits", "", 0, true, copies},
    {"T17a", "unused features switched off: the same bits", "", 0, true, unusedFeatures},
    {"T17b", "every step for every scene: the same bits", "", 0, true, generalForm},
};

} // namespace

std::span<const Row> sameBitsRows() { return kSameBitsRows; }

} // namespace battery
