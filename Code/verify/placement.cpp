// T7 to T9: the size and the place of a scene do not matter (promise P3). A scene is rendered
// beside its copy of another size or at another place; the truth is that nothing changes.
#include "base/math.h"
#include "base/text.h"
#include "desc/validate.h"
#include "image/compare.h"
#include "scene/frame.h"
#include "verify/anything.h"
#include "verify/groups.h"
#include "verify/scene_trials.h"
#include "verify/scenes.h"

#include <algorithm>
#include <mutex>

namespace battery {

namespace {

using meshes::Random;

// Calls `compare` for scenes of every kind, and for so many of anything.
using Compare = FunctionRef<void(const char* name, const SceneDesc&, Random&, Tally&)>;
Tally forScenes(const Effort& effort, std::uint64_t seed, double batches, Compare compare,
                int anythings = 0) {
    return inBatches(effort, seed, batches, [&](Random& random, Tally& tally) {
        for (const scenes::Maker& maker : scenes::makers())
            compare(maker.name, maker.make(random), random, tally);
        for (int i = 0; i < anythings; ++i)
            compare("anything", scenes::anything(random), random, tally);
    });
}

// Two powers between 1 and `most`, of both signs.
std::array<int, 2> powers(Random& random, std::uint32_t most) {
    const int k = 1 + static_cast<int>(random.below(most));
    return {k, -k};
}

// ---- T7

Tally powersOfTwo(const Effort& effort) {
    const auto withNumbers = [](RenderSettings& s) {
        s.aovs = {Aov::Id, Aov::Normal, Aov::Albedo};
    };
    const auto compare = [&](const char* name, const SceneDesc& desc, Random& random,
                             Tally& tally) {
        const std::uint64_t hash = scenes::hashOf(scenes::render(desc, withNumbers));
        for (const int k : powers(random, 20)) {
            ++tally.cases;
            const SceneDesc other = scenes::scaled(desc, std::ldexp(1.0, k));
            if (scenes::hashOf(scenes::render(other, withNumbers)) != hash)
                tally.fail([&] { return cat(name, " times 2^", k); });
        }
    };
    return forScenes(effort, 7, 1, compare, scenes::kAnythings);
}

// ---- T8 and T9: differences of pictures, in parts of the brightest value

// Collects the differences of pictures of one size. One sample on the other side of an edge is 0.2
// of one of 768 pixels, 7e-3 of so small a picture: the mark is for all pictures as if they were
// one large one.
class Differences {
public:
    void add(const Image& one, const Image& other, Tally& tally, const std::string& what) {
        const double difference = rmse(one, other) / scenes::largest(one);
        ++tally.cases;
        tally.measure(difference, [&] { return cat(what, ": ", difference); });
        const std::lock_guard lock(mutex_);
        squares_.push_back(sqr(difference));
    }
    // The root of the mean square; the case of the worst picture is kept.
    Tally summed(Tally tally) {
        std::sort(squares_.begin(), squares_.end()); // one order for any number of threads
        double sum = 0;
        for (const double square : squares_) sum += square;
        tally.worst = std::sqrt(sum / static_cast<double>(squares_.size()));
        return tally;
    }

private:
    std::mutex mutex_;
    std::vector<double> squares_;
};

Tally powersOfTen(const Effort& effort) {
    Differences differences;
    return differences.summed(
        forScenes(effort, 8, 1, [&](auto* name, auto& desc, Random& random, Tally& tally) {
            const Image one = scenes::render(desc).color;
            for (const int k : powers(random, 6)) {
                const SceneDesc other = scenes::scaled(desc, exact::pow(10.0, k));
                differences.add(one, scenes::render(other).color, tally,
                                cat(name, " times 10^", k));
            }
        }));
}

// Which object is seen in the middle of each pixel.
Image objectsIn(const SceneDesc& desc) {
    return scenes::render(desc,
                          [](RenderSettings& s) {
                              s.picture.integrator = IntegratorKind::Id;
                              s.aovs = {Aov::Id};
                              s.picture.width = 160;
                              s.picture.height = 120;
                              s.picture.samplesPerPixel = 1;
                          })
        .aovs[0]
        .image;
}

Tally objectsAtPowersOfTen(const Effort& effort) {
    Tally sum = forScenes(effort, 80, 1, [](auto* name, auto& desc, Random& random, Tally& tally) {
        const Image one = objectsIn(desc);
        for (const int k : powers(random, 6)) {
            const Image other = objectsIn(scenes::scaled(desc, exact::pow(10.0, k)));
            for (std::size_t i = 0; i < one.pixels().size(); ++i) {
                ++tally.cases;
                if (one.pixels()[i] != other.pixels()[i])
                    tally.fail([&] { return cat(name, " times 10^", k, ", pixel ", i); });
            }
        }
    });
    // Some may differ: failures become a measure.
    sum.worst = static_cast<double>(sum.failures) / static_cast<double>(sum.cases);
    sum.failures = 0;
    std::swap(sum.worstCase, sum.failedCase);
    return sum;
}

SceneDesc movedBy(const SceneDesc& desc, int power, Random& random) {
    const double extent = 2 / frameAround(boundsOf(desc)).scale; // 1 to 2 of the scene's
    return scenes::moved(desc, random.direction() * (extent * exact::pow(10.0, power)));
}

bool warnsOfDistance(const SceneDesc& desc) {
    Diagnostics diagnostics;
    validate(desc, {"scene", ""}, diagnostics);
    return std::any_of(
        diagnostics.warnings.begin(), diagnostics.warnings.end(),
        [](const std::string& w) { return w.find("times its size") != std::string::npos; });
}

Tally movedScenes(const Effort& effort, int leastPower, int mostPower, bool mustWarn) {
    Differences differences;
    const auto compare = [&](auto* name, auto& desc, Random& random, Tally& tally) {
        const Image one = scenes::render(desc).color;
        for (int k = leastPower; k <= mostPower; ++k) {
            const SceneDesc other = movedBy(desc, k, random);
            const std::string what = cat(name, " by 10^", k, " extents");
            differences.add(one, scenes::render(other).color, tally, what);
            if (warnsOfDistance(other) != mustWarn)
                tally.fail([&] { return cat(what, mustWarn ? ": no warning" : ": a warning"); });
        }
    };
    return differences.summed(
        forScenes(effort, 9 + static_cast<std::uint64_t>(mostPower), 1, compare));
}
Tally movedInReach(const Effort& effort) { return movedScenes(effort, 3, 6, false); }
Tally movedTooFar(const Effort& effort) { return movedScenes(effort, 9, 9, true); }

constexpr Row kPlacementRows[] = {
    {"T7", "scenes times 2^-20 to 2^20: the same bits", "", 0, true, powersOfTwo},
    {"T8a", "scenes times 10^-6 to 10^6: RMSE", "of the peak", 1e-4, true, powersOfTen},
    {"T8b", "scenes times 10^-6 to 10^6: other objects", "of the pixels", 1e-6, true,
     objectsAtPowersOfTen},
    {"T9a", "scenes moved by 10^3 to 10^6 extents: RMSE", "of the peak", 1e-4, true, movedInReach},
    {"T9b", "scenes moved by 10^9 extents: RMSE, a warning", "of the peak", 1e-2, true,
     movedTooFar},
};

} // namespace

std::span<const Row> placementRows() { return kPlacementRows; }

} // namespace battery
