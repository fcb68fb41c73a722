// Mirrors and glass, sharp and rough, by the register: every ray has the bits of asking its point's
// material alone, and its place among the others.
#include "accel/kernels/kernels.h"
#include "check.h"
#include "render/shading.h"
#include "render/waves/bounce_lanes.h"
#include "sample/hash.h"
#include "sample/sobol.h"
#include "verify/meshes.h"

#include <array>
#include <bit>
#include <cmath>
#include <vector>

namespace test_bounce_lanes {

using meshes::Random;

namespace {

constexpr std::size_t kPoints = PointBlock::kPoints;
constexpr float kCutoff = 0.02f;

bool sameBits(float a, float b) {
    return std::bit_cast<std::uint32_t>(a) == std::bit_cast<std::uint32_t>(b);
}
bool sameBits(Vec3 a, Vec3 b) {
    return sameBits(a.x, b.x) && sameBits(a.y, b.y) && sameBits(a.z, b.z);
}
bool sameBits(Rgb a, Rgb b) { return sameBits(Vec3{a.r, a.g, a.b}, Vec3{b.r, b.g, b.b}); }

Rgb someLight(Random& random, double black) {
    if (random.chance(black)) return {};
    const auto channel = [&] { return static_cast<float>(random.unit()); };
    return {channel(), random.chance(0.1) ? 0 : channel(), channel()};
}

struct Kind {
    Material material;
    float eta = 1;
    std::uint32_t beyond = 0;
};

Kind someKind(Random& random) {
    Kind kind;
    Material& m = kind.material;
    m.mirror = someLight(random, 0.1);
    // From the narrowest lobe, which is that of 0.067, to the widest.
    if (random.chance(0.5)) m.roughness = static_cast<float>(random.logUniform(0.05, 1));
    if (random.chance(0.3)) return kind;
    m.fresnel = random.chance(0.5)
                    ? FresnelModel::Dielectric
                    : (random.chance(0.5) ? FresnelModel::Schlick : FresnelModel::None);
    m.transmission = someLight(random, isBlack(m.mirror) ? 0 : 0.1);
    kind.eta = random.chance(0.1) ? 1 : static_cast<float>(random.logUniform(0.4, 2.5));
    kind.beyond = random.below(9);
    return kind;
}

// Points of a few kinds, some of which send on nothing.
struct Block {
    PointBlock points{};
    std::array<Rgb, kPoints> weights{};
    std::vector<Kind> kinds;
    std::vector<AlikePoints> alike; // the first ones of `kinds`
    BouncePairs pairs;

    explicit Block(Random& random) {
        for (std::size_t k = 0; k < kPoints; ++k) addPoint(random, k);
        const std::size_t sets = 1 + random.below(4);
        for (std::size_t i = 0; i < sets; ++i) kinds.push_back(someKind(random));
        std::array<unsigned, 5> of{}; // the last is for points that do nothing
        for (std::size_t k = 0; k < kPoints; ++k)
            of[random.chance(0.1) ? 4 : random.below(static_cast<std::uint32_t>(sets))] |= 1u << k;
        for (std::size_t i = 0; i < sets; ++i)
            alike.push_back({of[i], &kinds[i].material, kinds[i].eta, kinds[i].beyond});
        addPairs(random);
    }

    // Some are on the lobe's axis, some where the circle crosses the axes: there one number is 0.
    void addPairs(Random& random) {
        // Of v = 0, 1/4, 1/2, 3/4 in sample 0 with index 0.
        constexpr std::uint32_t kQuarters[] = {0, 0x1486ece, 0x1fbbaed, 0xe90bd1};
        const auto any = [&] { return random.below(0xffffffff); };
        for (std::size_t k = 0; k < kPoints; ++k)
            if (random.chance(0.1)) {
                pairs.x[k] = random.chance(0.3) ? 0 : any();
                pairs.y[k] = random.chance(0.3) ? any() : kQuarters[random.below(4)];
            } else {
                pairs.sample[k] = random.below(1 << 12), pairs.index[k] = any();
                pairs.x[k] = any(), pairs.y[k] = any();
            }
    }
    Vec2 pairOf(std::size_t k) const {
        const auto bits = kernels::one::sobolPair<std::uint32_t>(pairs.sample[k], pairs.index[k],
                                                                 pairs.x[k], pairs.y[k]);
        return {unitFloat(bits.x), unitFloat(bits.y)};
    }

