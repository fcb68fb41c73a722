// The adversarial triangles of meshes.h.
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

} // namespace meshes
