// MeshBuilder: faces of any corner count to the arrays of a MeshDesc. Knows no file format.
#pragma once

#include "desc/scene_desc.h"

#include <cstdint>
#include <span>
#include <vector>

class MeshBuilder {
public:
    static constexpr std::uint32_t kMissing = 0xffffffffu;
    struct Corner {
        std::uint32_t point = 0, uv = kMissing, normal = kMissing;
    };

    // Points, normals and uvs come first, by whoever reads them; the rest grows with the faces.
    MeshDesc mesh;
    std::uint32_t slot = 0;  // material of the faces that follow
    std::uint32_t group = 0; // smoothing group of the faces that follow, 0: flat

    // At most so many triangles will come.
    void reserve(std::size_t triangles);
    // Either all corners have a uv or none, and either all have a normal or none. Triangles without
    // area are left out; false when none is left.
    bool addFace(std::span<const Corner> corners);

    // Of a face to come, so that it need not wait for its points then.
    void prefetch(const Corner& corner) const { __builtin_prefetch(&points()[corner.point]); }

    // A builder for some of the faces, at most so many triangles of this slot and group; it looks
    // at the points here. When parts have all of their faces these are added, one part behind the
    // other.
    MeshBuilder part(std::size_t triangles) const;
    void addFaces(std::span<const MeshBuilder> parts, int threads);

    struct Dropped {
        std::size_t points = 0; // that nothing used
    };
    // Completes the arrays: corners without a normal get that of their smoothing group or of their
    // triangle, corners without uv get 0 0. Then `mesh` is done.
    Dropped finish(int threads = 1);

private:
    bool addTriangle(const Corner& a, const Corner& b, const Corner& c);
    void fillNormals(int threads);
    void fillUvs(int threads);

    const RawVector<Vec3d>& points() const { return points_ ? *points_ : mesh.points; }

    const RawVector<Vec3d>* points_ = nullptr; // of another builder; nullptr: its own
    std::size_t expected_ = 0;
    RawVector<std::uint32_t> groups_; // per triangle; empty: none is smooth
    std::vector<Vec3d> polygon_;
    std::vector<MeshDesc::Corners> pieces_;
};
