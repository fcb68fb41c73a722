#include "read/nff/entities.h"

#include "base/text.h"
#include "read/added_by_text.h"
#include "read/mesh/triangulate.h"
#include "read/nff/surfaces.h"
#include "read/nff/view.h"

#include <cmath>
#include <span>
#include <utility>

namespace {

NffFillHere readFillHere(NffWords& in, ErrorList& errors, const NffWord& word) {
    NffNumbers numbers(in, errors, word, 8);
    NffFill fill;
    fill.color = numbers.color();
    fill.diffuse = numbers.number(kColor);
    fill.specular = numbers.number(kColor);
    fill.shine = numbers.number({0, 1e9});
    fill.transmittance = numbers.number(kColor);
    fill.ior = numbers.number({-kLargestLength, 1000});
    return {fill, word.loc()};
}

class EntityReader {
public:
    EntityReader(const SourceFile& source, const NffRange& range, const ReadOptions& options,
                 ErrorList& errors)
        : in_(source, range.first), last_(range.last), isFirst_(range.first == 0),
          options_(options), errors_(errors), fill_(range.fill) {}

    NffEntities read() {
        for (NffWord word = in_.next(); !word.text.empty() && word.offset < last_;
             word = in_.next()) {
            readEntity(word);
            previous_ = word;
        }
        out_.lastFill = fill_;
        return std::move(out_);
    }

private:
    struct Entity {
        std::string_view word;
        void (EntityReader::*read)(const NffWord&);
    };
    static std::span<const Entity> entities() {
        static constexpr auto kEntities = std::to_array<Entity>({
            {"v", &EntityReader::readView},
            {"b", &EntityReader::readBackground},
            {"l", &EntityReader::readLight},
            {"f", &EntityReader::readFill},
            {"s", &EntityReader::readSphere},
            {"c", &EntityReader::readCone},
            {"p", &EntityReader::readPolygon},
            {"pp", &EntityReader::readPolygon},
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
        in_.refuseSecond(word, out_.view);
        const auto view = readNffView(in_, errors_, word);
        if (!view) return;
        CameraDesc& camera =
            out_.desc.cameras.emplace_back(nffCamera(*view, options_.nffAngleToEdges));
        camera.name = "view";
        camera.loc = word.loc();
        out_.desc.settings.loc = word.loc();
        out_.desc.settings.width = view->width;
        out_.desc.settings.height = view->height;
    }

    void readBackground(const NffWord& word) {
        in_.refuseSecond(word, out_.background);
        out_.desc.world.loc = word.loc();
        out_.desc.world.background = numbersOf(word, 3).color();
    }

    void readLight(const NffWord& word) {
        NffNumbers numbers = numbersOf(word, 3);
        const Vec3d position = numbers.point();
        const bool hasColor = numbers.more(3);
        LightDesc& light = out_.desc.lights.emplace_back(
            nffLight(position, hasColor ? numbers.color() : Rgbd{1, 1, 1}));
        if (isFirst_) light.name = cat("light", out_.desc.lights.size());
        light.loc = word.loc();
        if (!hasColor) out_.uncolouredLights.push_back(out_.desc.lights.size() - 1);
    }

    void readFill(const NffWord& word) {
        fill_ = readFillHere(in_, errors_, word);
        surface_ = kNotLookedFor;
    }

    // Of the fill in force; nothing without one.
    std::optional<std::uint32_t> surface(const NffWord& user) {
        if (surface_ != kNotLookedFor) return surface_;
        if (!fill_.isGiven()) {
            out_.withoutFill.add(user);
            return {};
        }
        const auto next = static_cast<std::uint32_t>(out_.surfaces.size());
        const auto first = surfaceOf_.insert(fill_.fill, next);
        surface_ = first.value_or(next);
        if (!first) added(out_.surfaces, user) = {fill_, {kNone, kNone}};
        return surface_;
    }

    void addObject(ObjectDesc object, const NffWord& word, std::size_t meshKind = 0) {
        if (const auto surface = this->surface(word))
            object.materials = {static_cast<Handle>(*surface)};
        object.loc = word.loc();
        if (isFirst_) out_.counts.name(object, meshKind);
        added(out_.desc.objects, word) = std::move(object);
    }
    template <class Block> Block& added(std::vector<Block>& blocks, const NffWord& word) const {
        return addedByText(blocks, word.offset, last_);
    }

    void readSphere(const NffWord& word) {
        NffNumbers numbers = numbersOf(word, 4);
        const Vec3d centre = numbers.point();
        const double radius = numbers.number();
        if (radius == 0) return out_.pointSpheres.add(word);
        ObjectDesc sphere;
        sphere.worldFromObject = {{1, 0, 0, centre.x, 0, 1, 0, centre.y, 0, 0, 1, centre.z}};
        sphere.radius = std::fabs(radius);
        // Nothing sees the inside of a closed sphere, so that the outside needs no exception.
        sphere.sides = radius < 0 ? nffSides(fill_.fill, true) : ObjectDesc::Sides::Both;
        addObject(std::move(sphere), word);
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
        if (!cone) return out_.flatCones.add(word);
        cone->sides = nffSides(fill_.fill, baseRadius < 0 || apexRadius < 0);
        addObject(std::move(*cone), word);
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
        if (!hasArea(corners_)) return out_.flatPolygons.add(word);
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
        Handle& mesh = (surface ? out_.surfaces[*surface] : out_.noSurface).meshes[isPatch];
        if (mesh == kNone) {
            mesh = static_cast<Handle>(out_.desc.meshes.size());
            ObjectDesc object;
            object.kind = ObjectDesc::Kind::Mesh;
            object.mesh = mesh;
            object.sides = nffSides(fill_.fill, false);
            addObject(std::move(object), word, isPatch);
            MeshDesc& made = out_.desc.meshes.emplace_back();
            made.name = out_.desc.objects.back().name;
            made.loc = word.loc();
        }
        return out_.desc.meshes[static_cast<std::size_t>(mesh)];
    }

    void addPolygon(MeshDesc& mesh, const NffWord& word) {
        const auto first = static_cast<std::uint32_t>(mesh.points.size());
        makeRoomByText(mesh.points, corners_.size(), mesh.loc.offset, word.offset, last_);
        mesh.points.insert(mesh.points.end(), corners_.begin(), corners_.end());
        mesh.normals.insert(mesh.normals.end(), normals_.begin(), normals_.end());
        triangles_.clear();
        triangulate(corners_, triangles_);
        makeRoomByText(mesh.triangles, triangles_.size(), mesh.loc.offset, word.offset, last_);
        for (const MeshDesc::Corners& t : triangles_) {
            const MeshDesc::Corners corners{first + t[0], first + t[1], first + t[2]};
            mesh.triangles.push_back(corners);
            if (!normals_.empty()) mesh.normalTriangles.push_back(corners);
        }
    }

    static constexpr std::uint32_t kNotLookedFor = static_cast<std::uint32_t>(-1);
    NffWords in_;
    std::size_t last_;
    bool isFirst_;
    const ReadOptions& options_;
    ErrorList& errors_;
    NffEntities out_;
    NffWord previous_;
    NffFillHere fill_;
    std::uint32_t surface_ = kNotLookedFor; // of fill_
    NffSurfaceTable surfaceOf_;
    // Of the polygon that is read; kept for their memory.
    std::vector<Vec3d> corners_;
    std::vector<Vec3> normals_;
    std::vector<MeshDesc::Corners> triangles_;
};

} // namespace

void NffCounts::name(ObjectDesc& object, std::size_t meshKind) {
    const bool isSphere = object.kind == ObjectDesc::Kind::Sphere,
               isMesh = object.kind == ObjectDesc::Kind::Mesh;
    std::size_t& count = isSphere ? spheres : isMesh ? meshes[meshKind] : cones;
    object.name = cat(isSphere        ? "sphere"
                      : !isMesh       ? "cone"
                      : meshKind == 0 ? "polygons"
                                      : "patches",
                      ++count);
}

NffEntities readNffEntities(const SourceFile& source, const NffRange& range,
                            const ReadOptions& options, ErrorList& errors) {
    return EntityReader(source, range, options, errors).read();
}

NffFillHere readNffFill(const SourceFile& source, std::size_t offset, ErrorList& errors) {
    NffWords in(source, offset);
    const NffWord word = in.next();
    return readFillHere(in, errors, word);
}