    void addPoint(Random& random, std::size_t k) {
        const Vec3d ng = random.direction();
        // The eye on the side of both normals, now and then near the horizon.
        const double height =
            random.chance(0.3) ? random.logUniform(1e-6, 0.1) : random.uniform(0, 1);
        const Vec3d eye = normalize(normalize(cross(ng, random.direction())) + ng * height);
        // Any way, or away from the eye: rays that hardly leave such glass may come back.
        const Vec3d bend = random.chance(0.5) ? random.direction() * random.uniform(0, 0.9)
                                              : eye * (-dot(ng, eye) * random.uniform(0, 1));
        const Vec3d bent = normalize(ng + bend);
        const bool isFront = random.chance(0.5);
        SurfaceBlock::set(points.ng, k, toFloat(isFront ? ng : -ng));
        points.front |= static_cast<unsigned>(isFront) << k;
        SurfaceBlock::set(points.n, k,
                          toFloat(random.chance(0.5) && dot(bent, eye) > 0 ? bent : ng));
        SurfaceBlock::set(points.toEye, k, toFloat(eye));
        SurfaceBlock::set(points.p, k, toFloat(random.inBox(3)));
        points.error[k] = static_cast<float>(random.logUniform(1e-9, 1e-2));
        weights[k] = random.chance(0.1) ? someLight(random, 1) : someLight(random, 0);
    }
};

struct Sent {
    Vec3 org, dir;
    Rgb weight;
};
struct Cases {
    long long points = 0, reflected = 0, refracted = 0, total = 0, dropped = 0;
    long long bentBack = 0, bentDown = 0;            // where normals are too bent to be followed
    long long rough = 0, onAxis = 0, atQuarters = 0; // of the lobe, of the circle
};

// What single points send on, in their order.
std::vector<Sent> sentAlone(const Block& block, LeavingRays& told, Cases& cases) {
    std::vector<Sent> rays;
    for (std::size_t k = 0; k < kPoints; ++k)
        for (const AlikePoints& some : block.alike) {
            if ((some.points >> k & 1) == 0) continue;
            ++cases.points;
            const Vec3 n = SurfaceBlock::get(block.points.n, k);
            const Vec3 ng =
                SurfaceBlock::get(block.points.ng, k) * (block.points.isFront(k) ? 1.0f : -1.0f);
            const Vec3 toEye = SurfaceBlock::get(block.points.toEye, k);
            cases.bentDown += !(dot(reflectAbout(toEye, n), ng) > 0);
            Bounces out;
            const Vec2 u = block.pairOf(k);
            if (!isPlainMirror(*some.material))
                out = bounces(*some.material, n, ng, toEye, some.eta, u);
            else if (!isBlack(some.material->mirror))
                out.reflected = Bounce{mirrored(toEye, n, ng), some.material->mirror};
            if (some.material->roughness > 0)
                ++cases.rough, cases.onAxis += u.x == 0,
                    cases.atQuarters += 4 * u.y == std::floor(4 * u.y);
            const auto send = [&](const std::optional<Bounce>& ray, Vec3 side, unsigned which) {
                if (!ray) return;
                const Rgb weight = block.weights[k] * ray->weight;
                const bool isWorth = maxChannel(weight) > 0 && maxChannel(weight) >= kCutoff;
                cases.dropped += !isWorth;
                if (!isWorth) return;
                rays.push_back({leave(block.points.at(k), side), ray->dir, weight});
                told.rays |= 1u << (2 * k + which);
                ++(which == 0 ? told.reflected : told.refracted);
            };
            send(out.reflected, ng, 0);
            send(out.refracted, -ng, 1);
            if (isBlack(some.material->transmission)) continue;
            cases.total += !out.refracted;
            const auto through = refractThrough(toEye, n, some.eta);
            cases.bentBack += through && !(dot(*through, ng) < 0);
        }
    cases.reflected += static_cast<long long>(told.reflected);
    cases.refracted += static_cast<long long>(told.refracted);
    return rays;
}

template <class Fn> void forAllLanes(const Fn& fn) {
    for (const Isa& kernel : allIsas())
        if (const BounceLanes lanes = lanesOf(kernel.bounce); kernel.supported() && lanes.bounce)
            fn(kernel.name, lanes);
}

} // namespace

TEST(bounce_lanes_have_the_bits_and_the_order_of_single_points) {
    forAllLanes([](const char* name, const BounceLanes& lanes) {
        Random random(91);
        Cases cases;
        for (int i = 0; i < check::scaled(4000); ++i) {
            const Block block(random);
            std::array<Vec3, 3 * kPoints> org, dir;
            std::array<Rgb, 3 * kPoints> weight;
            LeavingRays out;
            lanes.bounce(block.points, block.weights.data(), block.alike, &block.pairs, kCutoff,
                         {org.data(), dir.data(), nullptr, weight.data()}, out);
            LeavingRays told;
            const std::vector<Sent> alone = sentAlone(block, told, cases);
            bool same = out.rays == told.rays && out.reflected == told.reflected &&
                        out.refracted == told.refracted;
            for (std::size_t ray = 0; ray < alone.size() && same; ++ray)
                same = sameBits(org[ray], alone[ray].org) && sameBits(dir[ray], alone[ray].dir) &&
                       sameBits(weight[ray], alone[ray].weight);
            for (std::size_t k = 0; k < kPoints && same; ++k)
                for (const AlikePoints& some : block.alike)
                    if ((some.points >> k & 1) != 0 && (told.rays >> (2 * k + 1) & 1) != 0)
                        same = out.beyond[k] == some.beyond;
            CHECK_INFO(same, name << ": block " << i);
        }
        // All of it happens, or the test says nothing.
        CHECK_INFO(cases.reflected > cases.points / 2 && cases.refracted > cases.points / 5 &&
                       cases.total > cases.points / 20 && cases.dropped > cases.points / 50 &&
                       cases.bentBack > cases.points / 1000 &&
                       cases.bentDown > cases.points / 100 && cases.rough > cases.points / 3 &&
                       cases.onAxis > cases.rough / 50 && cases.atQuarters > cases.rough / 50,
                   name << ": of " << cases.points << " points " << cases.reflected
                        << " reflected, " << cases.refracted << " refracted, " << cases.total
                        << " totally, " << cases.dropped << " dropped, " << cases.bentBack
                        << " bent back, " << cases.bentDown << " bent down, " << cases.rough
                        << " rough, of them " << cases.onAxis << " on the axis of the lobe, "
                        << cases.atQuarters << " at quarters of the circle");
    });
    CHECK(oneLane().bounce == nullptr);
}

// Whatever their materials are: as those of each material together.
TEST(bounce_lanes_mirror_points_of_many_materials) {
    forAllLanes([](const char* name, const BounceLanes& lanes) {
        Random random(93);
        std::size_t reflected = 0;
        for (int i = 0; i < check::scaled(2000); ++i) {
            const Block block(random);
            std::array<const Material*, kPoints> materials{}; // null where nobody may look
            std::vector<AlikePoints> mirrors;
            unsigned points = 0;
            for (const AlikePoints& some : block.alike) {
                if (!isPlainMirror(*some.material)) continue;
                mirrors.push_back(some), points |= some.points;
                for (std::size_t k = 0; k < kPoints; ++k)
                    if ((some.points >> k & 1) != 0) materials[k] = some.material;
            }
            struct Rays {
                std::array<Vec3, 3 * kPoints> org, dir;
                std::array<Rgb, 3 * kPoints> weight;
                LeavingRays out;
                RayPlaces places() { return {org.data(), dir.data(), nullptr, weight.data()}; }
            } one, other;
            lanes.mirror(block.points, block.weights.data(), materials.data(), points, kCutoff,
                         one.places(), one.out);
            lanes.bounce(block.points, block.weights.data(), mirrors, nullptr, kCutoff,
                         other.places(), other.out);
            bool same = one.out.rays == other.out.rays &&
                        one.out.reflected == other.out.reflected && one.out.refracted == 0;
            for (std::size_t ray = 0; ray < one.out.reflected && same; ++ray)
                same = sameBits(one.org[ray], other.org[ray]) &&
                       sameBits(one.dir[ray], other.dir[ray]) &&
                       sameBits(one.weight[ray], other.weight[ray]);
            CHECK_INFO(same, name << ": block " << i);
            reflected += one.out.reflected;
        }
        CHECK_INFO(reflected > 2000, name << ": " << reflected);
    });
}

TEST(bounce_lanes_divide_points_by_what_they_have_in_common) {
    forAllLanes([](const char* name, const BounceLanes& lanes) {
        Random random(92);
        for (int i = 0; i < check::scaled(2000); ++i) {
            PointBlock block{};
            std::array<std::uint32_t, kPoints> media{};
            const std::uint32_t kinds = 1 + random.below(3);
            for (std::size_t k = 0; k < kPoints; ++k)
                block.material[k] = random.below(kinds), media[k] = random.below(kinds);
            block.front = random.chance(0.5) ? 0xffffu : random.below(1u << 16);
            const unsigned used = (2u << random.below(16)) - 1;
            std::array<std::uint16_t, kPoints> alike;
            const std::size_t sets = lanes.divide(block, media.data(), used, alike.data());
            const auto areAlike = [&](std::size_t a, std::size_t b) {
                return block.material[a] == block.material[b] && media[a] == media[b] &&
                       block.isFront(a) == block.isFront(b);
            };
            unsigned seen = 0;
            bool right = true;
            for (std::size_t s = 0; s < sets; ++s) {
                const auto first = static_cast<std::size_t>(std::countr_zero(used & ~seen));
                for (std::size_t k = 0; k < kPoints; ++k)
                    right &=
                        ((alike[s] >> k & 1) != 0) == ((used >> k & 1) != 0 && areAlike(first, k));
                seen |= alike[s];
            }
            CHECK_INFO(right && seen == used, name << ": block " << i);
        }
    });
}

} // namespace test_bounce_lanes
