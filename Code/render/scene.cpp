// Builds a Scene from a SceneDesc. Which class is behind a shape or a light: make_shape.cpp and
// make_light.cpp.
#include "render/scene.h"

#include "base/for_each.h"
#include "base/math.h"
#include "base/text.h"
#include "desc/enum_tables.h"
#include "desc/scene_bounds.h"
#include "image/image.h"
#include "render/make_light.h"
#include "render/make_shape.h"
#include "render/merge.h"
#include "render/texture_files.h"
#include "render/to_float.h"
#include "shape/mesh_instance.h"

#include <algorithm>
#include <map>
#include <set>
#include <utility>

class SceneBuilder {
public:
    SceneBuilder(Scene& scene, const SceneDesc& desc, const SourceFile& source,
                 const RenderSettings& settings)
        : scene_(scene), desc_(desc), source_(source), settings_(settings), on_(settings.switches) {
    }

    void build() {
        scene_.frame_ = frameOf(desc_);
        scene_.accelKind_ = settings_.accel;
        buildCamera();
        buildPictures();
        buildMaterials();
        buildWorld();
        buildObjects();
        buildLights();
        scene_.shapes_.finish(settings_.accel == AccelKind::Bvh, chooseKernel(settings_.kernel),
                              settings_.threads);
        scene_.features_ = featuresOf(desc_, *cameraDesc_, settings_);
    }

private:
    // ---- textures and materials

    // At the same time; of several that fail the one that is used first is told. Pictures that
    // nothing uses are not read.
    void buildPictures() {
        scene_.textures_.resize(desc_.textures.size());
        if (!on_.textures) return;
        std::vector<std::size_t> used;
        std::vector<bool> isUsed(desc_.textures.size());
        for (const MaterialDesc& m : desc_.materials)
            for (const Handle handle : {m.diffuseTexture, m.specularTexture, m.emissionTexture,
                                        m.opacityTexture, m.normalMap, m.bumpMap}) {
                const auto i = static_cast<std::size_t>(handle);
                if (handle == kNone || isUsed[i]) continue;
                isUsed[i] = true;
                used.push_back(i);
            }
        const bool surrounded = desc_.world.environment != kNone && !settings_.background;
        forEachOn(settings_.threads, used.size() + (surrounded ? 1 : 0), [&](std::size_t i) {
            if (i < used.size())
                scene_.textures_[used[i]] = makeTexture(desc_.textures[used[i]]);
            else
                buildEnvironment();
        });
    }

    std::unique_ptr<const Texture> makeTexture(const TextureDesc& desc) const {
        TextureParams params;
        params.space = spaceOf(desc);
        params.interpolation = interpolationOf(desc);
        params.extension = desc.extension == TextureDesc::Extension::Repeat   ? Extension::Repeat
                           : desc.extension == TextureDesc::Extension::Extend ? Extension::Extend
                                                                              : Extension::Clip;
        params.channel = desc.channel == TextureDesc::Channel::Alpha
                             ? TextureParams::Channel::Alpha
                             : TextureParams::Channel::Color;
        params.scale = desc.scale;
        params.rotationRad = radians(desc.rotationDeg);
        params.offset = desc.offset;
        return std::make_unique<const Texture>(loadPicture(desc, source_, settings_.textureFolder),
                                               params);
    }

    static ColorSpace spaceOf(const TextureDesc& desc) {
        return desc.space == TextureDesc::Space::Srgb ? ColorSpace::Srgb : ColorSpace::Linear;
    }
    static Interpolation interpolationOf(const TextureDesc& desc) {
        return desc.interpolation == TextureDesc::Interpolation::Nearest ? Interpolation::Nearest
                                                                         : Interpolation::Bilinear;
    }

    const Texture* textureOf(Handle handle) const {
        return handle == kNone ? nullptr : scene_.textures_[static_cast<std::size_t>(handle)].get();
    }

    void buildMaterials() {
        for (const MaterialDesc& desc : desc_.materials)
            scene_.materials_.push_back(makeMaterial(desc));
        scene_.materials_.push_back(makeMaterial(MaterialDesc{}));
        for (const SceneMaterial& m : scene_.materials_)
            scene_.hasSeeThrough_ = scene_.hasSeeThrough_ || m.seeThrough();
    }

    static SpecularModel specularModelOf(MaterialDesc::SpecularModel model) {
        switch (model) {
        case MaterialDesc::SpecularModel::Ashikhmin: return SpecularModel::Ashikhmin;
        case MaterialDesc::SpecularModel::Phong: return SpecularModel::Phong;
        case MaterialDesc::SpecularModel::Blinn: break;
        }
        return SpecularModel::Blinn;
    }

