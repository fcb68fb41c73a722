// Textures by the register: every lane has the bits of looking its point up alone, and a wave's
// points get the numbers that each would get for itself.
#include "accel/kernels/kernels.h"
#include "check.h"
#include "render/waves/picture_lanes.h"
#include "render/waves/texture_points.h"
#include "texture/texture.h"
#include "verify/meshes.h"

#include <bit>
#include <limits>
#include <memory>

namespace test_texture_lanes {

using meshes::Random;

namespace {

constexpr float kInfinite = std::numeric_limits<float>::infinity();

StoredImage someImage(Random& random, StoredImage::Depth depth) {
    // The smallest, a row, a column, sides that are no powers of two, and larger than a block.
    constexpr int kSizes[][2] = {{1, 1}, {1, 5}, {7, 1}, {2, 2}, {3, 5}, {64, 33}, {257, 3}};
    const auto& size = kSizes[random.below(std::size(kSizes))];
    StoredImage image;
    image.width = size[0], image.height = size[1];
    image.channels = static_cast<int>(1 + random.below(4));
    image.depth = depth;
    const auto count = static_cast<std::size_t>(image.width) *
                       static_cast<std::size_t>(image.height) *
                       static_cast<std::size_t>(image.channels);
    const bool isDark = random.chance(0.2); // where the sRGB curve is a line
    for (std::size_t i = 0; i < count; ++i) {
        const std::uint32_t code = random.chance(0.1)   ? 0
                                   : random.chance(0.1) ? 65535
                                                        : random.below(isDark ? 3000 : 65536);
        if (depth == StoredImage::Depth::Bits8)
            image.bytes.push_back(static_cast<std::uint8_t>(code >> 8));
        else
            image.words.push_back(static_cast<std::uint16_t>(code));
    }
    return image;
}

TextureParams someParams(Random& random) {
    TextureParams params;
    if (random.chance(0.3)) params.space = ColorSpace::Linear;
    if (random.chance(0.3)) params.interpolation = Interpolation::Nearest;
    params.extension = static_cast<Extension>(random.below(3));
    if (random.chance(0.2)) params.channel = TextureParams::Channel::Alpha;
    if (random.chance(0.5)) {
        params.scale = {random.uniform(-5, 5), random.uniform(-5, 5)};
        params.rotationRad = random.uniform(-4, 4);
        params.offset = {random.uniform(-3, 3), random.uniform(-3, 3)};
    }
    return params;
}

float someCoordinate(Random& random, int size) {
    switch (random.below(8)) {
    case 0: {
        constexpr float kOdd[] = {0.0f,
                                  -0.0f,
                                  1.0f,
                                  -1.0f,
                                  -1e-30f,
                                  0.99999994f,
                                  1e30f,
                                  -1e30f,
                                  3e9f,
                                  -3e9f,
                                  1e-40f,
                                  -5e-9f,
                                  8388609,
                                  -8388607.5f,
                                  -kInfinite,
                                  kInfinite,
                                  std::numeric_limits<float>::quiet_NaN(),
                                  std::numeric_limits<float>::max()};
        return kOdd[random.below(std::size(kOdd))];
    }
    case 1: // centres and borders of texels
        return static_cast<float>(random.below(4 * static_cast<std::size_t>(size) + 8)) /
                   static_cast<float>(2 * size) -
               1;
    case 2: return static_cast<float>(random.uniform(-1000, 1000));
    default: return static_cast<float>(random.uniform(-0.5, 1.5));
    }
}

bool sameBits(float a, float b) {
    return std::bit_cast<std::uint32_t>(a) == std::bit_cast<std::uint32_t>(b);
}
bool sameBits(Rgb a, Rgb b) {
    return sameBits(a.r, b.r) && sameBits(a.g, b.g) && sameBits(a.b, b.b);
}

} // namespace

TEST(texture_lanes_have_the_bits_of_single_look_ups) {
    for (const Isa& kernel : allIsas()) {
        const TextureColorsFn colors =
            kernel.supported() ? lanesOf(kernel.pictures).texture : nullptr;
        if (!colors) continue;
        Random random(41);
        long long asked = 0, black = 0, dark = 0, wrong = 0;
        for (int i = 0; i < check::scaled(2500); ++i) {
            const StoredImage image = someImage(random, StoredImage::Depth::Bits8);
            const TextureParams params = someParams(random);
            const Texture texture(image, params);
            const auto bytes = texture.bytes();
            CHECK(bytes.has_value());
            TextureBlock block;
            const std::size_t count = 1 + random.below(TextureBlock::kPoints);
            for (std::size_t k = 0; k < count; ++k) {
                block.u[k] = someCoordinate(random, image.width);
                block.v[k] = someCoordinate(random, image.height);
            }
            colors(*bytes, block, count);
            for (std::size_t k = 0; k < count; ++k) {
                const Rgb alone = texture.color({block.u[k], block.v[k]});
                const Rgb lane{block.color[0][k], block.color[1][k], block.color[2][k]};
                ++asked, black += isBlack(alone), dark += alone.r > 0 && alone.r < 0.003f;
                if (!sameBits(lane, alone) && ++wrong <= 3)
                    CHECK_INFO(false, kernel.name
                                          << " texture " << i << " (" << image.width << "x"
                                          << image.height << "x" << image.channels << ", extension "
                                          << static_cast<int>(params.extension) << ") at "
                                          << block.u[k] << " " << block.v[k] << ": " << lane.r
                                          << " " << lane.g << " " << lane.b << " instead of "
                                          << alone.r << " " << alone.g << " " << alone.b);
            }
        }
        CHECK_INFO(black > asked / 50 && black < asked / 2 && dark > asked / 100,
                   kernel.name << ": of " << asked << " colours " << black << " are black, " << dark
                               << " dark");
        CHECK_EQUAL(wrong, 0);
    }
}

TEST(texture_lanes_are_for_bytes) {
    Random random(1);
    CHECK(!Texture(someImage(random, StoredImage::Depth::Bits16), {}).bytes());
    CHECK(oneLane().pictures == nullptr);
}

// Materials with any of their four pictures, more of them than there are groups, at any number of
// points each.
TEST(texture_points_get_the_numbers_of_their_materials) {
    Random random(42);
    long long asked = 0, wrong = 0;
    TexturedPoints points; // as in a wave: one for all
    for (int i = 0; i < check::scaled(60); ++i) {
        std::vector<std::unique_ptr<const Texture>> textures;
        for (int t = 0; t < 8; ++t)
            textures.push_back(std::make_unique<const Texture>(
                someImage(random, t < 6 ? StoredImage::Depth::Bits8 : StoredImage::Depth::Bits16),
                someParams(random)));
        const auto maybe = [&]() -> const Texture* {
            return random.chance(0.5) ? textures[random.below(textures.size())].get() : nullptr;
        };
        std::vector<SceneMaterial> materials(1 + random.below(40));
        std::vector<MaterialPictures> pictures(materials.size());
        for (std::size_t number = 0; number < materials.size(); ++number) {
            SceneMaterial& m = materials[number];
            m.base.diffuse = {0.9f, 0.7f, 0.3f}, m.base.specular = {0.5f, 0.6f, 0.1f};
            m.base.emission = {3, 4, 5}, m.base.opacity = 0.9f;
            pictures[number] = {maybe(), maybe(), maybe(), maybe()};
            m.pictures = &pictures[number];
        }
        const std::size_t count = 1 + random.below(400);
        PointColumns columns;
        columns.setMaterials(materials);
        columns.resize(count);
        std::vector<ShadedPoint> at(count);
        std::vector<Material> numbers(count);
        points.clear();
        const double goesOn = random.chance(0.5) ? 0.7 : 0.98;
        std::uint32_t added = 0; // so many points
        for (std::size_t k = 0; k < count; ++k) {
            // In runs, as on surfaces.
            at[k].of = k > 0 && random.chance(goesOn) ? at[k - 1].of
                                                      : &materials[random.below(materials.size())];
            at[k].surface.uv = {someCoordinate(random, 8), someCoordinate(random, 8)};
            at[k].surface.material = static_cast<std::uint32_t>(at[k].of - materials.data());
            columns.put(k, at[k]);
            // One by one, or some that are alike.
            const auto end = static_cast<std::uint32_t>(k);
            if (added < end && (at[k].of != at[added].of || random.chance(0.2))) {
                points.add(*at[added].of, added, end - added);
                added = end;
            }
        }
        points.add(*at[added].of, added, static_cast<std::uint32_t>(count) - added);
        const Isa& kernel = allIsas()[random.below(allIsas().size())];
        points.apply(kernel.supported() ? lanesOf(kernel.pictures).texture : nullptr, columns,
                     numbers);
        for (std::size_t k = 0; k < count; ++k) {
            const Material alone = materialAt(at[k]);
            ++asked;
            if (!(sameBits(numbers[k].diffuse, alone.diffuse) &&
                  sameBits(numbers[k].specular, alone.specular) &&
                  sameBits(numbers[k].emission, alone.emission) &&
                  sameBits(numbers[k].opacity, alone.opacity)) &&
                ++wrong <= 3)
                CHECK_INFO(false, kernel.name << " scene " << i << " point " << k << " of " << count
                                              << ", " << materials.size() << " materials");
        }
    }
    CHECK_INFO(asked > 5000, asked);
    CHECK_EQUAL(wrong, 0);
}

} // namespace test_texture_lanes
