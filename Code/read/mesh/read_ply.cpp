#include "read/mesh/read_ply.h"

#include "base/text.h"
#include "desc/names.h"
#include "desc/range.h"
#include "read/mesh/ply_bytes.h"
#include "read/mesh/ply_header.h"
#include "read/mesh/ply_text.h"
#include "read/mesh/triangulate.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace {

// What the properties of a vertex are to us.
enum class Role { X, Y, Z, NormalX, NormalY, NormalZ, U, V, None };
constexpr std::size_t kRoleCount = static_cast<std::size_t>(Role::None);

// Groups of properties that count only together, in the order of preference: of several names for
// the same the first ones.
struct Group {
    Role first;
    std::array<std::string_view, 3> names; // the last one may be empty
};
constexpr auto kGroups = std::to_array<Group>({
    {Role::X, {"x", "y", "z"}},
    {Role::NormalX, {"nx", "ny", "nz"}},
    {Role::U, {"s", "t"}},
    {Role::U, {"u", "v"}},
    {Role::U, {"texture_u", "texture_v"}},
    {Role::U, {"texture_s", "texture_t"}},
});

struct VertexRoles {
    std::vector<Role> roles; // per property
    std::array<bool, kRoleCount> has{};
    bool hasRole(Role role) const { return has[static_cast<std::size_t>(role)]; }
};

VertexRoles rolesOf(const PlyElement& vertex) {
    VertexRoles out;
    out.roles.assign(vertex.properties.size(), Role::None);
    for (const Group& group : kGroups) {
        auto role = static_cast<std::size_t>(group.first);
        std::vector<std::size_t> found;
        bool isComplete = !out.has[role];
        for (const std::string_view name : group.names) {
            if (name.empty()) continue;
            const PlyProperty* const p = vertex.property(name);
            isComplete = isComplete && p && !p->countType;
            if (isComplete) found.push_back(static_cast<std::size_t>(p - vertex.properties.data()));
        }
        if (!isComplete) continue;
        for (const std::size_t i : found) {
            out.roles[i] = static_cast<Role>(role);
            out.has[role++] = true;
        }
    }
    return out;
}

// An index as it was written: negative ones were wrapped around.
std::string indexText(const PlyProperty& property, std::uint32_t index) {
    const bool isSigned = property.type == PlyType::Int8 || property.type == PlyType::Int16 ||
                          property.type == PlyType::Int32;
    return isSigned ? cat(static_cast<std::int32_t>(index)) : cat(index);
}

