#include "sample/warp.h"

#include "base/math.h"

namespace {

struct Circle {
    double x, y;
};
// The angle 2 pi u.
Circle circlePoint(float u) {
    const auto [s, c] = exact::sinCos(kTwoPi * static_cast<double>(u));
    return {c, s};
}

double squareRoot(double x) { return std::sqrt(max(x, 0.0)); }

// A direction at cosine c and sine s from +z, turned by 2 pi u about it.
Vec3 direction(double c, double s, float u) {
    const Circle circle = circlePoint(u);
    return toFloat({s * circle.x, s * circle.y, c});
}

} // namespace

Vec2 diskFromSquare(Vec2 u) {
    const double x = 2 * static_cast<double>(u.x) - 1, y = 2 * static_cast<double>(u.y) - 1;
    if (x == 0 && y == 0) return {};
    const bool isSide = std::fabs(x) > std::fabs(y);
    const double radius = isSide ? x : y;
    const auto [s, c] = exact::sinCos(kPi / 4 * (isSide ? y / x : x / y));
    return {static_cast<float>(radius * (isSide ? c : s)),
            static_cast<float>(radius * (isSide ? s : c))};
}

Polygon::Polygon(int blades, double rotationRad) : blades_(blades < 3 ? 0 : blades) {
    if (blades_ == 0) return;
    const double step = kTwoPi / blades_;
    for (int i = 0; i <= blades_; ++i) {
        const auto corner = exact::sinCos(rotationRad + i * step);
        corners_.push_back(corner.cos), corners_.push_back(corner.sin);
    }
}

// u.x picks the triangle of two neighbouring corners and the centre, and the place across it;
// sqrt(u.y) is the distance from the centre.
Vec2 Polygon::fromSquare(Vec2 u) const {
    if (blades_ == 0) return diskFromSquare(u);
    const double place = static_cast<double>(u.x) * blades_;
    const double blade = std::floor(place), across = place - blade;
    const double* const from = corners_.data() + 2 * static_cast<std::size_t>(blade);
    const double radius = std::sqrt(static_cast<double>(u.y));
    return {static_cast<float>(radius * lerp(from[0], from[2], across)),
            static_cast<float>(radius * lerp(from[1], from[3], across))};
}

Vec3 coneFromSquare(Vec2 u, double oneMinusCos) {
    const double h = oneMinusCos * static_cast<double>(u.x); // 1 - cos of the direction
    return direction(1 - h, squareRoot(h * (2 - h)), u.y);
}

Vec3 sphereFromSquare(Vec2 u) { return coneFromSquare(u, 2); }

Vec3 cosineHemisphereFromSquare(Vec2 u) {
    const Vec2 d = diskFromSquare(u); // lifted to the sphere (Malley)
    const double x = static_cast<double>(d.x), y = static_cast<double>(d.y);
    return {d.x, d.y, static_cast<float>(squareRoot(1 - x * x - y * y))};
}

Vec3 cosinePowerFromSquare(Vec2 u, float exponent) {
    // The distribution of the cosine is cos^(n+1). 1 - c has an error of 1e-16, the sine one of
    // 1e-16 over itself: below a float's last place down to angles of 1e-8.
    const double c =
        exact::pow(1 - static_cast<double>(u.x), 1 / (static_cast<double>(exponent) + 1));
    return direction(c, squareRoot((1 - c) * (1 + c)), u.y);
}

Frame frameAround(Vec3 unitZ) {
    const double x = static_cast<double>(unitZ.x), y = static_cast<double>(unitZ.y);
    const double z = static_cast<double>(unitZ.z);
    const double sign = std::copysign(1.0, z);
    const double a = -1 / (sign + z), b = x * y * a;
    return {toFloat({1 + sign * x * x * a, sign * b, -sign * x}),
            toFloat({b, sign + y * y * a, -y}), unitZ};
}
