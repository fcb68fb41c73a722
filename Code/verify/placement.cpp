// T7 to T9: the size and the place of a scene do not matter (promise P3). A scene and its copy of
// another size or at another place are rendered and compared; neither is more right than the other.
#include "base/math.h"
#include "base/text.h"
#include "desc/validate.h"
#include "image/compare.h"
#include "render/frame.h"
#include "verify/groups.h"
#include "verify/scenes.h"

#include <array>

namespace battery {

namespace {

using meshes::Random;

// What is the same at every size and place, beside the colours.
void withNumbers(RenderSettings& settings) {
    settings.aovs = {Aov::Id, Aov::Normal, Aov::Albedo};
}

// Calls `compare` for a scene of every kind, `batches` times at effort 1.
using Compare = std::function<void(const char* name, const SceneDesc&, Random&, Tally&)>;
Tally forScenes(const Effort& effort, std::uint64_t seed, double batches, const Compare& compare) {
    return inBatches(effort, seed, batches, [&](Random& random, Tally& tally) {
        for (const scenes::Maker& maker : scenes::makers())
            compare(maker.name, maker.make(random), random, tally);
    });
}

Tally powersOfTwo(const Effort& effort) {
    return forScenes(effort, 7, 2, [](auto* name, auto& desc, Random& random, Tally& tally) {
        const std::uint64_t hash = scenes::hashOf(scenes::render(desc, withNumbers));
        const int size = 1 + static_cast<int>(random.below(20));
        for (const int k : {size, -size}) {
            const SceneDesc other = scenes::scaled(desc, std::ldexp(1.0, k));
            ++tally.cases;
            if (scenes::hashOf(scenes::render(other, withNumbers)) != hash)
                tally.fail([&] { return cat(name, " times 2^", k); });
        }
    });
}

Tally powersOfTen(const Effort& effort) {
    return forScenes(effort, 8, 2, [](auto* name, auto& desc, Random& random, Tally& tally) {
        const Picture one = scenes::render(desc, withNumbers);
        const int size = 1 + static_cast<int>(random.below(6));
        for (const int k : {size, -size}) {
            const SceneDesc other = scenes::scaled(desc, exact::pow(10.0, k));
            const Picture two = scenes::render(other, withNumbers);
            ++tally.cases;
            tally.measure(rmse(one.color, two.color) / scenes::largest(one.color),
                          [&] { return cat(name, " times 10^", k); });
            int ids=0; for (size_t i=0;i<one.aovs[0].image.pixels().size();++i) ids+= one.aovs[0].image.pixels()[i]!=two.aovs[0].image.pixels()[i];
            fprintf(stderr,"%s %d rmse %g ids %d\n",name,k,rmse(one.color, two.color) / scenes::largest(one.color),ids);
        }
    });
}

Vec3d away(const SceneDesc& desc, int k, Random& random) {
    const double extent = 2 / frameOf(desc).scale; // at least that of the scene
    return random.direction() * (extent * exact::pow(10.0, k));
}

Tally movedFar(const Effort& effort) {
    return forScenes(effort, 9, 2, [](auto* name, auto& desc, Random& random, Tally& tally) {
        const Picture one = scenes::render(desc, withNumbers);
        for (const int k : {3, 6,9}) {
            const SceneDesc other = scenes::moved(desc, away(desc, k, random));
            const Picture two = scenes::render(other, withNumbers);
            ++tally.cases;
            tally.measure(rmse(one.color, two.color) / scenes::largest(one.color),
                          [&] { return cat(name, " by 10^", k); });
            int ids=0; for (size_t i=0;i<one.aovs[0].image.pixels().size();++i) ids+= one.aovs[0].image.pixels()[i]!=two.aovs[0].image.pixels()[i];
            fprintf(stderr,"%s moved %d rmse %g ids %d\n",name,k,rmse(one.color, two.color) / scenes::largest(one.color),ids);
        }
    });
}

constexpr Row kRows[] = {
    {"T7", "scenes times 2^-20 to 2^20, the same bits", "", 0, true, powersOfTwo},
    {"T8a", "scenes times 10^-6 to 10^6", "of the peak, RMSE", 1e-4, true, powersOfTen},
    {"T9", "scenes times 10^-6 to 10^6", "of the peak, RMSE", 1e-4, true, movedFar},
};

} // namespace

std::span<const Row> placementRows() { return kRows; }

} // namespace battery
