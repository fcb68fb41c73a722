// Where points and directions are in pictures, and the colours there: Texture and Environment are
// the one lane of it.
#pragma once

#include "base/math.h"
#include "simd/double_double_lanes.h"
#include "simd/lanes.h"
#include "simd/vectors3.h"
#include "texture/picture_lanes.h"
#include "texture/texels_in_lanes.h"

#include <cstddef>

LANES_BEGIN

// From the left and the lower edge of a picture, whose sides are 1.
struct PicturePlaces {
    Doubles s, t;
};
inline PicturePlaces mappedBy(const TextureMap& map, Floats u, Floats v) {
    const auto mapped = [&](double fromU, double fromV, double offset) {
        return Doubles(fromU) * Doubles(u) + Doubles(fromV) * Doubles(v) + Doubles(offset);
    };
    return {mapped(map.sFromU, map.sFromV, map.offsetS),
            mapped(map.tFromU, map.tFromV, map.offsetT)};
}

// Returns the places that directions of any length see.
inline PicturePlaces placesOf(const Environment::View& view, const Floats3& dir) {
    const Doubles minusZero(-0.0), half(0.5);
    const bool isZUp = view.up == Environment::Up::Z;
    const Doubles x(dir.x), y = isZUp ? Doubles(dir.y) : minusZero - Doubles(dir.z);
    const Doubles z(isZUp ? dir.z : dir.y);
    // asin(z) of a unit vector, without its loss of digits near the poles.
    return {half - anglesOf(y, x) * Doubles(kInvTwoPi) + Doubles(view.turns),
            half + anglesOf(z, sqrt(x * x + y * y)) * Doubles(kInvPi)};
}

inline void textureColors(const Texture& texture, TextureBlock& block, std::size_t count) {
    const TexelLanes texels(texture.grid(), texture.extension(), texture.extension(),
                            texture.isAlpha());
    for (std::size_t first = 0; first < count; first += W) {
        const PicturePlaces at =
            mappedBy(texture.map(), Floats::load(block.u + first), Floats::load(block.v + first));
        texels.colors(at.s, at.t, block.color[0] + first, block.color[1] + first,
                      block.color[2] + first);
    }
}

inline void environmentColors(const Environment& environment, EnvironmentBlock& block,
                              std::size_t count) {
    const TexelLanes texels(environment.grid(), Extension::Repeat, Extension::Extend, false);
    for (std::size_t first = 0; first < count; first += W) {
        const auto of = [&](int axis) { return Floats::load(block.dir[axis] + first); };
        const PicturePlaces at = placesOf(environment.view(), {of(0), of(1), of(2)});
        texels.colors(at.s, at.t, block.color[0] + first, block.color[1] + first,
                      block.color[2] + first);
    }
}

inline constexpr PictureLanes kPictures{textureColors, environmentColors};

LANES_END
