// Builds a Scene from a SceneDesc. Which class is behind a shape or a light: make_shapes.cpp and
// make_body.cpp.
#include "scene/scene.h"

#include "base/for_each.h"
#include "base/math.h"
#include "base/text.h"
#include "desc/lobes.h"
#include "desc/names.h"
#include "desc/validate.h"
#include "image/image.h"
#include "scene/eye.h"
#include "scene/frame.h"
#include "scene/lobed_materials.h"
#include "scene/make_shape.h"
#include "scene/make_shapes.h"
#include "scene/scene_lights.h"
#include "scene/texture_files.h"
#include "texture/environment.h"
#include "texture/mip_levels.h"

#include <algorithm>
#include <functional>
#include <mutex>
#include <optional>
#include <utility>

class SceneBuilder {
public:
    // `spent`: the description once more, where nobody else needs its objects, meshes and
    // materials.
    SceneBuilder(Scene& scene, const SceneDesc& desc, SceneDesc* spent, const SourceFile& source,
                 const RenderSettings& settings, PictureReader* pictures)
        : scene_(scene), desc_(desc), spent_(spent), source_(source), settings_(settings),
          pictures_(pictures), on_(settings.switches), objectCount_(desc.objects.size()) {}

    void build() {
        chooseCamera();
        scene_.frame_ = frameOf(desc_, *cameraDesc_, settings_.threads);
        sceneLights_.emplace(desc_, scene_.frame_, settings_);
        scene_.shapes_.distantFrom = scene_.frame_.distantFrom;
        scene_.accelKind_ = settings_.accel;
        buildCamera();
        scene_.features_ = featuresOf(desc_, *cameraDesc_, settings_);
        keepUnevenPlaces();
        if (isShaded()) sceneLights_->keepObjects();
        buildPicturesAndShapes();
        warnOfMissing();
        buildMaterials();
        buildWorld();
        buildLights();
        scene_.shapes_.finish(settings_.accel == AccelKind::Bvh, *settings_.isa, settings_.threads);
        lookAround();
    }

private:
    // Whether the picture shows materials in the light of lamps, and not what the camera meets.
    bool isShaded() const {
        return settings_.picture.integrator == IntegratorKind::Whitted || isPath();
    }
    bool isPath() const { return settings_.picture.integrator == IntegratorKind::Path; }

    // ---- textures and materials

    // At the same time, because shapes need no more of a material than whether it is see-through.
    // Shapes come first, as one that is late would be waited for; of pictures that cannot be read
    // the one that is used first is told.
    void buildPicturesAndShapes() {
        const std::vector<std::uint8_t> seeThrough = seeThroughMaterials();
        ShapeMaker maker(desc_, settings_, scene_.frame_, seeThrough);
        std::vector<std::function<void()>> jobs = maker.jobs(scene_.shapes_);
        if (pictures_ != nullptr) pictures_->beginNoMore(); // they are jobs like others
        const std::size_t ofShapes = jobs.size();
        addPictures(jobs);
        const std::size_t longJobs = maker.trees() + jobs.size() - ofShapes;
        if (longJobs < static_cast<std::size_t>(settings_.threads)) maker.leaveTrees();
        forEachOn(settings_.threads, jobs.size(), [&](std::size_t i) { jobs[i](); });
        // Large trees come now, where the meshes were that have been copied.
        if (spent_ != nullptr)
            for (MeshDesc& mesh : spent_->meshes) mesh = {};
        maker.finish(scene_.shapes_, scene_.geometries_);
        scene_.moves_ = scene_.moves_ || maker.moves();
        scene_.degenerateCount_ = maker.degenerateCount();
        if (spent_ == nullptr) return;
        std::vector<ObjectDesc>().swap(spent_->objects);
        std::vector<MeshDesc>().swap(spent_->meshes);
    }

