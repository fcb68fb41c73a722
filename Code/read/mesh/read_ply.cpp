#include "read/mesh/mesh_file.h"

#include "base/for_each.h"
#include "base/text.h"
#include "desc/names.h"
#include "read/mesh/mesh_steps.h"
#include "read/mesh/ply_bytes.h"
#include "read/mesh/ply_header.h"
#include "read/mesh/ply_rows.h"
#include "read/mesh/ply_text.h"
#include "read/read_context.h"

#include <algorithm>
#include <optional>

namespace {

// The texture coordinates of the corners of faces, as MeshLab writes them; null: none.
const PlyProperty* uvsOf(const PlyElement& face) {
    if (face.name != "face") return nullptr;
    for (const std::string_view name : {"texcoord", "texcoords"})
        if (const PlyProperty* p = face.property(name); p && p->countType) return p;
    return nullptr;
}
// The number of the picture that they are of.
const PlyProperty* pictureOf(const PlyElement& face) {
    const PlyProperty* const p = face.property("texnumber");
    return p && !p->countType ? p : nullptr;
}
// The list of indices, of faces and strips; null: none.
const PlyProperty* indicesOf(const PlyElement& faces) {
    for (const std::string_view name : {"vertex_indices", "vertex_index"})
        if (const PlyProperty* p = faces.property(name)) return p;
    return nullptr;
}

bool isColour(std::string_view property) {
    for (const std::string_view name : {"red", "green", "blue", "r", "g", "b", "diffuse_red"})
        if (property == name) return true;
    return false;
}

// Properties of an element that make no difference.
std::vector<std::string> leftOutOf(const PlyElement& element, const MeshDesc& mesh) {
    std::vector<std::string> names;
    const bool isVertex = element.name == "vertex";
    const VertexRoles roles = isVertex ? rolesOf(element) : VertexRoles{};
    // Texture coordinates of corners take the place of those of vertices.
    const bool hasOwnUvs = mesh.uvTriangles.empty();
    for (const PlyProperty& p : element.properties) {
        const auto role =
            isVertex ? roles.roles[static_cast<std::size_t>(&p - element.properties.data())]
                     : PlyRole::None;
        const bool isOfFaceUvs = &p == uvsOf(element) || &p == pictureOf(element);
        const bool isRead = role == PlyRole::U || role == PlyRole::V ? hasOwnUvs
                            : isVertex                               ? role != PlyRole::None
                            : isOfFaceUvs                            ? !hasOwnUvs && uvsOf(element)
                                                                     : &p == indicesOf(element);
        if (!isRead) names.push_back(shown(p.name));
    }
    return names;
}

// The body of the file: the rows of one element after the other. Input: PlyText or PlyBytes.
template <class Input> class BodyReader {
public:
    BodyReader(Input input, const SourceFile& source, int threads, MeshDesc& mesh)
        : rows_(input), source_(source), threads_(threads > 0 ? threads : hardwareThreads()),
          mesh_(mesh) {}

    void read(const PlyElement& element) {
        const Input start = rows_.in;
        rows_.in.begin(element);
        if (element.properties.empty()) return;
        if (element.name == "vertex") {
            readVertices(element);
            hasVertices_ = true;
        } else if (!kindOf(element)) {
            rows_.skipRows(element);
        } else if (hasVertices_) {
            readFaces(element);
        } else {
            waiting_.emplace_back(&element, start);
            rows_.skipRows(element);
        }
    }
    std::optional<std::pair<std::size_t, std::string>> finish() {
        const Input end = rows_.in;
        for (const auto& [element, start] : waiting_) {
            rows_.in = start;
            rows_.in.begin(*element);
            readFaces(*element);
        }
        rows_.in = end;
        mesh_.triangles = std::move(rows_.triangles);
        // Of vertices they are better than of some faces only.
        const bool someFit = rows_.withUvsCount > 0;
        if (someFit && (mesh_.uvs.empty() || rows_.withoutUvsCount == 0)) {
            mesh_.uvs = std::move(rows_.uvs);
            mesh_.uvTriangles = std::move(rows_.uvTriangles);
        }
        return rows_.in.rest();
    }
    const PlyRows<Input>& rows() const { return rows_; }

private:
    void readVertices(const PlyElement& element) {
        const VertexRoles roles = rolesOf(element);
        if (!roles.hasRole(PlyRole::X))
            failAt(source_, element.offset, "'vertex' needs the properties x, y and z");
        mesh_.points.resize(element.count);
        if (roles.hasRole(PlyRole::NormalX)) mesh_.normals.resize(element.count);
        if (roles.hasRole(PlyRole::U)) mesh_.uvs.resize(element.count);
        readRows(element, [&](PlyRows<Input>& rows, std::size_t first, std::size_t count) {
            rows.readVertices(element, roles, first, count, mesh_);
        });
    }

    static std::optional<PlyFaces::Kind> kindOf(const PlyElement& element) {
        if (element.name == "face") return PlyFaces::Kind::Polygons;
        if (element.name == "tristrips") return PlyFaces::Kind::Strips;
        return {};
    }

    void readFaces(const PlyElement& element) {
        const PlyProperty* const indices = indicesOf(element);
        if (!indices || !indices->countType || !isWhole(indices->type))
            failAt(source_, indices ? indices->offset : element.offset,
                   cat("'", shown(element.name),
                       "' needs a list of whole numbers, such as 'property list uchar int "
                       "vertex_indices'"));
        PlyFaces faces{*kindOf(element), indices, uvsOf(element), nullptr,
                       rows_.notFiniteCount > 0};
        if (faces.uvs) faces.picture = pictureOf(element);
        readRows(element, [&](PlyRows<Input>& rows, std::size_t first, std::size_t count) {
            rows.readFaces(element, faces, first, count, mesh_.points);
        });
    }

    // read(rows, first, count)
    template <class Read> void readRows(const PlyElement& element, const Read& read) {
        constexpr std::uint32_t kWorthThreads = 10'000;
        if (threads_ > 1 && element.count >= kWorthThreads && readTogether(element, read)) return;
        read(rows_, 0, element.count);
    }

    // False when the rows are not where they were taken to be, or when there is a mistake: then
    // nothing has changed but vertices that will be read again.
    template <class Read> bool readTogether(const PlyElement& element, const Read& read) {
        std::vector<RowChunk> chunks;
        try {
            chunks = rows_.in.chunks(threads_);
        } catch (const Error&) {
            return false;
        }
        if (chunks.size() < 2 || chunks.back().firstRow + chunks.back().count < element.count)
            return false;
        std::vector<std::optional<PlyRows<Input>>> parts(chunks.size());
        forEachOn(threads_, chunks.size(), [&](std::size_t i) {
            const RowChunk& chunk = chunks[i];
            PlyRows<Input> rows(rows_.in);
            rows.in.goTo(chunk.first, chunk.firstRow);
            try {
                read(rows, chunk.firstRow, chunk.count);
            } catch (const Error&) {
                return; // who reads one row after the other says it
            }
            // Where a chunk ends as it was taken to, the next one begins rightly.
            if (i + 1 == chunks.size() || rows.in.rowEnd() == chunks[i + 1].first)
                parts[i].emplace(std::move(rows));
        });
        if (!std::all_of(parts.begin(), parts.end(), [](const auto& part) { return !!part; }))
            return false;
        join(parts);
        return true;
    }

    void join(std::vector<std::optional<PlyRows<Input>>>& parts) {
        std::size_t count = rows_.triangles.size();
        for (const auto& part : parts) count += part->triangles.size();
        rows_.triangles.reserve(count);
        for (const auto& part : parts) {
            rows_.triangles.insert(rows_.triangles.end(), part->triangles.begin(),
                                   part->triangles.end());
            const auto firstUv = static_cast<std::uint32_t>(rows_.uvs.size());
            for (const auto& [a, b, c] : part->uvTriangles)
                rows_.uvTriangles.push_back({firstUv + a, firstUv + b, firstUv + c});
            rows_.uvs.insert(rows_.uvs.end(), part->uvs.begin(), part->uvs.end());
            rows_.notFiniteCount += part->notFiniteCount;
            rows_.withUvsCount += part->withUvsCount;
            rows_.withoutUvsCount += part->withoutUvsCount;
            rows_.mostPictures = std::max(rows_.mostPictures, part->mostPictures);
            if (rows_.degenerateCount == 0) rows_.firstDegenerate = part->firstDegenerate;
            rows_.degenerateCount += part->degenerateCount;
        }
        rows_.in = parts.back()->in;
    }

    PlyRows<Input> rows_;
    const SourceFile& source_;
    int threads_;
    MeshDesc& mesh_;
    bool hasVertices_ = false;
    // Faces in front of the vertices that they name, and where their rows begin.
    std::vector<std::pair<const PlyElement*, Input>> waiting_;
};

// Before megabytes are read: is there something to show?
void checkElements(const PlyHeader& header, const SourceFile& source) {
    const PlyElement* const vertex = header.element("vertex");
    if (!vertex) failAt(source, 0, "the file has no element 'vertex'");
    std::size_t faces = 0;
    for (const std::string_view name : {"face", "tristrips"}) {
        const PlyElement* const element = header.element(name);
        if (element) faces += element->count;
    }
    if (faces == 0)
        failAt(source, vertex->offset,
               "the file has vertices but no faces: a point cloud has no surface to show");
}

// Vertices of no triangle would only make the mesh seem larger than it looks.
std::size_t dropUnusedVertices(MeshDesc& mesh, int threads) {
    RawVector<Vec2> none;
    return dropUnused(mesh.triangles, threads, mesh.points, mesh.normals,
                      mesh.uvTriangles.empty() ? mesh.uvs : none);
}

// What is in the file and not in the picture, in one warning.
void warnOfLeftOut(const PlyHeader& header, const MeshDesc& mesh, const SourceFile& source,
                   const ReadContext& context) {
    std::vector<std::string> parts;
    std::size_t first = 0;
    bool hasColours = false;
    for (const PlyElement& element : header.elements) {
        const std::vector<std::string> names = leftOutOf(element, mesh);
        hasColours = hasColours || std::any_of(names.begin(), names.end(), isColour);
        if (names.empty()) continue;
        if (parts.empty()) first = element.offset;
        parts.push_back(cat("'", shown(element.name), "' (", join(names), ")"));
    }
    for (const std::string_view picture : header.pictures)
        parts.push_back(cat("the picture '", shown(picture), "' (TextureFile)"));
    if (!parts.empty())
        context.warn(
            source, first,
            cat("left out: ", join(parts), hasColours ? "; materials alone give colour here" : ""));
}

template <class Input>
void warn(const PlyHeader& header, const PlyRows<Input>& rows, const MeshDesc& mesh,
          const SourceFile& source, const ReadContext& context) {
    const std::size_t vertexOffset = header.element("vertex")->offset;
    const auto tell = [&](std::size_t count, std::string_view one, std::string_view many,
                          std::string_view rest) {
        if (count > 0)
            context.warn(source, vertexOffset, cat(count, count == 1 ? one : many, rest));
    };
    tell(rows.notFiniteCount, " point, normal or texture coordinate is",
         " points, normals or texture coordinates are",
         " not finite or too large; faces do without them");
    tell(mesh.uvTriangles.empty() ? 0 : rows.withoutUvsCount, " face has", " faces have",
         " no texture coordinates, or not two for each corner; they have 0 0");
    if (rows.mostPictures > 1)
        context.warn(source, header.element("face")->offset,
                     cat("the texture coordinates are of ", rows.mostPictures,
                         " pictures; the material's picture is shown for all"));
    if (rows.degenerateCount == 0) return;
    const PlyElement& face = *header.element("face");
    context.warn(source, face.offset,
                 cat("left out ", rows.degenerateCount, " of ", face.count,
                     " faces, with fewer than three different corners; the first is face ",
                     rows.firstDegenerate, ", counted from 0"));
}

template <class Input>
MeshFile readBody(const PlyHeader& header, Input input, const SourceFile& source,
                  const ReadContext& context) {
    MeshFile file;
    MeshDesc& mesh = file.mesh;
    BodyReader<Input> body(input, source, context.options.threads, mesh);
    for (const PlyElement& element : header.elements) body.read(element);
    const std::size_t vertexOffset = header.element("vertex")->offset;
    const auto rest = body.finish();
    if (mesh.triangles.empty())
        failAt(
            source, vertexOffset,
            cat("none of the faces has three different corners",
                body.rows().notFiniteCount > 0 ? ", whose numbers are finite and below 1e60" : ""));
    if (rest) context.warn(source, rest->first, rest->second);
    warn(header, body.rows(), mesh, source, context);
    const std::size_t vertices = mesh.points.size();
    if (const std::size_t count = dropUnusedVertices(mesh, context.options.threads))
        context.warn(source, vertexOffset,
                     cat("left out ", count, " of ", vertices, " vertices, which no face uses"));
    warnOfLeftOut(header, mesh, source, context);
    if (!mesh.normals.empty()) mesh.normalTriangles = mesh.triangles;
    if (!mesh.uvs.empty() && mesh.uvTriangles.empty()) mesh.uvTriangles = mesh.triangles;
    return file;
}

} // namespace

MeshFile readPly(const SourceFile& source, const ReadContext& context) {
    checkTextSize(source);
    const PlyHeader header = readPlyHeader(source);
    checkElements(header, source);
    if (header.format == PlyFormat::Ascii)
        return readBody(header, PlyText(source, header.dataOffset), source, context);
    const PlyBytes bytes(source, header.dataOffset, header.format);
    return readBody(header, bytes, source, context);
}
