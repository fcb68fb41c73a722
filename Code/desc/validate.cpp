#include "desc/validate.h"

#include "base/text.h"
#include "base/transform.h"
#include "desc/error_list.h"
#include "desc/name_table.h"
#include "desc/names.h"
#include "desc/properties.h"
#include "desc/scene_bounds.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <vector>

namespace {

constexpr std::uint32_t kLargestSlot = 65535; // Blender's limit is 32767

// "sphere 'ball'", "settings"
template <class Block> std::string called(const Block& block) {
    if constexpr (requires { block.name; })
        return cat(wordOf(block), " '", shown(block.name), "'");
    else
        return std::string(wordOf(block));
}

constexpr std::size_t kListed = 10;
// "a, b, c and 4 more"; `names` are at least the first kListed of `count`.
std::string listed(const std::vector<std::string>& names, std::size_t count) {
    const std::span<const std::string> all = names;
    const std::string head = join(all.first(std::min(names.size(), kListed)));
    return count > kListed ? cat(head, " and ", count - kListed, " more") : head;
}

std::string mustHave(std::string_view keyword, const Range& range, double value) {
    if (!std::isfinite(value)) return cat("'", keyword, "' is not a finite number");
    return cat("'", keyword, "' ", mustBe(range, value), ", got ", shortest(value));
}

// The largest size of some numbers; infinite where one is none.
double largestOf(std::span<const double> numbers) {
    double largest = 0, zero = 0;
    for (const double x : numbers) {
        largest = std::max(largest, std::fabs(x));
        zero += x * 0;
    }
    if (zero == 0) return largest;
    return kInfinity;
}

// Are four corners in one plane, in order around a convex quadrilateral with an area?
std::string_view faultOfCorners(const Corners4& c) {
    const Vec3d normal = cross(c[2] - c[0], c[3] - c[1]); // twice the area vector
    const double size = std::max(maxAbs(c[2] - c[0]), maxAbs(c[3] - c[1]));
    double farthest = 0;
    for (const Vec3d& corner : c) farthest = std::max(farthest, maxAbs(corner));
    if (!(length(normal) > 1e-12 * size * size)) return "'corners' have no area";
    const Vec3d unit = normalize(normal);
    // Corners from a file in single precision are off by an ulp or two, 2.4e-7 of their size.
    if (!(std::fabs(dot(unit, c[1] - c[0])) <= 1e-5 * size + 2.4e-7 * farthest))
        return "'corners' do not lie in one plane";
    for (std::size_t i = 0; i < 4; ++i) {
        const Vec3d in = c[(i + 1) % 4] - c[i], out = c[(i + 2) % 4] - c[(i + 1) % 4];
        if (!(dot(cross(in, out), unit) > 1e-12 * size * size))
            return "'corners' must go around a convex quadrilateral";
    }
    return {};
}

class Validator {
public:
    Validator(const SceneDesc& desc, const SourceFile& source, Diagnostics& diagnostics)
        : desc_(desc), source_(source), diagnostics_(diagnostics) {
        for (const auto& row : kEnumNames<Target>)
            used_[static_cast<std::size_t>(row.value)].resize(countOf(row.value));
    }

    void run() {
        checkProperties(desc_.settings);
        checkProperties(desc_.world);
        stage_ = Stage::Names;
        checkSettings();
        stage_ = Stage::Wholes;
        if (desc_.cameras.empty()) errors().add({}, [] { return "the scene has no camera"; });
        checkBlocks(desc_.cameras, "camera");
        checkBlocks(desc_.textures, "texture");
        checkBlocks(desc_.materials, "material");
        checkBlocks(desc_.lights, "light");
        checkBlocks(desc_.meshes, "mesh"); // before those who show them
        checkBlocks(desc_.objects, "object");
        ErrorList all(source_);
        for (const ErrorList& some : errors_) all.append(some);
        all.throwIfAny();
        warnUnused();
        warnDark();
        warnFar();
    }

private:
    // Messages come in this order: of single properties, of names, of blocks as wholes.
    enum class Stage : std::size_t { Properties, Names, Wholes };
    ErrorList& errors() { return errors_[static_cast<std::size_t>(stage_)]; }
    template <class Block, class... Parts> void error(const Block& block, const Parts&... parts) {
        errors().add(block.loc, [&] { return cat(called(block), ": ", parts...); });
    }
    void warn(SourceLoc loc, std::string_view what) {
        diagnostics_.warnings.push_back(errors().locatedAt(loc, what, "warning"));
    }