    // Tells whether a map keeps all angles, to a millionth: turns, shifts, mirrors and one scale
    // do.
    static bool keepsAngles(const Transform& map) {
        const Vec3d x = map.column(0), y = map.column(1), z = map.column(2);
        const double most = dot(x, x) * 1e-6;
        return std::fabs(dot(x, y)) <= most && std::fabs(dot(y, z)) <= most &&
               std::fabs(dot(z, x)) <= most && std::fabs(dot(y, y) - dot(x, x)) <= most &&
               std::fabs(dot(z, z) - dot(x, x)) <= most;
    }

    // A normal map is carved into an object before it is placed.
    void keepUnevenPlaces() {
        if (!on_.textures) return;
        const auto isMapped = [&](Handle h) {
            return h != kNone && desc_.materials[static_cast<std::size_t>(h)].normalMap != kNone;
        };
        if (std::none_of(desc_.materials.begin(), desc_.materials.end(),
                         [](const MaterialDesc& m) { return m.normalMap != kNone; }))
            return;
        for (std::size_t i = 0; i < objectCount_; ++i) {
            const ObjectDesc& object = desc_.objects[i];
            if (std::none_of(object.materials.begin(), object.materials.end(), isMapped)) continue;
            const MovingTransform place =
                placedKeys(object.worldFromObject, scene_.frame_, on_.motionBlur);
            const auto keys = place.keys();
            if (std::all_of(keys.begin(), keys.end(), keepsAngles)) continue;
            scene_.unevenPlaces_.resize(objectCount_);
            scene_.unevenPlaces_[i] = std::make_unique<const MovingTransform>(place);
        }
    }

    // Pictures that nothing uses are not read.
    void addPictures(std::vector<std::function<void()>>& jobs) {
        scene_.textures_.resize(desc_.textures.size());
        missing_.resize(desc_.textures.size());
        if (!on_.textures) return;
        for (const std::size_t i : usedTextures(desc_, false))
            jobs.emplace_back([this, i] { scene_.textures_[i] = makeTexture(desc_.textures[i]); });
        if (desc_.world.environment != kNone && !settings_.background)
            jobs.emplace_back([this] { buildEnvironment(); });
    }

    // SceneMaterial::seeThrough() before there are pictures; the default material is the last.
    std::vector<std::uint8_t> seeThroughMaterials() const {
        std::vector<std::uint8_t> out(desc_.materials.size() + 1);
        forSomeMaterials([&](std::size_t first, std::size_t last) {
            for (std::size_t i = first; i < last; ++i) {
                const MaterialDesc& m = desc_.materials[i];
                out[i] = toFloat(m.opacity) < 1 || (on_.textures && m.opacityTexture != kNone);
            }
        });
        return out;
    }

    // Null when its picture misses and may.
    std::unique_ptr<const Texture> makeTexture(const TextureDesc& desc) {
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
        auto picture = pictureOf(desc);
        if (!picture) return nullptr;
        return std::make_unique<const Texture>(std::move(*picture), params);
    }

    std::optional<StoredImage> pictureOf(const TextureDesc& desc) {
        if (pictures_ != nullptr)
            if (auto image = pictures_->take(desc)) return image;
        if (!settings_.picturesMayMiss) return loadPicture(desc, source_, settings_.textureFolder);
        std::string fault;
        auto image = findAndRead(desc, source_.name, settings_.textureFolder, fault);
        if (!image)
            missing_[static_cast<std::size_t>(&desc - desc_.textures.data())] =
                located(source_, desc.fileLoc.offset, cat(fault, "; it is left out"), "warning");
        return image;
    }
    void warnOfMissing() {
        for (std::string& warning : missing_)
            if (!warning.empty()) scene_.warnings_.push_back(std::move(warning));
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
        RawVector<SceneMaterial>& materials = scene_.materials_;
        materials.resize(desc_.materials.size() + 1);
        materials.back() = makeMaterial(MaterialDesc{});
        scene_.any_ |= materials.back();
        std::mutex mutex; // of any_
        forSomeMaterials([&](std::size_t first, std::size_t last) {
            AnyMaterial any;
            for (std::size_t i = first; i < last; ++i)
                any |= materials[i] = makeMaterial(desc_.materials[i]);
            const std::lock_guard lock(mutex);
            scene_.any_ |= any;
        });
        for (std::size_t i = 0; i < (desc_.textures.empty() ? 0 : desc_.materials.size()); ++i) {
            materials[i].pictures = picturesOf(desc_.materials[i]);
            scene_.any_ |= materials[i];
        }
        if (isShaded()) buildLobes();
        if (spent_ != nullptr) std::vector<MaterialDesc>().swap(spent_->materials);
    }

