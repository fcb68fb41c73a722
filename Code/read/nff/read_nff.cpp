#include "read/nff/read_nff.h"

#include "base/text.h"
#include "desc/validate.h"
#include "read/load.h"
#include "read/mesh/mesh_steps.h"
#include "read/nff/terms.h"
#include "read/nff/view.h"
#include "read/nff/words.h"
#include "read/read_context.h"

#include <array>
#include <cmath>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace {

class NffReader {
public:
    NffReader(const SourceFile& source, const ReadContext& context, ErrorList& errors)
        : in_(source), context_(context), errors_(errors) {}

    // Errors that need not stop are collected, others thrown. Warns.
    SceneDesc read() {
        for (NffWord word = in_.next(); !word.text.empty(); word = in_.next()) {
            readEntity(word);
            previous_ = word;
        }
        finish();
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
        in_.refuseSecond(word, view_);
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
        in_.refuseSecond(word, background_);
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
        if (!hasColor) uncolouredLights_.push_back(desc_.lights.size() - 1);
    }

    void readFill(const NffWord& word) {
        NffNumbers numbers = numbersOf(word, 8);
        fill_.color = numbers.color();
        fill_.diffuse = numbers.number(kColor);
        fill_.specular = numbers.number(kColor);
        fill_.shine = numbers.number({0, 1e9});
        fill_.transmittance = numbers.number(kColor);
        fill_.ior = numbers.number({-kLargestLength, 1000});
        fillLoc_ = word.loc();
        surface_ = kNotLookedFor;
    }

    // The material of the fill in force; nothing without one.
    std::optional<std::uint32_t> surface(const NffWord& user) {
        if (surface_ != kNotLookedFor) return surface_;
        if (fillLoc_.offset == SourceLoc::kUnknown) {
            withoutFill_.add(user.offset);
            return {};
        }
        const auto next = static_cast<std::uint32_t>(desc_.materials.size());
        const auto first = surfaceOf_.insert(fill_, next);
        surface_ = first.value_or(next);
        if (first) return surface_;
        MaterialDesc& material = added(desc_.materials, user) = nffMaterial(fill_);
        material.name = cat("fill", next + 1);
        material.loc = fillLoc_;
        meshesOf_.push_back(kNoMeshes);
        return surface_;
    }

    void addObject(ObjectDesc object, const NffWord& word, std::string_view kind,
                   std::size_t& count) {
        if (const auto surface = this->surface(word))
            object.materials = {static_cast<Handle>(*surface)};
        object.loc = word.loc();
        object.name = cat(kind, ++count);
        added(desc_.objects, word) = std::move(object);
    }
    template <class Block> Block& added(std::vector<Block>& blocks, const NffWord& word) const {
        return addedByText(blocks, word.offset, textSize());
    }
    std::size_t textSize() const { return in_.source().text.size(); }

    void readSphere(const NffWord& word) {
        NffNumbers numbers = numbersOf(word, 4);
        const Vec3d centre = numbers.point();
        const double radius = numbers.number();
        if (radius == 0) return pointSpheres_.add(word.offset);
        ObjectDesc sphere;
        sphere.worldFromObject = {{1, 0, 0, centre.x, 0, 1, 0, centre.y, 0, 0, 1, centre.z}};
        sphere.radius = std::fabs(radius);
        sphere.sides = nffSides(fill_, radius < 0);
        addObject(std::move(sphere), word, "sphere", spheres_);
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
        if (!cone) return flatCones_.add(word.offset);
        cone->sides = nffSides(fill_, baseRadius < 0 || apexRadius < 0);
        addObject(std::move(*cone), word, "cone", cones_);
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
        if (!hasArea(corners_)) return flatPolygons_.add(word.offset);
        addPolygon(meshOf(word, isPatch), word);
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
        const auto surface = this->surface(word);
        Handle& mesh = (surface ? meshesOf_[*surface] : meshesWithoutFill_)[isPatch];
        if (mesh == kNone) {
            mesh = static_cast<Handle>(desc_.meshes.size());
            ObjectDesc object;
            object.kind = ObjectDesc::Kind::Mesh;
            object.mesh = mesh;
            addObject(std::move(object), word, isPatch ? "patches" : "polygons",
                      isPatch ? patches_ : polygons_);
            MeshDesc& made = desc_.meshes.emplace_back();
            made.name = desc_.objects.back().name;
            made.loc = word.loc();
        }
        return desc_.meshes[static_cast<std::size_t>(mesh)];
    }

