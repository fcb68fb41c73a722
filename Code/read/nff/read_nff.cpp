#include "read/nff/read_nff.h"

#include "base/text.h"
#include "desc/error_list.h"
#include "desc/name_table.h"
#include "desc/names.h"
#include "read/added_by_text.h"
#include "read/mesh/triangulate.h"
#include "read/nff/terms.h"
#include "read/nff/view.h"
#include "read/nff/words.h"

#include <array>
#include <cmath>
#include <deque>
#include <span>
#include <utility>
#include <vector>

namespace {

// Things that show nothing are left out; all of a kind make one warning.
struct LeftOut {
    std::size_t count = 0, first = 0;
    void add(const NffWord& word) {
        if (count++ == 0) first = word.offset;
    }
};

class NffReader {
public:
    NffReader(const SourceFile& source, const ReadContext& context)
        : in_(source), errors_(source), context_(context) {
        // Every bounce as far as the benchmark's depth of 5, which counts the eye ray as 1.
        desc_.settings.maxDepth = 4;
        desc_.settings.cutoff = 0;
    }

    SceneDesc read() {
        try {
            for (NffWord word = in_.next(); !word.text.empty(); word = in_.next()) {
                readEntity(word);
                previous_ = word;
            }
            finish();
        } catch (const Error& error) {
            errors_.addComplete(error.what());
        }
        errors_.throwIfAny();
        return std::move(desc_);
    }

private:
    struct Entity {
        std::string_view word;
        void (NffReader::*read)(const NffWord&);
    };
    static std::span<const Entity> entities() {
        static constexpr auto kEntities = std::to_array<Entity>({
            {"v", &NffReader::readView},
            {"b", &NffReader::readBackground},
            {"l", &NffReader::readLight},
            {"f", &NffReader::readFill},
            {"s", &NffReader::readSphere},
            {"c", &NffReader::readCone},
            {"p", &NffReader::readPolygon},
            {"pp", &NffReader::readPolygon},
        });
        return kEntities;
    }

    void readEntity(const NffWord& word) {
        for (const Entity& entity : entities())
            if (entity.word.front() == word.text.front() && entity.word == word.text)
                return (this->*entity.read)(word);
        if (startsNumber(word) && !previous_.text.empty())
            in_.failAt(word,
                       cat("expected an entity, got ", described(word), "; the '", previous_.text,
                           "' at line ", in_.lineOf(previous_.offset), " has all its numbers"));
        if (isNffViewLine(word))
            in_.failAt(word, cat("'", word.text, "' belongs to a view; expected 'v' before it"));
        std::string known;
        for (const Entity& entity : entities())
            known += cat(known.empty() ? "" : ", ", entity.word);
        in_.failAt(word, cat("unknown entity ", described(word), "; known: ", known));
    }

    NffNumbers numbersOf(const NffWord& word, std::size_t count) {
        return {in_, errors_, word, count};
    }
    void readView(const NffWord& word) {
        in_.refuseSecond(word, viewGiven_);
        const auto view = readNffView(in_, errors_, word);
        if (!view) return;
        CameraDesc& camera =
            desc_.cameras.emplace_back(nffCamera(*view, context_.options.nffAngleToEdges));
        camera.name = "view";
        camera.loc = word.loc();
        desc_.settings.loc = word.loc();
        desc_.settings.width = view->width;
        desc_.settings.height = view->height;
    }

    void readBackground(const NffWord& word) {
        in_.refuseSecond(word, backgroundGiven_);
        desc_.world.loc = word.loc();
        desc_.world.background = numbersOf(word, 3).color();
    }

    void readLight(const NffWord& word) {
        NffNumbers numbers = numbersOf(word, 3);
        const Vec3d position = numbers.point();
        const bool hasColor = numbers.more(3);
        LightDesc& light = desc_.lights.emplace_back(
            nffLight(position, hasColor ? numbers.color() : Rgbd{1, 1, 1}));
        light.name = cat("light", desc_.lights.size());
        light.loc = word.loc();
        if (!hasColor) uncoloured_.push_back(desc_.lights.size() - 1);
    }

    void readFill(const NffWord& word) {
        NffNumbers numbers = numbersOf(word, 8);
        fill_.color = numbers.color();
        fill_.diffuse = numbers.number(kColor);
        fill_.specular = numbers.number(kColor);
        fill_.shine = numbers.number({0, 1e9});
        fill_.transmittance = numbers.number(kColor);
        fill_.ior = numbers.number({-kLargestLength, 1000});
        fillWord_ = word;
        slot_ = nullptr;
    }