    void buildLobes() {
        LobedMaterials& lobed = scene_.lobedMaterials_;
        const TextureOf pictures = [this](Handle handle) { return textureOf(handle); };
        const MaterialDesc standard;
        for (std::size_t i = 0; i <= desc_.materials.size(); ++i) {
            const MaterialDesc& desc = i < desc_.materials.size() ? desc_.materials[i] : standard;
            const LobeList list = lobesOf(desc, pictures, on_);
            scene_.materials_[i].isPainted = !list.factors.empty();
            scene_.any_ |= scene_.materials_[i];
            const auto warn = [&](std::string_view what) {
                scene_.warnings_.push_back(located(
                    source_, desc.loc.offset, cat("material '", desc.name, "'", what), "warning"));
            };
            const bool isSound =
                lobed.add(list.lobes, list.factors, traitsOf(scene_.materials_[i]));
            // Whitted pictures may have it by short keywords: they follow rays so deep only.
            if (!isSound && (!desc.lobes.empty() || isPath())) {
                lobed.scaleDown();
                if (!isTold(desc))
                    warn(" reflects more than arrives, and is scaled to what does; weights whose "
                         "sum "
                         "is at most 1 would be right");
            }
            if (list.variesBoundaries())
                warn(" has a picture on the ior of a lobe that transmits, which is left out; a "
                     "number alone would be right");
        }
    }
    // Whether validate() has warned of its lobes already.
    static bool isTold(const MaterialDesc& desc) {
        return !desc.lobes.empty() && sumOfWeights(desc) > kMostOfWeights;
    }
    static std::uint32_t traitsOf(const SceneMaterial& of) {
        return (isBlack(of.emission) ? 0 : LobedMaterial::kEmits) |
               (of.seeThrough() ? LobedMaterial::kSeeThrough : 0) |
               (of.litOutside ? LobedMaterial::kLitOutside : 0);
    }

    // By several threads: call(first, last).
    template <class Call> void forSomeMaterials(const Call& call) const {
        constexpr std::size_t kTogether = 1 << 12;
        forEachPart(settings_.threads, desc_.materials.size(), kTogether, call);
    }

    const MaterialPictures* picturesOf(const MaterialDesc& desc) {
        const MaterialPictures of{
            .diffuse = textureOf(desc.diffuseTexture),
            .emission = textureOf(desc.emissionTexture),
            .opacity = textureOf(desc.opacityTexture),
            .normalMap = textureOf(desc.normalMap),
            .bumpMap = textureOf(desc.bumpMap),
            .normalStrength = toFloat(desc.normalStrength),
            .bumpHeight = toFloat(desc.bumpStrength * desc.bumpDistance * scene_.frame_.scale)};
        if (!of.diffuse && !of.emission && !of.opacity && !of.normalMap && !of.bumpMap)
            return &kNoPictures;
        scene_.pictures_.push_back(std::make_unique<const MaterialPictures>(of));
        return scene_.pictures_.back().get();
    }

