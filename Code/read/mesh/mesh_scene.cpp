#include "read/mesh/mesh_file.h"

#include "base/bounds.h"
#include "base/for_each.h"
#include "base/transform.h"
#include "desc/validate.h"
#include "read/mesh/mesh_steps.h"
#include "read/unique_names.h"

#include <algorithm>
#include <span>
#include <unordered_map>
#include <utility>

namespace {

constexpr Vec3d kUp{0, 1, 0};
// Objects cost the renderer more than triangles do: a file with more parts is shown as one.
constexpr std::size_t kMostParts = 65536;

struct Ball {
    Vec3d centre;
    double radius = 0;
};
Ball ballAround(const MeshDesc& mesh, int threads) {
    constexpr std::size_t kTogether = 1 << 14;
    const std::span<const Vec3d> points(mesh.points);
    std::vector<double> farthest((points.size() + kTogether - 1) / kTogether);
    const BoundsD bounds = boundsOf(mesh, threads);
    const Vec3d centre = bounds.centre();
    const double size = maxAbs(bounds.size()); // squares of very small lengths would vanish
    forEachPart(threads, points.size(), kTogether, [&](std::size_t first, std::size_t last) {
        double most = 0;
        for (const Vec3d& p : points.subspan(first, last - first)) {
            const Vec3d d = (p - centre) / size;
            most = max(most, dot(d, d));
        }
        farthest[first / kTogether] = most;
    });
    return {centre, size * std::sqrt(*std::max_element(farthest.begin(), farthest.end()))};
}

CameraDesc cameraFor(const Ball& ball, const SettingsDesc& settings) {
    const Vec3d fromBall = normalize(Vec3d{0.6, 0.45, 1});
    CameraDesc camera;
    camera.name = "camera";
    // Half the smaller side of the picture, as the sine of its angle: there the ball touches.
    const double halfHeight = camera.sensorWidthMm / 2 * settings.height / settings.width;
    const double sine = halfHeight / std::sqrt(sqr(halfHeight) + sqr(camera.lensMm));
    constexpr double kMargin = 1.05;
    const double distance = kMargin * ball.radius / sine;
    camera.worldFromCamera = {
        Transform::lookAt(ball.centre + fromBall * distance, ball.centre, kUp).rows()};
    camera.focusDistance = distance;
    return camera;
}

// `from` in the frame of the camera: x right, y up, z towards it.
LightDesc sunFrom(const char* name, Vec3d from, double irradiance, const CameraDesc& camera,
                  const Ball& ball) {
    const Transform worldFromCamera = Transform::fromRows(camera.worldFromCamera.front());
    const Vec3d direction = normalize(worldFromCamera.vector(from));
    LightDesc sun;
    sun.name = name;
    sun.kind = LightDesc::Kind::Sun;
    sun.color = {irradiance, irradiance, irradiance};
    sun.angleDeg = 3;
    // Where a sun stands does not matter; here it is seen in an editor.
    sun.worldFromLight =
        Transform::lookAt(ball.centre + direction * (2 * ball.radius), ball.centre, kUp).rows();
    return sun;
}

// White that faces the key light and sees the fill light too stays below 1: 0.7 + 0.1 + 0.12.
void addLights(SceneDesc& scene, const Ball& ball) {
    const CameraDesc& camera = scene.cameras.front();
    scene.lights.push_back(sunFrom("key", {-0.7, 0.8, 1}, 2.2, camera, ball));
    scene.lights.push_back(sunFrom("fill", {1, 0.1, 0.6}, 0.6, camera, ball));
    scene.world.ambient = {0.12, 0.12, 0.12};
    scene.world.background = {0.6, 0.6, 0.6};
    scene.world.environmentUp = WorldDesc::Up::Y;
}

// Brings the materials that are used from the libraries into the scene, with their textures.
class MaterialPicker {
public:
    MaterialPicker(const MeshFile& file, std::span<const MtlFile> libraries, SceneDesc& scene)
        : names_(file.materials), locs_(file.materialLocs), libraries_(libraries), scene_(scene),
          handles_(names_.size(), kNone) {
        for (std::size_t i = 0; i < libraries.size(); ++i) {
            libraryLocs_.push_back(i < file.libraries.size() ? file.libraries[i].loc : SourceLoc{});
            textureHandles_.emplace_back(libraries[i].textures.size(), kNone);
            for (const MaterialDesc& material : libraries[i].materials)
                known_.try_emplace(material.name, Known{i, &material});
        }
    }

