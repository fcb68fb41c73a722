// Scene: a SceneDesc made ready to be traced, immutable. Everything is placed in double, moved by
// the centre of the scene and scaled by a power of two (SceneFrame), and only then becomes float: a
// scene far from the origin or of any size renders alike, whatever is far from it (promise P3).
#pragma once

#include "base/motion.h"
#include "base/raw_vector.h"
#include "base/source.h"
#include "camera/camera.h"
#include "desc/scene_desc.h"
#include "light/light.h"
#include "material/material.h"
#include "render/features.h"
#include "render/frame.h"
#include "render/path/lobed_materials.h"
#include "render/path/path_lights.h"
#include "render/seen_lamps.h"
#include "render/settings.h"
#include "render/shape_set.h"
#include "render/stats.h"
#include "shape/mesh.h"
#include "texture/environment.h"
#include "texture/texture.h"

#include <memory>
#include <span>
#include <vector>

class PictureReader;

// Pictures that change a material's numbers from place to place, or bend normals.
struct MaterialPictures {
    const Texture* diffuse = nullptr;
    const Texture* specular = nullptr;
    const Texture* emission = nullptr;
    const Texture* opacity = nullptr;
    const Texture* normalMap = nullptr;
    const Texture* bumpMap = nullptr;
    float normalStrength = 1;
    float bumpHeight = 0; // strength times distance, in normalised units
};
inline constexpr MaterialPictures kNoPictures;

// A material of the scene, in as few lines of the cache as there may be thousands of them.
struct alignas(64) SceneMaterial {
    Material base;
    bool litOutside = false;   // answers lamps outside of it, whichever side is seen
    bool lightsOthers = false; // Whitted pictures: its emission does
    bool emitsFront = false;   // its emission leaves to the outside only
    bool isLamp = false;       // the visible body of an area light; flat ones have no back
    const MaterialPictures* pictures = &kNoPictures;
    // Pictures that change its numbers.
    bool isTextured() const {
        return pictures->diffuse || pictures->specular || pictures->emission || pictures->opacity;
    }
    bool seeThrough() const { return base.opacity < 1 || pictures->opacity != nullptr; }
    bool bendsNormals() const {
        return pictures->normalMap != nullptr || pictures->bumpMap != nullptr;
    }
};
static_assert(sizeof(SceneMaterial) == 128);

// What any of some materials has; each is looked at once, as there may be more than a cache holds.
struct AnyMaterial {
    bool isLamp = false;
    bool bounces = false;    // mirrors or transmits
    bool transmits = false;  // refracts
    bool isRough = false;    // in what it mirrors and transmits
    bool branches = false;   // gives more than one ray
    bool pictures = false;   // asks for texture coordinates
    bool seeThrough = false; // lets light straight through

    AnyMaterial& operator|=(const SceneMaterial& m);
    AnyMaterial& operator|=(const AnyMaterial& other);
};

class Scene {
public:
    // Fails with the place in `source` when a texture can't be read, unless the settings say that
    // it may miss. `pictures`: some that are read already.
    Scene(const SceneDesc& desc, const SourceFile& source, const RenderSettings& settings,
          PictureReader* pictures = nullptr);
    // Lets go of what the description has of objects and meshes as soon as shapes are made of it:
    // with millions, both and the trees are not in memory at once.
    Scene(SceneDesc&& desc, const SourceFile& source, const RenderSettings& settings,
          PictureReader* pictures = nullptr);
    Scene(const Scene&) = delete;
    Scene& operator=(const Scene&) = delete;

    const SceneFrame& frame() const { return frame_; }
    const Camera& camera() const { return *camera_; }
    const ShapeSet& shapes() const { return shapes_; }
    std::span<const SceneMaterial> materials() const { return materials_; }
    const std::vector<std::unique_ptr<const Light>>& lights() const { return lights_; }
    const SeenLamps& seenLamps() const { return seenLamps_; }
    // Whether it is shaded by lobes: paths are, and what other forms of shading can't do.
    bool isLobed() const { return isLobed_; }
    const LobedMaterials& lobedMaterials() const { return lobedMaterials_; }
    const PathLights& pathLights() const { return pathLights_; }
    Rgb ambient() const { return ambient_; }
    // How far surfaces hide ambient light from each other; 0: they don't.
    float ambientReach() const { return ambientReach_; }
    // Radiance where a ray meets no surface.
    Rgb background(Vec3 dir) const {
        return environment_ ? background(environment_->radiance(dir)) : background_;
    }
    // Where the picture around the scene is so bright.
    Rgb background(Rgb inPicture) const { return background_ * inPicture; }
    const Environment* environment() const { return environment_.get(); } // null: none
    // Returns where an object stands that has a normal map and is stretched unevenly; null for
    // others.
    const MovingTransform* unevenPlace(std::uint32_t object) const {
        return object < unevenPlaces_.size() ? unevenPlaces_[object].get() : nullptr;
    }
    bool moves() const { return moves_; }
    bool hasSeeThrough() const { return any_.seeThrough; }
    const AnyMaterial& anyMaterial() const { return any_; }
    const Features& features() const { return features_; }
    // Complete lines, of the pictures that miss.
    std::span<const std::string> warnings() const { return warnings_; }
    // See spacingInPixels().
    std::optional<double> spacing() const { return spacing_; }
    // Fills in what the scene knows: accelerator, features, degenerate primitives.
    void describe(Stats& stats) const;

private:
    friend class SceneBuilder;
    SceneFrame frame_;
    std::unique_ptr<const Camera> camera_;
    std::vector<std::unique_ptr<const Texture>> textures_;
    std::vector<std::unique_ptr<const MaterialPictures>> pictures_; // of those that have some
    RawVector<SceneMaterial> materials_;
    std::vector<std::unique_ptr<const MeshGeometry>> geometries_;
    std::vector<std::unique_ptr<const MovingTransform>> unevenPlaces_; // empty without any
    ShapeSet shapes_;
    std::vector<std::unique_ptr<const Light>> lights_;
    SeenLamps seenLamps_; // of lights_
    bool isLobed_ = false;
    float ambientReach_ = 0;
    LobedMaterials lobedMaterials_;
    PathLights pathLights_;
    std::unique_ptr<const Environment> environment_;
    Rgb background_, ambient_;
    bool moves_ = false;
    AnyMaterial any_; // of the materials
    Features features_;
    AccelKind accelKind_ = AccelKind::Bvh;
    std::uint64_t degenerateCount_ = 0;
    std::vector<std::string> warnings_;
    std::optional<double> spacing_;
};
