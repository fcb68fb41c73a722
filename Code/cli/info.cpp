#include "cli/output.h"

#include "base/platform/platform.h"
#include "base/text.h"
#include "cli/stats_output.h"
#include "desc/enum_tables.h"
#include "desc/lobes.h"
#include "scene/texture_files.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iomanip>
#include <sstream>

namespace {

// A heading at the left of the first line, the rest below each other.
class Lines {
public:
    void add(const std::string& heading, const std::string& text) {
        out_ << std::left << std::setw(12) << heading << text << "\n";
    }
    std::string text() const { return out_.str(); }

private:
    std::ostringstream out_;
};

std::string triple(Vec3d v) { return cat(v.x, " ", v.y, " ", v.z); }
std::string triple(Rgbd c) { return triple(Vec3d{c.r, c.g, c.b}); }

std::string counted(std::size_t count, const std::string& what) {
    return cat(count, " ", what, count == 1 ? "" : "s");
}

// "3 sphere, 1 plane" for things with a kind.
template <class Kind, class Things> std::string countsPerKind(const Things& things) {
    std::array<std::size_t, kNamesByValue<Kind>.size()> counts{};
    for (const auto& thing : things) ++counts[static_cast<std::size_t>(thing.kind)];
    std::vector<std::string> parts;
    for (std::size_t i = 0; i < counts.size(); ++i)
        if (counts[i] > 0) parts.push_back(cat(counts[i], " ", kNamesByValue<Kind>[i]));
    return parts.empty() ? "none" : join(parts);
}

// With every instance counted.
std::size_t triangleCount(const SceneDesc& desc) {
    std::size_t count = 0;
    for (const ObjectDesc& object : desc.objects)
        if (object.kind == ObjectDesc::Kind::Mesh)
            count += desc.meshes[static_cast<std::size_t>(object.mesh)].triangles.size();
    return count;
}

std::size_t storedTriangleCount(const SceneDesc& desc) {
    std::size_t count = 0;
    for (const MeshDesc& mesh : desc.meshes) count += mesh.triangles.size();
    return count;
}

template <class T, class A> std::size_t bytesOf(const std::vector<T, A>& values) {
    return values.size() * sizeof(T);
}
std::size_t bytesOf(const MeshDesc& m) {
    return bytesOf(m.points) + bytesOf(m.triangles) + bytesOf(m.normals) +
           bytesOf(m.normalTriangles) + bytesOf(m.uvs) + bytesOf(m.uvTriangles) +
           bytesOf(m.triangleMaterials);
}
std::size_t bytesOf(const StoredImage& image) {
    return bytesOf(image.bytes) + bytesOf(image.words) + bytesOf(image.floats);
}

// The boxes of shapes are rounded outwards in float; what that adds is not worth a digit.
Vec3d rounded(Vec3d p, double extent) {
    const double step = extent * 1e-6;
    if (!(step > 0)) return p;
    const auto whole = [&](double x) { return std::round(x / step) * step + 0.0; }; // no -0
    return {whole(p.x), whole(p.y), whole(p.z)};
}

// Of all that has a size and an end, in world units; empty when there is nothing.
BoundsD worldBounds(const Scene& scene) {
    BoundsD box;
    for (const auto& shape : scene.shapes().shapes) {
        const Bounds normalised = shape->bounds();
        if (normalised.isEmpty() || !normalised.isFinite()) continue;
        box.extend(scene.frame().worldPoint(toDouble(normalised.lo)));
        box.extend(scene.frame().worldPoint(toDouble(normalised.hi)));
    }
    if (box.isEmpty()) return box;
    const double extent = maxAbs(box.size());
    return {rounded(box.lo, extent), rounded(box.hi, extent)};
}

std::string_view unitOf(LightDesc::Kind kind) {
    switch (kind) {
    case LightDesc::Kind::Point:
    case LightDesc::Kind::Spot: return "W/sr";
    case LightDesc::Kind::Sun: return "W/m2";
    case LightDesc::Kind::Rectangle:
    case LightDesc::Kind::Disk:
    case LightDesc::Kind::Sphere: break;
    }
    return "W/(m2 sr)";
}

std::string lightText(const LightDesc& light) {
    const Rows& rows = light.worldFromLight;
    std::string text = cat(nameOf(light.kind), " '", light.name, "' ", triple(light.color), " ",
                           unitOf(light.kind));
    if (light.kind != LightDesc::Kind::Sun)
        text += " at " + triple(Vec3d{rows[3], rows[7], rows[11]});
    if (!light.shadows) text += ", no shadows";
    return text;
}

std::string cameraText(const CameraDesc& camera) {
    const Rows& rows = camera.worldFromCamera[0];
    std::string text = cat("'", camera.name, "' ", nameOf(camera.kind), " ");
    if (camera.kind == CameraDesc::Kind::Perspective)
        text += cat(camera.lensMm, " mm");
    else
        text += cat(camera.orthoScale, " wide");
    text += " at " + triple(Vec3d{rows[3], rows[7], rows[11]});
    if (camera.apertureRadius > 0)
        text +=
            cat(", aperture radius ", camera.apertureRadius, ", focus at ", camera.focusDistance);
    if (camera.worldFromCamera.size() > 1) text += ", moves";
    return text;
}

std::string pictureText(const SettingsDesc& p) {
    std::string text = cat(p.width, "x", p.height, " pixels, ",
                           counted(static_cast<std::size_t>(p.samplesPerPixel), "sample"),
                           " per pixel (", nameOf(p.sampler), "), ", nameOf(p.filter), " filter ",
                           p.filterWidth, ", ", nameOf(p.integrator), ", depth ", p.maxDepth);
    if (p.crop)
        text +=
            cat(", crop ", (*p.crop)[0], ",", (*p.crop)[1], ",", (*p.crop)[2], ",", (*p.crop)[3]);
    return text;
}

std::string materialsText(const std::vector<MaterialDesc>& materials) {
    std::vector<std::size_t> lobes(lobeForms().size());
    std::size_t lighting = 0;
    for (const MaterialDesc& material : materials) {
        for (const LobeDesc& lobe : material.lobes) ++lobes[lobe.kind];
        if (material.emissionLights) ++lighting;
    }
    std::vector<std::string> parts{std::to_string(materials.size())};
    for (std::size_t i = 0; i < lobes.size(); ++i)
        if (lobes[i] > 0) parts.push_back(counted(lobes[i], cat(lobeForms()[i].name, " lobe")));
    if (lighting > 0) parts.push_back(cat(lighting, " lighting others"));
    return join(parts);
}

// One line per texture; adds up the memory that the pictures take.
void addTextures(Lines& lines, const SourceFile& source, const SceneDesc& desc,
                 const RenderSettings& settings, std::size_t& bytes) {
    for (const TextureDesc& texture : desc.textures) {
        std::string fault;
        const std::optional<StoredImage> read =
            settings.picturesMayMiss
                ? findAndRead(texture, source.name, settings.textureFolder, fault)
                : loadPicture(texture, source, settings.textureFolder);
        if (!read) {
            lines.add("texture", cat("'", texture.name, "' ", texture.file, ", missing"));
            continue;
        }
        const StoredImage& picture = *read;
        bytes += bytesOf(picture);
        const int bits = picture.depth == StoredImage::Depth::Bits8    ? 8
                         : picture.depth == StoredImage::Depth::Bits16 ? 16
                                                                       : 32;
        lines.add("texture", cat("'", texture.name, "' ", texture.file, " ", picture.width, "x",
                                 picture.height, ", ", picture.channels, " x ", bits, " bit, ",
                                 nameOf(texture.space)));
    }
}

} // namespace

