// Rows of the elements of a PLY file: what vertices, faces and strips are. Knows no headers and no
// threads; Input is PlyText or PlyBytes.
#pragma once

#include "base/source.h"
#include "base/text.h"
#include "desc/names.h"
#include "desc/range.h"
#include "desc/scene_desc.h"
#include "read/mesh/mesh_steps.h"
#include "read/mesh/ply_header.h"

#include <algorithm>
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

// PlyInput: what PlyText and PlyBytes have in common: which row of which element is read, and
// where.
class PlyInput {
public:
    // To the start of another row of the same element.
    void goTo(const char* p, std::size_t row) { p_ = p, row_ = row; }

protected:
    PlyInput(const SourceFile& source, std::size_t offset)
        : source_(&source), p_(source.text.data() + offset),
          end_(source.text.data() + source.text.size()) {}

    // Fails when `bytes` cannot hold the rows that the header promises, each of this many or more.
    void begin(const PlyElement& element, std::size_t rowBytes, std::size_t bytes) {
        element_ = &element;
        row_ = 0;
        if (rowBytes == 0) return;
        if (const std::size_t possible = bytes / rowBytes; element.count > possible)
            failAt(*source_, element.offset,
                   cat("'element ", shown(element.name), " ", element.count,
                       "' is more than the rest of the file can hold (", possible, " at most)"));
    }
    static std::string tooManyItems(const PlyProperty& property, std::string_view count,
                                    std::size_t possible, std::size_t most) {
        return cat("a list of '", shown(property.name), "' has ", count, " items; at most ",
                   possible, possible < most ? " fit into the rest of the file" : " are possible");
    }
    std::size_t bytesLeft() const { return static_cast<std::size_t>(end_ - p_); }

    const SourceFile* source_;
    const PlyElement* element_ = nullptr;
    std::size_t row_ = 0;
    const char* p_;
    const char* end_;                 // *end_ is the string's terminating zero
    const char* last_ = nullptr;      // the value that was read last
    const char* listStart_ = nullptr; // the items of the list that was read last
};

