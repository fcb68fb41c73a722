// SurfaceBlock: the surfaces at sixteen points, component by component, as lanes want them.
#pragma once

#include "base/ray.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>

struct alignas(64) SurfaceBlock {
    static constexpr std::size_t kPoints = 16;
    using Lane = float[kPoints];
    Lane p[3], ng[3];
    Lane ns[3], lift[3]; // of the curved ones only: others have ng and nothing
    Lane uv[2], error, rayError;
    std::uint32_t material[kPoints], object[kPoints];
    unsigned curved = 0; // one bit for each point

    void put(std::size_t i, const Surface& s) {
        set(p, i, s.p), set(ng, i, s.ng);
        uv[0][i] = s.uv.x, uv[1][i] = s.uv.y;
        error[i] = s.error, rayError[i] = s.rayError;
        material[i] = s.material, object[i] = s.object;
        const unsigned bit = 1u << i;
        curved &= ~bit;
        // Bit by bit: zeros keep their signs.
        using Bits = std::array<std::uint32_t, 3>;
        const auto bits = [](Vec3 v) { return std::bit_cast<Bits>(v); };
        if (bits(s.ns) == bits(s.ng) && bits(s.lift) == Bits{}) return;
        set(ns, i, s.ns), set(lift, i, s.lift);
        curved |= bit;
    }
    // Before its points are put one by one: those that lanes write have normals of the geometry
    // only, and no texture coordinates.
    void clear() {
        for (float* const lane : {uv[0], uv[1], rayError}) std::fill_n(lane, kPoints, 0.0f);
        curved = 0;
    }
    bool isCurved(std::size_t i) const { return (curved >> i & 1) != 0; }
    Surface at(std::size_t i) const {
        const Vec3 flat = get(ng, i);
        return {.p = get(p, i),
                .ng = flat,
                .ns = isCurved(i) ? get(ns, i) : flat,
                .uv = {uv[0][i], uv[1][i]},
                .material = material[i],
                .object = object[i],
                .error = error[i],
                .rayError = rayError[i],
                .lift = isCurved(i) ? get(lift, i) : Vec3{}};
    }

    static void set(Lane (&to)[3], std::size_t i, Vec3 v) {
        to[0][i] = v.x, to[1][i] = v.y, to[2][i] = v.z;
    }
    static Vec3 get(const Lane (&from)[3], std::size_t i) {
        return {from[0][i], from[1][i], from[2][i]};
    }
};

// Surfaces are written to place k of a row of blocks, each of which may be part of something
// larger: out[k].put(surface).
class SurfacePlaces {
public:
    // `first` is the surface part of the first block, which is `step` bytes before that of the
    // next.
    explicit SurfacePlaces(SurfaceBlock* first, std::size_t step = sizeof(SurfaceBlock))
        : first_(reinterpret_cast<std::byte*>(first)), step_(step) {}

    struct Place {
        SurfaceBlock& block;
        std::size_t lane;
        void put(const Surface& surface) const { block.put(lane, surface); }
        Surface surface() const { return block.at(lane); }
    };
    Place operator[](std::size_t k) const {
        return {block(k / SurfaceBlock::kPoints), k % SurfaceBlock::kPoints};
    }
    // The block of which these are all the places, in order; null: they are not.
    SurfaceBlock* whole(std::span<const std::uint32_t> places) const {
        constexpr std::size_t kAll = SurfaceBlock::kPoints;
        if (places.size() != kAll || places[0] % kAll != 0) return nullptr;
        for (std::size_t i = 1; i < kAll; ++i)
            if (places[i] != places[0] + i) return nullptr;
        return &block(places[0] / kAll);
    }
    SurfaceBlock& block(std::size_t number) const {
        return *reinterpret_cast<SurfaceBlock*>(first_ + number * step_);
    }

private:
    std::byte* first_;
    std::size_t step_;
};
