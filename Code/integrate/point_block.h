// PointBlock: sixteen points of a wave, component by component, as lanes want them; and PointBatch,
// all points of one. ShadedPoint is one of them in one piece.
#pragma once

#include "base/surface_block.h"
#include "integrate/shading.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <span>
#include <vector>

struct alignas(64) PointBlock : SurfaceBlock {
    alignas(64) Lane toEye[3]; // not right behind the bits
    Lane n[3];                 // eye.n
    Lane litN[3];              // lit.n of those that are lit apart
    // One bit for each point.
    unsigned front = 0;    // the ray came from the outside
    unsigned litApart = 0; // seen from the inside, lit on the outside

    // Place i becomes point `from` of another block.
    void take(std::size_t i, const PointBlock& other, std::size_t from) {
        const auto copy = [&](const auto& source, auto& to) {
            for (std::size_t axis = 0; axis < std::size(to); ++axis)
                to[axis][i] = source[axis][from];
        };
        copy(other.p, p), copy(other.ng, ng), copy(other.uv, uv);
        copy(other.toEye, toEye), copy(other.n, n);
        error[i] = other.error[from], rayError[i] = other.rayError[from];
        material[i] = other.material[from], object[i] = other.object[from];
        const auto bit = [&](unsigned bits) { return (bits >> from & 1) << i; };
        front |= bit(other.front), litApart |= bit(other.litApart), curved |= bit(other.curved);
        if (other.isCurved(from)) copy(other.ns, ns), copy(other.lift, lift);
        if (other.isLitApart(from)) copy(other.litN, litN);
    }
    // Are its normals as they are seen, or turned around?
    bool isFront(std::size_t i) const { return (front >> i & 1) != 0; }
    bool isLitApart(std::size_t i) const { return (litApart >> i & 1) != 0; }
};

// PointColumns: the points of a wave by component, in blocks; at[k] puts one together.

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
    Vec2 uv(std::size_t k) const {
        const PointBlock& block = blocks_[k / kPoints];
        return {block.uv[0][k % kPoints], block.uv[1][k % kPoints]};
    }

private:
    std::vector<PointBlock> blocks_;
    const SceneMaterial* materials_ = nullptr; // of the scene
};

// The points that the rays of a wave have met; element k of every array is point k.
struct PointBatch {
    std::size_t count = 0;             // the arrays may be longer
    std::vector<std::uint32_t> ray;    // ascending
    std::vector<std::uint32_t> missed; // rays that have met nothing, ascending
    std::size_t missedCount = 0;
    std::vector<std::uint32_t> slot; // of its sample
    PointColumns at;
    std::vector<Rgb> weight; // of what the surface sends to the eye

    // Makes room for `most` points; lanes may look at whole blocks.
    void clear(std::size_t most) {
        count = missedCount = 0;
        if (most == 0 || ray.size() >= most) return;
        at.resize(most);
        const std::size_t room = at.size();
        ray.resize(room), missed.resize(room), slot.resize(room), weight.resize(room);
    }
    std::size_t blocks() const {
        return (count + PointColumns::kPoints - 1) / PointColumns::kPoints;
    }
    // How many points of a block there are, and a bit for each.
    std::size_t sizeOf(std::size_t block) const {
        return std::min(count - block * PointColumns::kPoints, PointColumns::kPoints);
    }
    unsigned usedOf(std::size_t block) const { return (1u << sizeOf(block)) - 1; }
};
