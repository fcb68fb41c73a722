#include "read/mesh/mesh_file.h"

#include "base/for_each.h"
#include "base/text.h"
#include "desc/names.h"
#include "read/mesh/line_reader.h"
#include "read/mesh/mesh_builder.h"
#include "read/mesh/obj_chunks.h"
#include "read/mesh/obj_faces.h"

#include <algorithm>
#include <array>
#include <optional>
#include <unordered_map>
#include <unordered_set>

namespace {

// What the standard knows besides faces: points, lines, free-form curves and surfaces, display.
constexpr std::string_view kOtherStatements[] = {
    "p",     "l",    "vp",     "cstype", "deg",      "bmat",     "step",       "curv",      "curv2",
    "surf",  "parm", "trim",   "hole",   "scrv",     "sp",       "end",        "con",       "mg",
    "bevel", "lod",  "ctech",  "stech",  "res",      "bsp",      "bzp",        "cdc",       "cdp",
    "call",  "csh",  "usemap", "maplib", "c_interp", "d_interp", "shadow_obj", "trace_obj",
};

std::string counted(std::size_t count, std::string_view one, std::string_view many) {
    return cat(count, " ", count == 1 ? one : many);
}

class ObjReader {
public:
    ObjReader(const SourceFile& source, const ReadContext& context)
        : source_(source), context_(context), in_(source) {}

    // Three ways through the text: how much there is, so that memory is asked for once; the
    // vertices, which faces may name before they come; the faces.
    MeshFile read() {
        if (source_.text.size() >= SourceLoc::kUnknown)
            in_.failAt(0, "the file is larger than 4 GiB");
        chunks_ = chunksOf(source_, context_.options.threads);
        vertices_ = readVertices(source_, chunks_, builder_.mesh, context_.options.threads);
        builder_.reserve(chunks_.triangles);
        readFaces();
        finish();
        return std::move(file_);
    }

private:
    void readFaces() {
        const std::vector<ObjChunk>& chunks = chunks_.chunks;
        for (std::size_t i = 0; i < chunks.size();) {
            if (chunks[i].isPlain && !chunks[i].hasFaces) {
                ++i; // vertices have been read
                continue;
            }
            std::size_t count = 0;
            // Behind the first face of a part and material, plain chunks belong to these.
            const bool isSettled = inPart_ && slot_ && !partIsNew_;
            while (isSettled && count < kTogether && i + count < chunks.size() &&
                   chunks[i + count].isPlain)
                ++count;
            if (count > 1 && context_.options.threads != 1)
                readTogether(std::span(chunks).subspan(i, count));
            else if (count > 0)
                for (const ObjChunk& chunk : std::span(chunks).subspan(i, count))
                    leftOut_.add(readPlainFaces(source_, chunk, chunks_.total, builder_));
            else
                readInOrder(chunks[i]);
            i += std::max<std::size_t>(count, 1);
        }
    }

    // Chunks. Their faces are there twice until they are added.
    static constexpr std::size_t kTogether = 1024;

    void readTogether(std::span<const ObjChunk> chunks) {
        std::vector<MeshBuilder> faces;
        std::vector<FacesLeftOut> leftOut(chunks.size());
        faces.reserve(chunks.size());
        // Memory is asked for here: of one thread, malloc takes it from where all the rest lies.
        for (const ObjChunk& chunk : chunks) faces.push_back(builder_.part(chunk.triangles));
        forEachOn(context_.options.threads, chunks.size(), [&](std::size_t i) {
            leftOut[i] = readPlainFaces(source_, chunks[i], chunks_.total, faces[i]);
        });
        builder_.addFaces(faces, context_.options.threads);
        for (const FacesLeftOut& some : leftOut) leftOut_.add(some);
    }

