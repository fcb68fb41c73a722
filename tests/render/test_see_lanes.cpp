// Points by the register: every lane has the bits of seeing its point alone.
#include "check.h"
#include "shot.h"

#include "integrate/shading_kernel.h"
#include "integrate/point_block.h"
#include "verify/meshes.h"

#include <array>
#include <bit>
#include <optional>

namespace test_see_lanes {

using meshes::Random;

namespace {

constexpr std::size_t kPoints = PointColumns::kPoints;
using Vectors = std::array<Vec3, kPoints>;

bool sameBits(float a, float b) {
    return std::bit_cast<std::uint32_t>(a) == std::bit_cast<std::uint32_t>(b);
}
bool sameBits(Vec3 a, Vec3 b) {
    return sameBits(a.x, b.x) && sameBits(a.y, b.y) && sameBits(a.z, b.z);
}
bool sameBits(const ShadedPoint::Side& a, const ShadedPoint::Side& b) {
    return sameBits(a.ng, b.ng) && sameBits(a.ns, b.ns) && sameBits(a.n, b.n);
}

// The first material is lit on the side that is seen, the second one outside.
std::optional<Scene> materials() {
    const std::string text = shot::TopView{}.text() +
                             "sphere s {\n material a\n}\nmaterial a {\n diffuse 1 1 1\n}\n"
                             "material b {\n lit_side outside\n}\n";
    const SceneDesc desc = shot::parse(text);
    RenderSettings settings;
    settings.picture = desc.settings;
    return std::optional<Scene>(std::in_place, desc, SourceFile{"scene", ""}, settings);
}

Vec3 someDirection(Random& random) { return toFloat(random.direction()); }

Surface someSurface(Random& random, bool flat) {
    Surface s;
    s.p = toFloat(random.inBox(2));
    s.ng = s.ns = someDirection(random);
    s.error = static_cast<float>(random.logUniform(1e-9, 1e-2));
    s.rayError = random.chance(0.5) ? 0 : 0x1p-22f;
    s.material = random.below(2), s.object = random.below(9);
    if (flat || random.chance(0.5)) return s;
    s.ns = toFloat(normalize(toDouble(s.ng) + random.direction() * 0.9));
    if (random.chance(0.5)) s.lift = s.ng * static_cast<float>(random.logUniform(1e-8, 1e-2));
    return s;
}

struct Cases {
    long long points = 0, turned = 0, apart = 0;
};

// What lanes make of a block, and what single points are.
class Compared {
public:
    Compared(const Scene& scene, const ShadingKernel& lanes, Random& random)
        : scene_(scene), lanes_(lanes), count_(random.chance(0.5) ? kPoints : 1 + random.below(16)),
          used_((1u << count_) - 1) {
        columns_.setMaterials(scene.materials());
        columns_.resize(kPoints);
        const bool flat = random.chance(0.3);
        for (std::size_t k = 0; k < count_; ++k) {
            alone_[k].surface = someSurface(random, flat);
            columns_.surfaces()[k].put(alone_[k].surface);
            dirs_[k] = someDirection(random) * static_cast<float>(random.logUniform(0.1, 10));
            if (random.chance(0.2)) // grazing
                dirs_[k] = toFloat(cross(toDouble(alone_[k].surface.ng), random.direction())) +
                           alone_[k].surface.ng * (random.chance(0.5) ? 1e-3f : -1e-3f);
        }
    }

    bool see(Cases& cases) {
        unsigned outside = 0;
        for (std::size_t k = 0; k < count_; ++k)
            outside |= static_cast<unsigned>(alone_[k].surface.material == 1) << k;
        const unsigned away = lanes_.see(columns_.block(0), dirs_.data(), used_, outside);
        bool same = (away & ~used_) == 0;
        for (std::size_t k = 0; k < count_; ++k) {
            if ((away >> k & 1) != 0) {
                const ShadedPoint at = columns_[k];
                SurfaceBlock::set(columns_.block(0).n, k, shading::turnedAway(at.toEye, at.eye));
            }
            const Ray ray{{}, dirs_[k], 0, kInfinityF, 0};
            ShadedPoint& alone = alone_[k];
            shadeSurface<false>(scene_, ray, {}, alone);
            const ShadedPoint at = columns_[k];
            same &= sameBits(at.toEye, alone.toEye) && at.front == alone.front &&
                    at.of == alone.of && sameBits(at.eye, alone.eye) &&
                    sameBits(at.lit, alone.lit) && sameBits(at.surface.lift, alone.surface.lift);
            cases.turned += (away >> k & 1) != 0;
            cases.apart += columns_.block(0).isLitApart(k);
        }
        cases.points += static_cast<long long>(count_);
        return same;
    }

private:
    const Scene& scene_;
    const ShadingKernel& lanes_;
    std::size_t count_;
    unsigned used_;
    PointColumns columns_;
    std::array<ShadedPoint, kPoints> alone_;
    Vectors dirs_{};
};

// For the lanes of every kernel that there are.
template <class Fn> void forAllLanes(const Fn& fn) {
    for (const Isa& kernel : allIsas())
        if (kernel.supported()) fn(kernel.name, *kernel.shading);
}

} // namespace

TEST(see_lanes_have_the_bits_of_single_points) {
    const std::optional<Scene> scene = materials();
    forAllLanes([&](const char* name, const ShadingKernel& lanes) {
        Random random(7001);
        Cases cases;
        for (int i = 0; i < check::scaled(2000); ++i) {
            Compared block(*scene, lanes, random);
            CHECK_INFO(block.see(cases), name << ": block " << i);
        }
        // All that there is a branch for has been there.
        for (const long long some : {cases.turned, cases.apart})
            CHECK_INFO(some > cases.points / 50, name << ": " << some << " of " << cases.points);
    });
}

} // namespace test_see_lanes
