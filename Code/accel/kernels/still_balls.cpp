#include "accel/kernels/still_balls.h"

#include <bit>

namespace {

// Lanes repeat the steps of the whole map, in which zeros have signs.
bool sameBits(double a, double b) {
    return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
}

// Is the linear part s times the identity?
bool scalesBy(double s, const AffineRows& map) {
    for (std::size_t row = 0; row < 3; ++row)
        for (std::size_t column = 0; column < 3; ++column)
            if (!sameBits(map[4 * row + column], row == column ? s : 0.0)) return false;
    return true;
}

} // namespace

bool StillBalls::take(std::size_t number, const StillShape& shape) {
    if (shape.kind != StillShape::Kind::Sphere) return false;
    const AffineRows& there = shape.worldFromObject.rows();
    const AffineRows& back = shape.objectFromWorld();
    const Shared shared{there[0], back[0], shape.errorPerPlace};
    if (!scalesBy(shared.scale, there) || !scalesBy(shared.back, back)) return false;
    if (!(shared.scale > 0 && shared.back > 0)) return false;
    for (const std::size_t offset : {3u, 7u, 11u})
        if (back[offset] == 0 || !sameBits(back[offset], -(shared.back * there[offset])))
            return false;
    if (isEmpty()) {
        shared_ = shared;
        isBall_.resize(count_), balls_.resize(count_);
    }
    if (!(shared == shared_)) return false;
    isBall_[number] = 1;
    balls_[number] = {shape.worldFromObject.translation(), shape.radius, shape.leastError,
                      shape.material, shape.object};
    return true;
}