    SceneMaterial makeMaterial(const MaterialDesc& desc) const {
        SceneMaterial m;
        m.base.diffuse = toRgb(desc.diffuse);
        m.base.specular = toRgb(desc.specular);
        m.base.specularModel = specularModelOf(desc.specularModel);
        m.base.exponent = toFloat(desc.exponent);
        m.litOutside = desc.litSide == MaterialDesc::LitSide::Outside;
        if (on_.reflection) m.base.mirror = toRgb(desc.mirror);
        if (on_.refraction) m.base.transmission = toRgb(desc.transmission);
        m.base.ior = toFloat(desc.ior);
        if (on_.fresnel && desc.fresnel == MaterialDesc::Fresnel::Dielectric)
            m.base.fresnel = FresnelModel::Dielectric;
        if (on_.fresnel && desc.fresnel == MaterialDesc::Fresnel::Schlick)
            m.base.fresnel = FresnelModel::Schlick;
        if (on_.glossy) m.base.roughness = toFloat(desc.roughness);
        m.base.emission = toRgb(desc.emission);
        m.base.opacity = toFloat(desc.opacity);
        m.base.filter = toRgb(desc.filter);
        m.diffuse = textureOf(desc.diffuseTexture);
        m.specular = textureOf(desc.specularTexture);
        m.emission = textureOf(desc.emissionTexture);
        m.opacity = textureOf(desc.opacityTexture);
        m.normalMap = textureOf(desc.normalMap);
        m.bumpMap = textureOf(desc.bumpMap);
        m.normalStrength = toFloat(desc.normalStrength);
        m.bumpHeight = toFloat(desc.bumpStrength * desc.bumpDistance * scene_.frame_.scale);
        return m;
    }

    // The scene's number of a material; objects without one get the default, which is the last.
    std::uint32_t materialId(Handle handle) const {
        return handle == kNone ? static_cast<std::uint32_t>(desc_.materials.size())
                               : static_cast<std::uint32_t>(handle);
    }
    // At least one.
    std::vector<std::uint32_t> materialIds(const ObjectDesc& object) const {
        std::vector<std::uint32_t> ids;
        for (const Handle handle : object.materials) ids.push_back(materialId(handle));
        if (ids.empty()) ids.push_back(materialId(kNone));
        return ids;
    }

    // ---- camera and world

    MovingTransform placed(const Keys& keys) {
        std::vector<Transform> maps;
        for (const Rows& rows : keys) maps.push_back(scene_.frame_.placed(rows));
        MovingTransform moving{std::span<const Transform>(maps)};
        if (!on_.motionBlur) return MovingTransform(moving.at(0.5));
        if (!moving.isStatic()) scene_.moves_ = true;
        return moving;
    }

    void buildCamera() {
        const auto wanted =
            std::find_if(desc_.cameras.begin(), desc_.cameras.end(), [&](const CameraDesc& camera) {
                return settings_.camera.empty() || camera.name == settings_.camera;
            });
        if (wanted == desc_.cameras.end()) {
            std::vector<std::string> known;
            for (const CameraDesc& camera : desc_.cameras) known.push_back(camera.name);
            fail(ErrorKind::Input,
                 cat(source_.name, ": error: no camera ", unknownName(settings_.camera, known)));
        }
        const CameraDesc& desc = *wanted;
        cameraDesc_ = &desc;
        const double scale = scene_.frame_.scale;
        CameraParams params;
        params.kind = desc.kind == CameraDesc::Kind::Orthographic ? CameraParams::Kind::Orthographic
                                                                  : CameraParams::Kind::Perspective;
        params.worldFromCamera = placed(desc.worldFromCamera);
        params.width = settings_.picture.width;
        params.height = settings_.picture.height;
        params.pixelAspect = settings_.picture.pixelAspect;
        params.lensMm = desc.lensMm;
        params.sensorWidthMm = desc.sensorWidthMm;
        params.sensorHeightMm = desc.sensorHeightMm;
        params.sensorFit = static_cast<CameraParams::SensorFit>(desc.sensorFit);
        params.shiftX = desc.shiftX;
        params.shiftY = desc.shiftY;
        params.orthoScale = desc.orthoScale * scale;
        params.clipStart = desc.clipStart * scale;
        params.apertureRadius = on_.dof ? desc.apertureRadius * scale : 0;
        params.focusDistance = desc.focusDistance * scale;
        params.apertureBlades = desc.apertureBlades;
        params.apertureRotationRad = radians(desc.apertureRotationDeg);
        params.apertureRatio = desc.apertureRatio;
        scene_.camera_ = std::make_unique<const Camera>(params);
    }

    void buildWorld() {
        scene_.background_ = toRgb(settings_.background.value_or(desc_.world.background));
        scene_.ambient_ = toRgb(desc_.world.ambient);
    }

