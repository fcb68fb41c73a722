#include "read/txt/read_blocks.h"

#include "base/transform.h"
#include "base/math.h"

#include <algorithm>

namespace {

using Numbers = std::span<const double>;

Vec3d at(Numbers n, std::size_t i) { return {n[i], n[i + 1], n[i + 2]}; }

// The first line is taken as it is: a product with the identity could lose the sign of a zero. No
// inverse is made on the way: nobody asks for it here.
Rows placed(const Rows& before, const Rows& next) {
    return before == kIdentityRows ? next : product(before, next);
}

Rows translate(const Rows& before, Numbers n, std::string_view&) {
    return placed(before, {1, 0, 0, n[0], 0, 1, 0, n[1], 0, 0, 1, n[2]});
}
Rows rotate(const Rows& before, Numbers n, std::string_view& fault) {
    const Vec3d axis = at(n, 1);
    if (axis == Vec3d{}) {
        fault = "the axis of 'rotate' has no direction";
        return before;
    }
    // Its square must not underflow.
    const Vec3d direction = axis / maxAbs(axis);
    return placed(before, Transform::rotate(direction, radians(n[0])).rows());
}
Rows scale(const Rows& before, Numbers n, std::string_view&) {
    return placed(before, {n[0], 0, 0, 0, 0, n[1], 0, 0, 0, 0, n[2], 0});
}
Rows transform(const Rows& before, Numbers n, std::string_view&) {
    Rows rows{};
    std::copy(n.begin(), n.end(), rows.begin());
    return placed(before, rows);
}
Rows lookAt(const Rows& before, Numbers n, std::string_view& fault) {
    if (at(n, 0) == at(n, 3))
        fault = "'look_at' looks at its own place";
    else if (at(n, 6) == Vec3d{})
        fault = "the up direction of 'look_at' is 0 0 0";
    if (!fault.empty()) return before;
    return placed(before, Transform::lookAt(at(n, 0), at(n, 3), at(n, 6)).rows());
}

constexpr auto kLines = std::to_array<TransformLine>({
    {"translate", 3, false, false, translate},
    {"rotate", 4, true, false, rotate},
    {"scale", 3, false, true, scale},
    {"transform", 12, false, false, transform},
    {"look_at", 9, false, false, lookAt},
});

} // namespace

std::span<const TransformLine> transformLines() { return kLines; }

bool isViewAlong(std::span<const double> n) {
    const Vec3d view = at(n, 3) - at(n, 0), up = at(n, 6);
    const double far = maxAbs(view), high = maxAbs(up);
    return far > 0 && high > 0 && !(maxAbs(cross(view / far, up / high)) > 1e-10);
}

bool mayPlace(char first) {
    static constexpr auto kFirst = [] {
        std::array<bool, 256> table{};
        table['k'] = true;
        for (const TransformLine& line : kLines)
            table[static_cast<unsigned char>(line.keyword.front())] = true;
        return table;
    }();
    return kFirst[static_cast<unsigned char>(first)];
}