    // What is made for a fill when the first thing uses it: equal fills share it.
    struct Slot {
        std::array<double, 8> fill{}; // its numbers, whose bytes are what tells fills apart
        Handle material = kNone;
        std::array<Handle, 2> meshes{kNone, kNone}; // of polygons, of patches
    };
    Slot& slot(const NffWord& user) {
        if (slot_) return *slot_;
        if (fillWord_.text.empty()) {
            withoutFill_.add(user);
            return noFill_;
        }
        const auto [r, g, b] = fill_.color;
        Slot& made = slots_.emplace_back();
        made.fill = {
            r, g, b, fill_.diffuse, fill_.specular, fill_.shine, fill_.transmittance, fill_.ior};
        for (double& number : made.fill) number += 0.0; // -0 becomes 0
        const std::string_view bytes(reinterpret_cast<const char*>(made.fill.data()),
                                     sizeof made.fill);
        const auto number = static_cast<std::uint32_t>(slots_.size() - 1);
        if (const auto first = slotOf_.insert(bytes, number)) {
            slots_.pop_back();
            slot_ = &slots_[*first];
        } else {
            slot_ = &made;
        }
        if (slot_->material == kNone) {
            slot_->material = static_cast<Handle>(desc_.materials.size());
            MaterialDesc& material = added(desc_.materials, user);
            material = nffMaterial(fill_);
            material.name = cat("fill", desc_.materials.size());
            material.loc = fillWord_.loc();
        }
        return *slot_;
    }

    void addObject(ObjectDesc object, const NffWord& word, std::string_view kind,
                   std::size_t number) {
        const Slot& slot = this->slot(word);
        object.name = cat(kind, number);
        object.loc = word.loc();
        if (slot.material != kNone) object.materials = {slot.material};
        added(desc_.objects, word) = std::move(object);
    }
    template <class Block> Block& added(std::vector<Block>& blocks, const NffWord& word) const {
        return addedByText(blocks, word.offset, in_.source().text.size());
    }

    void readSphere(const NffWord& word) {
        NffNumbers numbers = numbersOf(word, 4);
        const Vec3d centre = numbers.point();
        const double radius = numbers.number();
        if (radius == 0) return pointSpheres_.add(word);
        ObjectDesc sphere;
        sphere.worldFromObject = {{1, 0, 0, centre.x, 0, 1, 0, centre.y, 0, 0, 1, centre.z}};
        sphere.radius = std::fabs(radius);
        // Nothing sees the inside of a closed sphere, so that the outside needs no exception.
        sphere.sides = radius < 0 ? nffSides(fill_, true) : ObjectDesc::Sides::Both;
        addObject(std::move(sphere), word, "sphere", ++sphereCount_);
    }

    void readCone(const NffWord& word) {
        NffNumbers numbers = numbersOf(word, 8);
        const Vec3d base = numbers.point();
        const double baseRadius = numbers.number();
        const Vec3d apex = numbers.point();
        const double apexRadius = numbers.number();
        if (baseRadius * apexRadius < 0)
            return errors_.add(word.loc(), [&] {
                return cat("the radii of 'c' have different signs: ", shortest(baseRadius), " and ",
                           shortest(apexRadius), "; negative ones show the inside");
            });
        auto cone = nffCone(base, std::fabs(baseRadius), apex, std::fabs(apexRadius));
        if (!cone) return flatCones_.add(word);
        cone->sides = nffSides(fill_, baseRadius < 0 || apexRadius < 0);
        addObject(std::move(*cone), word, "cone", ++coneCount_);
    }

    // p n, and pp n with a normal behind each corner.
    void readPolygon(const NffWord& word) {
        const bool isPatch = word.text == "pp";
        const std::size_t numbersPerCorner = isPatch ? 6 : 3;
        const std::size_t count = readCount(word, numbersPerCorner);
        NffNumbers numbers = numbersOf(word, count * numbersPerCorner);
        corners_.clear();
        normals_.clear();
        for (std::size_t i = 0; i < count; ++i) {
            corners_.push_back(numbers.point());
            if (isPatch) normals_.push_back(toFloat(numbers.point()));
        }
        if (!hasArea(corners_)) return flatPolygons_.add(word);
        addPolygon(meshOf(word, isPatch));
    }