    void buildEnvironment() {
        const TextureDesc& picture =
            desc_.textures[static_cast<std::size_t>(desc_.world.environment)];
        scene_.environment_ = std::make_unique<const Environment>(
            loadPicture(picture, source_, settings_.textureFolder), spaceOf(picture),
            interpolationOf(picture),
            desc_.world.environmentUp == WorldDesc::Up::Z ? Environment::Up::Z : Environment::Up::Y,
            radians(desc_.world.rotationDeg));
    }

    // ---- objects

    ShapeSet::Shadow shadowOf(const std::vector<std::uint32_t>& materials) const {
        const bool seeThrough =
            std::any_of(materials.begin(), materials.end(),
                        [&](std::uint32_t m) { return scene_.materials_[m].seeThrough(); });
        return seeThrough ? ShapeSet::Shadow::SeeThrough : ShapeSet::Shadow::Opaque;
    }

    void buildObjects() {
        const auto isMesh = [](const ObjectDesc& object) {
            return object.kind == ObjectDesc::Kind::Mesh;
        };
        std::vector<std::uint64_t> uses(desc_.meshes.size(), 0);
        for (std::size_t i = 0; i < desc_.objects.size(); ++i) {
            const ObjectDesc& object = desc_.objects[i];
            if (isMesh(object)) {
                ++uses[static_cast<std::size_t>(object.mesh)];
                continue;
            }
            const std::vector<std::uint32_t> materials = materialIds(object);
            scene_.shapes_.add(makeShape(object, placed(object.worldFromObject), materials,
                                         static_cast<std::uint32_t>(i)),
                               shadowOf(materials));
        }
        const std::vector<bool> isCopied = meshesToCopy(uses);

        // Meshes that stand still become one, with one tree over all triangles; see-through ones
        // apart, as their shadows have to look at every hit, and those apart of which not all sides
        // are seen. Meshes that move or have too many copies are instances. After the other shapes:
        // ShapeSet::isBefore() needs those with triangles in a row.
        constexpr std::size_t kSides = kEnumNames<ObjectDesc::Sides>.size();
        std::array<MergedMesh, kSides> opaque, seeThrough;
        for (std::size_t i = 0; i < desc_.objects.size(); ++i) {
            const ObjectDesc& object = desc_.objects[i];
            if (!isMesh(object)) continue;
            const auto id = static_cast<std::uint32_t>(i);
            const MovingTransform place = placed(object.worldFromObject);
            const auto mesh = static_cast<std::size_t>(object.mesh);
            const auto materials = materialsBySlot(object, desc_.meshes[mesh]);
            if (isCopied[mesh] && place.isStatic() && isInScene(object, place.at(0))) {
                const bool solid = shadowOf(materials) == ShapeSet::Shadow::Opaque;
                MergedMesh& merged =
                    (solid ? opaque : seeThrough)[static_cast<std::size_t>(object.sides)];
                const std::uint64_t before = merged.degenerateCount;
                merged.add(desc_.meshes[mesh], place.at(0), materials, id);
                countDegenerate(mesh, merged.degenerateCount - before);
            } else {
                addInstance(object, place, materials, id);
            }
        }
        for (auto* group : {&opaque, &seeThrough})
            for (std::size_t sides = 0; sides < kSides; ++sides)
                addMerged(std::move((*group)[sides]), static_cast<ObjectDesc::Sides>(sides));
    }

    // Once for all copies and instances of a mesh.
    void countDegenerate(std::size_t mesh, std::uint64_t count) {
        if (counted_.insert(mesh).second) scene_.degenerateCount_ += count;
    }

    // By mesh: those that are used once, and others as long as there is room for all their copies.
    std::vector<bool> meshesToCopy(const std::vector<std::uint64_t>& uses) const {
        std::vector<bool> out(uses.size());
        std::uint64_t room = settings_.copiedTriangles;
        for (std::size_t mesh = 0; mesh < uses.size(); ++mesh) {
            const std::uint64_t triangles = uses[mesh] * desc_.meshes[mesh].triangles.size();
            out[mesh] = uses[mesh] == 1 || triangles <= room;
            if (uses[mesh] > 1 && out[mesh]) room -= triangles;
        }
        return out;
    }

    // Within kSceneExtent, on which the pads of all that is merged depend. Only an object that has
    // several keys, and whose movement is switched off, may be elsewhere in between.
    bool isInScene(const ObjectDesc& object, const Transform& place) const {
        if (object.worldFromObject.size() == 1) return true;
        const BoundsD box =
            place.bounds(boundsOf(desc_.meshes[static_cast<std::size_t>(object.mesh)]));
        return max(maxAbs(box.lo), maxAbs(box.hi)) <= static_cast<double>(kSceneExtent);
    }

