// PointLists: the points of a wave whose surfaces are to be found, listed by what finds them.
#pragma once

#include "accel/still_shape.h"
#include "base/raw_vector.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>

class PointLists {
public:
    // Numbers of lists: of still shapes by kind, without texture coordinates and with, then the
    // others.
    static constexpr std::size_t onStills(StillShape::Kind kind, bool wantsUv) {
        return 2 * static_cast<std::size_t>(kind) + (wantsUv ? 1 : 0);
    }
    static constexpr std::size_t kOnOthers = 2 * StillShape::kKinds, kLists = kOnOthers + 1;

    // Empties all. Each can take `most`; what it doesn't take isn't touched.
    void clear(std::size_t most) {
        if (room_ < most) {
            room_ = most;
            rays_ = RawVector<std::uint32_t>(kLists * most);
            points_ = RawVector<std::uint32_t>(kLists * most);
            shapes_ = std::make_unique_for_overwrite<const StillShape*[]>(kOnOthers * most);
        }
        for (std::size_t list = 0; list < kLists; ++list) ends_[list] = list * room_;
    }
    // `shape`: of those on still shapes.
    void push(std::size_t list, std::uint32_t ray, std::uint32_t point, const StillShape* shape) {
        const std::size_t at = ends_[list]++;
        rays_[at] = ray, points_[at] = point;
        if (list < kOnOthers) shapes_[at] = shape;
    }
    // So many that follow each other, on one shape. Inlined: of a number that is known.
    [[gnu::always_inline]] void pushAlike(std::size_t list, const std::uint32_t* rays,
                                          std::uint32_t firstPoint, std::uint32_t count,
                                          const StillShape* shape) {
        const std::size_t at = ends_[list];
        ends_[list] += count;
        std::copy_n(rays, count, &rays_[at]);
        for (std::uint32_t i = 0; i < count; ++i) points_[at + i] = firstPoint + i;
        if (list < kOnOthers) std::fill_n(&shapes_[at], count, shape);
    }

    std::span<const std::uint32_t> rays(std::size_t list) const { return of(rays_.data(), list); }
    std::span<const std::uint32_t> points(std::size_t list) const {
        return of(points_.data(), list);
    }
    // Of lists of still shapes.
    std::span<const StillShape* const> shapes(std::size_t list) const {
        return of(shapes_.get(), list);
    }

private:
    template <class T> std::span<const T> of(const T* all, std::size_t list) const {
        const std::size_t begin = list * room_;
        return {all + begin, ends_[list] - begin};
    }

    std::size_t room_ = 0; // of each list
    std::array<std::size_t, kLists> ends_{};
    RawVector<std::uint32_t> rays_, points_;      // list after list
    std::unique_ptr<const StillShape*[]> shapes_; // the same
};
