// Rays of W hits by columns, and columns of surfaces on their way into blocks of points.
#pragma once

#include "accel/kernels/surface_lanes.h"
#include "accel/kernels/still_numbers.h"
#include "simd/vectors3.h"
#include "base/ray.h"
#include "base/vec.h"
#include "simd/lanes.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>

LANES_BEGIN

struct RaysInLanes {
    Doubles3 org, dir;
    Doubles t;
};

inline Doubles3 along(const Doubles3& from, const Doubles3& dir, const Doubles& t) {
    return {from.x + dir.x * t, from.y + dir.y * t, from.z + dir.z * t};
}

// The rays of W lanes; those behind the last of `which` repeat it.
class RaysOfLanes {
public:
    explicit RaysOfLanes(std::span<const std::uint32_t> which) {
        const std::size_t count = which.size();
        if (count == W) {
            std::memcpy(ray_, which.data(), sizeof ray_);
            return;
        }
        std::copy_n(which.data(), count, ray_);
        std::fill(ray_ + count, ray_ + W, which.back());
    }
    std::uint32_t operator[](std::size_t lane) const { return ray_[lane]; }

private:
    std::uint32_t ray_[W];
};

// The rays of W hits. They are read one register ahead: what was stored number by number can't be
// loaded all at once before it has reached the cache.
class HitRayColumns {
public:
    // Rays that ascend, of which so many differ.
    void read(const RaySpan& rays, std::span<const Hit> hits, const RaysOfLanes& ray,
              std::size_t count) {
        static_assert(offsetof(Hit, u) == offsetof(Hit, t) + sizeof(float));
        Floats t, lost;
        loadPairs([&](std::size_t i) { return &hits[ray[i]].t; }, t, lost);
        t.store(t_), lost.store(lost_);
        const std::size_t first = ray[0];
        if (count == W && ray[W - 1] == first + (W - 1)) {
            readRow(&rays.org[first].x, org_), readRow(&rays.dir[first].x, dir_);
            return;
        }
        for (std::size_t i = 0; i < W; ++i) {
            const Vec3 &from = rays.org[ray[i]], &to = rays.dir[ray[i]]; // g++ 12 copies by memory
            org_[0][i] = from.x, org_[1][i] = from.y, org_[2][i] = from.z;
            dir_[0][i] = to.x, dir_[1][i] = to.y, dir_[2][i] = to.z;
        }
    }
    RaysInLanes lanes() const {
        const auto load = [](const float(&v)[3][W]) {
            return Doubles3::of(Floats::load(v[0]), Floats::load(v[1]), Floats::load(v[2]));
        };
        return {load(org_), load(dir_), Doubles(Floats::load(t_)) + Doubles(Floats::load(lost_))};
    }

private:
    static void readRow(const float* from, float (&to)[3][W]) {
        Floats x, y, z;
        loadVectors(from, x, y, z);
        x.store(to[0]), y.store(to[1]), z.store(to[2]);
    }
    alignas(64) float org_[3][W], dir_[3][W], t_[W], lost_[W];
};

// For each W of so many things, read(first, count, into) one ahead of use(first, count, of).
template <class Columns, class ReadFn, class UseFn>
void readAhead(std::size_t size, const ReadFn& read, const UseFn& use) {
    std::array<Columns, 2> columns;
    const auto countFrom = [&](std::size_t at) { return std::min<std::size_t>(W, size - at); };
    if (size > 0) read(std::size_t{0}, countFrom(0), columns[0]);
    for (std::size_t first = 0; first < size; first += W) {
        const std::size_t next = first + W;
        if (next < size) read(next, countFrom(next), columns[next / W % 2]);
        use(first, countFrom(first), columns[first / W % 2]);
    }
}

struct SurfacesInLanes {
    alignas(64) float p[3][W], n[3][W], error[W];
    alignas(64) std::uint32_t material[W], object[W];
    alignas(64) float uv[2][W];
    unsigned odd = 0; // lanes on an odd square of a plane
    bool hasUv = false;

    // Lane i into place to[i], flat. The blocks know of nothing else.
    void put(std::span<const std::uint32_t> to, const SurfacePlaces& out) const {
        const std::size_t lane = to[0] % SurfaceBlock::kPoints;
        if (to.size() == W && to[W - 1] == to[0] + (W - 1) && lane + W <= SurfaceBlock::kPoints &&
            areInARow(to))
            return putRow(out[to[0]].block, lane);
        for (std::size_t i = 0; i < to.size(); ++i) {
            const auto [block, at] = out[to[i]];
            SurfaceBlock::set(block.p, at, {p[0][i], p[1][i], p[2][i]});
            SurfaceBlock::set(block.ng, at, {n[0][i], n[1][i], n[2][i]});
            block.error[at] = error[i];
            if (hasUv) block.uv[0][at] = uv[0][i], block.uv[1][at] = uv[1][i];
            block.material[at] = material[i], block.object[at] = object[i];
        }
    }

private:
    static bool areInARow(std::span<const std::uint32_t> to) {
        unsigned wrong = 0;
        for (std::uint32_t i = 0; i < W; ++i) wrong |= to[i] ^ (to[0] + i);
        return wrong == 0;
    }
    void putRow(SurfaceBlock& block, std::size_t lane) const {
        for (std::size_t axis = 0; axis < 3; ++axis) {
            std::copy_n(p[axis], W, block.p[axis] + lane);
            std::copy_n(n[axis], W, block.ng[axis] + lane);
        }
        std::copy_n(error, W, block.error + lane);
        if (hasUv)
            for (std::size_t axis = 0; axis < 2; ++axis)
                std::copy_n(uv[axis], W, block.uv[axis] + lane);
        std::copy_n(material, W, block.material + lane);
        std::copy_n(object, W, block.object + lane);
    }
};

// floatAbove() of what is not negative.
inline Floats roundedUp(const Doubles& x) {
    const Floats nearest = x.toFloats();
    return select(Doubles(nearest) < x, nextFloat(nearest), nearest);
}

// Lanes on the odd ones of the squares that a plane is divided into.
inline unsigned oddSquares(Floats u, Floats v) {
    const Floats half = (floor(u) + floor(v)) * Floats(0.5f);
    return bits(floor(half) == half) ^ ((1u << W) - 1);
}

// Rounded, by axis.
inline void store(const Doubles3& v, float (&to)[3][W]) {
    v.x.toFloats().store(to[0]), v.y.toFloats().store(to[1]), v.z.toFloats().store(to[2]);
}

LANES_END
