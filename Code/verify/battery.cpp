#include "verify/battery.h"

#include "base/parallel.h"
#include "base/text.h"
#include "sample/hash.h"
#include "verify/groups.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>
#include <utility>
#include <vector>

namespace battery {

namespace {

// "T19b": 19, then the letter.
std::pair<int, std::string_view> orderOf(const Row& row) {
    const std::string_view id = row.id;
    std::size_t letter = 1;
    int number = 0;
    for (; letter < id.size() && id[letter] >= '0' && id[letter] <= '9'; ++letter)
        number = number * 10 + (id[letter] - '0');
    return {number, id.substr(letter)};
}

} // namespace

std::vector<Row> rows() {
    std::vector<Row> all;
    for (const auto& group : kGroups)
        for (const Row& row : group()) all.push_back(row);
    std::stable_sort(all.begin(), all.end(),
                     [](const Row& a, const Row& b) { return orderOf(a) < orderOf(b); });
    return all;
}

Tally& Tally::operator+=(const Tally& other) {
    cases += other.cases;
    if (failures == 0) failedCase = other.failedCase;
    failures += other.failures;
    if (isWorse(other.worst)) {
        worst = other.worst;
        worstCase = other.worstCase;
    }
    return *this;
}

Tally inBatches(const Effort& effort, std::uint64_t seed, double batches,
                FunctionRef<void(meshes::Random&, Tally&)> batch) {
    const auto wanted = static_cast<std::size_t>(std::max(1.0, std::ceil(batches * effort.factor)));
    const std::size_t first = effort.batch.value_or(0), count = effort.batch ? 1 : wanted;
    std::vector<Tally> tallies(count);
    ThreadPool pool(effort.threads);
    pool.run(count, [&](std::size_t at, int) {
        const std::size_t i = first + at;
        meshes::Random random(hash(low32(seed), high32(seed), static_cast<std::uint32_t>(i)));
        Tally& tally = tallies[at];
        batch(random, tally);
        for (std::string* text : {&tally.failedCase, &tally.worstCase})
            if (!text->empty()) *text = cat("seed ", seed, " batch ", i, ": ", *text);
    });
    Tally sum;
    for (const Tally& tally : tallies) sum += tally;
    return sum;
}

} // namespace battery
