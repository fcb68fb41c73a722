// All shapes of a scene from its objects: which meshes are merged and which are instances, and the
// preparing of both, on several threads and beside other work.
#pragma once

#include "base/motion.h"
#include "base/one_or_more.h"
#include "desc/scene_desc.h"
#include "scene/frame.h"
#include "scene/merge.h"
#include "scene/settings.h"
#include "scene/shape_set.h"

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <vector>

// normalisedFromObject while the shutter is open; without motion blur as it is at half time.
MovingTransform placedKeys(const Keys& keys, const SceneFrame& frame, bool motionBlur);

class ShapeMaker {
public:
    // `seeThrough`: by material, the default one last. What is handed in must outlive it.
    ShapeMaker(const SceneDesc& desc, const RenderSettings& settings, const SceneFrame& frame,
               const std::vector<std::uint8_t>& seeThrough);

    // What one thread each can do, all at the same time: merging, the trees of small meshes, and
    // the shapes that are no meshes, which become the first ones of the set.
    std::vector<std::function<void()>> jobs(ShapeSet& shapes);
    // How many of them build trees. Before they are done: where that leaves threads over, small
    // trees are built like large ones.
    std::size_t trees() const;
    void leaveTrees() { largestInJob_ = 0; }
    // When those are done: large trees, by all threads one after the other, and the other shapes.
    void finish(ShapeSet& shapes, std::vector<std::unique_ptr<const MeshGeometry>>& geometries);

    bool moves() const { return moves_; } // does anything?
    std::uint64_t degenerateCount() const;

private:
    // An object that shows a mesh.
    struct Placed {
        std::uint32_t object = 0;
        std::vector<std::uint32_t> materials; // by slot of the mesh
        bool isCopied = false;                // into one of the merged meshes
        std::uint64_t degenerateCount = 0;    // of its copy
    };
    // A mesh for instances.
    struct Shared {
        std::size_t mesh = 0;
        std::unique_ptr<MeshGeometry> geometry;
        std::uint64_t degenerateCount = 0;
    };
    // Meshes that stand still become one, with one tree over all triangles; see-through ones apart,
    // as their shadows have to look at every hit, and those apart of which not all sides are seen.
    struct Merged {
        ObjectDesc::Sides sides = ObjectDesc::Sides::Both;
        bool isSolid = true;
        std::vector<std::size_t> members; // of placed_
        MergedMesh mesh;
        std::unique_ptr<MeshGeometry> geometry;
    };

    OneOrMore<std::uint32_t> materialIds(const ObjectDesc& object) const;
    std::vector<std::uint32_t> materialsBySlot(const ObjectDesc& object) const;
    ShapeSet::Shadow shadowOf(std::span<const std::uint32_t> materials) const;
    std::vector<bool> meshesToCopy() const;
    MovingTransform placeOf(std::uint32_t object) const;
    bool isNear(std::uint32_t number) const;
    const MeshDesc& meshOf(const Placed& placed) const;
    void merge(Merged& merged);
    void share(Shared& shared);
    bool isBuiltInJob(const MeshGeometry& geometry) const {
        return geometry.triangles.size() <= largestInJob_;
    }
    void finishTree(MeshGeometry& geometry, int threads) const;
    void makeSimple(ShapeSet& shapes, std::size_t first, std::size_t last);
    void addInstances(ShapeSet& shapes);

    const SceneDesc& desc_;
    const RenderSettings& settings_;
    const SceneFrame& frame_;
    const std::vector<std::uint8_t>& seeThrough_;
    // Triangles of a tree that is built by the thread of its mesh.
    std::size_t largestInJob_ = std::size_t{1} << 16;
    bool moves_ = false;
    std::vector<std::uint32_t> simple_; // objects that are no meshes
    std::vector<Placed> placed_;        // the others, in the same order
    std::vector<Shared> shared_;        // in the order of their first use
    std::vector<std::size_t> sharedOf_; // by mesh: its number in shared_
    std::vector<Merged> merged_;
};
