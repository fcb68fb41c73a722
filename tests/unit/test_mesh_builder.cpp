// Faces that several builders have are added as if one builder had got them all.
#include "base/text.h"
#include "check.h"
#include "read/mesh/mesh_builder.h"

#include <random>
#include <vector>

namespace test_mesh_builder {

namespace {

using Corner = MeshBuilder::Corner;

// Corners with normals or coordinates, or without.
struct Face {
    std::vector<Corner> corners;
};

std::vector<Face> someFaces(std::mt19937& random, const MeshDesc& mesh, unsigned what) {
    std::vector<Face> faces(random() % 40);
    for (Face& face : faces) {
        const bool uv = (what & 1) != 0 && random() % 2 == 0,
                   normal = (what & 2) != 0 && random() % 3 != 0;
        face.corners.resize(3 + random() % 2);
        for (Corner& c : face.corners) {
            c.point = static_cast<std::uint32_t>(random() % mesh.points.size());
            if (uv) c.uv = static_cast<std::uint32_t>(random() % mesh.uvs.size());
            if (normal) c.normal = static_cast<std::uint32_t>(random() % mesh.normals.size());
        }
    }
    return faces;
}

} // namespace

TEST(mesh_builder_adds_parts_like_faces) {
    for (unsigned seed = 0; seed < 200; ++seed) {
        std::mt19937 random(seed);
        MeshBuilder whole;
        for (int i = 0; i < 30; ++i) {
            const auto next = [&] { return static_cast<float>(random() % 1000) / 100; };
            whole.mesh.points.push_back({next(), next(), next()});
            whole.mesh.normals.push_back({next(), next(), 1});
            whole.mesh.uvs.push_back({next(), next()});
        }
        MeshBuilder parted = whole;
        // Each part has one slot and group, and its own way of writing faces.
        std::vector<MeshBuilder> parts;
        const std::size_t before = random() % 2, count = 1 + random() % 6;
        for (std::size_t i = 0; i < count; ++i) {
            const unsigned what = random() % 4;
            const std::uint32_t slot = random() % 3 == 0 ? 1 : 0, group = random() % 4 == 0 ? 5 : 0;
            const std::vector<Face> faces = someFaces(random, whole.mesh, what);
            whole.slot = parted.slot = slot, whole.group = parted.group = group;
            if (i >= before) parts.push_back(parted.part(2 * faces.size()));
            for (const Face& face : faces) {
                whole.addFace(face.corners);
                (i < before ? parted : parts.back()).addFace(face.corners);
            }
        }
        parted.addFaces(parts, 1 + static_cast<int>(seed % 4));
        const std::string what = cat("seed ", seed);
        CHECK_INFO(parted.mesh == whole.mesh, what);
        if (whole.mesh.triangles.empty()) continue;
        whole.finish(), parted.finish(2);
        CHECK_INFO(parted.mesh == whole.mesh, what);
    }
}

} // namespace test_mesh_builder
