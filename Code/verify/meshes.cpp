#include "verify/meshes.h"

#include "base/math.h"
#include "shape/mesh_instance.h"

#include <algorithm>
#include <map>
#include <utility>

namespace meshes {

using Corners = MeshDesc::Corners;

double Random::logUniform(double lo, double hi) {
    return lo * exact::exp(unit() * exact::log(hi / lo));
}

Vec3d Random::inBox(double half) {
    const double x = uniform(-half, half), y = uniform(-half, half);
    return {x, y, uniform(-half, half)};
}

Vec3d Random::direction() {
    for (;;) {
        const Vec3d v = inBox(1);
        const double l = length(v);
        if (l > 0.01 && l <= 1) return v / l;
    }
}

Transform Random::affine(double stretch, double shift) {
    Vec3d factors;
    for (std::size_t i = 0; i < 3; ++i)
        factors[i] = logUniform(1 / stretch, stretch) * (chance(0.5) ? 1 : -1);
    const Vec3d axis1 = direction(), axis2 = direction();
    const double turn1 = uniform(0, kTwoPi), turn2 = uniform(0, kTwoPi);
    const Vec3d offset = shift > 0 ? inBox(shift) : Vec3d{};
    return Transform::translate(offset) * Transform::rotate(axis1, turn1) *
           Transform::scale(factors) * Transform::rotate(axis2, turn2);
}

MeshDesc uvSphere(int segments, int rings) {
    MeshDesc mesh;
    const auto number = [&](int ring, int segment) {
        if (ring == 0) return 0u;
        if (ring == rings) return 1u;
        return static_cast<std::uint32_t>(2 + (ring - 1) * segments + segment % segments);
    };
    mesh.points = {{0, 0, 1}, {0, 0, -1}};
    for (int ring = 1; ring < rings; ++ring) {
        for (int segment = 0; segment < segments; ++segment) {
            const double theta = kPi * ring / rings, phi = kTwoPi * segment / segments;
            mesh.points.push_back({std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi),
                                   std::cos(theta)});
        }
    }
    for (const Vec3d p : mesh.points) mesh.normals.push_back(toFloat(normalize(p)));
    // Coordinates have their own grid: the seam has two.
    for (int ring = 0; ring <= rings; ++ring)
        for (int segment = 0; segment <= segments; ++segment)
            mesh.uvs.push_back({static_cast<float>(segment) / static_cast<float>(segments),
                                1 - static_cast<float>(ring) / static_cast<float>(rings)});
    const auto uvNumber = [&](int ring, int segment) {
        return static_cast<std::uint32_t>(ring * (segments + 1) + segment);
    };
    const auto add = [&](int r0, int s0, int r1, int s1, int r2, int s2) {
        mesh.triangles.push_back({number(r0, s0), number(r1, s1), number(r2, s2)});
        mesh.uvTriangles.push_back({uvNumber(r0, s0), uvNumber(r1, s1), uvNumber(r2, s2)});
    };
    for (int r = 0; r < rings; ++r) {
        for (int s = 0; s < segments; ++s) {
            if (r + 1 < rings) add(r, s, r + 1, s, r + 1, s + 1);
            if (r > 0) add(r, s, r + 1, s + 1, r, s + 1);
        }
    }
    mesh.normalTriangles = mesh.triangles;
    return mesh;
}

MeshDesc icosphere(int level) {
    MeshDesc mesh;
    const double g = (1 + std::sqrt(5.0)) / 2;
    for (const double a : {-1.0, 1.0}) {
        for (const double b : {-g, g}) {
            mesh.points.push_back(normalize(Vec3d{0, a, b}));
            mesh.points.push_back(normalize(Vec3d{a, b, 0}));
            mesh.points.push_back(normalize(Vec3d{b, 0, a}));
        }
    }
    // The faces are the triples of neighbours; their distance is 2 in units of the rectangles.
    const double edge = 2 / std::sqrt(1 + g * g);
    const auto near = [&](std::uint32_t i, std::uint32_t j) {
        return length(mesh.points[i] - mesh.points[j]) < edge * 1.1;
    };
    for (std::uint32_t i = 0; i < 12; ++i)
        for (std::uint32_t j = i + 1; j < 12; ++j)
            for (std::uint32_t k = j + 1; k < 12; ++k)
                if (near(i, j) && near(j, k) && near(k, i)) {
                    const Vec3d p = mesh.points[i], q = mesh.points[j], r = mesh.points[k];
                    const bool outward = dot(cross(q - p, r - p), p) > 0;
                    mesh.triangles.push_back(outward ? Corners{i, j, k} : Corners{i, k, j});
                }
    for (int l = 0; l < level; ++l) {
        std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
        const auto middle = [&](std::uint32_t i, std::uint32_t j) {
            const auto [at, isNew] = middles.try_emplace(
                std::minmax(i, j), static_cast<std::uint32_t>(mesh.points.size()));
            if (isNew) mesh.points.push_back(normalize(mesh.points[i] + mesh.points[j]));
            return at->second;
        };
        std::vector<Corners> finer;
        for (const Corners c : mesh.triangles) {
            const std::uint32_t a = middle(c[0], c[1]), b = middle(c[1], c[2]),
                                d = middle(c[2], c[0]);
            finer.insert(finer.end(), {{c[0], a, d}, {c[1], b, a}, {c[2], d, b}, {a, b, d}});
        }
        mesh.triangles = finer;
    }
    return mesh;
}

