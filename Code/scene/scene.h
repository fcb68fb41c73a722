// Scene: a SceneDesc made ready to be traced, immutable. Everything is placed in double, moved by
// the centre of the scene and scaled by a power of two (SceneFrame), and only then becomes float: a
// scene far from the origin or of any size renders alike, whatever is far from it (promise P3).
#pragma once

#include "base/motion.h"
#include "base/raw_vector.h"
#include "base/source.h"
#include "camera/camera.h"
#include "desc/scene_desc.h"
#include "scene/features.h"
#include "scene/frame.h"
#include "scene/lobed_materials.h"
#include "scene/path_lights.h"
#include "scene/scene_material.h"
#include "scene/settings.h"
#include "scene/shape_set.h"
#include "scene/stats.h"
#include "shape/mesh.h"
#include "texture/environment.h"
#include "texture/texture.h"

#include <memory>
#include <span>
#include <vector>

class PictureReader;

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
    // Returns the memory of the mip levels that have been made so far.
    std::uint64_t mipBytes() const;
    std::uint64_t unmadeMipBytes() const; // of those that there could be

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
