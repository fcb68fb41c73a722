// TexturedPoints: the points of a wave whose materials have pictures, sorted by material, so that a
// picture is looked up at all of its points at once.
#pragma once

#include "render/point_columns.h"
#include "render/waves/texture_lanes.h"

#include <cstdint>
#include <span>
#include <vector>

class TexturedPoints {
public:
    void clear();
    // So many that follow each other, of one material.
    void add(const SceneMaterial& material, std::uint32_t first, std::uint32_t count);
    // materialAt() for all points that were added: numbers[point] from at[point]. Null `colors`:
    // one by one.
    void apply(TextureColorsFn colors, const PointColumns& at, std::span<Material> numbers) const;

private:
    struct Group {
        const SceneMaterial* material;
        std::vector<std::uint32_t> points;
    };
    std::vector<Group> groups_; // of which `used_` are used
    std::size_t used_ = 0, last_ = 0;
    std::vector<std::uint32_t> others_; // of rarer materials
};
