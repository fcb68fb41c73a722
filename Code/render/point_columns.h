// PointColumns: the points of a wave by component, in blocks; at[k] puts one together.
#pragma once

#include "render/point_block.h"
#include "render/shading.h"

#include <cstdint>
#include <span>
#include <vector>

class PointColumns {
public:
    static constexpr std::size_t kPoints = SurfaceBlock::kPoints;

    void setMaterials(std::span<const SceneMaterial> materials) { materials_ = materials.data(); }
    std::size_t size() const { return blocks_.size() * kPoints; }
    // Room for so many points at least.
    void resize(std::size_t points) { blocks_.resize((points + kPoints - 1) / kPoints); }

    PointBlock& block(std::size_t number) { return blocks_[number]; }
    const PointBlock& block(std::size_t number) const { return blocks_[number]; }
    // Where shapes write surfaces to.
    SurfacePlaces surfaces() { return SurfacePlaces(blocks_.data(), sizeof(PointBlock)); }

    const SceneMaterial& of(std::size_t k) const {
        return materials_[blocks_[k / kPoints].material[k % kPoints]];
    }
    // Inlined: most callers look at a part of it.
    [[gnu::always_inline]] ShadedPoint operator[](std::size_t k) const {
        const PointBlock& block = blocks_[k / kPoints];
        const std::size_t i = k % kPoints;
        ShadedPoint at;
        at.surface = block.at(i);
        at.of = materials_ + at.surface.material;
        at.front = block.isFront(i);
        at.toEye = SurfaceBlock::get(block.toEye, i);
        const float side = at.front ? 1.0f : -1.0f; // times it is exact
        at.eye = {at.surface.ng * side, at.surface.ns * side, SurfaceBlock::get(block.n, i)};
        at.lit = at.eye;
        if (block.isLitApart(i))
            at.lit = {at.surface.ng, at.surface.ns, SurfaceBlock::get(block.litN, i)};
        return at;
    }
    void put(std::size_t k, const ShadedPoint& at) {
        PointBlock& block = blocks_[k / kPoints];
        const std::size_t i = k % kPoints;
        const unsigned bit = 1u << i;
        block.put(i, at.surface);
        SurfaceBlock::set(block.toEye, i, at.toEye);
        SurfaceBlock::set(block.n, i, at.eye.n);
        block.front = at.front ? block.front | bit : block.front & ~bit;
        block.litApart &= ~bit;
        if (!at.of->litOutside || at.front) return;
        block.litApart |= bit;
        SurfaceBlock::set(block.litN, i, at.lit.n);
    }
    Vec2 uv(std::size_t k) const {
        const PointBlock& block = blocks_[k / kPoints];
        return {block.uv[0][k % kPoints], block.uv[1][k % kPoints]};
    }

private:
    std::vector<PointBlock> blocks_;
    const SceneMaterial* materials_ = nullptr; // of the scene
};