// The body of the file: the rows of one element after the other. Input: PlyText or PlyBytes.
template <class Input> class BodyReader {
public:
    BodyReader(const PlyHeader& header, const SourceFile& source, MeshDesc& mesh)
        : in_(source, header.dataOffset), source_(source), mesh_(mesh) {}

    void read(const PlyElement& element) {
        in_.begin(element);
        if (element.properties.empty()) return;
        if (element.name == "vertex")
            readVertices(element);
        else if (element.name == "face")
            readLists(element, kMostCorners, [this](const PlyProperty& p) { addFace(p); });
        else if (element.name == "tristrips")
            readLists(element, source_.text.size(), [this](const PlyProperty& p) { addStrip(p); });
        else
            for (std::uint32_t row = 0; row < element.count; ++row) {
                in_.beginRow();
                for (const PlyProperty& p : element.properties) skip(p);
                in_.endRow();
            }
    }
    std::optional<std::pair<std::size_t, std::string>> rest() { return in_.rest(); }
    std::size_t degenerateCount() const { return degenerateCount_; }
    std::size_t firstDegenerate() const { return firstDegenerate_; }

private:
    void skip(const PlyProperty& p) {
        if (p.countType)
            in_.skipList(p);
        else
            in_.skip(p.type);
    }

    void readVertices(const PlyElement& element) {
        const VertexRoles roles = rolesOf(element);
        if (!roles.hasRole(Role::X))
            failAt(source_, element.offset, "'vertex' needs the properties x, y and z");
        mesh_.points.resize(element.count);
        if (roles.hasRole(Role::NormalX)) mesh_.normals.resize(element.count);
        if (roles.hasRole(Role::U)) mesh_.uvs.resize(element.count);
        std::array<double, kRoleCount> values{};
        const auto value = [&](Role role) { return values[static_cast<std::size_t>(role)]; };
        const auto narrow = [&](Role role) { return static_cast<float>(value(role)); };
        for (std::uint32_t row = 0; row < element.count; ++row) {
            in_.beginRow();
            for (std::size_t i = 0; i < element.properties.size(); ++i) {
                const Role role = roles.roles[i];
                if (role == Role::None)
                    skip(element.properties[i]);
                else
                    values[static_cast<std::size_t>(role)] =
                        vertexNumber(element.properties[i], role);
            }
            in_.endRow();
            mesh_.points[row] = {value(Role::X), value(Role::Y), value(Role::Z)};
            if (!mesh_.normals.empty())
                mesh_.normals[row] = {narrow(Role::NormalX), narrow(Role::NormalY),
                                      narrow(Role::NormalZ)};
            if (!mesh_.uvs.empty()) mesh_.uvs[row] = {narrow(Role::U), narrow(Role::V)};
        }
    }

    double vertexNumber(const PlyProperty& property, Role role) {
        constexpr double kLargestFloat = 1e15; // its square is far from the end of float
        const double value = in_.number(property.type);
        const double largest = role <= Role::Z ? kLargestLength : kLargestFloat;
        if (!(std::fabs(value) <= largest))
            in_.fail(
                std::isfinite(value)
                    ? cat("'", shown(property.name), "' is too large; at most ", shortest(largest))
                    : cat("'", shown(property.name), "' is not a finite number"));
        return value;
    }

    // Calls with the list of indices of every row in items_.
    template <class Call>
    void readLists(const PlyElement& element, std::size_t most, const Call& call) {
        const PlyProperty* indices = element.property("vertex_indices");
        if (!indices) indices = element.property("vertex_index");
        if (!indices || !indices->countType || !isWhole(indices->type))
            failAt(source_, indices ? indices->offset : element.offset,
                   cat("'", shown(element.name),
                       "' needs a list of whole numbers, such as 'property list uchar int "
                       "vertex_indices'"));
        mesh_.triangles.reserve(mesh_.triangles.size() + element.count);
        for (row_ = 0; row_ < element.count; ++row_) {
            in_.beginRow();
            for (const PlyProperty& p : element.properties) {
                if (&p != indices) {
                    skip(p);
                    continue;
                }
                in_.list(p, most, items_);
                call(p);
            }
            in_.endRow();
        }
    }

    void checkIndex(const PlyProperty& property, std::size_t i) {
        if (items_[i] < mesh_.points.size()) return;
        in_.failAtItem(property, i,
                       cat("there is no vertex ", indexText(property, items_[i]), "; the file has ",
                           mesh_.points.size(), ", counted from 0"));
    }

    bool addTriangle(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
        if (a == b || b == c || c == a) return false;
        mesh_.triangles.push_back({a, b, c});
        return true;
    }

    void addFace(const PlyProperty& property) {
        for (std::size_t i = 0; i < items_.size(); ++i) checkIndex(property, i);
        bool shows = false;
        if (items_.size() == 3) {
            shows = addTriangle(items_[0], items_[1], items_[2]);
        } else if (items_.size() > 3) {
            corners_.clear();
            for (const std::uint32_t index : items_) corners_.push_back(mesh_.points[index]);
            triangles_.clear();
            triangulate(corners_, triangles_);
            for (const auto& [a, b, c] : triangles_)
                shows = addTriangle(items_[a], items_[b], items_[c]) || shows;
        }
        if (!shows && degenerateCount_++ == 0) firstDegenerate_ = row_;
    }

    // Every corner makes a triangle with the two before it, every second one turned round; -1 ends
    // the strip and begins another. Equal corners stitch strips together and show nothing.
    void addStrip(const PlyProperty& property) {
        constexpr std::uint32_t kEnd = 0xffffffffu;
        std::size_t first = 0;
        for (std::size_t i = 0; i < items_.size(); ++i) {
            if (items_[i] == kEnd) {
                first = i + 1;
                continue;
            }
            checkIndex(property, i);
            if (i < first + 2) continue;
            if ((i - first) % 2 == 0)
                addTriangle(items_[i - 2], items_[i - 1], items_[i]);
            else
                addTriangle(items_[i - 1], items_[i - 2], items_[i]);
        }
    }

    Input in_;
    const SourceFile& source_;
    MeshDesc& mesh_;
    std::uint32_t row_ = 0;
    std::size_t degenerateCount_ = 0, firstDegenerate_ = 0;
    // Of the row that is read; kept for their memory.
    std::vector<std::uint32_t> items_;
    std::vector<Vec3d> corners_;
    std::vector<MeshDesc::Corners> triangles_;
};

