// The adversarial triangles of meshes.h: almost degenerate ones, and those of whole numbers.
#include "verify/meshes.h"

#include <cmath>

namespace meshes {

std::vector<std::array<Vec3, 3>> soup(Random& random, std::size_t count) {
    std::vector<std::array<Vec3, 3>> out;
    const auto add = [&](Vec3d a, Vec3d b, Vec3d c) {
        out.push_back({toFloat(a), toFloat(b), toFloat(c)});
    };
    while (out.size() < count) {
        const Vec3d p = random.inBox(1);
        switch (random.below(11)) {
        case 0: { // needle
            const Vec3d along = random.direction() * random.logUniform(0.1, 2);
            add(p, p + along,
                p + along * random.unit() +
                    random.direction() * (length(along) * random.logUniform(1e-7, 1e-3)));
            break;
        }
        case 1: { // coplanar stack
            const Vec3d e = random.direction(), f = random.direction();
            for (int i = 0; i < 4; ++i)
                add(p, p + e * random.uniform(0.2, 1), p + f * random.uniform(0.2, 1));
            break;
        }
        case 2: { // duplicates, also with the corners turned
            const Vec3d q = random.inBox(1), r = random.inBox(1);
            add(p, q, r), add(p, q, r), add(q, r, p), add(p, r, q);
            break;
        }
        case 3: { // in an axis plane
            const auto axis = static_cast<std::size_t>(random.below(3));
            Vec3d q = random.inBox(1), r = random.inBox(1), o = p;
            o[axis] = q[axis] = r[axis] = random.below(5) * 0.25 - 0.5;
            add(o, q, r);
            if (random.chance(0.5)) add(q, o, random.chance(0.5) ? r : Vec3d{q.x, o.y, r.z});
            break;
        }
        case 4: { // tiny
            const double size = random.logUniform(1e-6, 1e-2);
            add(p, p + random.direction() * size, p + random.direction() * size);
            break;
        }
        case 5: // huge
            if (random.chance(0.8)) break;
            add(p * 100.0, random.inBox(100), random.inBox(100));
            break;
        case 6: { // collinear, or nearly
            const Vec3d q = random.inBox(1);
            const Vec3d off = random.chance(0.5) ? Vec3d{} : random.direction() * 1e-8;
            add(p, q, lerp(p, q, random.uniform(-0.5, 1.5)) + off);
            break;
        }
        case 7: { // fan about p
            const Vec3d e = random.direction(), f = random.direction();
            Vec3d last = p + e * 0.3;
            for (int i = 1; i <= 6; ++i) {
                const Vec3d next = p + (e * std::cos(i * 0.9) + f * std::sin(i * 0.9)) * 0.3;
                add(p, last, next);
                last = next;
            }
            break;
        }
        case 8: add(p, p, random.chance(0.5) ? p : random.inBox(1)); break; // point, segment
        case 9: { // sliver in an axis plane
            const auto axis = static_cast<std::size_t>(random.below(3));
            Vec3d q = random.inBox(1), r = q;
            q[axis] = r[axis] = p[axis];
            r[(axis + 1) % 3] += random.logUniform(1e-7, 1e-3);
            add(p, q, r);
            break;
        }
        default: add(p, random.inBox(1), random.inBox(1));
        }
    }
    out.resize(count);
    return out;
}

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
