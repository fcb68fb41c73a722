#include "read/mesh/obj_chunks.h"

#include "base/for_each.h"
#include "base/text.h"
#include "desc/range.h"
#include "read/mesh/plain_lines.h"

#include <array>
#include <cmath>
#include <cstring>
#include <limits>

namespace {

// Small enough that a file of some megabytes is work for many threads.
constexpr std::size_t kChunkBytes = std::size_t{1} << 16;
constexpr double kLargestFloat = 1e15; // as in native meshes: its square is far from the end

// Behind a line end, where no backslash joins the lines and no reader at the end of a chunk would
// go on over blanks.
const char* lineStartFrom(const char* p, const char* end) {
    while (true) {
        const void* const found = std::memchr(p, '\n', static_cast<std::size_t>(end - p));
        if (!found) return end;
        const char* const newline = static_cast<const char*>(found);
        const char* last = newline; // p is behind the first byte of the text
        if (last[-1] == '\r') --last;
        p = newline + 1;
        const bool joins = last[-1] == '\\', blank = *p == ' ' || *p == '\t' || *p == '\r';
        if (!joins && !blank && *p != '\\') return p;
    }
}

std::vector<ObjChunk> divided(const FileText& text) {
    const char* first = text.data();
    const char* const end = first + text.size();
    if (text.starts_with("\xef\xbb\xbf")) first += 3; // what some editors put first
    std::vector<ObjChunk> chunks;
    while (first < end) {
        const auto left = static_cast<std::size_t>(end - first);
        const char* const last =
            left <= kChunkBytes ? end : lineStartFrom(first + kChunkBytes - 1, end);
        ObjChunk& chunk = chunks.emplace_back();
        chunk.first = first, chunk.last = last;
        first = last;
    }
    return chunks;
}

bool has(const ObjChunk& chunk, char byte) {
    return std::memchr(chunk.first, byte, static_cast<std::size_t>(chunk.last - chunk.first));
}

// Of the rest of the line, which the reader stays in, or has read.
std::size_t countWords(LineReader& in, bool isSimple) {
    if (isSimple)
        if (const CountedWords counted = wordsOfLine(in.text(), in.end()); counted.next) {
            in.moveToLine(counted.next);
            return counted.words;
        }
    // Ahead: words may reach beyond a comment that a reader of corners stops at.
    LineReader ahead = in;
    std::size_t words = 0;
    while (!ahead.word().empty()) ++words;
    return words;
}

// The vertices in it.
ObjCounts count(const SourceFile& source, ObjChunk& chunk) {
    LineReader in(source, chunk.first, chunk.last);
    ObjCounts counts;
    const bool isSimple = !has(chunk, '#') && !has(chunk, '\\');
    while (in.nextLine()) {
        const char first = *in.text();
        if (first == 'v' && takeVertex(in, counts)) continue;
        if (first == 'f' && takeFace(in)) {
            const std::size_t corners = countWords(in, isSimple);
            chunk.triangles += corners < 3 ? 0 : corners - 2;
            chunk.hasFaces = true;
        } else {
            chunk.isPlain = false;
        }
    }
    return counts;
}

class VertexReader {
public:
    VertexReader(const SourceFile& source, const ObjChunk& chunk, MeshDesc& mesh)
        : in_(source, chunk.first, chunk.last), at_(chunk.before), mesh_(mesh) {}

