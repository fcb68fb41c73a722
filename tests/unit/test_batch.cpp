// Ray batches and the stack of transparent media.
#include "render/batch.h"

#include "check.h"
#include "verify/meshes.h"

#include <algorithm>

namespace {

// The rule written out: a list, the last one entered on top.
struct Reference {
    std::vector<std::uint32_t> inside;
    void enter(std::uint32_t m) {
        if (inside.size() < 7) inside.push_back(m);
    }
    void leave(std::uint32_t m) {
        const auto at = std::find(inside.rbegin(), inside.rend(), m);
        if (at != inside.rend()) inside.erase(std::next(at).base());
    }
    std::uint32_t top() const { return inside.empty() ? MediumStack::kOutside : inside.back(); }
};

} // namespace

TEST(batch_keeps_rays_together) {
    PathBatch batch;
    CHECK(batch.empty());
    MediumStack glass;
    glass.enter(3);
    for (std::uint32_t i = 0; i < 10; ++i) {
        const float f = static_cast<float>(i);
        batch.push({{f, 1, 2}, {3, f, 4}, f / 2, f + 1, f / 10}, i * 7, {f, 0, 1},
                   i % 2 ? glass : MediumStack(), i + 100, i % 3 == 0);
    }
    CHECK_EQUAL(batch.size(), 10u);
    const Ray ray = batch.ray(7);
    CHECK(ray.org == (Vec3{7, 1, 2}) && ray.dir == (Vec3{3, 7, 4}));
    CHECK(ray.tMin == 3.5f && ray.tMax == 8 && ray.time == 0.7f);
    CHECK(batch.sample[7] == 49 && batch.weight[7] == Rgb({7, 0, 1}) && batch.stream[7] == 107);
    CHECK(batch.medium[7].top() == 3 && batch.medium[6].top() == MediumStack::kOutside);
    CHECK(!batch.seesLights[7] && batch.seesLights[9]);
    batch.clear();
    CHECK(batch.empty() && batch.dir.empty() && batch.tMin.empty() && batch.tMax.empty() &&
          batch.time.empty());
    CHECK(batch.sample.empty() && batch.weight.empty() && batch.medium.empty() &&
          batch.stream.empty() && batch.seesLights.empty());
}

TEST(batch_medium_stack) {
    constexpr std::uint32_t air = MediumStack::kOutside, glass = 1, water = 2, ice = 3;
    MediumStack s;
    CHECK_EQUAL(s.top(), air);
    s.leave(glass); // the ray started inside: no change
    CHECK_EQUAL(s.top(), air);
    s.enter(glass), s.enter(water), s.enter(ice); // nested
    CHECK_EQUAL(s.top(), ice);
    s.leave(water); // the outer ends first: overlapping solids
    CHECK_EQUAL(s.top(), ice);
    s.leave(ice);
    CHECK_EQUAL(s.top(), glass);
    s.enter(glass), s.leave(glass); // twice the same: counted
    CHECK_EQUAL(s.top(), glass);
    s.leave(glass);
    CHECK_EQUAL(s.top(), air);
    // The innermost entry goes: 1 2 1 - 1 = 1 2.
    s.enter(glass), s.enter(water), s.enter(glass), s.leave(glass);
    CHECK_EQUAL(s.top(), water);
    s.leave(water), s.leave(glass);
    // Full at seven: what is entered beyond is not remembered.
    for (std::uint32_t i = 0; i < 64; ++i) s.enter(100 + i);
    CHECK_EQUAL(s.top(), 106u);
    s.leave(163);
    CHECK_EQUAL(s.top(), 106u);
    for (std::uint32_t i = 0; i < 64; ++i) s.leave(100 + i);
    CHECK_EQUAL(s.top(), air);
}

TEST(batch_medium_stack_at_random) {
    meshes::Random random(121);
    for (int n = 0; n < 200; ++n) {
        MediumStack stack;
        Reference reference;
        for (int i = 0; i < 200; ++i) {
            const std::uint32_t m = random.below(5);
            if (random.chance(0.55))
                stack.enter(m), reference.enter(m);
            else
                stack.leave(m), reference.leave(m);
            CHECK_INFO(stack.top() == reference.top(), "seed 121 round " << n << " step " << i);
        }
    }
}
