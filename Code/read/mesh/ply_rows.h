// Rows of the elements of a PLY file: what vertices, faces and strips are. Knows no headers and no
// threads; Input is PlyText or PlyBytes.
#pragma once

#include "base/source.h"
#include "base/text.h"
#include "desc/names.h"
#include "desc/range.h"
#include "desc/scene_desc.h"
#include "read/mesh/ply_header.h"
#include "read/mesh/triangulate.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <utility>
#include <vector>

// An index as it was written: negative ones were wrapped around.
inline std::string indexText(const PlyProperty& property, std::uint32_t index) {
    const bool isSigned = property.type == PlyType::Int8 || property.type == PlyType::Int16 ||
                          property.type == PlyType::Int32;
    return isSigned ? cat(static_cast<std::int32_t>(index)) : cat(index);
}

// Whose list of indices makes triangles how.
struct PlyFaces {
    enum class Kind { Polygons, Strips };
    Kind kind = Kind::Polygons;
    const PlyProperty* indices = nullptr;
};

template <class Input> class PlyRows {
public:
    explicit PlyRows(Input input) : in(std::move(input)) {}

    // Into the places of the mesh's vertices that begin at `first`.
    void readVertices(const PlyElement& element, const VertexRoles& roles, std::size_t first,
                      std::size_t count, MeshDesc& mesh) {
        std::array<double, kPlyRoleCount> values{};
        const auto value = [&](PlyRole role) { return values[static_cast<std::size_t>(role)]; };
        const auto narrow = [&](PlyRole role) { return static_cast<float>(value(role)); };
        for (std::size_t row = first; row < first + count; ++row) {
            in.beginRow();
            for (std::size_t i = 0; i < element.properties.size(); ++i) {
                const PlyRole role = roles.roles[i];
                if (role == PlyRole::None)
                    skip(element.properties[i]);
                else
                    values[static_cast<std::size_t>(role)] =
                        vertexNumber(element.properties[i], role);
            }
            in.endRow();
            mesh.points[row] = {value(PlyRole::X), value(PlyRole::Y), value(PlyRole::Z)};
            if (!mesh.normals.empty())
                mesh.normals[row] = {narrow(PlyRole::NormalX), narrow(PlyRole::NormalY),
                                     narrow(PlyRole::NormalZ)};
            if (!mesh.uvs.empty()) mesh.uvs[row] = {narrow(PlyRole::U), narrow(PlyRole::V)};
        }
    }

    void readFaces(const PlyElement& element, const PlyFaces& faces, std::size_t first,
                   std::size_t count, std::span<const Vec3d> points) {
        triangles.reserve(triangles.size() + count);
        const std::size_t most = faces.kind == PlyFaces::Kind::Polygons
                                     ? kMostCorners
                                     : std::numeric_limits<std::uint32_t>::max();
        for (std::size_t row = first; row < first + count; ++row) {
            in.beginRow();
            for (const PlyProperty& p : element.properties) {
                if (&p != faces.indices) {
                    skip(p);
                    continue;
                }
                in.list(p, most, items_);
                if (faces.kind == PlyFaces::Kind::Strips)
                    addStrip(p, points);
                else if (!addFace(p, points) && degenerateCount++ == 0)
                    firstDegenerate = row;
            }
            in.endRow();
        }
    }

    void skipRows(const PlyElement& element) {
        for (std::uint32_t row = 0; row < element.count; ++row) {
            in.beginRow();
            for (const PlyProperty& p : element.properties) skip(p);
            in.endRow();
        }
    }

    Input in;
    RawVector<MeshDesc::Corners> triangles;
    std::size_t degenerateCount = 0, firstDegenerate = 0; // faces that show nothing

private:
    void skip(const PlyProperty& p) {
        if (p.countType)
            in.skipList(p);
        else
            in.skip(p.type);
    }

    double vertexNumber(const PlyProperty& property, PlyRole role) {
        constexpr double kLargestFloat = 1e15; // its square is far from the end of float
        const double value = in.number(property.type);
        const double largest = role <= PlyRole::Z ? kLargestLength : kLargestFloat;
        if (!(std::fabs(value) <= largest))
            in.fail(
                std::isfinite(value)
                    ? cat("'", shown(property.name), "' is too large; at most ", shortest(largest))
                    : cat("'", shown(property.name), "' is not a finite number"));
        return value;
    }

    void checkIndex(const PlyProperty& property, std::size_t i, std::size_t points) {
        if (items_[i] < points) return;
        in.failAtItem(property, i,
                      cat("there is no vertex ", indexText(property, items_[i]), "; the file has ",
                          points, ", counted from 0"));
    }

    bool addTriangle(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
        if (a == b || b == c || c == a) return false;
        triangles.push_back({a, b, c});
        return true;
    }

    // False when it shows nothing.
    bool addFace(const PlyProperty& property, std::span<const Vec3d> points) {
        for (std::size_t i = 0; i < items_.size(); ++i) checkIndex(property, i, points.size());
        if (items_.size() == 3) return addTriangle(items_[0], items_[1], items_[2]);
        if (items_.size() < 3) return false;
        corners_.clear();
        for (const std::uint32_t index : items_) corners_.push_back(points[index]);
        pieces_.clear();
        triangulate(corners_, pieces_);
        bool shows = false;
        for (const auto& [a, b, c] : pieces_)
            shows = addTriangle(items_[a], items_[b], items_[c]) || shows;
        return shows;
    }

    // Every corner makes a triangle with the two before it, every second one turned round; -1 ends
    // the strip and begins another. Equal corners stitch strips together and show nothing.
    void addStrip(const PlyProperty& property, std::span<const Vec3d> points) {
        constexpr std::uint32_t kEnd = 0xffffffffu;
        std::size_t first = 0;
        for (std::size_t i = 0; i < items_.size(); ++i) {
            if (items_[i] == kEnd) {
                first = i + 1;
                continue;
            }
            checkIndex(property, i, points.size());
            if (i < first + 2) continue;
            if ((i - first) % 2 == 0)
                addTriangle(items_[i - 2], items_[i - 1], items_[i]);
            else
                addTriangle(items_[i - 1], items_[i - 2], items_[i]);
        }
    }

    // Of the row that is read; kept for their memory.
    std::vector<std::uint32_t> items_;
    std::vector<Vec3d> corners_;
    std::vector<MeshDesc::Corners> pieces_;
};