// Before megabytes are read: is there something to show?
void checkElements(const PlyHeader& header, const SourceFile& source) {
    const PlyElement* const vertex = header.element("vertex");
    if (!vertex) failAt(source, 0, "the file has no element 'vertex'");
    std::size_t faces = 0;
    for (const std::string_view name : {"face", "tristrips"}) {
        const PlyElement* const element = header.element(name);
        if (!element) continue;
        faces += element->count;
        if (element < vertex)
            failAt(source, element->offset, cat("'", name, "' stands before 'vertex'"));
    }
    if (faces == 0)
        failAt(source, vertex->offset,
               "the file has vertices but no faces: a point cloud has no surface to show");
}

template <class Row> void keepOnly(std::vector<Row>& rows, const std::vector<bool>& kept) {
    std::size_t out = 0;
    for (std::size_t i = 0; i < rows.size(); ++i)
        if (kept[i]) rows[out++] = rows[i];
    rows.resize(out);
}

// Vertices of no triangle would only make the mesh seem larger than it looks.
std::size_t dropUnusedVertices(MeshDesc& mesh) {
    std::vector<bool> used(mesh.points.size());
    for (const MeshDesc::Corners& t : mesh.triangles)
        for (const std::uint32_t corner : t) used[corner] = true;
    const auto dropped = static_cast<std::size_t>(std::count(used.begin(), used.end(), false));
    if (dropped == 0) return 0;
    std::vector<std::uint32_t> newIndex(used.size());
    std::uint32_t next = 0;
    for (std::size_t i = 0; i < used.size(); ++i) {
        newIndex[i] = next;
        if (used[i]) ++next;
    }
    for (MeshDesc::Corners& t : mesh.triangles)
        for (std::uint32_t& corner : t) corner = newIndex[corner];
    keepOnly(mesh.points, used);
    if (!mesh.normals.empty()) keepOnly(mesh.normals, used);
    if (!mesh.uvs.empty()) keepOnly(mesh.uvs, used);
    return dropped;
}

template <class Input>
MeshFile readBody(const PlyHeader& header, const SourceFile& source, const ReadContext& context) {
    MeshFile file;
    MeshDesc& mesh = file.mesh;
    BodyReader<Input> body(header, source, mesh);
    for (const PlyElement& element : header.elements) body.read(element);
    const std::size_t vertexOffset = header.element("vertex")->offset;
    if (mesh.triangles.empty())
        failAt(source, vertexOffset, "none of the faces has three different corners");
    if (const auto rest = body.rest()) context.warn(source, rest->first, rest->second);
    if (const std::size_t count = body.degenerateCount())
        context.warn(source, header.element("face")->offset,
                     cat("left out ", count, " of ", header.element("face")->count,
                         " faces, with fewer than three different corners; the first is face ",
                         body.firstDegenerate(), ", counted from 0"));
    const std::size_t vertices = mesh.points.size();
    if (const std::size_t count = dropUnusedVertices(mesh))
        context.warn(source, vertexOffset,
                     cat("left out ", count, " of ", vertices, " vertices, which no face uses"));
    if (!mesh.normals.empty()) mesh.normalTriangles = mesh.triangles;
    if (!mesh.uvs.empty()) mesh.uvTriangles = mesh.triangles;
    return file;
}

} // namespace

MeshFile readPly(const SourceFile& source, const ReadContext& context) {
    // Locations are 32 bits wide.
    if (source.text.size() >= SourceLoc::kUnknown)
        fail(ErrorKind::Input, cat(source.name, ": error: the file is larger than 4 GiB"));
    const PlyHeader header = readPlyHeader(source);
    checkElements(header, source);
    switch (header.format) {
    case PlyFormat::Ascii: return readBody<PlyText>(header, source, context);
    case PlyFormat::LittleEndian:
        return readBody<PlyBytes<PlyFormat::LittleEndian>>(header, source, context);
    case PlyFormat::BigEndian:
        return readBody<PlyBytes<PlyFormat::BigEndian>>(header, source, context);
    }
    return {};
}