    std::vector<std::uint32_t> materialsBySlot(const ObjectDesc& object,
                                               const MeshDesc& mesh) const {
        std::vector<std::uint32_t> out = materialIds(object);
        std::uint32_t slots = 1;
        for (const std::uint32_t slot : mesh.triangleMaterials) slots = std::max(slots, slot + 1);
        while (out.size() < slots) out.push_back(out.back());
        return out;
    }

    void addMerged(MergedMesh merged, ObjectDesc::Sides sides) {
        if (merged.geometry.triangles.empty()) return;
        auto geometry = std::make_unique<MeshGeometry>(std::move(merged.geometry));
        geometry->finish(settings_.accel == AccelKind::Bvh, chooseKernel(settings_.kernel),
                         settings_.threads);
        auto mesh = std::make_unique<Mesh>(*geometry, merged.materials, std::move(merged.parts));
        scene_.shapes_.add(withSides(std::move(mesh), sides), shadowOf(merged.materials));
        scene_.geometries_.push_back(std::move(geometry));
    }

    // One geometry per mesh; as many transforms as there are instances.
    void addInstance(const ObjectDesc& object, const MovingTransform& place,
                     std::vector<std::uint32_t> materials, std::uint32_t id) {
        const auto mesh = static_cast<std::size_t>(object.mesh);
        const auto [at, isNew] = shared_.try_emplace(mesh);
        if (isNew) {
            auto geometry = std::make_unique<MeshGeometry>(toSharedGeometry(desc_.meshes[mesh]));
            countDegenerate(mesh, geometry->dropDegenerate());
            geometry->finish(settings_.accel == AccelKind::Bvh, chooseKernel(settings_.kernel),
                             settings_.threads);
            at->second = geometry.get();
            scene_.geometries_.push_back(std::move(geometry));
        }
        const MeshGeometry& geometry = *at->second;
        if (geometry.triangles.empty()) return;
        const ShapeSet::Shadow shadow = shadowOf(materials);
        auto shape = std::make_unique<MeshInstance>(geometry, place, std::move(materials), id);
        scene_.shapes_.add(withSides(std::move(shape), object.sides), shadow);
    }

    // ---- lights

    void buildLights() {
        for (std::size_t i = 0; i < desc_.lights.size(); ++i) {
            const LightDesc& light = desc_.lights[i];
            scene_.lights_.push_back(makeLight(light, scene_.frame_));
            if (light.visible)
                addLampBody(light, static_cast<std::uint32_t>(desc_.objects.size() + i));
        }
    }

    // A lamp that can be seen casts no shadows: its light passes through its body.
    void addLampBody(const LightDesc& light, std::uint32_t id) {
        const auto material = static_cast<std::uint32_t>(scene_.materials_.size());
        auto body = makeLampBody(light, scene_.frame_, material, id);
        if (!body) return;
        SceneMaterial glow;
        glow.base.diffuse = {};
        glow.base.emission = toRgb(light.color);
        glow.isLamp = true;
        scene_.materials_.push_back(glow);
        scene_.shapes_.add(std::move(body), ShapeSet::Shadow::None);
    }

    Scene& scene_;
    const SceneDesc& desc_;
    const SourceFile& source_;
    const RenderSettings& settings_;
    Switches on_;
    const CameraDesc* cameraDesc_ = nullptr;            // the one that is used
    std::map<std::size_t, const MeshGeometry*> shared_; // of instances, by mesh
    std::set<std::size_t> counted_;                     // meshes; see countDegenerate()
};

Scene::Scene(const SceneDesc& desc, const SourceFile& source, const RenderSettings& settings) {
    SceneBuilder(*this, desc, source, settings).build();
}

void Scene::describe(Stats& stats) const {
    stats.accel = {};
    stats.accel.kind = accelKind_ == AccelKind::Bvh ? "bvh" : "none";
    stats.accel.primitives = shapes_.shapes.size();
    const auto addTree = [&](const Bvh& bvh) {
        stats.accel.nodes += bvh.nodes.size();
        stats.accel.leaves += leafCount(bvh);
        stats.accel.sah += sahCost(bvh);
        stats.accel.bytes += bvh.bytes();
    };
    addTree(shapes_.bvh);
    for (const auto& geometry : geometries_) {
        addTree(geometry->bvh);
        stats.accel.nodes += geometry->wide.nodes;
        stats.accel.leaves += geometry->wide.leaves;
        stats.accel.sah += geometry->wide.sah;
        stats.accel.bytes += geometry->wide.bytes();
        stats.accel.primitives += geometry->triangles.size();
        stats.accel.triangles += geometry->triangles.size();
        stats.accel.meshBytes += geometry->bytes();
    }
    for (const Feature& feature : features_) {
        if (feature.needed)
            stats.featuresNeeded.push_back(feature.name);
        else
            stats.featuresSkipped.push_back(cat(feature.name, ": ", feature.reason));
    }
    stats.degeneratePrimitives = degenerateCount_;
}
