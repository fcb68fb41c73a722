// Textures by the register: every lane has the bits of looking its point up alone. And what
// textures multiply.
#include "accel/kernels/kernels.h"
#include "check.h"
#include "integrate/lobe_block.h"
#include "scene/lobed_materials.h"
#include "texture/picture_lanes.h"
#include "texture/texture.h"
#include "verify/meshes.h"

#include <array>
#include <bit>
#include <cmath>
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
        else if (depth == StoredImage::Depth::Bits16)
            image.words.push_back(static_cast<std::uint16_t>(code));
        else
            image.floats.push_back(static_cast<float>(code) / 10000);
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

// Of a footprint: nothing, a part of a texel, many pictures, and what no ray sees.
float someExtent(Random& random) {
    switch (random.below(8)) {
    case 0: return 0;
    case 1: return random.chance(0.5) ? 1e30f : std::numeric_limits<float>::quiet_NaN();
    default:
        return static_cast<float>(std::exp2(random.uniform(-12, 3)) *
                                  (random.chance(0.5) ? 1 : -1));
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
    using Depth = StoredImage::Depth;
    for (const Isa& kernel : allIsas()) {
        if (!kernel.supported()) continue;
        Random random(41);
        long long asked = 0, black = 0, dark = 0, wrong = 0;
        for (int i = 0; i < check::scaled(2500); ++i) {
            const StoredImage image = someImage(random, random.chance(0.5)   ? Depth::Bits8
                                                        : random.chance(0.5) ? Depth::Bits16
                                                                             : Depth::Float);
            const TextureParams params = someParams(random);
            const Texture texture(image, params);
            TextureBlock block;
            const std::size_t count = 1 + random.below(TextureBlock::kPoints);
            for (std::size_t k = 0; k < count; ++k) {
                block.u[k] = someCoordinate(random, image.width);
                block.v[k] = someCoordinate(random, image.height);
            }
            block.isFiltered = random.chance(0.5);
            for (std::size_t k = 0; block.isFiltered && k < count; ++k)
                for (auto* const axis : {&block.along, &block.across})
                    (*axis)[0][k] = someExtent(random), (*axis)[1][k] = someExtent(random);
            kernel.pictures->texture(texture, block, count);
            for (std::size_t k = 0; k < count; ++k) {
                const Vec2 uv{block.u[k], block.v[k]};
                const UvFootprint footprint{{block.along[0][k], block.along[1][k]},
                                            {block.across[0][k], block.across[1][k]}};
                const Rgb alone = block.isFiltered ? texture.color(uv, footprint)
                                                   : texture.color(uv);
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

// A footprint below a texel is a point; one of the whole picture is its mean; a long one goes along
// its longer axis only.
TEST(texture_footprints_are_means) {
    Random random(43);
    StoredImage stripes; // of single columns, black and white
    stripes.width = stripes.height = 64, stripes.channels = 1;
    for (int i = 0; i < 64 * 64; ++i)
        stripes.bytes.push_back(i % 2 == 0 ? std::uint8_t{0} : std::uint8_t{255});
    TextureParams params;
    params.space = ColorSpace::Linear;
    const Texture texture(stripes, params);
    for (int i = 0; i < 200; ++i) {
        const Vec2 uv{static_cast<float>(random.uniform(0, 1)),
                      static_cast<float>(random.uniform(0, 1))};
        const Rgb point = texture.color(uv);
        CHECK(sameBits(texture.color(uv, {{0.015f, 0}, {0, 0.015f}}), point));
        CHECK_NEAR(texture.color(uv, {{1, 0}, {0, 1}}).r, 0.5, 1e-6);
        CHECK_NEAR(texture.color(uv, {{0.25f, 0}, {0, 0.25f}}).r, 0.5, 1e-6);
        // Along the stripes nothing is mixed, across them it is.
        CHECK_NEAR(texture.color(uv, {{0, 0.2f}, {0.01f, 0}}).r, point.r, 1e-6);
        CHECK_NEAR(texture.color(uv, {{0.25f, 0}, {0, 0.01f}}).r, 0.5, 1e-6);
    }
}

// What is transparent has no colour, however much of it there is; what is cut off is black.
TEST(texture_footprints_weigh_by_alpha) {
    StoredImage half; // red where it covers, green where it doesn't
    half.width = half.height = 16, half.channels = 4;
    for (int i = 0; i < 256; ++i)
        for (const int code : i % 4 == 0 ? std::array{255, 0, 0, 255} : std::array{0, 255, 0, 0})
            half.bytes.push_back(static_cast<std::uint8_t>(code));
    for (const float extent : {0.3f, 0.5f, 1.0f, 7.0f}) {
        const UvFootprint footprint{{extent, 0}, {0, extent}};
        const Rgb seen = Texture(half, {}).color({0.4f, 0.6f}, footprint);
        CHECK_NEAR(seen.r, 1, 1e-6);
        CHECK_NEAR(seen.g, 0, 1e-6);
        TextureParams alpha;
        alpha.channel = TextureParams::Channel::Alpha;
        CHECK_NEAR(Texture(half, alpha).color({0.4f, 0.6f}, footprint).r, 0.25, 0.07);
    }
    StoredImage white;
    white.width = white.height = 8, white.channels = 1, white.bytes.assign(64, 255);
    TextureParams clip;
    clip.extension = Extension::Clip;
    const Texture cut(white, clip);
    CHECK_NEAR(cut.color({0, 0.5f}, {{0.5f, 0}, {0, 0.5f}}).r, 0.5, 0.05);
    CHECK_EQUAL(cut.color({-2, 0.5f}, {{0.5f, 0}, {0, 0.5f}}).r, 0.0f);
    CHECK_NEAR(cut.color({0.5f, 0.5f}, {{0.5f, 0}, {0, 0.5f}}).r, 1, 1e-6);
}

// Where the edge of a picture goes on, nothing of its inside is mixed in.
TEST(texture_footprints_beside_the_picture_see_its_edge) {
    StoredImage image; // a white frame around black
    image.width = image.height = 32, image.channels = 1;
    for (int y = 0; y < 32; ++y)
        for (int x = 0; x < 32; ++x) {
            const bool isEdge = x == 0 || y == 0 || x == 31 || y == 31;
            image.bytes.push_back(isEdge ? 255 : 0);
        }
    TextureParams params;
    params.extension = Extension::Extend;
    const Texture texture(image, params);
    for (const float x : {-3.0f, -0.5f, 1.5f, 9.0f})
        for (const float extent : {0.02f, 0.1f, 0.5f})
            CHECK_EQUAL(texture.color({x, x}, {{extent, 0}, {0, extent}}).r, 1.0f);
}

// Points of two materials with the same kinds of lobes: each number is multiplied by the picture,
// or by one minus a part of it, and the others stay.
TEST(texture_factors_multiply_numbers_of_lobes) {
    Random random(42);
    const auto block = std::make_unique<LobeBlock>();
    for (int round = 0; round < 100; ++round) {
        std::vector<std::unique_ptr<const Texture>> textures;
        for (int t = 0; t < 3; ++t)
            textures.push_back(std::make_unique<const Texture>(
                someImage(random, t < 2 ? StoredImage::Depth::Bits8 : StoredImage::Depth::Bits16),
                someParams(random)));
        LobedMaterials materials;
        std::vector<LobeRow> rows[2];
        std::vector<LobeFactor> factors[2];
        for (std::size_t m = 0; m < 2; ++m) {
            const auto part = static_cast<float>(random.uniform(0.1, 0.4));
            rows[m] = {lobeRow("diffuse", {part, 0.2f, 0.3f}),
                       lobeRow("conductor", {0.3f, part, 0.1f})};
            const auto any = [&] { return textures[random.below(textures.size())].get(); };
            factors[m] = {{0, 0, 3, 0, 1, any()},      // diffuse: by the colour
                          {1, 0, 3, 1, -0.5f, any()},  // metal: by one minus half of it
                          {1, 3 + 6, 1, 0, 1, any()}}; // its roughness: by the grey value
            materials.add(rows[m], factors[m], 0);
        }
        const Isa& kernel = allIsas()[random.below(allIsas().size())];
        const PictureLanes& pictures = *(kernel.supported() ? kernel : oneLane()).pictures;
        SurfaceBlock at{};
        for (float& coordinate : at.uv[0]) coordinate = static_cast<float>(random.uniform(-1, 2));
        for (float& coordinate : at.uv[1]) coordinate = static_cast<float>(random.uniform(-1, 2));
        block->begin(materials, materials[0]);
        for (std::size_t i = 0; i < LobeBlock::kPoints; ++i)
            block->put(materials, materials[i % 2], i);
        const unsigned first = round % 2 == 0 ? 0x5555u : 0x0014u; // few points, too
        block->paint(materials, materials[0], first, at, pictures);
        block->paint(materials, materials[1], 0xaaaau, at, pictures);
        for (std::size_t i = 0; i < LobeBlock::kPoints; ++i) {
            const std::size_t m = i % 2;
            if (m == 0 && (first >> i & 1) == 0) continue;
            const Vec2 uv{at.uv[0][i], at.uv[1][i]};
            const Rgb a = factors[m][0].texture->color(uv), b = factors[m][1].texture->color(uv);
            const float grey = factors[m][2].texture->valueOf(factors[m][2].texture->color(uv));
            std::vector<float> expected[2];
            for (std::size_t l = 0; l < 2; ++l)
                expected[l].assign(rows[m][l].value, rows[m][l].value + (l == 0 ? 3 : 12));
            expected[0][0] *= a.r, expected[0][1] *= a.g, expected[0][2] *= a.b;
            expected[1][0] *= 1 - 0.5f * b.r, expected[1][1] *= 1 - 0.5f * b.g,
                expected[1][2] *= 1 - 0.5f * b.b;
            expected[1][9] *= grey;
            for (std::size_t l = 0; l < 2; ++l)
                for (std::size_t v = 0; v < expected[l].size(); ++v)
                    CHECK_INFO(block->lobe[l].value[v][i] == expected[l][v],
                               "round " << round << " point " << i << " lobe " << l << " value "
                                        << v << ": " << block->lobe[l].value[v][i] << ", expected "
                                        << expected[l][v]);
        }
    }
}

} // namespace test_texture_lanes
