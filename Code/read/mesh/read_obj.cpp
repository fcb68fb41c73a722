#include "read/mesh/read_obj.h"

#include "base/text.h"
#include "desc/names.h"
#include "desc/range.h"
#include "read/mesh/line_reader.h"
#include "read/mesh/mesh_builder.h"
#include "read/mesh/triangulate.h"

#include <algorithm>
#include <array>
#include <optional>
#include <unordered_map>
#include <unordered_set>

namespace {

constexpr double kLargestFloat = 1e15; // as in native meshes: its square is far from the end

// What the standard knows besides faces: points, lines, free-form curves and surfaces, display.
constexpr std::string_view kOtherStatements[] = {
    "p",     "l",    "vp",     "cstype", "deg",      "bmat",     "step",       "curv",      "curv2",
    "surf",  "parm", "trim",   "hole",   "scrv",     "sp",       "end",        "con",       "mg",
    "bevel", "lod",  "ctech",  "stech",  "res",      "bsp",      "bzp",        "cdc",       "cdp",
    "call",  "csh",  "usemap", "maplib", "c_interp", "d_interp", "shadow_obj", "trace_obj",
};

// How often something happened, and where first.
struct Counted {
    std::size_t count = 0, first = 0;
    void add(std::size_t offset) {
        if (count++ == 0) first = offset;
    }
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
        count();
        in_.rewind();
        readVertices();
        in_.rewind();
        readFaces();
        finish();
        return std::move(file_);
    }

private:
    struct Counts {
        std::size_t points = 0, uvs = 0, normals = 0;
    };

    void count() {
        std::size_t triangles = 0;
        while (in_.nextLine()) {
            const char first = *in_.text();
            if (first == 'v') {
                countVertex(total_);
            } else if (first == 'f' && takeFace()) {
                std::size_t corners = 0;
                for (; !in_.word().empty(); ++corners)
                    ;
                triangles += corners < 3 ? 0 : corners - 2;
            }
        }
        MeshDesc& mesh = builder_.mesh;
        mesh.points.reserve(total_.points);
        mesh.uvs.reserve(total_.uvs);
        mesh.normals.reserve(total_.normals);
        builder_.reserve(triangles);
    }
    bool countVertex(Counts& counts) {
        if (in_.take("v"))
            ++counts.points;
        else if (in_.take("vn"))
            ++counts.normals;
        else if (in_.take("vt"))
            ++counts.uvs;
        else
            return false;
        return true;
    }
    bool takeFace() { return in_.take("f") || in_.take("fo"); } // fo: an old word for the same

    void readVertices() {
        MeshDesc& mesh = builder_.mesh;
        while (in_.nextLine()) {
            if (*in_.text() != 'v') continue;
            if (in_.take("v")) {
                readPoint();
            } else if (in_.take("vn")) {
                const float x = in_.number<float>("vn", kLargestFloat),
                            y = in_.number<float>("vn", kLargestFloat),
                            z = in_.number<float>("vn", kLargestFloat);
                mesh.normals.push_back({x, y, z});
                expectLineEnd("vn");
            } else if (in_.take("vt")) {
                Vec2 uv;
                uv.x = in_.number<float>("vt", kLargestFloat);
                if (!in_.atLineEnd()) uv.y = in_.number<float>("vt", kLargestFloat);
                if (!in_.atLineEnd())
                    in_.number<float>("vt", kLargestFloat); // of pictures with depth
                mesh.uvs.push_back(uv);
                expectLineEnd("vt");
            }
        }
    }
    // x y z, then w (of curves) or r g b or both.
    void readPoint() {
        Vec3d p;
        p.x = in_.number<double>("v", kLargestLength);
        p.y = in_.number<double>("v", kLargestLength);
        p.z = in_.number<double>("v", kLargestLength);
        builder_.mesh.points.push_back(p);
        int more = 0;
        for (; more < 4 && !in_.atLineEnd(); ++more) in_.number<double>("v", kLargestLength);
        if (more == 2)
            in_.failAt(in_.offset(), "'v' has 5 numbers; x y z, then w or r g b or both are known");
        if (more >= 3) colours_.add(in_.offset());
        expectLineEnd("v");
    }
    void expectLineEnd(std::string_view keyword) {
        if (!in_.atLineEnd())
            in_.failAt(in_.offset(), cat("expected the end of the line after '", keyword, "', got ",
                                         in_.nextWord()));
    }

    void readFaces() {
        while (in_.nextLine()) {
            const char first = *in_.text();
            if (first == 'v' && countVertex(soFar_)) continue;
            const std::size_t start = in_.offset();
            if (first == 'f' && takeFace())
                readFace(start);
            else
                readOther();
        }
    }

    void readFace(std::size_t start) {
        corners_.clear();
        while (!in_.atLineEnd()) {
            if (corners_.size() == kMostCorners)
                in_.failAt(in_.offset(),
                           cat("a face with more than ", kMostCorners, " corners; divide it"));
            readCorner();
        }
        if (corners_.size() < 3) return tooFewCorners_.add(start);
        if (!inPart_) startPart();
        if (!slot_) startMaterial();
        builder_.slot = *slot_;
        const std::size_t before = builder_.mesh.triangles.size();
        if (!builder_.addFace(corners_)) return noArea_.add(start);
        if (partIsNew_) {
            file_.parts.push_back(
                {partName(), static_cast<std::uint32_t>(before), locOf(partOffset_)});
            partIsNew_ = false;
        }
    }

