#include "verify/battery.h"

#include "base/parallel.h"
#include "base/text.h"
#include "sample/hash.h"
#include "verify/groups.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace battery {

std::vector<Row> rows() {
    std::vector<Row> all;
    for (const auto& group : kGroups)
        for (const Row& row : group()) all.push_back(row);
    return all;
}

Tally& Tally::operator+=(const Tally& other) {
    cases += other.cases;
    if (failures == 0) failedCase = other.failedCase;
    failures += other.failures;
    if (!(other.worst <= worst)) {
        worst = other.worst;
        worstCase = other.worstCase;
    }
    return *this;
}

Tally inBatches(const Effort& effort, std::uint64_t seed, double batches,
                const std::function<void(meshes::Random&, Tally&)>& batch) {
    const auto count = static_cast<std::size_t>(std::max(1.0, std::ceil(batches * effort.factor)));
    std::vector<Tally> tallies(count);
    ThreadPool pool(effort.threads);
    pool.run(count, [&](std::size_t i, int) {
        meshes::Random random(hash(low32(seed), high32(seed), static_cast<std::uint32_t>(i)));
        Tally& tally = tallies[i];
        batch(random, tally);
        for (std::string* text : {&tally.failedCase, &tally.worstCase})
            if (!text->empty()) *text = cat("seed ", seed, " batch ", i, ": ", *text);
    });
    Tally sum;
    for (const Tally& tally : tallies) sum += tally;
    return sum;
}

} // namespace battery
