// Hits of one shape that all rays were asked about, as far as they lie in its box, by the register:
// every kernel chooses as ShapeSet does ray by ray.
#include "accel/kernels/solids.h"
#include "accel/ray_setup.h"
#include "analytic_kit.h"
#include "check.h"
#include "verify/hostile_rays.h"

namespace test_boxed {

using kit::Random;

TEST(boxed_hits_in_lanes_are_those_of_single_rays) {
    Random random(3501);
    long long taken = 0, left = 0, ties = 0;
    for (int i = 0; i < check::scaled(2000); ++i) {
        const Vec3d middle = random.inBox(2), half = random.inBox(1);
        Bounds box;
        box.extend(toFloat(middle - half)), box.extend(toFloat(middle + half));
        const float extent = max(maxAbs(box.lo), maxAbs(box.hi));
        const BoxedShape shape{box, extent, 7};
        battery::RayList rays;
        std::vector<Hit> found, best;
        for (std::size_t k = 0; k < 1 + random.below(40); ++k) {
            const Vec3d from = random.inBox(3), at = middle + random.inBox(1.2);
            rays.push({toFloat(from), toFloat((at - from) * random.logUniform(1e-3, 1e3)), 0,
                       kInfinityF, 0});
            Hit hit, other{.t = random.chance(0.4) ? kInfinityF : 0};
            const auto someT = [&] { return static_cast<float>(random.logUniform(1e-4, 1e4)); };
            if (random.chance(0.8))
                hit = {.t = someT(), .u = 0.25f, .v = 0.5f, .prim = random.below(9), .shape = 3};
            if (other.t == 0) other.t = random.chance(0.2) && hit.isHit() ? hit.t : someT();
            if (random.chance(0.7)) other.shape = 5, other.prim = 2;
            found.push_back(hit), best.push_back(other);
        }
        // Ray by ray; those that are as far as the best are left to others.
        std::vector<Hit> expected = best, moved = found;
        std::vector<std::uint32_t> asFar;
        for (std::uint32_t k = 0; k < best.size(); ++k) {
            if (!found[k].isHit()) continue;
            const RaySetup setup(rays.span().org[k], rays.span().dir[k], extent);
            float zEntry = 0;
            const bool enters = setup.enters(box, depthCut(1.0f / (best[k].t * setup.dz)), zEntry);
            const float t = max(zEntry / setup.dz, found[k].t);
            if (!enters || t > best[k].t) {
                ++left;
                continue;
            }
            moved[k].t = t, moved[k].shape = shape.number;
            if (t == best[k].t) {
                asFar.push_back(k), ++ties;
            } else {
                expected[k] = moved[k], ++taken;
            }
        }
        for (const Isa& kernel : allIsas()) {
            const SolidKernel* const lanes = kernel.solids;
            if (!kernel.supported() || lanes == nullptr) continue;
            std::vector<Hit> nearest = best, mine = found;
            std::vector<std::uint32_t> list(best.size());
            list.resize(
                lanes->nearerInBox(shape, rays.span(), mine.data(), nearest.data(), list.data()));
            CHECK_INFO(nearest == expected, kernel.name << " case " << i);
            CHECK_INFO(list == asFar, kernel.name << " case " << i);
            for (const std::uint32_t k : list)
                CHECK_INFO(mine[k] == moved[k], kernel.name << " case " << i << " ray " << k);
        }
    }
    CHECK_INFO(taken > 1000 && left > 1000 && ties > 100, taken << ' ' << left << ' ' << ties);
}

} // namespace test_boxed