    std::size_t readCount(const NffWord& word, std::size_t numbersPerCorner) {
        const NffWord number = in_.next();
        const auto count = parseInteger(number.text);
        if (!count || *count < 0)
            in_.failAt(number, cat("expected the number of corners after '", word.text, "', got ",
                                   described(number)));
        // A number takes two bytes at least: counts that cannot be are found before they cost
        // memory.
        const std::size_t possible = (in_.bytesLeft() + 1) / (2 * numbersPerCorner);
        if (static_cast<unsigned long long>(*count) > possible)
            in_.failAt(number, cat("'", word.text, " ", *count,
                                   "' is more than the rest of the file can hold (", possible,
                                   " at most)"));
        if (static_cast<unsigned long long>(*count) > kMostCorners)
            in_.failAt(number, cat("a polygon has at most ", kMostCorners, " corners, got ",
                                   described(number)));
        return static_cast<std::size_t>(*count);
    }

    // All polygons of a fill are one mesh, its patches another: files have thousands of them.
    MeshDesc& meshOf(const NffWord& word, bool isPatch) {
        Handle& mesh = slot(word).meshes[isPatch ? 1 : 0];
        if (mesh == kNone) {
            mesh = static_cast<Handle>(desc_.meshes.size());
            ObjectDesc object;
            object.kind = ObjectDesc::Kind::Mesh;
            object.mesh = mesh;
            object.sides = nffSides(fill_, false);
            addObject(std::move(object), word, isPatch ? "patches" : "polygons",
                      ++meshCounts_[isPatch ? 1 : 0]);
            MeshDesc& made = desc_.meshes.emplace_back();
            made.name = desc_.objects.back().name;
            made.loc = word.loc();
        }
        return desc_.meshes[static_cast<std::size_t>(mesh)];
    }

    void addPolygon(MeshDesc& mesh) {
        const auto first = static_cast<std::uint32_t>(mesh.points.size());
        mesh.points.insert(mesh.points.end(), corners_.begin(), corners_.end());
        mesh.normals.insert(mesh.normals.end(), normals_.begin(), normals_.end());
        triangles_.clear();
        triangulate(corners_, triangles_);
        for (const MeshDesc::Corners& t : triangles_) {
            const MeshDesc::Corners corners{first + t[0], first + t[1], first + t[2]};
            mesh.triangles.push_back(corners);
            if (!normals_.empty()) mesh.normalTriangles.push_back(corners);
        }
    }

    void finish() {
        if (viewGiven_ == NffWords::kNotGiven)
            errors_.add({}, [] { return "the file has no view; expected 'v' and its lines"; });
        const double intensity = nffIntensity(desc_.lights.size());
        desc_.world.ambient = {intensity, intensity, intensity};
        for (const std::size_t i : uncoloured_) {
            Rgbd& color = desc_.lights[i].color;
            color = {color.r * intensity, color.g * intensity, color.b * intensity};
        }
        warn(flatPolygons_, "polygon without an area was", "polygons without an area were");
        warn(pointSpheres_, "sphere of radius 0 was", "spheres of radius 0 were");
        warn(flatCones_, "cone without height or radius was",
             "cones without height or radius were");
        if (withoutFill_.count > 0)
            context_.warn(in_.source(), withoutFill_.first,
                          "there is no fill ('f') before this; it is grey");
    }

    void warn(const LeftOut& leftOut, std::string_view one, std::string_view many) {
        if (leftOut.count == 0) return;
        context_.warn(in_.source(), leftOut.first,
                      leftOut.count == 1
                          ? cat("a ", one, " left out")
                          : cat(leftOut.count, " ", many, " left out; this is the first"));
    }

    NffWords in_;
    ErrorList errors_;
    const ReadContext& context_;
    SceneDesc desc_;
    NffWord previous_;
    std::size_t viewGiven_ = NffWords::kNotGiven, backgroundGiven_ = NffWords::kNotGiven;
    std::vector<std::size_t> uncoloured_; // lights
    NffFill fill_;
    NffWord fillWord_;
    std::deque<Slot> slots_; // which stay where they are
    NameTable slotOf_;       // by the bytes of its fill
    Slot noFill_;
    Slot* slot_ = nullptr; // of fill_, once something uses it
    std::size_t sphereCount_ = 0, coneCount_ = 0;
    std::array<std::size_t, 2> meshCounts_{};
    LeftOut flatPolygons_, pointSpheres_, flatCones_, withoutFill_;
    // Of the polygon that is read; kept for their memory.
    std::vector<Vec3d> corners_;
    std::vector<Vec3> normals_;
    std::vector<MeshDesc::Corners> triangles_;
};

} // namespace

SceneDesc readNff(const SourceFile& source, const ReadContext& context) {
    // Locations are 32 bits wide.
    if (source.text.size() >= SourceLoc::kUnknown)
        fail(ErrorKind::Input, cat(source.name, ": error: the file is larger than 4 GiB"));
    return NffReader(source, context).read();
}
