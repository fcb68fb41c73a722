// NFF that threads read in parts is what one thread reads: every block, its name and place, and
// every message, wherever parts begin.
#include "base/text.h"
#include "check.h"
#include "read/nff/read_nff.h"
#include "read/nff/split.h"
#include "unit/read_outcome.h"

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace test_nff_parts {

namespace {

using Outcome = check::ReadOutcome;

Outcome checkSame(const std::string& text, const std::string& what) {
    const SourceFile source{"t.nff", text};
    const auto readWith = [&](int threads, std::size_t partBytes) {
        return check::outcomeOf([&](Diagnostics& diagnostics) {
            ReadOptions options;
            options.threads = threads;
            return readNff(source, {options, diagnostics}, partBytes);
        });
    };
    Outcome one = readWith(1, 1);
    check::checkParts(one, {{2, 1}, {3, 60}, {2, 200}}, cat(what, " of\n", text), readWith);
    return one;
}

const std::string kView = "v from 0 -10 0 at 0 0 0\nup 0 0 1 angle 90\nhither 1\n"
                          "resolution 11 11\n";
// Fills that come again, written otherwise too, before and behind what they colour, and words at
// the starts of lines that begin nothing.
const std::string kText = "# s 1 1 1 1\nb 0.1 0.2 0.3\nl 1 2 3\n" + kView +
                          "f 1 0.5 0.25 0.7 0.2 50 0 0\n"
                          "s 0 0 0 1\ns 1 0 0 -1\n"
                          "p 3\n0 0 0\n1 0 0\n0 1 0\n"
                          "pp 3\n0 0 0 0 0 1\n1 0 0 0 0 1\n0 1 0 0 0 1\n"
                          "  f 0.25 1 1 1 0 9 0.5 1.5 # glass\r\n"
                          "p 4\n0 0 1\n1 0 1\n#s\n1 1 1 # f 1 1 1\n0 1 1\n"
                          "c 0 0 0 1\n0 0 1 0.5\nc 0 0 0 -1 0 0 2 -1\n"
                          "l 4 5 6 1 0.5 0.25\n"
                          "s 3 0 0 -2\n"
                          "f 1 .5 0.250 0.7 2e-1 50 -0 0\n"
                          "p 3\n0 0 2\n1 0 2\n0 1 2\ns 2 2 2 0\n"
                          "pp 3\n0 0 3 0 0 1\n1 0 3 0 0 1\n0 1 3 0 0 1\n"
                          "p 3\n0 0 2\n1 0 2\n2 0 2\n"
                          "l 7 8 9\nf 0.5 0.5 0.5 1 0 0 0 0\n"
                          "pp 3\n0 0 5 0 0 1\n1 0 5 0 0 1\n0 1 5 0 0 1\n"
                          "c 0 0 0 0 0 0 0 0\ns 9 9 9 1\nf 1 1 1 1 0 0 0 0\n";

} // namespace

TEST(nff_parts_begin_at_entities) {
    for (std::size_t bytes = 1; bytes < kText.size(); ++bytes) {
        const std::vector<std::size_t> starts = nffPartStarts(kText, bytes);
        CHECK(starts.at(0) == 0);
        for (std::size_t i = 1; i < starts.size(); ++i) {
            const std::string line = kText.substr(starts[i], kText.find('\n', starts[i]));
            const std::string word = line.substr(line.find_first_not_of(' '), 2);
            CHECK_INFO(
                starts[i] >= starts[i - 1] + bytes && kText[starts[i] - 1] == '\n' &&
                    (word == "pp" ||
                     (std::string("blvfspc").find(word[0]) != std::string::npos && word[1] == ' ')),
                bytes << ": " << line);
        }
    }
    CHECK_INFO(nffPartStarts(kText, 1).size() > 20, nffPartStarts(kText, 1).size());
}

TEST(nff_parts_know_their_fill) {
    const std::string text = "f 1\n#f 2\ns 1 f 3\n \tf 4\nfx\n";
    CHECK_EQUAL(lastNffFill(text, 0, text.size()).value_or(99), text.find("f 4"));
    CHECK_EQUAL(lastNffFill(text, 0, text.find("f 4") - 2).value_or(99), std::size_t{0});
    CHECK(!lastNffFill(text, 4, text.find("f 4") - 2));
}

TEST(nff_parts_give_the_same_scene) {
    const Outcome one = checkSame(kText, "all kinds");
    CHECK_INFO(one.said.empty() && one.warnings.size() == 3, one.said << join(one.warnings, "\n"));
    CHECK_EQUAL(one.desc.materials.size(), std::size_t{3});
    CHECK_EQUAL(one.desc.meshes.size(), std::size_t{4});
    CHECK_EQUAL(one.desc.meshes.at(0).points.size(), std::size_t{6});
    checkSame("\xef\xbb\xbf" + kText, "byte order mark");
    checkSame("s 1 2 3 4\np 3 0 0 0 1 0 0 0 1 0\ns 1 2 3 -4\n" + kText +
                  "p 3\n0 0 0\n1 0 0\n0 1 0\n",
              "things in front of the first fill");
    checkSame(kView + "s 1 2 3 4\np 3\n0 0 0\n1 0 0\n0 1 0\nc 0 0 0 1 0 0 1 1\n"
                      "p 3\n0 0 1\n1 0 1\n0 1 1\npp 3\n0 0 0 0 0 1\n1 0 0 0 0 1\n0 1 0 0 0 1\n",
              "no fill at all");
    // A fill that nobody finds from the starts of lines.
    checkSame(kText + "s 1 1 1 1 f 0.125 1 1 1 0 0 0 0\ns 1 2 1 1\ns 1 3 1 1\ns 1 4 1 1\n",
              "a fill inside a line");
}

TEST(nff_parts_give_the_same_messages) {
    const std::vector<std::pair<std::string, std::string>> cases = {
        {"s 1 2 3\n", "expected 4 numbers"},
        {"s 1 2 3 4 5\n", "expected an entity"},
        {"s 1 2 3 1e70\n", "number 4 of 's'"},
        {"f 1 1 1 -1 0 0 0 0\n", "number 4 of 'f'"},
        {"f 1 1 x\n", "expected 8 numbers"},
        {"q 1\n", "unknown entity"},
        {"p -3\n", "expected the number of corners"},
        {"p 999999999\n", "more than the rest"},
        {"from 1 2 3\n", "'from'"},
        {kView, "given already at line"},
        {"b 1 1 1\n", "given already at line"},
        {"c 0 0 0 1 0 0 1 -1\n", "different signs"},
    };
    for (const auto& [entity, words] : cases)
        for (std::size_t at = kText.find("f 1"); at < kText.size();
             at = kText.find("\ns ", at) == std::string::npos ? kText.size()
                                                              : kText.find("\ns ", at) + 1) {
            std::string text = kText;
            text.insert(at, entity);
            const std::string said = checkSame(text, entity).said;
            CHECK_INFO(said.find(words) != std::string::npos, entity << ": " << said);
        }
    const std::string noView =
        kText.substr(0, kText.find("v from")) + kText.substr(kText.find("f 1"));
    CHECK(checkSame(noView, "no view").said.find("has no view") != std::string::npos);
}

TEST(nff_parts_give_the_same_for_all_examples) {
    const int count =
        check::forEachFile({"tests/scenes/nff", "tests/bad/nff", "ASCII"}, ".nff", checkSame);
    CHECK_INFO(count > 15, count << " files");
}

TEST(nff_parts_give_the_same_after_random_damage) {
    const std::vector<std::string> pieces = {
        "s ", "\n", " f 1 1 1 1 1 1 0 1\n", "#", "p ", "-", "e", "c", "\r", "l 1 1 1\n"};
    int said = 0;
    const int cases = check::scaled(1500);
    for (int seed = 0; seed < cases; ++seed) {
        const std::string text = damage::damaged(kText, pieces, static_cast<std::uint32_t>(seed));
        said += !checkSame(text, cat("seed ", seed)).said.empty();
    }
    CHECK_INFO(said > cases / 4 && said < 9 * cases / 10, said << " of " << cases);
}

} // namespace test_nff_parts
