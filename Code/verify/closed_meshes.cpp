// The closed ones of meshes.h.
#include "verify/meshes.h"

#include "base/math.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace meshes {

using Corners = MeshDesc::Corners;

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
        RawVector<Corners> finer;
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

} // namespace meshes