    void addPolygon(MeshDesc& mesh, const NffWord& word) {
        const auto first = static_cast<std::uint32_t>(mesh.points.size());
        makeRoomByText(mesh.points, corners_.size(), mesh.loc.offset, word.offset, textSize());
        mesh.points.insert(mesh.points.end(), corners_.begin(), corners_.end());
        mesh.normals.insert(mesh.normals.end(), normals_.begin(), normals_.end());
        triangles_.clear();
        triangulate(corners_, triangles_);
        makeRoomByText(mesh.triangles, triangles_.size(), mesh.loc.offset, word.offset, textSize());
        for (const MeshDesc::Corners& t : triangles_) {
            const MeshDesc::Corners corners{first + t[0], first + t[1], first + t[2]};
            mesh.triangles.push_back(corners);
            if (!normals_.empty()) mesh.normalTriangles.push_back(corners);
        }
    }

    // What depends on all of the file.
    void finish() {
        // Every bounce as far as the benchmark's depth of 5, which counts the eye ray as 1.
        desc_.settings.maxDepth = 4;
        desc_.settings.cutoff = 0;
        if (view_ == NffWords::kNotGiven)
            errors_.add({}, [] { return "the file has no view; expected 'v' and its lines"; });
        const double intensity = nffIntensity(desc_.lights.size());
        desc_.world.ambient = {intensity, intensity, intensity};
        for (const std::size_t i : uncolouredLights_) {
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
    // Things that show nothing are left out; all of a kind make one warning.
    void warn(const Counted& leftOut, std::string_view one, std::string_view many) const {
        if (leftOut.count == 0) return;
        context_.warn(in_.source(), leftOut.first,
                      leftOut.count == 1
                          ? cat("a ", one, " left out")
                          : cat(leftOut.count, " ", many, " left out; this is the first"));
    }

    static constexpr std::uint32_t kNotLookedFor = static_cast<std::uint32_t>(-1);
    NffWords in_;
    const ReadContext& context_;
    ErrorList& errors_;
    SceneDesc desc_;
    NffWord previous_;
    NffFill fill_;                          // in force
    SourceLoc fillLoc_;                     // unknown before the first one
    std::uint32_t surface_ = kNotLookedFor; // of fill_
    NffSurfaceTable surfaceOf_;
    // Of polygons and of patches, by their materials.
    using Meshes = std::array<Handle, 2>;
    static constexpr Meshes kNoMeshes{kNone, kNone};
    std::vector<Meshes> meshesOf_;
    Meshes meshesWithoutFill_ = kNoMeshes;
    std::size_t spheres_ = 0, cones_ = 0, polygons_ = 0, patches_ = 0;
    std::vector<std::size_t> uncolouredLights_;
    std::size_t view_ = NffWords::kNotGiven, background_ = NffWords::kNotGiven;
    Counted flatPolygons_, pointSpheres_, flatCones_, withoutFill_;
    // Of the polygon that is read; kept for their memory.
    std::vector<Vec3d> corners_;
    std::vector<Vec3> normals_;
    std::vector<MeshDesc::Corners> triangles_;
};

} // namespace

SceneDesc readNff(const SourceFile& source, const ReadContext& context) {
    checkTextSize(source);
    ErrorList errors(source);
    SceneDesc desc;
    try {
        desc = NffReader(source, context, errors).read();
    } catch (const Error& error) {
        errors.addComplete(error.what());
    }
    errors.throwIfAny();
    return desc;
}