    VerticesLeftOut read() {
        while (in_.nextLine()) {
            if (*in_.text() != 'v') continue;
            if (const char* const next = readPlainly(in_.text())) {
                in_.moveToLine(next);
            } else if (in_.take("v")) {
                readPoint();
            } else if (in_.take("vn")) {
                const float x = other("vn"), y = other("vn"), z = other("vn");
                mesh_.normals[at_.normals++] = isFinite(x + y + z) ? Vec3{x, y, z} : Vec3{};
                expectLineEnd("vn");
            } else if (in_.take("vt")) {
                Vec2 uv;
                uv.x = other("vt");
                if (!in_.atLineEnd()) uv.y = other("vt");
                if (!in_.atLineEnd()) other("vt"); // of pictures with depth
                mesh_.uvs[at_.uvs++] = isFinite(uv.x + uv.y) ? uv : Vec2{};
                expectLineEnd("vt");
            }
        }
        return leftOut_;
    }

private:
    // Returns the next line, or nullptr.
    const char* readPlainly(const char* line) {
        std::array<double, 3> point;
        std::array<float, 3> normal;
        std::array<float, 2> uv;
        const char* next = nullptr;
        if (line[1] == ' ') {
            next = readPlainNumbers(line + 1, in_.end(), kLargestLength, point);
            if (next) mesh_.points[at_.points++] = {point[0], point[1], point[2]};
        } else if (line[1] == 'n') {
            next = readPlainNumbers(line + 2, in_.end(), kLargestFloat, normal);
            if (next) mesh_.normals[at_.normals++] = {normal[0], normal[1], normal[2]};
        } else if (line[1] == 't') {
            next = readPlainNumbers(line + 2, in_.end(), kLargestFloat, uv);
            if (next) mesh_.uvs[at_.uvs++] = {uv[0], uv[1]};
        }
        return next;
    }

    // x y z, then w (of curves) or r g b or both.
    void readPoint() {
        const std::size_t start = in_.offset();
        Vec3d p;
        for (std::size_t i = 0; i < 3; ++i) p[i] = in_.numberOrNan<double>("v", kLargestLength);
        if (!std::isfinite(p.x + p.y + p.z)) {
            constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
            p = {kNone, kNone, kNone};
            leftOut_.notFinite.add(start);
        }
        mesh_.points[at_.points++] = p;
        int more = 0;
        for (; more < 4 && !in_.atLineEnd(); ++more) in_.numberOrNan<double>("v", kLargestLength);
        if (more == 2)
            in_.failAt(in_.offset(), "'v' has 5 numbers; x y z, then w or r g b or both are known");
        if (more >= 3) leftOut_.colours.add(in_.offset());
        expectLineEnd("v");
    }
    // A number of a normal or of texture coordinates.
    float other(std::string_view keyword) { return in_.numberOrNan<float>(keyword, kLargestFloat); }
    // Counts what is not.
    bool isFinite(float sum) {
        if (std::isfinite(sum)) return true;
        leftOut_.notFinite.add(in_.offset());
        return false;
    }
    void expectLineEnd(std::string_view keyword) {
        if (!in_.atLineEnd())
            in_.failAt(in_.offset(), cat("expected the end of the line after '", keyword, "', got ",
                                         in_.nextWord()));
    }

    LineReader in_;
    ObjCounts at_;
    MeshDesc& mesh_;
    VerticesLeftOut leftOut_;
};

} // namespace

ObjChunks chunksOf(const SourceFile& source, int threads) {
    ObjChunks out{divided(source.text), {}, 0};
    std::vector<ObjCounts> counts(out.chunks.size());
    forEachOn(threads, counts.size(),
              [&](std::size_t i) { counts[i] = count(source, out.chunks[i]); });
    for (std::size_t i = 0; i < counts.size(); ++i) {
        out.chunks[i].before = out.total;
        out.total.points += counts[i].points;
        out.total.uvs += counts[i].uvs;
        out.total.normals += counts[i].normals;
        out.chunks[i].behind = out.total;
        out.triangles += out.chunks[i].triangles;
    }
    return out;
}

VerticesLeftOut readVertices(const SourceFile& source, const ObjChunks& chunks, MeshDesc& mesh,
                             int threads) {
    mesh.points.resize(chunks.total.points);
    mesh.uvs.resize(chunks.total.uvs);
    mesh.normals.resize(chunks.total.normals);
    std::vector<VerticesLeftOut> leftOut(chunks.chunks.size());
    forEachOn(threads, leftOut.size(), [&](std::size_t i) {
        if (chunks.chunks[i].hasVertices())
            leftOut[i] = VertexReader(source, chunks.chunks[i], mesh).read();
    });
    VerticesLeftOut all;
    for (const VerticesLeftOut& some : leftOut) all.add(some);
    return all;
}
