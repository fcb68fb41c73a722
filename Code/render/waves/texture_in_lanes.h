// The formulas of Texture::color(), lane by lane and in their order.
#pragma once

#include "render/waves/texel_lanes.h"
#include "render/waves/texture_lanes.h"
#include "simd/lanes.h"

#include <cstddef>

LANES_BEGIN

void textureColors(const ByteTexture& texture, TextureBlock& block, std::size_t count) {
    const TexelLanes texels(texture.texels);
    for (std::size_t first = 0; first < count; first += W) {
        const Doubles u(Floats::load(block.u + first)), v(Floats::load(block.v + first));
        const auto mapped = [&](double fromU, double fromV, double offset) {
            return Doubles(fromU) * u + Doubles(fromV) * v + Doubles(offset);
        };
        texels.colors(mapped(texture.sFromU, texture.sFromV, texture.offsetS),
                      mapped(texture.tFromU, texture.tFromV, texture.offsetT),
                      block.color[0] + first, block.color[1] + first, block.color[2] + first);
    }
}

LANES_END