    Handle materialOf(std::uint32_t slot) {
        Handle& handle = handles_[slot];
        if (handle == kNone) {
            handle = static_cast<Handle>(scene_.materials.size());
            scene_.materials.push_back(made(names_[slot]));
            MaterialDesc& material = scene_.materials.back();
            material.loc = slot < locs_.size() ? locs_[slot] : SourceLoc{};
            material.name = materialNames_.of(names_[slot].empty() ? "default" : names_[slot]);
            if (isUnknown_) unknown_.push_back(slot);
        }
        return handle;
    }

    void warnUnknown(const SourceFile& source, const ReadContext& context) const {
        if (unknown_.empty()) return;
        constexpr std::size_t kShown = 5;
        std::vector<std::string> names;
        for (const std::uint32_t slot : unknown_)
            if (names.size() < kShown) names.push_back(cat("'", shown(names_[slot]), "'"));
        const std::size_t more = unknown_.size() - names.size();
        const std::size_t place =
            unknown_.front() < locs_.size() ? locs_[unknown_.front()].offset : 0;
        context.warn(source, place,
                     cat(unknown_.size() == 1 ? "unknown material " : "unknown materials ",
                         join(names), more > 0 ? cat(" and ", more, " more") : "",
                         unknown_.size() == 1 ? "; it is grey" : "; they are grey"));
    }

private:
    struct Known {
        std::size_t library;
        const MaterialDesc* material;
    };

    MaterialDesc made(const std::string& name) {
        const auto known = known_.find(name);
        isUnknown_ = known == known_.end() && !name.empty();
        if (known == known_.end()) return {};
        MaterialDesc material = *known->second.material;
        for (Handle* texture :
             {&material.diffuseTexture, &material.specularTexture, &material.emissionTexture,
              &material.opacityTexture, &material.normalMap, &material.bumpMap})
            if (*texture != kNone) *texture = textureOf(known->second.library, *texture);
        return material;
    }
    Handle textureOf(std::size_t library, Handle texture) {
        Handle& handle = textureHandles_[library][static_cast<std::size_t>(texture)];
        if (handle == kNone) {
            handle = static_cast<Handle>(scene_.textures.size());
            TextureDesc copy = libraries_[library].textures[static_cast<std::size_t>(texture)];
            copy.name = textureNames_.of(copy.name);
            copy.loc = copy.fileLoc = libraryLocs_[library];
            scene_.textures.push_back(std::move(copy));
        }
        return handle;
    }

    std::vector<std::string> names_;
    std::vector<SourceLoc> locs_;
    std::vector<SourceLoc> libraryLocs_;
    std::span<const MtlFile> libraries_;
    SceneDesc& scene_;
    std::unordered_map<std::string_view, Known> known_;
    std::vector<Handle> handles_;                     // by slot
    std::vector<std::vector<Handle>> textureHandles_; // by library
    UniqueNames materialNames_, textureNames_;
    std::vector<std::uint32_t> unknown_; // slots
    bool isUnknown_ = false;
};

// "data/bunny.obj" -> "bunny"
std::string_view stemOf(std::string_view fileName) {
    const std::size_t slash = fileName.find_last_of("/\\");
    if (slash != std::string_view::npos) fileName.remove_prefix(slash + 1);
    const std::size_t dot = fileName.rfind('.');
    return fileName.empty() ? "mesh" : dot == 0 ? fileName : fileName.substr(0, dot);
}

} // namespace

SceneDesc sceneAround(MeshFile file, std::span<const MtlFile> libraries, const SourceFile& source,
                      const ReadContext& context) {
    SceneDesc scene;
    const Ball ball = ballAround(file.mesh, context.options.threads);
    scene.cameras.push_back(cameraFor(ball, scene.settings));
    addLights(scene, ball);

    if (file.parts.size() > kMostParts) {
        context.warn(source, file.parts.front().loc.offset,
                     cat(file.parts.size(), " objects and groups, more than ", kMostParts,
                         "; they are shown as one object"));
        file.parts.clear();
    }
    MaterialPicker materials(file, libraries, scene);
    UniqueNames names;
    for (SeparatePart& part : splitMesh(std::move(file))) {
        ObjectDesc object;
        object.name = names.of(part.mesh.name.empty() ? stemOf(source.name) : part.mesh.name);
        object.loc = part.mesh.loc;
        object.kind = ObjectDesc::Kind::Mesh;
        object.mesh = static_cast<Handle>(scene.meshes.size());
        for (const std::uint32_t slot : part.slots)
            object.materials.push_back(materials.materialOf(slot));
        part.mesh.name = object.name;
        scene.objects.push_back(std::move(object));
        scene.meshes.push_back(std::move(part.mesh));
    }
    materials.warnUnknown(source, context);
    return scene;
}
