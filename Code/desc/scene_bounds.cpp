#include "desc/validate.h"

#include "base/transform.h"
#include "base/for_each.h"

#include <optional>
#include <vector>

namespace {

// Of the meshes that somebody asks for.
class MeshBoxes {
public:
    MeshBoxes(const SceneDesc& desc, int threads)
        : desc_(desc), threads_(threads), boxes_(desc.meshes.size()) {}
    const BoundsD& operator[](Handle mesh) {
        const auto i = static_cast<std::size_t>(mesh);
        if (!boxes_[i]) boxes_[i] = boundsOf(desc_.meshes[i], threads_);
        return *boxes_[i];
    }
    // All of them; then several threads may ask. A single mesh is for all threads.
    void prepare() {
        const int perMesh = boxes_.size() == 1 ? threads_ : 1;
        forEachOn(threads_, boxes_.size(),
                  [&](std::size_t i) { boxes_[i] = boundsOf(desc_.meshes[i], perMesh); });
    }

private:
    const SceneDesc& desc_;
    int threads_;
    std::vector<std::optional<BoundsD>> boxes_;
};

BoundsD objectBox(const ObjectDesc& object, MeshBoxes& meshBoxes) {
    const double r = object.radius;
    switch (object.kind) {
    case ObjectDesc::Kind::Sphere: return {{-r, -r, -r}, {r, r, r}};
    case ObjectDesc::Kind::Cube: return {{-1, -1, -1}, {1, 1, 1}};
    case ObjectDesc::Kind::Disk: return {{-r, -r, 0}, {r, r, 0}};
    case ObjectDesc::Kind::Cylinder: return {{-r, -r, -1}, {r, r, 1}};
    case ObjectDesc::Kind::Cone: {
        const double wide = max(r, object.topRadius);
        return {{-wide, -wide, -1}, {wide, wide, 1}};
    }
    case ObjectDesc::Kind::Plane: {
        BoundsD box;
        for (const Vec3d corner : *object.corners) box.extend(corner);
        return box;
    }
    case ObjectDesc::Kind::Mesh: return meshBoxes[object.mesh];
    case ObjectDesc::Kind::InfinitePlane: break;
    }
    return {};
}

void extendBy(BoundsD& box, const ObjectDesc& object, MeshBoxes& meshBoxes) {
    const BoundsD local = objectBox(object, meshBoxes);
    if (local.isEmpty()) return;
    for (const Rows& key : object.worldFromObject) box.extend(boundsOf(key, local));
}

} // namespace

BoundsD boundsOf(const MeshDesc& mesh, int threads) {
    constexpr std::size_t kTogether = 1 << 13;
    std::vector<BoundsD> parts((mesh.points.size() + kTogether - 1) / kTogether);
    forEachPart(threads, mesh.points.size(), kTogether, [&](std::size_t first, std::size_t last) {
        BoundsD part;
        for (std::size_t i = first; i < last; ++i) part.extend(mesh.points[i]);
        parts[first / kTogether] = part;
    });
    BoundsD box;
    for (const BoundsD& part : parts) box.extend(part);
    return box;
}

BoundsD boundsUpTo(const SceneDesc& desc, double enough, int threads) {
    MeshBoxes meshBoxes(desc, threads);
    BoundsD box;
    for (const ObjectDesc& object : desc.objects) {
        extendBy(box, object, meshBoxes);
        if (maxAbs(box.size()) >= enough) break;
    }
    return box;
}

// Gives take(part, box of an object) all objects; several threads have a part each at a time.
template <class Part, class Take>
static std::vector<Part> partsOf(const SceneDesc& desc, MeshBoxes& meshBoxes, int threads,
                                 const Take& take) {
    constexpr std::size_t kTogether = 1 << 12;
    const std::size_t count = desc.objects.size();
    std::vector<Part> parts((count + kTogether - 1) / kTogether);
    forEachPart(threads, count, kTogether, [&](std::size_t first, std::size_t last) {
        Part part; // far from those of other threads
        for (std::size_t i = first; i < last; ++i) {
            BoundsD box;
            extendBy(box, desc.objects[i], meshBoxes);
            if (!box.isEmpty()) take(part, box);
        }
        parts[first / kTogether] = part;
    });
    return parts;
}

static double distanceTo(const BoundsD& box, Vec3d p) {
    Vec3d beside;
    for (std::size_t axis = 0; axis < 3; ++axis)
        beside[axis] = max(0.0, max(box.lo[axis] - p[axis], p[axis] - box.hi[axis]));
    const double distance = length(beside);
    return distance > 0 ? distance : maxAbs(box.size()) / 64;
}

BoundsD boundsOf(const SceneDesc& desc, int threads) {
    MeshBoxes meshBoxes(desc, threads);
    meshBoxes.prepare();
    BoundsD box;
    for (const BoundsD& part : partsOf<BoundsD>(
             desc, meshBoxes, threads, [](BoundsD&all, const BoundsD&of) { all.extend(of); }))
        box.extend(part);
    return box;
}

NearBounds boundsNear(const SceneDesc& desc, Vec3d eye, double farTimes, double least,
                      int threads) {
    MeshBoxes meshBoxes(desc, threads);
    meshBoxes.prepare();
    struct Part {
        BoundsD box;
        double nearest = kInfinity, farthest = 0;
    };
    Part all;
    for (const Part& part : partsOf<Part>(desc, meshBoxes, threads, [&](Part&p, const BoundsD&of) {
             const double distance = max(distanceTo(of, eye), least);
             p.box.extend(of);
             p.nearest = min(distance, p.nearest), p.farthest = max(distance, p.farthest);
         })) {
        all.box.extend(part.box);
        all.nearest = min(part.nearest, all.nearest),
        all.farthest = max(part.farthest, all.farthest);
    }
    const double most = farTimes * all.nearest;
    if (!(all.farthest > most)) return {all.box, all.box, all.nearest};
    NearBounds out{{}, all.box, all.nearest};
    for (const BoundsD& part :
         partsOf<BoundsD>(desc, meshBoxes, threads, [&](BoundsD&some, const BoundsD&of) {
             if (distanceTo(of, eye) <= most) some.extend(of);
         }))
        out.near.extend(part);
    return out;
}
