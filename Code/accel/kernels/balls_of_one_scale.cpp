#include "accel/kernels/balls_of_one_scale.h"

#include <algorithm>

namespace {

// 0: it is no ball.
double scaleOf(const SolidTree::Solid& solid) {
    if (solid.meets != SolidTree::Meets::Sphere || solid.turned) return 0;
    const AffineRows& m = solid.shape->objectFromWorld();
    return m[0] == m[5] && m[0] == m[10] ? m[0] : 0;
}

SolidTree::Ball ballOf(const SolidTree::Solid& solid) {
    const AffineRows& m = solid.shape->objectFromWorld();
    return {{m[3], m[7], m[11]}, solid.shape->radius};
}

} // namespace

BallsOfOneScale::BallsOfOneScale(std::size_t solids, std::size_t together)
    : together_(together), parts_((solids + together - 1) / together), isBall_(solids, 0) {
    balls_.resize(solids);
}

void BallsOfOneScale::look(std::size_t place, const SolidTree::Solid& solid) {
    constexpr std::size_t kSome = 32;
    Part& part = parts_[place / together_];
    // After some of which few are balls, the others are not looked at.
    if (part.balls + kSome < place % together_ / 2) return;
    const double scale = scaleOf(solid);
    if (scale == 0) return;
    ++part.seen;
    if (scale != part.scale) {
        if (2 * part.balls >= part.seen) return;
        // Most so far are of another scale than the one that was kept.
        part.scale = scale, part.balls = 0;
        const auto here = isBall_.begin() + static_cast<std::ptrdiff_t>(place);
        std::fill(here - static_cast<std::ptrdiff_t>(place % together_), here, std::uint8_t{0});
    }
    balls_[place] = ballOf(solid);
    isBall_[place] = 1, ++part.balls;
}

void BallsOfOneScale::decide() {
    const auto most =
        std::max_element(parts_.begin(), parts_.end(),
                         [](const Part& a, const Part& b) { return a.balls < b.balls; });
    if (most != parts_.end()) scale_ = most->scale;
    for (const Part& part : parts_) count_ += part.scale == scale_ ? part.balls : 0;
}