    // v, v/vt, v//vn, v/vt/vn; as some programs write it also v/ v// v/vt/
    void readCorner() {
        const std::size_t start = in_.offset();
        const char* p = in_.text();
        MeshBuilder::Corner corner;
        corner.point = readIndex(p, total_.points, soFar_.points, "vertex", "vertices");
        if (*p == '/') {
            ++p;
            if (*p != '/' && !in_.isNumberEnd(p))
                corner.uv = readIndex(p, total_.uvs, soFar_.uvs, "'vt'", "of them");
            if (*p == '/' && !in_.isNumberEnd(++p))
                corner.normal = readIndex(p, total_.normals, soFar_.normals, "'vn'", "of them");
        }
        if (!in_.isNumberEnd(p)) failCorner(start);
        constexpr std::uint32_t kMissing = MeshBuilder::kMissing;
        if (!corners_.empty() && ((corner.uv == kMissing) != (corners_[0].uv == kMissing) ||
                                  (corner.normal == kMissing) != (corners_[0].normal == kMissing)))
            in_.failAt(start, cat("corner ", in_.nextWord(),
                                  " is not written as the first one of its face; all are v, v/vt, "
                                  "v//vn or v/vt/vn"));
        corners_.push_back(corner);
        in_.moveTo(p);
    }
    [[noreturn]] void failCorner(std::size_t start) {
        in_.failAt(start, cat("expected a corner of a face (v, v/vt, v//vn or v/vt/vn), got ",
                              in_.nextWord()));
    }

    // From 1, or from -1 for the last one so far. The reader still stands at the corner.
    std::uint32_t readIndex(const char*& p, std::size_t total, std::size_t soFar,
                            std::string_view one, std::string_view many) {
        const char* const start = p;
        const bool fromEnd = *p == '-';
        const auto index = readUnsigned(p + (fromEnd ? 1 : 0));
        if (index.fault == NumberFault::NotANumber) failCorner(in_.offset());
        const std::uint32_t value = index.value;
        if (index.fault == NumberFault::TooLarge || value == 0 ||
            value > (fromEnd ? soFar : total)) {
            const char* last = start + (fromEnd ? 1 : 0);
            while (*last >= '0' && *last <= '9') ++last;
            const std::string written = shown({start, static_cast<std::size_t>(last - start)});
            if (value == 0 && index.fault == NumberFault::None)
                in_.failAt(in_.offsetOf(start), "there is no index 0; the first is 1, the last -1");
            in_.failAt(in_.offsetOf(start),
                       fromEnd ? cat("there is no ", one, " ", written, "; only ", soFar, " ",
                                     soFar == 1 ? "comes" : "come", " before this line")
                               : cat("there is no ", one, " ", written, "; the file has ", total,
                                     " ", many));
        }
        p = index.end;
        return static_cast<std::uint32_t>(fromEnd ? soFar - value : value - 1);
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
            const std::size_t faces = tooFewCorners_.count + noArea_.count;
            in_.failAt(0, faces == 0 ? "the file has no faces"
                                     : cat("none of the ", counted(faces, "face", "faces"),
                                           " has three corners and an area"));
        }
        const MeshBuilder::Dropped dropped = builder_.finish();
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
        std::size_t first = 0;
        if (tooFewCorners_.count > 0)
            dropped.push_back(cat(counted(tooFewCorners_.count, "face", "faces"),
                                  " with fewer than three corners"));
        if (noArea_.count > 0)
            dropped.push_back(cat(counted(noArea_.count, "face", "faces"), " without area"));
        if (unusedPoints > 0)
            dropped.push_back(
                cat(counted(unusedPoints, "vertex", "vertices"), " that no face uses"));
        if (tooFewCorners_.count > 0) first = tooFewCorners_.first;
        if (noArea_.count > 0 && (tooFewCorners_.count == 0 || noArea_.first < first))
            first = noArea_.first;
        if (!dropped.empty()) context_.warn(source_, first, cat("left out: ", join(dropped)));
        const auto tell = [&](const Counted& what, std::string_view one, std::string_view many,
                              std::string_view rest) {
            if (what.count > 0)
                context_.warn(source_, what.first, cat(counted(what.count, one, many), rest));
        };
        tell(skipped_, "statement", "statements",
             " of points, lines, curves, surfaces or display left out; the first is here");
        tell(unknown_, "unknown statement", "unknown statements", " left out; the first is here");
        tell(colours_, "vertex has a colour", "vertices have colours",
             "; materials alone give colour here");
    }

    const SourceFile& source_;
    const ReadContext& context_;
    LineReader in_;
    MeshFile file_;
    MeshBuilder builder_;
    Counts total_, soFar_;
    std::vector<MeshBuilder::Corner> corners_;

    std::string_view object_, group_, material_;
    bool inPart_ = false, partIsNew_ = false, namesParts_ = false, namesMaterials_ = false;
    std::size_t materialOffset_ = 0, partOffset_ = 0;
    std::optional<std::uint32_t> slot_; // of material_, once a face uses it
    std::unordered_map<std::string_view, std::uint32_t> slots_;
    std::unordered_set<std::string_view> libraries_;
    Counted tooFewCorners_, noArea_, skipped_, unknown_, colours_;
};

} // namespace

MeshFile readObj(const SourceFile& source, const ReadContext& context) {
    return ObjReader(source, context).read();
}
