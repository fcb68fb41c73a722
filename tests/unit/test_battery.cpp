// The stress battery at its smallest size, and what it promises about itself.
#include "base/error.h"
#include "check.h"
#include "cli/command.h"
#include "verify/report.h"

#include <set>

namespace test_battery {

using battery::Effort;
using battery::Finding;
using battery::Row;
using battery::Tally;

namespace {

bool has(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
}

// "T9" before "T10" before "T10b".
bool isBefore(const std::string& a, const std::string& b) {
    const int x = std::stoi(a.substr(1)), y = std::stoi(b.substr(1));
    return x != y ? x < y : a < b;
}

// Made up: half of its cases are broken, the worst is 3 where 2 is allowed.
Tally broken(const Effort& effort) {
    return battery::inBatches(effort, 7, 4, [](meshes::Random& random, Tally& tally) {
        for (int i = 0; i < 10; ++i) {
            ++tally.cases;
            if (i % 2) tally.fail([&] { return cat("odd ", i); });
            tally.measure(random.uniform(0, 3), [&] { return cat("case ", i); });
        }
    });
}
constexpr Row kBroken{"T99", "made up", "metres", 2, true, broken, "worse"};

Tally tallyOf(std::uint64_t cases, std::uint64_t failures, double worst) {
    Tally tally;
    tally.cases = cases, tally.failures = failures, tally.worst = worst;
    return tally;
}

} // namespace

TEST(battery_every_row_passes) {
    for (const Row& row : battery::rows()) {
        const Tally tally = row.run({.factor = 1, .threads = 2});
        const std::string line = battery::reportLine(row, tally, 0);
        std::printf("%s", line.c_str());
        Row judged = row;
        if (row.timed) judged.limit = kInfinity; // `raytracer verify` and make stress look at it
        CHECK_INFO(battery::passed(judged, tally) == (*row.open == 0),
                   line); // or `open` is out of date
    }
}

TEST(battery_ids) {
    std::set<std::string> seen;
    std::string last;
    for (const Row& row : battery::rows()) {
        const std::string id = row.id;
        CHECK_INFO(id.size() >= 2 && id[0] == 'T' && id[1] >= '1' && id[1] <= '9', id);
        CHECK_INFO(seen.insert(id).second, id << " is there twice");
        CHECK_INFO(last.empty() || isBefore(last, id), last << " before " << id);
        // "T19" would stand for all of "T19a", "T19b" on the command line and for itself.
        const bool letter = id.back() >= 'a' && id.back() <= 'z';
        CHECK_INFO(!letter || !seen.contains(id.substr(0, id.size() - 1)), id);
        CHECK_INFO(*row.what && row.run && row.limit >= 0, id);
        CHECK_INFO(*row.unit || row.limit == 0, id << " has a mark without a unit");
        last = id;
    }
    CHECK(!seen.empty());
}

TEST(battery_does_not_depend_on_threads) {
    const Tally one = broken({.factor = 2, .threads = 1}),
                three = broken({.factor = 2, .threads = 3});
    CHECK_EQUAL(one.cases, 80u);
    CHECK_EQUAL(one.failures, 40u);
    CHECK_EQUAL(three.cases, one.cases);
    CHECK_EQUAL(three.failures, one.failures);
    CHECK_EQUAL(three.worst, one.worst);
    CHECK_EQUAL(three.worstCase, one.worstCase);
    CHECK_EQUAL(one.failedCase, "seed 7 batch 0: odd 1");
    CHECK_EQUAL(three.failedCase, one.failedCase);
    CHECK_EQUAL(broken({.factor = 0.001, .threads = 1}).cases, 10u); // never nothing
}

// A case is made again by the number of its batch, at any effort.
TEST(battery_repeats_a_batch) {
    const Tally all = broken({.factor = 5, .threads = 2});
    const std::size_t at = all.worstCase.find("batch ") + 6;
    const std::size_t batch = std::stoul(all.worstCase.substr(at));
    const Tally again = broken({.factor = 1, .threads = 1, .batch = batch});
    CHECK_EQUAL(again.cases, 10u);
    CHECK_EQUAL(again.worst, all.worst);
    CHECK_EQUAL(again.worstCase, all.worstCase);
}

TEST(battery_verdict) {
    CHECK(battery::passed(kBroken, tallyOf(1, 0, 2)));
    CHECK(!battery::passed(kBroken, tallyOf(0, 0, 0))); // nothing was tried
    CHECK(!battery::passed(kBroken, tallyOf(9, 1, 0)));
    CHECK(!battery::passed(kBroken, tallyOf(9, 0, 2.0001)));
    Tally tally = tallyOf(9, 0, 1);
    tally.measure(std::nan(""), [] { return "not a number"; });
    CHECK(!battery::passed(kBroken, tally) && tally.worstCase == "not a number");
    Tally sum = tallyOf(1, 0, 5); // and it stays the worst in a sum
    sum += tally;
    sum += tallyOf(1, 0, 7);
    CHECK(!battery::passed(kBroken, sum) && sum.worstCase == "not a number");
}

TEST(battery_report) {
    const Tally bad = broken({.factor = 1, .threads = 1});
    const std::string line = battery::reportLine(kBroken, bad, 1.25);
    for (const std::string part :
         {"T99 ", "made up", "20 failed", " metres", "0, 2", "FAILED (1.2 s)",
          "failed: seed 7 batch 0: odd 1", "worst: seed 7 batch "})
        CHECK_INFO(has(line, part), part << " in " << line);
    const Tally good = tallyOf(12345678, 0, 0.5);
    const std::string fine = battery::reportLine(kBroken, good, 0);
    CHECK_INFO(has(fine, "12,345,678  0 failed, 0.5 metres") && has(fine, "ok (0.0 s)"), fine);
    CHECK_EQUAL(std::count(fine.begin(), fine.end(), '\n'), 1);

    const std::string page =
        battery::markdownPage(std::vector<Finding>{{kBroken, bad}, {kBroken, good}}, "1.0", 100);
    for (const std::string part :
         {"effort 100", "1 of 2 tests", "| T99 | made up | 40 | 20 failed, ",
          "| **failed** | worse |", "| 12,345,678 | 0 failed, 0.5 metres | 0, 2 | ok | worse |",
          "verify TEST --batch N", "| T99 | failed: seed 7 batch 0: odd 1 |"})
        CHECK_INFO(has(page, part), part << " in " << page);
}

TEST(battery_command_line) {
    const auto parsed = [](std::vector<std::string> arguments) {
        return parseVerifyOptions(arguments);
    };
    const VerifyOptions options = parsed({"T25", "-e", "0.5", "--batch", "7", "-t2"});
    CHECK(options.tests == std::vector<std::string>{"T25"} && options.effort == 0.5);
    CHECK(options.batch == 7 && options.threads == 2);
    CHECK_THROWS(parsed({"--batch", "7"}), "--batch is for a TEST");
    CHECK_THROWS(parsed({"--effort", "0"}), "--effort expects a number from 0.01");
    CHECK_THROWS(verify(parsed({"T25x"})), "unknown test 'T25x'; did you mean 'T25'?");
    CHECK_THROWS(verify(parsed({"T"})), "unknown test 'T'");
    CHECK_EQUAL(verifyTests().size(), battery::rows().size());
}

} // namespace test_battery