    // All stages of a few blocks before the next ones: those of large files come from the memory
    // once.
    template <class Block>
    void checkBlocks(const std::vector<Block>& blocks, std::string_view kind) {
        constexpr std::size_t kTogether = 32;
        NameTable seen(blocks.size());
        for (std::size_t first = 0; first < blocks.size(); first += kTogether) {
            const std::size_t last = std::min(blocks.size(), first + kTogether);
            stage_ = Stage::Properties;
            for (std::size_t i = first; i < last; ++i) {
                seen.prepare(blocks[i].name);
                checkProperties(blocks[i]);
            }
            stage_ = Stage::Names;
            for (std::size_t i = first; i < last; ++i) checkName(blocks, i, kind, seen);
            stage_ = Stage::Wholes;
            for (std::size_t i = first; i < last; ++i) checkWhole(blocks[i]);
        }
    }

    template <class Block> void checkProperties(const Block& block) {
        forEachRow<Block>([&](auto row) {
            constexpr const Property<Block>& property = propertiesOf<Block>()[decltype(row)::value];
            const auto checkNumber = [&](const auto& number) {
                const auto value = static_cast<double>(number);
                if (!property.range.contains(value) && (property.kinds & kindOf(block)))
                    error(block, mustHave(property.keyword, property.range, value));
            };
            forEachNumberOf(block, std::get<property.first.index()>(property.first), checkNumber);
            if constexpr (property.second)
                forEachNumberOf(block, std::get<property.second->index()>(*property.second),
                                checkNumber);
            if constexpr (std::is_same_v<Block, LightDesc>)
                if (!(property.kinds & kindOf(block)) && !isDefault(block, property))
                    warn(block.loc, cat(called(block), ": '", property.keyword,
                                        "' has no effect on type ", nameOf(block.kind)));
        });
        forEachReference(block, [&](Handle handle, Target target, std::string_view keyword) {
            if (handle == kNone) return;
            if (handle < 0 || static_cast<std::size_t>(handle) >= countOf(target))
                return error(block, "'", keyword, "' refers to ", nameOf(target), " ", handle,
                             " of ", countOf(target));
            used_[static_cast<std::size_t>(target)][static_cast<std::size_t>(handle)] = true;
        });
    }

    template <class Block>
    static bool isDefault(const Block& block, const Property<Block>& property) {
        static const Block defaults{};
        return sameField(block, defaults, property.first) &&
               (!property.second || sameField(block, defaults, *property.second));
    }

    std::size_t countOf(Target target) const {
        return target == Target::Texture    ? desc_.textures.size()
               : target == Target::Material ? desc_.materials.size()
                                            : desc_.meshes.size();
    }

    void checkSettings() {
        const SettingsDesc& s = desc_.settings;
        constexpr long long kLargestArea = 1 << 28; // 3 GiB as float RGB
        if (static_cast<long long>(s.width) * s.height > kLargestArea)
            error(s, "'resolution' ", s.width, " ", s.height, " has more than 2^28 pixels");
        if (!s.crop) return;
        const auto [x0, y0, x1, y1] = *s.crop;
        if (x0 >= x1 || y0 >= y1) error(s, "'crop' is empty; x0 < x1 and y0 < y1 are needed");
        if (x1 > s.width || y1 > s.height)
            error(s, "'crop' ends at ", x1, " ", y1, ", outside the resolution ", s.width, " ",
                  s.height);
    }

    template <class Block>
    void checkName(const std::vector<Block>& blocks, std::size_t i, std::string_view kind,
                   NameTable& seen) {
        const Block& block = blocks[i];
        if (block.name.empty() || findBadText(block.name) != std::string_view::npos)
            error(block, "a name is UTF-8 without control characters, and not empty");
        if (const auto first = seen.insert(block.name, static_cast<std::uint32_t>(i)))
            error(block, "another ", kind, " has this name", atLine(blocks[*first].loc));
    }
    std::string atLine(SourceLoc loc) const {
        if (loc.offset >= source_.text.size()) return "";
        const auto begin = source_.text.begin();
        return cat(" already, at line ",
                   1 + std::count(begin, begin + static_cast<std::ptrdiff_t>(loc.offset), '\n'));
    }

