// SameNames against a map; all threads find the same. What validate() says, too, depends on them
// neither in its words nor in their order.
#include "base/text.h"
#include "check.h"
#include "desc/same_names.h"
#include "desc/validate.h"

#include <map>
#include <random>
#include <string>

namespace test_same_names {

namespace {

std::vector<SameNames::Pair> find(const std::vector<ObjectDesc>& blocks, std::size_t together,
                                  int threads) {
    SameNames same(blocks.size(), together);
    forEachPart(threads, blocks.size(), together, [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i) same.see(i, blocks[i].name);
        same.sort(first);
    });
    return same.find([&](std::size_t i) -> std::string_view { return blocks[i].name; }, threads);
}

} // namespace

TEST(same_names_are_those_of_a_map) {
    std::mt19937 random(31);
    for (const std::uint32_t count : {0u, 1u, 500u, 20000u})
        for (const std::uint32_t kinds : {1u, 3 * count + 1, count / 2 + 1}) {
            std::vector<ObjectDesc> blocks(count);
            for (ObjectDesc& block : blocks) block.name = cat("name", random() % kinds);
            std::map<std::string, std::uint32_t> first;
            std::vector<SameNames::Pair> expected;
            for (std::uint32_t i = 0; i < count; ++i)
                if (const auto [at, isNew] = first.emplace(blocks[i].name, i); !isNew)
                    expected.push_back({at->second, i});
            for (const int threads : {1, 2, 5})
                for (const std::size_t together : {64u, 4096u}) {
                    const auto found = find(blocks, together, threads);
                    const bool same =
                        std::equal(found.begin(), found.end(), expected.begin(), expected.end(),
                                   [](const auto& a, const auto& b) {
                                       return a.first == b.first && a.second == b.second;
                                   });
                    CHECK_INFO(same, count << " names of " << kinds << ", threads " << threads
                                           << ", seed 31");
                }
        }
}

// Three parts of blocks. Few mistakes of a kind, so that the list is not full before the next kind.
TEST(validate_says_the_same_with_any_threads) {
    std::mt19937 random(32);
    for (int scene = 0; scene < 12; ++scene) {
        SceneDesc desc;
        desc.cameras.resize(1);
        desc.cameras[0].name = "camera";
        desc.lights.resize(9000);
        desc.objects.resize(9000);
        desc.materials.resize(5000);
        for (std::size_t i = 0; i < desc.lights.size(); ++i) {
            desc.lights[i].name = cat("light", i);
            desc.objects[i].name = cat("object", i);
            desc.objects[i].materials = {static_cast<Handle>(i % 4000)};
        }
        for (std::size_t i = 0; i < desc.materials.size(); ++i)
            desc.materials[i].name = cat("material", i);
        const auto some = [&](auto& blocks) -> auto& { return blocks[random() % blocks.size()]; };
        some(desc.lights).angleDeg = 3; // without effect: a warning
        some(desc.lights).coneAngleDeg = 7;
        for (int k = 0; scene % 3 > 0 && k < 3; ++k) {
            some(desc.objects).radius = -1;
            some(desc.objects).name = some(desc.objects).name;
            some(desc.objects).name = "bad\n";
            some(desc.objects).worldFromObject.front()[0] = 0;
            some(desc.materials).ior = 1e99;
            some(desc.lights).name = "";
        }
        const auto said = [&](int threads) {
            Diagnostics diagnostics;
            std::string all;
            try {
                validate(desc, {"s.txt", ""}, diagnostics, threads);
            } catch (const Error& error) {
                all = error.what();
            }
            return all + join(diagnostics.warnings, "\n");
        };
        const std::string one = said(1);
        CHECK_INFO((one.find("error") != std::string::npos) == (scene % 3 > 0), one);
        CHECK_INFO(one.find("no effect") != std::string::npos, one);
        if (scene % 3 > 0)
            for (const char* words : {"'radius'", "another object", "a name is", "flattens"})
                CHECK_INFO(one.find(words) != std::string::npos, words << " in " << one);
        for (const int threads : {2, 5})
            CHECK_INFO(said(threads) == one, "scene " << scene << ", threads " << threads
                                                      << ", seed 32: " << said(threads));
    }
}

} // namespace test_same_names
