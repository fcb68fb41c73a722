// Points, turns and triangles of whole numbers: see meshes.h.
#include "verify/meshes.h"

namespace meshes {

Vec3 latticePoint(Random& random, std::uint32_t half) {
    const auto coordinate = [&] {
        const float x = static_cast<float>(random.below(2 * half + 1)) - static_cast<float>(half);
        return x == 0 && random.chance(0.5) ? -0.0f : x;
    };
    Vec3 p;
    for (std::size_t axis = 0; axis < 3; ++axis) p[axis] = coordinate();
    return p;
}

Transform quarterTurn(Random& random) {
    const std::size_t x = random.below(3), y = (x + 1 + random.below(2)) % 3, z = 3 - x - y;
    const auto sign = [&] { return random.chance(0.5) ? 1.0 : -1.0; };
    Transform::Rows rows{};
    rows[x] = sign(), rows[4 + y] = sign(), rows[8 + z] = sign();
    return Transform::fromRows(rows);
}

std::vector<std::array<Vec3, 3>> latticeSoup(Random& random, std::size_t count,
                                             std::uint32_t half) {
    std::vector<std::array<Vec3, 3>> out;
    while (out.size() < count) {
        const Vec3 p = latticePoint(random, half);
        switch (random.below(4)) {
        case 0: { // a rectangle in an axis plane
            const auto axis = random.below(3);
            const Vec3 size = latticePoint(random, half);
            Vec3 a = p, b = p, c = p;
            a[(axis + 1) % 3] += size.x, c[(axis + 2) % 3] += size.y;
            b[(axis + 1) % 3] = a[(axis + 1) % 3], b[(axis + 2) % 3] = c[(axis + 2) % 3];
            out.push_back({p, a, b}), out.push_back({p, b, c});
            break;
        }
        case 1: { // small, and the same the other way round
            const Vec3 q = p + latticePoint(random, 1), r = p + latticePoint(random, 1);
            out.push_back({p, q, r});
            if (random.chance(0.3)) out.push_back({p, r, q});
            break;
        }
        case 2: { // edges that go on through the origin of coordinates
            const Vec3 q = p * static_cast<float>(2 + random.below(3));
            out.push_back({p, q, latticePoint(random, half)});
            break;
        }
        default: out.push_back({p, latticePoint(random, half), latticePoint(random, half)});
        }
    }
    out.resize(count);
    return out;
}

} // namespace meshes