    template <class Block> void checkKeys(const Block& block, std::span<const Rows> keys) {
        if (keys.empty()) error(block, "has no transform at all; one key is needed");
        bool mirrors = false, turnsOver = false;
        for (const Rows& rows : keys) {
            const double largest = largestOf(rows);
            largestOfMaps_ = std::max(largest, largestOfMaps_);
            if (!(largest <= kLargestLength))
                return error(block, "its transform has numbers beyond ", shortest(kLargestLength));
            const Transform::Orientation orientation = Transform::orientationOf(rows);
            if (orientation == Transform::Orientation::Lost)
                return error(block, "its transform flattens it: a scale is 0");
            const bool isMirror = orientation == Transform::Orientation::Mirrored;
            if (&rows == &keys.front()) mirrors = isMirror;
            turnsOver = turnsOver || isMirror != mirrors;
        }
        if (turnsOver)
            error(block,
                  "one of its keys mirrors and another does not: on the way it would be flat");
    }

    void checkWhole(const CameraDesc& camera) { checkKeys(camera, camera.worldFromCamera); }
    void checkWhole(const MaterialDesc&) {}
    void checkWhole(const TextureDesc& texture) {
        if (texture.file.empty())
            error(texture, "has no 'file'");
        else if (texture.file.find('\0') != std::string::npos ||
                 findBadText(texture.file) != std::string::npos)
            error(texture, "its 'file' is not UTF-8 without control characters");
    }

    void checkWhole(const LightDesc& light) {
        checkKeys(light, {&light.worldFromLight, 1});
        if (light.kind == LightDesc::Kind::Sphere && !(light.radius > 0))
            error(light, "a light of type sphere needs a 'radius' > 0");
        if (light.attenuation == Vec3d{})
            error(light, "'attenuation' 0 0 0 would be light without end; 1 0 0 is the usual one");
    }

    void checkWhole(const ObjectDesc& object) {
        checkKeys(object, object.worldFromObject);
        reach_ = std::max({reach_, object.radius, object.topRadius});
        if (std::find(object.materials.begin(), object.materials.end(), kNone) !=
            object.materials.end())
            error(object, "one of its material slots is empty");
        using enum ObjectDesc::Kind;
        if (object.kind == Mesh) return checkInstance(object);
        const std::size_t most = object.kind == InfinitePlane ? 2 : 1;
        if (object.materials.size() > most)
            error(object, "has ", object.materials.size(),
                  " materials; only an instance has more than ", most == 1 ? "one" : "two");
        if (object.kind == Cone && object.radius == 0 && object.topRadius == 0)
            error(object, "'radius' and 'top_radius' are both 0");
        if (object.kind != Plane) return;
        if (const auto fault = faultOfCorners(*object.corners); !fault.empty())
            error(object, fault);
        for (const Vec3d& corner : *object.corners) reach_ = std::max(reach_, maxAbs(corner));
    }

    void checkInstance(const ObjectDesc& object) {
        if (object.mesh == kNone) return error(object, "has no 'mesh'");
        if (object.mesh < 0 || static_cast<std::size_t>(object.mesh) >= slots_.size())
            return; // told above
        // Without materials, all slots show the default one; with one, all show that.
        const std::uint32_t slots = slots_[static_cast<std::size_t>(object.mesh)];
        if (object.materials.size() > 1 && slots > object.materials.size())
            error(object, "its mesh uses material slot ", slots - 1, ", but it has ",
                  object.materials.size(), " materials (slots count from 0)");
    }

    void checkWhole(const MeshDesc& mesh) {
        if (!mesh.file.empty()) return slots_.push_back(1); // not read yet
        if (mesh.triangles.empty()) error(mesh, "has no triangles");
        for (std::size_t i = 0; i < mesh.points.size(); ++i) {
            const Vec3d& p = mesh.points[i];
            const double size = largestOf(std::array{p.x, p.y, p.z});
            if (!(size <= kLargestLength)) {
                error(mesh, "point ", i, " is not finite or beyond ", shortest(kLargestLength));
                break;
            }
            reach_ = std::max(reach_, size);
        }
        checkCorners(mesh, mesh.triangles, mesh.points.size(), "points", "triangles");
        checkCorners(mesh, mesh.normalTriangles, mesh.normals.size(), "normals",
                     "normal_triangles");
        checkCorners(mesh, mesh.uvTriangles, mesh.uvs.size(), "uvs", "uv_triangles");
        for (const Vec3& n : mesh.normals)
            if (!std::isfinite(dot(n, n))) {
                error(mesh, "a normal is not finite or too large");
                break;
            }
        for (const Vec2& uv : mesh.uvs)
            if (!std::isfinite(uv.x) || !std::isfinite(uv.y)) {
                error(mesh, "a uv is not finite");
                break;
            }
        std::uint32_t slots = 1;
        for (const std::uint32_t slot : mesh.triangleMaterials) {
            if (slot > kLargestSlot) {
                error(mesh, "material slot ", slot, " is above ", kLargestSlot);
                break;
            }
            slots = std::max(slots, slot + 1);
        }
        slots_.push_back(slots);
        if (!mesh.triangleMaterials.empty() &&
            mesh.triangleMaterials.size() != mesh.triangles.size())
            error(mesh, "has ", mesh.triangles.size(), " triangles, but ",
                  mesh.triangleMaterials.size(), " triangle_materials");
    }

