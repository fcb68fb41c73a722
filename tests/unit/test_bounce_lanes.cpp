// Mirrors and glass by the register: every lane has the bits of asking the material alone.
#include "accel/kernels/kernels.h"
#include "check.h"
#include "render/waves/bounce_lanes.h"
#include "verify/meshes.h"

#include <bit>

using meshes::Random;

namespace {

using PointRows = float[3][BounceBlock::kPoints];

bool sameBits(float a, float b) {
    return std::bit_cast<std::uint32_t>(a) == std::bit_cast<std::uint32_t>(b);
}
bool sameBits(const PointRows& rows, std::size_t i, Vec3 v) {
    return sameBits(rows[0][i], v.x) && sameBits(rows[1][i], v.y) && sameBits(rows[2][i], v.z);
}
void put(PointRows& rows, std::size_t i, Vec3 v) {
    rows[0][i] = v.x, rows[1][i] = v.y, rows[2][i] = v.z;
}
Vec3 asVector(Rgb c) { return {c.r, c.g, c.b}; }

struct Point {
    Vec3 n, ng, toEye;
    Material material;
    float eta;
    Rgb weight;
};

Rgb someLight(Random& random, double black) {
    if (random.chance(black)) return {};
    const auto channel = [&] { return static_cast<float>(random.unit()); };
    return {channel(), random.chance(0.1) ? 0 : channel(), channel()};
}

Point somePoint(Random& random) {
    Point point;
    const Vec3d ng = random.direction();
    // The eye on the side of both normals, now and then near the horizon.
    const double height = random.chance(0.3) ? random.logUniform(1e-6, 0.1) : random.uniform(0, 1);
    const Vec3d eye = normalize(normalize(cross(ng, random.direction())) + ng * height);
    point.ng = toFloat(ng), point.toEye = toFloat(eye);
    const Vec3d bent = normalize(ng + random.direction() * random.uniform(0, 0.5));
    point.n = random.chance(0.3) && dot(bent, eye) > 0 ? toFloat(bent) : point.ng;
    Material& m = point.material;
    m.mirror = someLight(random, 0.1);
    if (random.chance(0.7)) {
        m.fresnel = FresnelModel::Dielectric, m.transmission = someLight(random, 0.1);
        point.eta = random.chance(0.1) ? 1 : static_cast<float>(random.logUniform(0.4, 2.5));
    } else {
        point.eta = 1;
    }
    point.weight = random.chance(0.1) ? someLight(random, 1) : someLight(random, 0);
    return point;
}

} // namespace

TEST(bounce_lanes_have_the_bits_of_single_points) {
    constexpr float kCutoff = 0.02f;
    const auto isTraced = [](Rgb w) { return maxChannel(w) > 0 && maxChannel(w) >= kCutoff; };
    for (const Kernel& kernel : allKernels()) {
        const BouncesFn inLanes = kernel.supported() ? bouncesInLanes(kernel) : nullptr;
        if (!inLanes) continue;
        Random random(91);
        int points = 0, bent = 0, reflected = 0, refracted = 0, total = 0, wrong = 0;
        for (int i = 0; i < check::scaled(4000); ++i) {
            BounceBlock block;
            block.cutoff = kCutoff;
            std::vector<Point> all;
            const std::size_t used = random.chance(0.3) ? 1 + random.below(16) : 16;
            for (std::size_t k = 0; k < used; ++k) {
                const Point p = somePoint(random);
                put(block.n, k, p.n), put(block.ng, k, p.ng), put(block.toEye, k, p.toEye);
                put(block.mirror, k, asVector(p.material.mirror));
                put(block.transmission, k, asVector(p.material.transmission));
                put(block.weight, k, asVector(p.weight));
                block.eta[k] = p.eta, block.used |= 1u << k;
                if (isSharpGlass(p.material)) block.glass |= 1u << k;
                CHECK(isSharpGlass(p.material) || isPlainMirror(p.material));
                all.push_back(p);
            }
            inLanes(block);
            const unsigned any = block.reflects | block.refracts | block.bent;
            CHECK_INFO((any & ~block.used) == 0, kernel.name << " block " << i);
            for (std::size_t k = 0; k < used; ++k) {
                const Point& p = all[k];
                ++points;
                if ((block.bent >> k & 1) != 0) {
                    ++bent;
                    // A normal that is not bent may ask at the horizon only.
                    CHECK_INFO(p.n != p.ng || dot(p.ng, p.toEye) < 1e-3f,
                               kernel.name << " block " << i << " point " << k);
                    continue;
                }
                const Bounces alone = bounces(p.material, p.n, p.ng, p.toEye, p.eta, {0.5f, 0.5f});
                const auto isSame = [&](const std::optional<Bounce>& ray, unsigned traced,
                                        const PointRows& dir, const PointRows& weight) {
                    const Rgb w = ray ? p.weight * ray->weight : Rgb{};
                    if (isTraced(w) != ((traced >> k & 1) != 0)) return false;
                    return !isTraced(w) ||
                           (sameBits(dir, k, ray->dir) && sameBits(weight, k, asVector(w)));
                };
                reflected += (block.reflects >> k & 1) != 0;
                refracted += (block.refracts >> k & 1) != 0;
                total += alone.reflected && !alone.refracted && isSharpGlass(p.material);
                if ((!isSame(alone.reflected, block.reflects, block.reflectedDir,
                             block.reflected) ||
                     !isSame(alone.refracted, block.refracts, block.refractedDir,
                             block.refracted)) &&
                    ++wrong <= 3)
                    CHECK_INFO(false,
                               kernel.name << " block " << i << " point " << k << " eta " << p.eta);
            }
        }
        CHECK_EQUAL(wrong, 0);
        // All of it happens, or the test says nothing.
        CHECK_INFO(bent < points / 10 && bent > points / 1000 && reflected > points / 2 &&
                       refracted > points / 4 && total > points / 20,
                   kernel.name << ": of " << points << " points " << bent << " bent, " << reflected
                               << " reflected, " << refracted << " refracted, " << total
                               << " totally reflected");
    }
    CHECK(bouncesInLanes(chooseKernel("scalar")) == nullptr);
}