MeshDesc torus(double tubeRadius, int around, int across) {
    MeshDesc mesh;
    for (int i = 0; i < around; ++i) {
        for (int j = 0; j < across; ++j) {
            const double a = kTwoPi * i / around, b = kTwoPi * j / across;
            const double r = 1 + tubeRadius * std::cos(b);
            mesh.points.push_back({r * std::cos(a), r * std::sin(a), tubeRadius * std::sin(b)});
        }
    }
    const auto number = [&](int i, int j) {
        return static_cast<std::uint32_t>(i % around * across + j % across);
    };
    for (int i = 0; i < around; ++i) {
        for (int j = 0; j < across; ++j) {
            mesh.triangles.push_back({number(i, j), number(i + 1, j), number(i + 1, j + 1)});
            mesh.triangles.push_back({number(i, j), number(i + 1, j + 1), number(i, j + 1)});
        }
    }
    return mesh;
}

MeshDesc cube() {
    MeshDesc mesh;
    const BoundsD box{{-1, -1, -1}, {1, 1, 1}};
    for (int i = 0; i < 8; ++i) mesh.points.push_back(box.corner(i));
    const auto quad = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
        mesh.triangles.push_back({a, b, c});
        mesh.triangles.push_back({a, c, d});
    };
    quad(0, 4, 6, 2), quad(1, 3, 7, 5); // -x, +x
    quad(0, 1, 5, 4), quad(2, 6, 7, 3); // -y, +y
    quad(0, 2, 3, 1), quad(4, 5, 7, 6); // -z, +z
    return mesh;
}

MeshDesc doubleFan(int valence) {
    MeshDesc mesh;
    mesh.points = {{0, 0, 0.3}, {0, 0, -0.3}};
    for (int i = 0; i < valence; ++i) {
        const double a = kTwoPi * i / valence;
        mesh.points.push_back({std::cos(a), std::sin(a), 0});
    }
    for (int i = 0; i < valence; ++i) {
        const auto p = static_cast<std::uint32_t>(2 + i);
        const auto q = static_cast<std::uint32_t>(2 + (i + 1) % valence);
        mesh.triangles.push_back({0, p, q});
        mesh.triangles.push_back({1, q, p});
    }
    return mesh;
}

namespace {

void addTetra(MeshDesc& mesh, int depth, Vec3d centre, double half) {
    // The corners of the cube with x*y*z > 0.
    const Vec3d corners[4] = {{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}};
    if (depth > 0) {
        for (const Vec3d c : corners) addTetra(mesh, depth - 1, centre + c * (half / 2), half / 2);
        return;
    }
    const auto first = static_cast<std::uint32_t>(mesh.points.size());
    for (const Vec3d c : corners) mesh.points.push_back(centre + c * half);
    for (std::uint32_t left = 0; left < 4; ++left) {
        std::array<std::uint32_t, 3> face{};
        for (std::uint32_t i = 0, n = 0; i < 4; ++i)
            if (i != left) face[n++] = i;
        const Vec3d p = corners[face[0]], q = corners[face[1]], r = corners[face[2]];
        if (dot(cross(q - p, r - p), corners[left] - p) > 0) std::swap(face[1], face[2]);
        mesh.triangles.push_back({first + face[0], first + face[1], first + face[2]});
    }
}

} // namespace

MeshDesc tetra(int depth) {
    MeshDesc mesh;
    addTetra(mesh, depth, {}, 1);
    return mesh;
}

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

MeshGeometry geometryOf(const std::vector<std::array<Vec3, 3>>& triangles, bool withBvh) {
    MeshGeometry g;
    for (const auto& t : triangles) {
        const auto n = static_cast<std::uint32_t>(g.points.size());
        g.points.insert(g.points.end(), t.begin(), t.end());
        g.triangles.push_back({n, n + 1, n + 2});
    }
    g.finish(withBvh);
    return g;
}

SceneFrame frameFor(const MeshDesc& mesh, const Transform& worldFromMesh) {
    SceneDesc desc;
    desc.meshes.push_back(mesh);
    ObjectDesc object;
    object.kind = ObjectDesc::Kind::Mesh;
    object.mesh = 0;
    object.worldFromObject = {worldFromMesh.rows()};
    desc.objects.push_back(object);
    return frameOf(desc);
}

Vec3 Ready::corner(std::uint32_t n, std::size_t c) const {
    const std::uint32_t i = geometry->triangles[n][c];
    return geometry->exactPoints.empty() ? geometry->points[i]
                                         : placedPoint(sceneFromMesh, geometry->exactPoints[i]);
}

Ready baked(const MeshDesc& mesh, const Transform& worldFromMesh, const SceneFrame& frame) {
    MergedMesh merged;
    merged.add(mesh, frame.placed(worldFromMesh.rows()), {7}, 5);
    Ready out;
    out.geometry = std::make_unique<MeshGeometry>(std::move(merged.geometry));
    out.geometry->finish(true);
    out.shape = std::make_unique<Mesh>(*out.geometry, merged.materials, merged.parts);
    return out;
}

Ready instance(const MeshDesc& mesh, const Transform& worldFromMesh, const SceneFrame& frame) {
    Ready out;
    out.geometry = std::make_unique<MeshGeometry>(toSharedGeometry(mesh));
    out.geometry->dropDegenerate();
    out.geometry->finish(true);
    out.sceneFromMesh = frame.placed(worldFromMesh.rows());
    out.shape = std::make_unique<MeshInstance>(*out.geometry, MovingTransform(out.sceneFromMesh),
                                               std::vector<std::uint32_t>{7}, 5);
    return out;
}

float stepped(float x, int k) {
    for (; k > 0; --k) x = nextUp(x);
    for (; k < 0; ++k) x = nextDown(x);
    return x;
}

} // namespace meshes
