// The surfaces of W hits on balls: still_surfaces.inl with numbers of which most are constants.
#pragma once

#include "accel/kernels/still_balls.h"
#include "accel/kernels/still_numbers.h"
#include "accel/kernels/still_surfaces_in_lanes.h"
#include "accel/kernels/surface_columns.h"
#include "simd/lanes.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>

LANES_BEGIN

// The balls of W hits and their rays.
struct BallColumns {
    void read(const BallsMet& met, const RaysOfLanes& ray, std::size_t count) {
        rays.read(met.rays, met.hits, ray, count);
        static_assert(offsetof(StillBalls::Ball, radius) == 3 * sizeof(double));
        const double* row[W];
        for (std::size_t i = 0; i < W; ++i) {
            const StillBalls::Ball& ball = met.balls[met.hits[ray[i]].shape];
            row[i] = &ball.centre.x, leastError[i] = ball.leastError;
            material[i] = ball.material, object[i] = ball.object;
        }
        storeRows(row, place);
    }
    HitRayColumns rays;
    alignas(64) double place[4][W], leastError[W]; // place: centre and radius
    alignas(64) std::uint32_t material[W], object[W];
};

// The numbers of a ball for each lane.
class NumbersOfBalls {
public:
    // The zeros of the maps are left out: they would add +0 or -0 to a product, which changes
    // nothing but the sign of a zero. Points lose that sign where the offset is added, which is not
    // 0; what is mapped without an offset are differences and what is made of sums, whose zeros are
    // +0 and stay so under a map that does not mirror.
    static constexpr bool kScales = true;

    NumbersOfBalls(const StillBalls::Shared& shared, const BallColumns& columns)
        : scale_(shared.scale), back_(shared.back), errorPerPlace_(shared.errorPerPlace),
          columns_(columns) {}
    [[gnu::always_inline]] Doubles operator()(std::size_t number) const {
        switch (number) {
        case WorldFromObject:
        case WorldFromObject + 5:
        case WorldFromObject + 10: return scale_;
        case WorldFromObject + 3: return Doubles::load(columns_.place[0]);
        case WorldFromObject + 7: return Doubles::load(columns_.place[1]);
        case WorldFromObject + 11: return Doubles::load(columns_.place[2]);
        case ObjectFromWorld:
        case ObjectFromWorld + 5:
        case ObjectFromWorld + 10: return back_;
        case ObjectFromWorld + 3: return backTo(0);
        case ObjectFromWorld + 7: return backTo(1);
        case ObjectFromWorld + 11: return backTo(2);
        case Radius: return Doubles::load(columns_.place[3]);
        case LeastError: return Doubles::load(columns_.leastError);
        case ErrorPerPlace: return errorPerPlace_;
        default: return Doubles(0.0);
        }
    }

private:
    [[gnu::always_inline]] Doubles backTo(std::size_t axis) const {
        return Doubles(-0.0) - back_ * Doubles::load(columns_.place[axis]);
    }
    Doubles scale_, back_, errorPerPlace_;
    const BallColumns& columns_;
};

void ballSurfaces(const BallsMet& met, SurfacePlaces out) {
    SurfacesInLanes found;
    const auto read = [&](std::size_t first, std::size_t count, BallColumns& balls) {
        balls.read(met, RaysOfLanes(met.which.subspan(first, count)), count);
    };
    readAhead<BallColumns>(met.which.size(), read,
                           [&](std::size_t first, std::size_t count, const BallColumns& balls) {
                               const RaysInLanes rays = balls.rays.lanes();
                               describe<Kind::Sphere>(NumbersOfBalls(met.balls.shared(), balls),
                                                      rays, rays.dir, found);
                               std::copy_n(balls.material, W, found.material);
                               std::copy_n(balls.object, W, found.object);
                               found.put(met.to.subspan(first, count), out);
                           });
}

LANES_END