    void checkCorners(const MeshDesc& mesh, const std::vector<MeshDesc::Corners>& corners,
                      std::size_t count, std::string_view values, std::string_view keyword) {
        if (keyword != "triangles") {
            if (corners.empty() && count > 0)
                return error(mesh, "has ", values, ", but no ", keyword);
            if (!corners.empty() && corners.size() != mesh.triangles.size())
                return error(mesh, "has ", mesh.triangles.size(), " triangles, but ",
                             corners.size(), " ", keyword);
        }
        std::uint32_t largest = 0;
        for (const MeshDesc::Corners& c : corners) largest = std::max({largest, c[0], c[1], c[2]});
        if (!corners.empty() && largest >= count)
            error(mesh, "'", keyword, "' uses ", largest, " of '", values, "', which has ", count,
                  ", counted from 0");
    }

    void warnUnused() {
        const auto tell = [&](const auto& blocks, Target target, std::string_view plural) {
            std::vector<std::string> names;
            std::size_t count = 0;
            SourceLoc first;
            for (std::size_t i = 0; i < blocks.size(); ++i) {
                if (used_[static_cast<std::size_t>(target)][i]) continue;
                if (count++ == 0) first = blocks[i].loc;
                if (names.size() < kListed) names.push_back(shown(blocks[i].name));
            }
            if (count > 0)
                warn(first, cat("nothing uses the ", count == 1 ? nameOf(target) : plural, " ",
                                listed(names, count)));
        };
        tell(desc_.textures, Target::Texture, "textures");
        tell(desc_.materials, Target::Material, "materials");
        tell(desc_.meshes, Target::Mesh, "meshes");
    }

    void warnDark() {
        const Rgbd black{};
        const WorldDesc& world = desc_.world;
        if (world.environment != kNone && world.background == black)
            warn(world.loc, "the environment is multiplied by 'background', which is 0 0 0");
        if (desc_.objects.empty()) return warn({}, "the scene has no objects");
        const auto shines = [&](const auto& blocks, auto member) {
            return std::any_of(blocks.begin(), blocks.end(),
                               [&](const auto& block) { return block.*member != black; });
        };
        if (shines(desc_.lights, &LightDesc::color) ||
            shines(desc_.materials, &MaterialDesc::emission) || world.ambient != black)
            return;
        warn({},
             world.background == black
                 ? "there is no light, no emission and no ambient: the picture will be black"
                 : "there is no light, no emission and no ambient: diffuse surfaces will be black");
    }

    // Places are doubles, and the renderer makes them floats about the centre of the scene. Far
    // from the origin doubles are 2^-52 of the distance apart; where that is more than a float's
    // rounding of 2^-24 of the scene's extent, the file has lost what the picture could show.
    void warnFar() {
        constexpr double kMost = 0x1p28;
        // No point is farther: how long the box has to be, which most often its first object is.
        const double farthest = 1.01 * largestOfMaps_ * (3 * reach_ + 1);
        const BoundsD box = boundsUpTo(desc_, farthest / kMost);
        if (box.isEmpty()) return;
        const double extent = maxAbs(box.size());
        const double times = std::max(maxAbs(box.lo), maxAbs(box.hi)) / extent;
        if (extent > 0 && times > kMost)
            warn({}, cat("the scene lies more than 10^", std::floor(std::log10(times)),
                         " times its size away from the origin, where numbers are too coarse for "
                         "its details; it would be right about the origin"));
    }

    const SceneDesc& desc_;
    const SourceFile& source_;
    Diagnostics& diagnostics_;
    Stage stage_ = Stage::Properties;
    std::array<ErrorList, 3> errors_{ErrorList(source_), ErrorList(source_), ErrorList(source_)};
    std::array<std::vector<bool>, kEnumNames<Target>.size()> used_; // by what refers to them
    // Of what places things, and of things in spaces of their own.
    double largestOfMaps_ = 0, reach_ = 1;
    std::vector<std::uint32_t> slots_; // per mesh: how many material slots its triangles use
};

} // namespace

void validate(const SceneDesc& desc, const SourceFile& source, Diagnostics& diagnostics) {
    Validator(desc, source, diagnostics).run();
}