    void readInOrder(const ObjChunk& chunk) {
        in_ = LineReader(source_, chunk.first, chunk.last);
        soFar_ = chunk.before;
        while (in_.nextLine()) {
            const char first = *in_.text();
            if (first == 'v' && takeVertex(in_, soFar_)) continue;
            const std::size_t start = in_.offset();
            if (first == 'f' && takeFace(in_))
                readFace(start);
            else
                readOther();
        }
    }
    void readFace(std::size_t start) {
        const auto corners = corners_.readFace();
        if (corners.size() < 3) return leftOut_.tooFewCorners.add(start);
        if (!inPart_) startPart();
        if (!slot_) startMaterial();
        builder_.slot = *slot_;
        const std::size_t before = builder_.mesh.triangles.size();
        if (!builder_.addFace(corners)) return leftOut_.noArea.add(start);
        if (partIsNew_) {
            file_.parts.push_back(
                {partName(), static_cast<std::uint32_t>(before), locOf(partOffset_)});
            partIsNew_ = false;
        }
    }

    void readOther() {
        const std::size_t start = in_.offset();
        const std::string_view keyword = in_.word();
        if (keyword == "o") {
            object_ = in_.rest();
            group_ = {};
            inPart_ = false;
            partOffset_ = start;
        } else if (keyword == "g") {
            group_ = in_.rest();
            inPart_ = false;
            partOffset_ = start;
        } else if (keyword == "s") {
            readSmoothing();
        } else if (keyword == "usemtl") {
            material_ = in_.rest();
            materialOffset_ = start;
            slot_.reset();
            namesMaterials_ = true;
        } else if (keyword == "mtllib") {
            readLibraries();
        } else if (std::find(std::begin(kOtherStatements), std::end(kOtherStatements), keyword) !=
                   std::end(kOtherStatements)) {
            skipped_.add(start);
        } else {
            if (const std::size_t bad = findBadText(keyword); bad != std::string_view::npos)
                in_.failAt(start + bad, cat("unexpected byte '", shown(keyword.substr(bad, 1)),
                                            "'; an OBJ file is plain text"));
            unknown_.add(start);
        }
    }

    void readSmoothing() {
        const std::size_t place = (in_.atLineEnd(), in_.offset());
        const std::string found = in_.nextWord();
        const std::string_view word = in_.word();
        const auto number = word == "off" ? 0 : word == "on" ? 1 : parseInteger(word);
        if (!number || *number < 0 || *number > 0xffffffffll)
            in_.failAt(
                place,
                cat("expected the number of a smoothing group or 'off' after 's', got ", found));
        builder_.group = static_cast<std::uint32_t>(*number);
    }

    // Several files may stand on one line, and names of files may have blanks: a name ends where a
    // word ends in .mtl, or with the line.
    void readLibraries() {
        std::string_view name;
        while (!in_.atLineEnd()) {
            const std::string_view word = in_.word();
            name = name.empty() ? word
                                : std::string_view(name.data(),
                                                   static_cast<std::size_t>(
                                                       word.data() + word.size() - name.data()));
            const std::string_view end = name.size() < 4 ? "" : name.substr(name.size() - 4);
            if (!in_.atLineEnd() && !(end.size() == 4 && end[0] == '.' && (end[1] | 0x20) == 'm' &&
                                      (end[2] | 0x20) == 't' && (end[3] | 0x20) == 'l'))
                continue;
            if (libraries_.insert(name).second) {
                std::string path(name);
                std::replace(path.begin(), path.end(), '\\', '/');
                file_.libraries.push_back({std::move(path), locOf(in_.offsetOf(name))});
            }
            name = {};
        }
    }

    static SourceLoc locOf(std::size_t offset) { return {static_cast<std::uint32_t>(offset)}; }

    void startPart() {
        inPart_ = true;
        namesParts_ = namesParts_ || !object_.empty() || !group_.empty();
        partIsNew_ = file_.parts.empty() || partName() != file_.parts.back().name;
    }
    std::string partName() const {
        if (object_.empty() || group_.empty() || group_ == object_)
            return std::string(object_.empty() ? group_ : object_);
        return cat(object_, ".", group_);
    }