    SceneMaterial makeMaterial(const MaterialDesc& desc) {
        SceneMaterial m;
        m.diffuse = toRgb(desc.diffuse);
        m.litOutside = desc.litSide == MaterialDesc::LitSide::Outside;
        m.transmits = on_.refraction && !isBlack(toRgb(desc.transmission));
        m.ior = toFloat(desc.ior);
        for (const LobeDesc& lobe : desc.lobes) {
            if ((lobeTypes()[lobe.kind].flags & kHasSides) == 0) continue;
            m.transmits = true, m.ior = toFloat(lobe.numbers[0]);
        }
        m.emission = toRgb(desc.emission);
        m.lightsOthers = desc.emissionLights;
        m.emitsFront = desc.emissionSides == MaterialDesc::Sides::Front;
        m.opacity = toFloat(desc.opacity);
        m.filter = toRgb(desc.filter);
        return m;
    }

    // ---- camera and world

    void chooseCamera() {
        const auto wanted =
            std::find_if(desc_.cameras.begin(), desc_.cameras.end(), [&](const CameraDesc& camera) {
                return settings_.camera.empty() || camera.name == settings_.camera;
            });
        if (wanted == desc_.cameras.end()) {
            std::vector<std::string> known;
            for (const CameraDesc& camera : desc_.cameras) known.push_back(shown(camera.name));
            fail(ErrorKind::Input,
                 cat(source_.name, ": error: no camera ", unknownName(settings_.camera, known)));
        }
        cameraDesc_ = &*wanted;
    }

