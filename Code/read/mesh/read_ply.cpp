#include "read/mesh/mesh_file.h"

#include "base/for_each.h"
#include "base/text.h"
#include "desc/names.h"
#include "read/mesh/ply_bytes.h"
#include "read/mesh/ply_header.h"
#include "read/mesh/ply_rows.h"
#include "read/mesh/ply_text.h"
#include "read/read_context.h"

#include <algorithm>
#include <optional>

namespace {

// The body of the file: the rows of one element after the other. Input: PlyText or PlyBytes.
template <class Input> class BodyReader {
public:
    BodyReader(Input input, const SourceFile& source, int threads, MeshDesc& mesh)
        : rows_(input), source_(source), threads_(threads > 0 ? threads : hardwareThreads()),
          mesh_(mesh) {}

    void read(const PlyElement& element) {
        rows_.in.begin(element);
        if (element.properties.empty()) return;
        if (element.name == "vertex")
            readVertices(element);
        else if (element.name == "face")
            readFaces(element, PlyFaces::Kind::Polygons);
        else if (element.name == "tristrips")
            readFaces(element, PlyFaces::Kind::Strips);
        else
            rows_.skipRows(element);
    }
    std::optional<std::pair<std::size_t, std::string>> finish() {
        mesh_.triangles = std::move(rows_.triangles);
        return rows_.in.rest();
    }
    std::size_t degenerateCount() const { return rows_.degenerateCount; }
    std::size_t firstDegenerate() const { return rows_.firstDegenerate; }

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

    void readFaces(const PlyElement& element, PlyFaces::Kind kind) {
        const PlyProperty* indices = element.property("vertex_indices");
        if (!indices) indices = element.property("vertex_index");
        if (!indices || !indices->countType || !isWhole(indices->type))
            failAt(source_, indices ? indices->offset : element.offset,
                   cat("'", shown(element.name),
                       "' needs a list of whole numbers, such as 'property list uchar int "
                       "vertex_indices'"));
        const PlyFaces faces{kind, indices};
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
            PlyRows<Input> rows(rows_.in.at(chunk.first, chunk.firstRow));
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
            if (rows_.degenerateCount == 0) rows_.firstDegenerate = part->firstDegenerate;
            rows_.degenerateCount += part->degenerateCount;
        }
        rows_.in = parts.back()->in;
    }

    PlyRows<Input> rows_;
    const SourceFile& source_;
    int threads_;
    MeshDesc& mesh_;
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

template <class Row> void keepOnly(RawVector<Row>& rows, const std::vector<bool>& kept) {
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
MeshFile readBody(const PlyHeader& header, Input input, const SourceFile& source,
                  const ReadContext& context) {
    MeshFile file;
    MeshDesc& mesh = file.mesh;
    BodyReader<Input> body(input, source, context.options.threads, mesh);
    for (const PlyElement& element : header.elements) body.read(element);
    const std::size_t vertexOffset = header.element("vertex")->offset;
    const auto rest = body.finish();
    if (mesh.triangles.empty())
        failAt(source, vertexOffset, "none of the faces has three different corners");
    if (rest) context.warn(source, rest->first, rest->second);
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
    checkTextSize(source);
    const PlyHeader header = readPlyHeader(source);
    checkElements(header, source);
    if (header.format == PlyFormat::Ascii)
        return readBody(header, PlyText(source, header.dataOffset), source, context);
    const PlyBytes bytes(source, header.dataOffset, header.format);
    return readBody(header, bytes, source, context);
}