    void startMaterial() {
        const auto slot = static_cast<std::uint32_t>(file_.materials.size());
        const auto [entry, isNew] = slots_.try_emplace(material_, slot);
        if (isNew) {
            file_.materials.emplace_back(material_);
            file_.materialLocs.push_back(locOf(materialOffset_));
        }
        slot_ = entry->second;
    }

    void finish() {
        if (builder_.mesh.triangles.empty()) {
            const std::size_t faces = leftOut_.tooFewCorners.count + leftOut_.noArea.count;
            in_.failAt(0, faces == 0 ? "the file has no faces"
                                     : cat("none of the ", counted(faces, "face", "faces"),
                                           " has three corners and an area"));
        }
        const MeshBuilder::Dropped dropped = builder_.finish(context_.options.threads);
        file_.mesh = std::move(builder_.mesh);
        file_.mesh.loc = locOf(0);
        if (!namesMaterials_) {
            file_.materials.clear();
            file_.materialLocs.clear();
        }
        if (!namesParts_) file_.parts.clear();
        warn(dropped.points);
    }

    void warn(std::size_t unusedPoints) {
        std::vector<std::string> dropped;
        if (leftOut_.tooFewCorners.count > 0)
            dropped.push_back(cat(counted(leftOut_.tooFewCorners.count, "face", "faces"),
                                  " with fewer than three corners"));
        if (leftOut_.noArea.count > 0)
            dropped.push_back(
                cat(counted(leftOut_.noArea.count, "face", "faces"), " without area"));
        if (unusedPoints > 0)
            dropped.push_back(
                cat(counted(unusedPoints, "vertex", "vertices"), " that no face uses"));
        Counted faces = leftOut_.tooFewCorners;
        faces.add(leftOut_.noArea);
        if (!dropped.empty()) context_.warn(source_, faces.first, cat("left out: ", join(dropped)));
        const auto tell = [&](const Counted& what, std::string_view one, std::string_view many,
                              std::string_view rest) {
            if (what.count > 0)
                context_.warn(source_, what.first, cat(counted(what.count, one, many), rest));
        };
        leftOut_.unknown.add(corners_.unknown());
        tell(leftOut_.unknown, "face has", "faces have",
             " texture coordinates or normals that are not in the file; they do without; the first "
             "is here");
        tell(skipped_, "statement", "statements",
             " of points, lines, curves, surfaces or display left out; the first is here");
        tell(unknown_, "unknown statement", "unknown statements", " left out; the first is here");
        tell(vertices_.notFinite, "vertex, normal or texture coordinate is",
             "vertices, normals or texture coordinates are",
             " not finite or too large; faces do without them; the first is here");
        tell(vertices_.colours, "vertex has a colour", "vertices have colours",
             "; materials alone give colour here");
    }

    const SourceFile& source_;
    const ReadContext& context_;
    LineReader in_;
    MeshFile file_;
    MeshBuilder builder_;
    ObjChunks chunks_;
    ObjCounts soFar_;
    CornerReader corners_{in_, chunks_.total, soFar_};

    std::string_view object_, group_, material_;
    bool inPart_ = false, partIsNew_ = false, namesParts_ = false, namesMaterials_ = false;
    std::size_t materialOffset_ = 0, partOffset_ = 0;
    std::optional<std::uint32_t> slot_; // of material_, once a face uses it
    std::unordered_map<std::string_view, std::uint32_t> slots_;
    std::unordered_set<std::string_view> libraries_;
    FacesLeftOut leftOut_;
    VerticesLeftOut vertices_;
    Counted skipped_, unknown_;
};

} // namespace

MeshFile readObj(const SourceFile& source, const ReadContext& context) {
    return ObjReader(source, context).read();
}
