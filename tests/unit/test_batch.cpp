// Ray batches.
#include "integrate/batch.h"

#include "check.h"

namespace test_batch {

TEST(batch_keeps_rays_together) {
    PathBatch batch;
    CHECK(batch.empty());
    for (std::uint32_t i = 0; i < 10; ++i) {
        const float f = static_cast<float>(i);
        batch.push({{f, 1, 2}, {3, f, 4}, f / 2, f + 1, f / 10}, i * 7, {f, 0, 1}, i % 2, i + 100,
                   i % 3 == 0);
    }
    CHECK_EQUAL(batch.size(), 10u);
    const Ray ray = batch.ray(7);
    CHECK(ray.org == (Vec3{7, 1, 2}) && ray.dir == (Vec3{3, 7, 4}));
    CHECK(ray.tMin == 3.5f && ray.tMax == 8 && ray.time == 0.7f);
    CHECK(batch.sample[7] == 49 && batch.weight[7] == Rgb({7, 0, 1}) && batch.stream[7] == 107);
    CHECK(batch.medium[7] == 1 && batch.medium[6] == MediumTree::kNothing);
    CHECK(!batch.seesLights[7] && batch.seesLights[9]);
    batch.clear();
    CHECK(batch.empty() && batch.span().size() == 0);
    batch.setSize(20);
    CHECK(batch.size() == 20 && batch.span().org.size() == 20 && batch.span().time.size() == 20);
    CHECK(batch.sample.size() >= 20 && batch.weight.size() >= 20 && batch.medium.size() >= 20);
    CHECK(batch.stream.size() >= 20 && batch.seesLights.size() >= 20);
}

} // namespace test_batch
