// Where points and directions are in pictures, and the colours there: Texture and Environment are
// the one lane of it.
#pragma once

#include "sample/equirectangular.h"
#include "simd/lanes.h"
#include "texture/box_checker_in_lanes.h"
#include "texture/filtered_in_lanes.h"
#include "texture/footprint_in_lanes.h"
#include "texture/picture_lanes.h"
#include "texture/texels_in_lanes.h"

#include <cstddef>

LANES_BEGIN

// Returns where points are looked up.
inline PicturePlaces mappedBy(const TextureMap& map, Floats u, Floats v) {
    const auto mapped = [&](double fromU, double fromV, double offset) {
        return Doubles(fromU) * Doubles(u) + Doubles(fromV) * Doubles(v) + Doubles(offset);
    };
    return {mapped(map.sFromU, map.sFromV, map.offsetS),
            mapped(map.tFromU, map.tFromV, map.offsetT)};
}

inline void filteredColors(const Texture& texture, TextureBlock& block, std::size_t count) {
    const FilteredTexels texels(texture);
    for (std::size_t first = 0; first < count; first += W) {
        const auto of = [&](const float* from) { return Floats::load(from + first); };
        const Floats3 mean = texels.colors(
            mappedBy(texture.map(), of(block.u), of(block.v)),
            axesOf(texture.map(), of(block.along[0]), of(block.along[1]), of(block.across[0]),
                   of(block.across[1])));
        mean.x.store(block.color[0] + first), mean.y.store(block.color[1] + first);
        mean.z.store(block.color[2] + first);
    }
}

inline void textureColors(const Texture& texture, TextureBlock& block, std::size_t count) {
    if (block.isFiltered) return filteredColors(texture, block, count);
    const TexelLanes texels(texture.grid(), texture.extension(), texture.extension(),
                            texture.isAlpha());
    for (std::size_t first = 0; first < count; first += W) {
        const PicturePlaces at =
            mappedBy(texture.map(), Floats::load(block.u + first), Floats::load(block.v + first));
        texels.colors(at.s, at.t, block.color[0] + first, block.color[1] + first,
                      block.color[2] + first);
    }
}

// Returns Environment::radiance() of W directions.
inline Floats3 environmentColor(const Environment& environment, const Floats3& dir) {
    const TexelLanes texels(environment.grid(), Extension::Repeat, Extension::Extend, false);
    const PicturePlaces at = placesOf(environment.place(), dir);
    alignas(64) float color[3][W];
    texels.colors(at.s, at.t, color[0], color[1], color[2]);
    return {Floats::load(color[0]), Floats::load(color[1]), Floats::load(color[2])};
}

inline void environmentColors(const Environment& environment, EnvironmentBlock& block,
                              std::size_t count) {
    for (std::size_t first = 0; first < count; first += W) {
        const auto of = [&](int axis) { return Floats::load(block.dir[axis] + first); };
        const Floats3 color = environmentColor(environment, {of(0), of(1), of(2)});
        color.x.store(block.color[0] + first), color.y.store(block.color[1] + first);
        color.z.store(block.color[2] + first);
    }
}

inline constexpr PictureLanes kPictures{textureColors, environmentColors, findFootprints,
                                           findOddParts};

LANES_END
