// The picture around the scene by the register: every lane has the bits of looking alone.
#include "accel/kernels/kernels.h"
#include "check.h"
#include "texture/picture_lanes.h"
#include "verify/meshes.h"

#include <bit>
#include <cmath>
#include <limits>

namespace test_environment_lanes {

using meshes::Random;

namespace {

StoredImage someImage(Random& random, StoredImage::Depth depth) {
    constexpr int kSizes[][2] = {{1, 1}, {2, 1}, {8, 4}, {13, 7}, {256, 128}};
    const auto& size = kSizes[random.below(std::size(kSizes))];
    StoredImage image;
    image.width = size[0], image.height = size[1];
    image.channels = static_cast<int>(1 + random.below(4));
    image.depth = depth;
    const int count = image.width * image.height * image.channels;
    for (int i = 0; i < count; ++i) {
        const std::uint32_t code = random.below(65536);
        switch (depth) {
        case StoredImage::Depth::Bits8:
            image.bytes.push_back(static_cast<std::uint8_t>(code >> 8));
            break;
        case StoredImage::Depth::Bits16:
            image.words.push_back(static_cast<std::uint16_t>(code));
            break;
        case StoredImage::Depth::Float:
            image.floats.push_back(static_cast<float>(code) / 256);
            break;
        }
    }
    return image;
}

// All around, along axes and diagonals, close to them, and numbers that are no directions.
Vec3 someDirection(Random& random) {
    const auto odd = [&]() -> float {
        constexpr float kOdd[] = {0.0f,
                                  -0.0f,
                                  1.0f,
                                  -1.0f,
                                  0.5f,
                                  1e30f,
                                  -1e-30f,
                                  1e-44f,
                                  -3e38f,
                                  std::numeric_limits<float>::infinity(),
                                  -std::numeric_limits<float>::infinity(),
                                  std::numeric_limits<float>::quiet_NaN()};
        return kOdd[random.below(std::size(kOdd))];
    };
    switch (random.below(6)) {
    case 0: return {odd(), odd(), odd()};
    case 1: { // where the table's rows meet, k / 16 and half-way between
        const float a = static_cast<float>(random.below(33)) / 32;
        const auto sign = [&] { return random.chance(0.5) ? 1.0f : -1.0f; };
        const Vec3 d{a * sign(), sign(), a * sign()};
        return random.chance(0.5) ? d : Vec3{d.y, d.x, std::nextafter(d.z, 9.0f)};
    }
    case 2: {
        Vec3 d = toFloat(random.direction());
        d[random.below(3)] *= static_cast<float>(random.logUniform(1e-30, 1e-3));
        return d;
    }
    case 3: return toFloat(random.direction() * random.logUniform(1e-35, 1e35));
    default: return toFloat(random.direction());
    }
}

bool sameBits(float a, float b) {
    return std::bit_cast<std::uint32_t>(a) == std::bit_cast<std::uint32_t>(b);
}

} // namespace

TEST(environment_lanes_have_the_bits_of_single_rays) {
    using Depth = StoredImage::Depth;
    for (const Isa& kernel : allIsas()) {
        if (!kernel.supported()) continue;
        Random random(43);
        long long asked = 0, wrong = 0;
        for (int i = 0; i < check::scaled(1500); ++i) {
            const Depth depth = random.chance(0.5)   ? Depth::Bits8
                                : random.chance(0.5) ? Depth::Bits16
                                                     : Depth::Float;
            const Environment picture(someImage(random, depth),
                                      random.chance(0.5) ? ColorSpace::Srgb : ColorSpace::Linear,
                                      random.chance(0.7) ? Interpolation::Bilinear
                                                         : Interpolation::Nearest,
                                      random.chance(0.5) ? Environment::Up::Z : Environment::Up::Y,
                                      random.chance(0.3) ? 0 : random.uniform(-20, 20));
            EnvironmentBlock block;
            Vec3 dir[EnvironmentBlock::kRays];
            const std::size_t count = 1 + random.below(EnvironmentBlock::kRays);
            for (std::size_t k = 0; k < count; ++k) {
                dir[k] = someDirection(random);
                for (std::size_t axis = 0; axis < 3; ++axis) block.dir[axis][k] = dir[k][axis];
            }
            kernel.pictures->environment(picture, block, count);
            for (std::size_t k = 0; k < count; ++k) {
                const Rgb alone = picture.radiance(dir[k]);
                const bool same = sameBits(alone.r, block.color[0][k]) &&
                                  sameBits(alone.g, block.color[1][k]) &&
                                  sameBits(alone.b, block.color[2][k]);
                ++asked;
                if (!same && ++wrong <= 3)
                    CHECK_INFO(false, kernel.name << " picture " << i << " towards " << dir[k].x
                                                  << " " << dir[k].y << " " << dir[k].z);
            }
        }
        CHECK_INFO(asked > 2000, asked);
        CHECK_EQUAL(wrong, 0);
    }
}

} // namespace test_environment_lanes
