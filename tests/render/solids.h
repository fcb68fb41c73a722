// Triangle meshes for the render tests, as text and as data.
#pragma once

#include "base/text.h"
#include "desc/scene_desc.h"

#include <algorithm>
#include <array>
#include <map>
#include <string>
#include <vector>

namespace solids {

// A closed box [-1,1]^3, each face of n x n x 2 triangles that share their points, outward.
inline MeshDesc box(int n) {
    MeshDesc mesh;
    mesh.name = "box";
    std::map<std::array<int, 3>, std::uint32_t> index;
    const auto point = [&](std::array<int, 3> at) {
        const auto [where, isNew] =
            index.try_emplace(at, static_cast<std::uint32_t>(mesh.points.size()));
        if (isNew)
            mesh.points.push_back({2.0 * at[0] / n - 1, 2.0 * at[1] / n - 1, 2.0 * at[2] / n - 1});
        return where->second;
    };
    for (std::size_t axis = 0; axis < 3; ++axis)
        for (int side = 0; side < 2; ++side)
            for (int i = 0; i < n; ++i)
                for (int j = 0; j < n; ++j) {
                    const auto corner = [&](int di, int dj) {
                        std::array<int, 3> at{};
                        at[axis] = side * n;
                        at[(axis + 1) % 3] = i + di;
                        at[(axis + 2) % 3] = j + dj;
                        return point(at);
                    };
                    const auto a = corner(0, 0), b = corner(1, 0), c = corner(1, 1),
                               d = corner(0, 1);
                    if (side == 1)
                        mesh.triangles.insert(mesh.triangles.end(), {{a, b, c}, {a, c, d}});
                    else
                        mesh.triangles.insert(mesh.triangles.end(), {{a, c, b}, {a, d, c}});
                }
    return mesh;
}

// The box blown up to the unit sphere, every square folded outward: a convex body.
inline MeshDesc ball(int n) {
    MeshDesc mesh = box(n);
    mesh.name = "ball";
    for (Vec3d& p : mesh.points) p = p / std::sqrt(dot(p, p));
    for (std::size_t i = 0; i < mesh.triangles.size();
         i += 2) { // (a, b, c), (a, c, d) in some turn
        const auto [a, b, c] = mesh.triangles[i];
        const auto [e, f, g] = mesh.triangles[i + 1];
        const bool forward = f == c; // else (a, c, b), (a, d, c)
        const std::uint32_t x = forward ? b : c, y = forward ? c : b, z = forward ? g : f;
        const Vec3d n1 = cross(mesh.points[x] - mesh.points[a], mesh.points[y] - mesh.points[a]);
        const Vec3d toZ = mesh.points[z] - mesh.points[a];
        if ((dot(n1, toZ) > 0) != (dot(n1, mesh.points[a]) < 0)) {
            if (forward)
                mesh.triangles[i] = {a, x, z}, mesh.triangles[i + 1] = {x, y, z};
            else
                mesh.triangles[i] = {a, z, x}, mesh.triangles[i + 1] = {x, z, y};
        }
        static_cast<void>(e);
    }
    return mesh;
}

// As a block of the native format; doubles written so that they read back alike.
inline std::string text(const MeshDesc& mesh) {
    std::string out = cat("mesh ", mesh.name, " {\n points ", mesh.points.size(), "\n");
    for (const Vec3d p : mesh.points)
        out += shortest(p.x) + " " + shortest(p.y) + " " + shortest(p.z) + "\n";
    out += cat(" triangles ", mesh.triangles.size(), "\n");
    for (const auto& t : mesh.triangles) out += cat(t[0], " ", t[1], " ", t[2], "\n");
    return out + "}\n";
}

} // namespace solids