// Says which lists of the faces make triangles, and how.
struct PlyFaces {
    enum class Kind { Polygons, Strips };
    Kind kind = Kind::Polygons;
    const PlyProperty* indices = nullptr;
    const PlyProperty* uvs = nullptr;     // u v of each corner; null: none
    const PlyProperty* picture = nullptr; // the number of the picture that these are of; null: none
    bool someAreNone = false;             // are some points NaN? Faces with them show nothing
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
            if (std::isnan(value(PlyRole::X) + value(PlyRole::Y) + value(PlyRole::Z)))
                mesh.points[row].x = notFinite(std::numeric_limits<double>::quiet_NaN());
            if (!mesh.normals.empty()) {
                const Vec3 n{narrow(PlyRole::NormalX), narrow(PlyRole::NormalY),
                             narrow(PlyRole::NormalZ)};
                mesh.normals[row] = std::isnan(n.x + n.y + n.z) ? notFinite(Vec3{}) : n;
            }
            if (mesh.uvs.empty()) continue;
            const Vec2 uv{narrow(PlyRole::U), narrow(PlyRole::V)};
            mesh.uvs[row] = std::isnan(uv.x + uv.y) ? notFinite(Vec2{}) : uv;
        }
    }

    void readFaces(const PlyElement& element, const PlyFaces& faces, std::size_t first,
                   std::size_t count, std::span<const Vec3d> points) {
        triangles.reserve(triangles.size() + count);
        if (faces.uvs) uvTriangles.reserve(triangles.size() + count);
        const std::size_t most = faces.kind == PlyFaces::Kind::Polygons
                                     ? kMostCorners
                                     : std::numeric_limits<std::uint32_t>::max();
        for (std::size_t row = first; row < first + count; ++row) {
            in.beginRow();
            coordinates_.clear();
            for (const PlyProperty& p : element.properties) {
                if (&p == faces.indices) {
                    in.list(p, most, items_);
                    if (faces.kind == PlyFaces::Kind::Strips)
                        addStrip(p, faces, points);
                    else
                        for (std::size_t i = 0; i < items_.size(); ++i)
                            checkIndex(p, i, points.size());
                } else if (&p == faces.uvs) {
                    in.numbers(p, 2 * most, coordinates_);
                } else if (&p == faces.picture) {
                    mostPictures = std::max(mostPictures, in.number(p.type) + 1);
                } else {
                    skip(p);
                }
            }
            if (faces.kind == PlyFaces::Kind::Polygons && !addFace(faces, points) &&
                degenerateCount++ == 0)
                firstDegenerate = row;
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
    // What faces have, in the order of the triangles; uvTriangles is empty where faces have no u v.
    RawVector<MeshDesc::Corners> triangles, uvTriangles;
    RawVector<Vec2> uvs;
    std::size_t degenerateCount = 0, firstDegenerate = 0; // faces that show nothing
    std::size_t notFiniteCount = 0;                       // points, normals and u v of vertices
    std::size_t withUvsCount = 0, withoutUvsCount = 0;    // faces: u v for each corner, or not
    double mostPictures = 0;                              // the largest number of a picture, plus 1

private:
    void skip(const PlyProperty& p) {
        if (p.countType)
            in.skipList(p);
        else
            in.skip(p.type);
    }

    // NaN when it is not finite or too large.
    double vertexNumber(const PlyProperty& property, PlyRole role) {
        constexpr double kLargestFloat = 1e15; // its square is far from the end of float
        const double value = in.number(property.type);
        const double largest = role <= PlyRole::Z ? kLargestLength : kLargestFloat;
        return std::fabs(value) <= largest ? value : std::numeric_limits<double>::quiet_NaN();
    }
    template <class T> T notFinite(T instead) {
        ++notFiniteCount;
        return instead;
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

    // Adds the face of the row whose indices are read. Returns false when it shows nothing.
    bool addFace(const PlyFaces& faces, std::span<const Vec3d> points) {
        const std::size_t before = triangles.size();
        if (items_.size() < 3) return false;
        if (faces.someAreNone && std::any_of(items_.begin(), items_.end(), [&](std::uint32_t i) {
                return std::isnan(points[i].x);
            }))
            return false;
        if (items_.size() == 3 && !faces.uvs) return addTriangle(items_[0], items_[1], items_[2]);
        pieces_.assign(1, {0, 1, 2});
        if (items_.size() > 3) {
            corners_.clear();
            for (const std::uint32_t index : items_) corners_.push_back(points[index]);
            pieces_.clear();
            triangulate(corners_, pieces_);
        }
        const auto firstUv = static_cast<std::uint32_t>(uvs.size());
        for (const auto& [a, b, c] : pieces_)
            if (addTriangle(items_[a], items_[b], items_[c]) && faces.uvs)
                uvTriangles.push_back({firstUv + a, firstUv + b, firstUv + c});
        if (faces.uvs && triangles.size() > before) addUvs();
        return triangles.size() > before;
    }

    // u v of each corner; zero where the file has none.
    void addUvs() {
        const bool fits = coordinates_.size() == 2 * items_.size();
        ++(fits ? withUvsCount : withoutUvsCount);
        for (std::size_t i = 0; i < items_.size(); ++i) {
            Vec2 uv;
            if (fits) uv = {toUv(coordinates_[2 * i]), toUv(coordinates_[2 * i + 1])};
            uvs.push_back(uv);
        }
    }
    float toUv(double value) {
        return std::fabs(value) <= 1e15 ? static_cast<float>(value) : notFinite(0.0f);
    }

    // Every corner makes a triangle with the two before it, every second one turned round; -1 ends
    // the strip and begins another. Equal corners stitch strips together and show nothing.
    void addStrip(const PlyProperty& property, const PlyFaces& faces,
                  std::span<const Vec3d> points) {
        constexpr std::uint32_t kEnd = 0xffffffffu;
        const auto isNone = [&](std::uint32_t index) {
            return faces.someAreNone && std::isnan(points[index].x);
        };
        std::size_t first = 0;
        for (std::size_t i = 0; i < items_.size(); ++i) {
            if (items_[i] == kEnd) {
                first = i + 1;
                continue;
            }
            checkIndex(property, i, points.size());
            if (i < first + 2 || isNone(items_[i]) || isNone(items_[i - 1]) ||
                isNone(items_[i - 2]))
                continue;
            if ((i - first) % 2 == 0)
                addTriangle(items_[i - 2], items_[i - 1], items_[i]);
            else
                addTriangle(items_[i - 1], items_[i - 2], items_[i]);
        }
    }

    // Of the row that is read; kept for their memory.
    std::vector<std::uint32_t> items_;
    std::vector<double> coordinates_;
    std::vector<Vec3d> corners_;
    std::vector<MeshDesc::Corners> pieces_;
};
