#include "desc/check_block.h"

#include "base/for_each.h"
#include "base/text.h"
#include "base/transform.h"
#include "desc/lobes.h"
#include "desc/validate.h"

#include <algorithm>
#include <cmath>

namespace {

constexpr std::uint32_t kLargestSlot = 65535; // Blender's limit is 32767

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

// The largest that sizeOf() says of some things, 0 if there are none.
template <class T, class Size>
auto largestOfAll(int threads, std::span<const T> things, const Size& sizeOf) {
    constexpr std::size_t kTogether = 1 << 13;
    std::vector<decltype(sizeOf(things[0]))> parts((things.size() + kTogether - 1) / kTogether);
    forEachPart(threads, things.size(), kTogether, [&](std::size_t first, std::size_t last) {
        decltype(sizeOf(things[0])) largest = 0;
        for (std::size_t i = first; i < last; ++i) largest = std::max(largest, sizeOf(things[i]));
        parts[first / kTogether] = largest;
    });
    return parts.empty() ? 0 : *std::max_element(parts.begin(), parts.end());
}

// Are four corners in one plane, in order around a convex quadrilateral with an area?
std::string_view faultOfCorners(const std::array<Vec3d, 4>& c) {
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

} // namespace

std::string called(const AnyBlock& block) {
    return block.name ? cat(block.word, " '", shown(*block.name), "'") : std::string(block.word);
}

std::vector<std::uint32_t> materialSlots(const SceneDesc& desc) {
    std::vector<std::uint32_t> out;
    out.reserve(desc.meshes.size());
    for (const MeshDesc& mesh : desc.meshes) {
        std::uint32_t slots = 1;
        if (mesh.file.empty())
            for (const std::uint32_t slot : mesh.triangleMaterials) {
                if (slot > kLargestSlot) break;
                slots = std::max(slots, slot + 1);
            }
        out.push_back(slots);
    }
    return out;
}

void BlockChecker::checkProperties(const AnyBlock& block) {
    for (const Property& property : propertiesOf(block.type))
        if (property.kinds & block.kind && property.hasNumbers()) checkNumbers(block, property);
    forEachReference(block.type, block.data,
                     [&](Handle handle, BlockType target, std::string_view keyword) {
                         if (handle != kNone) checkHandle(block, handle, target, keyword);
                     });
}

void BlockChecker::checkNumbers(const AnyBlock& block, const Property& property) {
    std::array<double, kMostNumbers> numbers;
    for (std::size_t i = 0, n = getNumbers(property, block.data, numbers.data()); i < n; ++i)
        if (!property.range.contains(numbers[i]))
            properties.add(block.loc, [&] {
                return cat(called(block), ": ",
                           mustHave(property.keyword, property.range, numbers[i]));
            });
}

void BlockChecker::checkHandle(const AnyBlock& block, Handle handle, BlockType target,
                               std::string_view keyword) {
    const std::size_t count = countOf(desc_, target);
    if (handle >= 0 && static_cast<std::size_t>(handle) < count)
        return used_.mark(target, static_cast<std::size_t>(handle));
    properties.add(block.loc, [&] {
        return cat(called(block), ": '", keyword, "' refers to ", nameOf(target), " ", handle,
                   " of ", count);
    });
}

void BlockChecker::warnOfUnused(const LightDesc& light) {
    static const LightDesc kDefaults;
    const AnyBlock block = light;
    for (const Property& property : propertiesOf(block.type))
        if (!(property.kinds & block.kind) && !isSame(property, &light, &kDefaults))
            warnings.push_back(
                properties.locatedAt(light.loc,
                                     cat(called(block), ": '", property.keyword,
                                         "' has no effect on type ", nameOf(light.kind)),
                                     "warning"));
}

void BlockChecker::checkKeys(const AnyBlock& block, std::span<const Rows> keys) {
    if (keys.empty()) error(block, "has no transform at all; one key is needed");
    bool mirrors = false, turnsOver = false;
    for (const Rows& rows : keys) {
        const double largest = largestOf(rows);
        largestOfMaps = std::max(largest, largestOfMaps);
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
        error(block, "one of its keys mirrors and another does not: on the way it would be flat");
}

void BlockChecker::checkWhole(const CameraDesc& camera) {
    checkKeys(camera, camera.worldFromCamera);
}
void BlockChecker::checkWhole(const TextureDesc& texture) {
    if (texture.file.empty())
        error(texture, "has no 'file'");
    else if (texture.file.find('\0') != std::string::npos ||
             findBadText(texture.file) != std::string::npos)
        error(texture, "its 'file' is not UTF-8 without control characters");
}

void BlockChecker::checkWhole(const MaterialDesc& material) {
    if (material.lobes.size() > LobeDesc::kMost)
        error(material, "has ", material.lobes.size(), " lobes; at most ", LobeDesc::kMost,
              " are possible");
    for (std::size_t i = 0; i < material.lobes.size(); ++i) checkLobe(material, i);
}

void BlockChecker::checkLobe(const MaterialDesc& material, std::size_t number) {
    const LobeDesc& lobe = material.lobes[number];
    const auto wrong = [&](const auto&... parts) {
        error(material, "its lobe ", number + 1, ": ", parts...);
    };
    if (lobe.kind >= lobeForms().size())
        return wrong("there are ", lobeForms().size(), " kinds, and none has the number ",
                     lobe.kind);
    const LobeForm& form = lobeForms()[lobe.kind];
    const auto check = [&](std::string_view keyword, const Range& range, double value) {
        if (!range.contains(value)) wrong(mustHave(keyword, range, value));
    };
    for (const double x : {lobe.weight.r, lobe.weight.g, lobe.weight.b})
        check(kWeightWord, kColor, x);
    for (const LobeFieldForm& field : form.fields)
        for (const double x : std::span(lobe.numbers).subspan(field.first, field.count))
            check(field.name, field.range, x);
    for (const LobeDesc::Factor& factor : lobe.factors) {
        check(kWithoutWord, kFactorStrength, factor.strength);
        if (factor.texture == kNone) wrong("a picture that multiplies a value is missing");
        if (factor.field < LobeDesc::Factor::kWeight ||
            factor.field >= static_cast<int>(form.fields.size()))
            wrong(form.name, " has no field ", static_cast<int>(factor.field));
    }
}

void BlockChecker::checkWhole(const LightDesc& light) {
    warnOfUnused(light);
    checkKeys(light, {&light.worldFromLight, 1});
    if (hasNoArea(light))
        warnings.push_back(
            properties.locatedAt(light.loc,
                                 cat(called(light), ": it has no area, and is left out; a ",
                                     light.kind == LightDesc::Kind::Sphere ? "'radius'" : "'size'",
                                     " above 0 would be right"),
                                 "warning"));
    if (light.attenuation == Vec3d{})
        error(light, "'attenuation' 0 0 0 would be light without end; 1 0 0 is the usual one");
}

void BlockChecker::checkWhole(const ObjectDesc& object) {
    checkKeys(object, object.worldFromObject);
    reach = std::max({reach, object.radius, object.topRadius});
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
    if (const auto fault = faultOfCorners(*object.corners); !fault.empty()) error(object, fault);
    for (const Vec3d& corner : *object.corners) reach = std::max(reach, maxAbs(corner));
}

void BlockChecker::checkInstance(const ObjectDesc& object) {
    if (object.mesh == kNone) return error(object, "has no 'mesh'");
    if (object.mesh < 0 || static_cast<std::size_t>(object.mesh) >= slots_.size())
        return; // told above
    // Without materials, all slots show the default one; with one, all show that.
    const std::uint32_t slots = slots_[static_cast<std::size_t>(object.mesh)];
    if (object.materials.size() > 1 && slots > object.materials.size())
        error(object, "its mesh uses material slot ", slots - 1, ", but it has ",
              object.materials.size(), " materials (slots count from 0)");
}

void BlockChecker::checkWhole(const MeshDesc& mesh) {
    if (!mesh.file.empty()) return; // not read yet
    if (mesh.triangles.empty()) error(mesh, "has no triangles");
    const auto sizeOf = [](const Vec3d& p) { return largestOf(std::array{p.x, p.y, p.z}); };
    const double size = largestOfAll(threads_, std::span<const Vec3d>(mesh.points), sizeOf);
    if (size > kLargestLength) {
        const auto wrong = std::find_if(mesh.points.begin(), mesh.points.end(),
                                        [&](const Vec3d& p) { return sizeOf(p) > kLargestLength; });
        error(mesh, "point ", wrong - mesh.points.begin(), " is not finite or beyond ",
              shortest(kLargestLength));
    }
    reach = std::max(reach, size);
    checkCorners(mesh, mesh.triangles, mesh.points.size(), "points", "triangles");
    checkCorners(mesh, mesh.normalTriangles, mesh.normals.size(), "normals", "normal_triangles");
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
    const auto wrong = std::find_if(mesh.triangleMaterials.begin(), mesh.triangleMaterials.end(),
                                    [](std::uint32_t slot) { return slot > kLargestSlot; });
    if (wrong != mesh.triangleMaterials.end())
        error(mesh, "material slot ", *wrong, " is above ", kLargestSlot);
    if (!mesh.triangleMaterials.empty() && mesh.triangleMaterials.size() != mesh.triangles.size())
        error(mesh, "has ", mesh.triangles.size(), " triangles, but ",
              mesh.triangleMaterials.size(), " triangle_materials");
}

void BlockChecker::checkCorners(const MeshDesc& mesh, std::span<const MeshDesc::Corners> corners,
                                std::size_t count, std::string_view values,
                                std::string_view keyword) {
    if (keyword != "triangles") {
        if (corners.empty() && count > 0) return error(mesh, "has ", values, ", but no ", keyword);
        if (!corners.empty() && corners.size() != mesh.triangles.size())
            return error(mesh, "has ", mesh.triangles.size(), " triangles, but ", corners.size(),
                         " ", keyword);
    }
    const std::uint32_t largest = largestOfAll(threads_, corners, [](const MeshDesc::Corners& c) {
        return std::max({c[0], c[1], c[2]});
    });
    if (!corners.empty() && largest >= count)
        error(mesh, "'", keyword, "' uses ", largest, " of '", values, "', which has ", count,
              ", counted from 0");
}