std::string infoText(const SourceFile& source, const SceneDesc& desc,
                     const RenderSettings& settings, const Scene& scene) {
    Lines lines;
    lines.add("scene", source.name);
    lines.add("picture", pictureText(settings.picture));
    for (const CameraDesc& camera : desc.cameras) lines.add("camera", cameraText(camera));
    lines.add("objects", countsPerKind<ObjectDesc::Kind>(desc.objects));
    lines.add("meshes",
              cat(desc.meshes.size(), " with ", counted(storedTriangleCount(desc), "triangle"),
                  "; ", triangleCount(desc), " with all instances"));
    const BoundsD box = worldBounds(scene);
    if (box.isEmpty())
        lines.add("bounds", "none");
    else
        lines.add("bounds", cat(triple(box.lo), "  to  ", triple(box.hi)));
    if (const auto spacing = scene.spacing())
        lines.add("precision", cat(significant(*spacing),
                                   " of a pixel between numbers in the middle of the picture"));
    lines.add("materials", materialsText(desc.materials));
    lines.add("lights", countsPerKind<LightDesc::Kind>(desc.lights));
    for (const LightDesc& light : desc.lights) lines.add("light", lightText(light));
    lines.add("background", cat(triple(desc.world.background), " W/(m2 sr)",
                                desc.world.environment == kNone ? "" : ", times a picture",
                                desc.world.environmentLights ? ", lights surfaces" : ""));
    std::size_t textureBytes = 0, meshBytes = 0;
    lines.add("textures", std::to_string(desc.textures.size()));
    addTextures(lines, source, desc, settings, textureBytes);
    for (const MeshDesc& mesh : desc.meshes) meshBytes += bytesOf(mesh);
    for (const Feature& feature : scene.features())
        lines.add("feature", feature.needed ? feature.name
                                            : cat(feature.name, " not needed: ", feature.reason));
    const std::uint64_t peak = peakBytes();
    lines.add("memory", cat(mebibytes(source.text.size()), " file, ", mebibytes(meshBytes),
                            " meshes, ", mebibytes(textureBytes), " textures, ",
                            peak > 0 ? mebibytes(peak) : "unknown", " peak of this run"));
    return lines.text();
}

std::string summaryText(const SceneDesc& desc) {
    return cat(counted(desc.objects.size(), "object"), ", ", counted(desc.lights.size(), "light"),
               ", ", counted(desc.materials.size(), "material"), ", ",
               counted(desc.textures.size(), "texture"), ", ",
               counted(triangleCount(desc), "triangle"));
}