    void buildCamera() {
        const CameraDesc& desc = *cameraDesc_;
        const double scale = scene_.frame_.scale;
        CameraParams& params = cameraParams_;
        params.kind = desc.kind == CameraDesc::Kind::Orthographic ? CameraParams::Kind::Orthographic
                                                                  : CameraParams::Kind::Perspective;
        params.worldFromCamera = placedKeys(desc.worldFromCamera, scene_.frame_, on_.motionBlur);
        scene_.moves_ = !params.worldFromCamera.isStatic();
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

    // A camera on a surface, and one whose pixels are finer than floats.
    void lookAround() {
        if (const double depth = clearDepth(scene_.shapes_, *scene_.camera_);
            depth > cameraParams_.clipStart) {
            cameraParams_.clipStart = depth;
            scene_.camera_ = std::make_unique<const Camera>(cameraParams_);
        }
        scene_.spacing_ = spacingInPixels(scene_.shapes_, *scene_.camera_, cameraParams_.width,
                                          cameraParams_.height);
        if (scene_.spacing_ > kCoarseSpacing)
            scene_.warnings_.push_back(
                cat(source_.name, ": warning: numbers in the middle of the picture are ",
                    significant(*scene_.spacing_),
                    " of a pixel apart, which shows in edges; a camera that is nearer to it and a "
                    "shorter lens, or leaving out what is near the camera, would be right"));
    }
    static constexpr double kCoarseSpacing = 1e-3;

    void buildWorld() {
        scene_.background_ = toRgb(settings_.background.value_or(desc_.world.background));
        scene_.ambient_ = toRgb(desc_.world.ambient);
        scene_.ambientReach_ = toFloat(desc_.world.ambientOcclusion * scene_.frame_.scale);
        if (isPath() && !isBlack(scene_.ambient_))
            scene_.warnings_.push_back(
                located(source_, desc_.world.loc.offset,
                        "paths have no ambient light, and it is left out; a background, which they "
                        "find, would be right",
                        "warning"));
    }

    void buildEnvironment() {
        const TextureDesc& picture =
            desc_.textures[static_cast<std::size_t>(desc_.world.environment)];
        auto image = pictureOf(picture);
        if (!image) return;
        if (sceneLights_->skyLights())
            if (const auto why = whyNoLight(*image))
                fail(ErrorKind::Input,
                     located(source_, picture.fileLoc.offset, cat(picture.file, ": ", *why)));
        scene_.environment_ = std::make_unique<const Environment>(
            std::move(*image), spaceOf(picture), interpolationOf(picture),
            desc_.world.environmentUp == WorldDesc::Up::Z ? Environment::Up::Z : Environment::Up::Y,
            radians(desc_.world.rotationDeg));
    }

    // ---- lights

    void buildLights() {
        hasLampBody_.assign(desc_.lights.size(), false);
        for (std::size_t i = 0; i < desc_.lights.size(); ++i) {
            const LightDesc& light = desc_.lights[i];
            using enum LightDesc::Kind;
            const bool hasBody =
                light.kind == Rectangle || light.kind == Disk || light.kind == Sphere;
            if (light.visible && hasBody && !hasNoArea(light))
                addLampBody(light, static_cast<std::uint32_t>(objectCount_ + i));
        }
        if (!isShaded()) return;
        for (std::string& warning : sceneLights_->addTo(
                 scene_.pathLights_,
                 {scene_.shapes_, scene_.materials_, scene_.environment_.get(), scene_.background_,
                  hasLampBody_, static_cast<std::uint32_t>(objectCount_)},
                 source_))
            scene_.warnings_.push_back(std::move(warning));
    }

    // In path tracing a lamp that can be seen hides what is behind it from all rays, since light is
    // found by shadow rays and by lobes, weighted against each other (tests/truth: round_lamps).
    // Elsewhere it casts no shadows, and a flat one is seen from its front alone.
    void addLampBody(const LightDesc& light, std::uint32_t id) {
        const auto material = static_cast<std::uint32_t>(scene_.materials_.size());
        auto body = makeLampBody(light, scene_.frame_, material, id, isPath());
        if (!body) return;
        SceneMaterial glow;
        glow.diffuse = {};
        glow.emission = toRgb(light.color);
        glow.isLamp = true;
        glow.emitsFront = isPath() && light.kind != LightDesc::Kind::Sphere;
        scene_.materials_.push_back(glow);
        scene_.any_ |= glow;
        hasLampBody_[id - objectCount_] = true;
        scene_.shapes_.add(std::move(body),
                           isPath() ? ShapeSet::Shadow::Opaque : ShapeSet::Shadow::None);
        if (isShaded()) scene_.lobedMaterials_.add({}, {}, LobedMaterial::kEmits);
    }

    Scene& scene_;
    const SceneDesc& desc_;
    SceneDesc* spent_;              // may be null
    std::vector<bool> hasLampBody_; // by light
    std::optional<SceneLights> sceneLights_;
    std::vector<std::string> missing_; // by texture: the warning, of a picture that misses
    const SourceFile& source_;
    const RenderSettings& settings_;
    PictureReader* pictures_; // may be null
    Switches on_;
    std::size_t objectCount_;
    CameraParams cameraParams_;
    const CameraDesc* cameraDesc_ = nullptr; // the one that is used
};

Scene::Scene(const SceneDesc& desc, const SourceFile& source, const RenderSettings& settings,
             PictureReader* pictures) {
    SceneBuilder(*this, desc, nullptr, source, settings, pictures).build();
}

Scene::Scene(SceneDesc&& desc, const SourceFile& source, const RenderSettings& settings,
             PictureReader* pictures) {
    SceneBuilder(*this, desc, &desc, source, settings, pictures).build();
}

void Scene::describe(Stats& stats) const {
    stats.accel = {};
    stats.accel.kind = accelKind_ == AccelKind::Bvh ? "bvh" : "none";
    stats.accel.primitives = shapes_.shapes.size();
    for (const SolidTree* tree : {&shapes_.solids(), &shapes_.placed().boxes()}) {
        if (tree->lines.empty()) continue;
        stats.accel.nodes += tree->nodes();
        stats.accel.leaves += tree->solids.size();
        stats.accel.sah += tree->sah;
        stats.accel.bytes += tree->bytes();
    }
    for (const auto& geometry : geometries_) {
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

std::uint64_t Scene::mipBytes() const {
    std::uint64_t sum = 0;
    for (const auto& texture : textures_)
        if (texture != nullptr) sum += texture->mips().bytes();
    return sum;
}

std::uint64_t Scene::unmadeMipBytes() const {
    std::uint64_t all = 0;
    for (const auto& texture : textures_)
        if (texture != nullptr) all += texture->mips().bytesOfAll(texture->grid());
    return all - mipBytes();
}
