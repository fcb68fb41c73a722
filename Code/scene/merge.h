// MeshDesc -> MeshGeometry: as instances share it, or merged with others into one in the scene.
#pragma once

#include "scene/frame.h"
#include "shape/mesh.h"

#include <cstdint>
#include <vector>

// The mesh in the normalised space of `frame`, with its slots as they are.
MeshGeometry toGeometry(const MeshDesc& mesh, const SceneFrame& frame);

// The mesh for instances: with its exact points, and a tree in a normalised space of its own.
MeshGeometry toSharedGeometry(const MeshDesc& mesh, int threads = 1);

// Meshes that stand still, placed into one geometry in the scene's space.
struct MergedMesh {
    MeshGeometry geometry;
    std::vector<std::uint32_t> materials; // by slot of the geometry
    std::vector<MeshPart> parts;
    std::uint64_t degenerateCount = 0;

    // `sceneFromMesh` is SceneFrame::placed(). `meshMaterials` by slot of the mesh. Mirrored meshes
    // are turned, so that counter-clockwise stays outside.
    void add(const MeshDesc& mesh, const Transform& sceneFromMesh,
             const std::vector<std::uint32_t>& meshMaterials, std::uint32_t object,
             int threads = 1);
};
