// LobeBlock: the lobes of sixteen points whose materials have the same kinds of them, by column.
#pragma once

#include "base/surface_block.h"
#include "scene/lobed_materials.h"
#include "texture/picture_lanes.h"

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>

// Whether Whitted pictures follow rays of such a lobe: all but diffuse ones.
constexpr bool spawnsInWhitted(std::uint32_t flags) {
    return (flags & kSpawnsRays) != 0 && (flags & kDiffuse) == 0;
}

struct alignas(64) LobeBlock {
    static constexpr std::size_t kPoints = SurfaceBlock::kPoints;
    // A block has room for lobes that are written as such, and for four that short keywords mean.
    static constexpr std::size_t kMost = kMostLobes + 4;
    using Lane = float[kPoints];
    struct Column {
        std::uint8_t kind;
        bool covers, isHighlight;
        alignas(64) Lane value[LobeRow::kValues]; // as in LobeRow
    };
    std::size_t count = 0;
    std::uint32_t flags = 0;
    Column lobe[kMost];
    // Points whose lobes differ along and across dp/du, and that direction.
    unsigned turned = 0;
    alignas(64) Lane tangent[3];
    alignas(64) Lane leastAlpha = {}; // of the facets of points (LobeNumbers); begin() leaves it

    // Takes kinds and flags of a material; its numbers become those of all points.
    void begin(const LobedMaterials& materials, const LobedMaterial& of) {
        count = of.lobes, flags = of.flags, turned = 0;
        const std::span<const LobeRow> rows = materials.lobes(of);
        for (std::size_t l = 0; l < count; ++l) {
            lobe[l].kind = rows[l].kind, lobe[l].covers = rows[l].covers;
            lobe[l].isHighlight = rows[l].isHighlight;
            const std::size_t values = valuesOf(rows[l].kind);
            for (std::size_t v = 0; v < values; ++v)
                std::fill_n(lobe[l].value[v], kPoints, rows[l].value[v]);
        }
    }
    // The numbers of point i, of a material with the same signature.
    void put(const LobedMaterials& materials, const LobedMaterial& of, std::size_t i) {
        const std::span<const LobeRow> rows = materials.lobes(of);
        for (std::size_t l = 0; l < count; ++l) {
            const std::size_t values = valuesOf(rows[l].kind);
            for (std::size_t v = 0; v < values; ++v) lobe[l].value[v][i] = rows[l].value[v];
        }
    }
    // Takes a part of point i from another material with the same signature.
    void mix(const LobedMaterials& materials, const LobedMaterial& other, std::size_t i,
             float part) {
        const std::span<const LobeRow> rows = materials.lobes(other);
        for (std::size_t l = 0; l < count; ++l) {
            const std::size_t values = valuesOf(rows[l].kind);
            for (std::size_t v = 0; v < values; ++v) {
                float& value = lobe[l].value[v][i];
                value += (rows[l].value[v] - value) * part;
            }
        }
    }
    // Multiplies the numbers of `points`, which are of this material, by its textures at their
    // coordinates, and over these footprints of all points, if any.
    void paint(const LobedMaterials& materials, const LobedMaterial& of, unsigned points,
               const SurfaceBlock& at, const PictureLanes& pictures,
               const FootprintBlock* footprints = nullptr) {
        const Texture* last = nullptr;
        TextureBlock texels;
        std::size_t found = 0;
        std::uint8_t point[kPoints];
        texels.isFiltered = footprints != nullptr;
        for (; points != 0; points &= points - 1) {
            const auto i = static_cast<std::size_t>(std::countr_zero(points));
            texels.u[found] = at.uv[0][i], texels.v[found] = at.uv[1][i];
            if (footprints != nullptr)
                for (std::size_t axis = 0; axis < 2; ++axis) {
                    texels.along[axis][found] = footprints->along[axis][i];
                    texels.across[axis][found] = footprints->across[axis][i];
                }
            point[found++] = static_cast<std::uint8_t>(i);
        }
        for (const LobeFactor& factor : materials.factors(of)) {
            if (factor.texture != last) pictures.texture(*factor.texture, texels, found);
            last = factor.texture;
            for (std::size_t k = 0; k < found; ++k)
                multiply(factor, point[k],
                         {texels.color[0][k], texels.color[1][k], texels.color[2][k]});
        }
    }

private:
    void multiply(const LobeFactor& factor, std::size_t i, Rgb color) {
        auto* const value = &lobe[factor.lobe].value[factor.first];
        const auto times = [&](float& number, float texel) {
            number = clamp(number * (factor.a + factor.b * texel), factor.least, factor.most);
        };
        if (factor.count == 1) return times(value[0][i], factor.texture->valueOf(color));
        times(value[0][i], color.r), times(value[1][i], color.g), times(value[2][i], color.b);
    }
    static std::size_t valuesOf(std::uint8_t kind) {
        std::size_t values = 3;
        for (const LobeField& field : lobeTypes()[kind].fields)
            values += static_cast<std::size_t>(field.count);
        return values;
    }
};
