// T4: two halves of a ball that share the points of their border, as objects of their own, do not
// let rays from inside out between them.
#include "base/text.h"
#include "verify/groups.h"
#include "verify/placed_solid.h"

#include <algorithm>
#include <utility>

namespace battery {

namespace {

using meshes::Random;

constexpr double kBatchesOfCracks = 60; // at effort 1, each a ball in a place of its own
constexpr int kRaysAtCracks = 4096;     // of a batch

// The upper half of a uv sphere; the mirrored one is below, with its faces to the outside as well.
// Both have the same points at z = 0.
MeshDesc half(int segments, int rings, bool below) {
    MeshDesc mesh = meshes::uvSphere(segments, 2 * rings);
    mesh.normals.clear(), mesh.uvs.clear();
    mesh.normalTriangles.clear(), mesh.uvTriangles.clear();
    const auto firstOfBorder = static_cast<std::uint32_t>(2 + (rings - 1) * segments);
    const std::uint32_t endOfBorder = firstOfBorder + static_cast<std::uint32_t>(segments);
    std::erase_if(mesh.triangles, [&](const MeshDesc::Corners& c) {
        // The other tip is point 1.
        return std::any_of(c.begin(), c.end(),
                           [&](std::uint32_t i) { return i == 1 || i >= endOfBorder; });
    });
    mesh.points.resize(endOfBorder);
    mesh.points[1] = mesh.points[firstOfBorder]; // unused, and must not stretch the box
    for (int s = 0; s < segments; ++s) {
        const double phi = kTwoPi * s / segments;
        mesh.points[firstOfBorder + static_cast<std::uint32_t>(s)] = {exact::cos(phi),
                                                                      exact::sin(phi), 0};
    }
    if (!below) return mesh;
    for (Vec3d& p : mesh.points) p.z = -p.z;
    for (MeshDesc::Corners& c : mesh.triangles) std::swap(c[1], c[2]);
    return mesh;
}

enum class Form { Separate, Merged, Instances };

// A ball of two halves in the normalised space of their scene.
struct Ball {
    std::string name;
    Transform sceneFromBall;
    int segments;
    std::vector<meshes::Ready> parts;
    std::unique_ptr<MeshGeometry> merged;
    ShapeSet set;
};

Ball ball(Random& random, Form form, bool otherRings) {
    Ball out;
    out.segments = random.chance(0.5) ? 64 : 7 + static_cast<int>(random.below(100));
    const int rings = 3 + static_cast<int>(random.below(30));
    const int ringsBelow = otherRings ? 2 + static_cast<int>(random.below(30)) : rings;
    const MeshDesc above = half(out.segments, rings, false);
    const MeshDesc below = half(out.segments, ringsBelow, true);
    const Vec3d offset = random.chance(0.5) ? Vec3d{} : Vec3d{148376, 1234, -223423};
    const Transform map = Transform::translate(offset) * random.affine(2, 1);
    SceneFrame frame = meshes::frameFor(meshes::uvSphere(64, 32), map);
    frame.centre += random.inBox(0.2); // not the middle of the ball
    out.sceneFromBall = frame.placed(map.rows());
    out.name = cat(out.segments, " segments, ", rings, " and ", ringsBelow, " rings",
                   offset == Vec3d{} ? "" : ", far");
    if (form == Form::Merged) {
        MergedMesh merged;
        merged.add(above, frame.placed(map.rows()), {7}, 5);
        merged.add(below, frame.placed(map.rows()), {7}, 6);
        out.merged = std::make_unique<MeshGeometry>(std::move(merged.geometry));
        out.merged->finish(true);
        out.set.add(std::make_unique<Mesh>(*out.merged, merged.materials, merged.parts),
                    ShapeSet::Shadow::Opaque);
    } else {
        const Transform mirrored = map * Transform::scale({1, 1, -1});
        if (form == Form::Separate) {
            out.parts.push_back(meshes::baked(above, map, frame));
            out.parts.push_back(meshes::baked(below, map, frame));
        } else if (otherRings) {
            out.parts.push_back(meshes::instance(above, map, frame));
            out.parts.push_back(meshes::instance(below, map, frame));
        } else { // the same mesh twice
            out.parts.push_back(meshes::instance(above, map, frame));
            out.parts.push_back(meshes::instance(above, mirrored, frame));
        }
        for (meshes::Ready& part : out.parts)
            out.set.add(std::move(part.shape), ShapeSet::Shadow::Opaque);
    }
    out.set.finish(true);
    return out;
}

// Rays from inside to the border: at its points, along its edges, and a few floats beside.
Tally atBorder(const Effort& effort, std::uint64_t seed, Form form, bool otherRings) {
    return inBatches(effort, seed, kBatchesOfCracks, [&](Random& random, Tally& tally) {
        const Ball at = ball(random, form, otherRings);
        const auto borderPoint = [&](std::size_t s) {
            const double phi = kTwoPi * static_cast<double>(s) / at.segments;
            return Vec3d{exact::cos(phi), exact::sin(phi), 0};
        };
        for (int i = 0; i < kRaysAtCracks; ++i) {
            const std::size_t s = random.below(static_cast<std::size_t>(at.segments));
            const double along = random.chance(0.3) ? 0 : random.unit();
            const Vec3d to = lerp(borderPoint(s), borderPoint(s + 1), along);
            const Vec3d from =
                random.chance(0.3) ? to * (1 - random.logUniform(1e-3, 1)) : random.inBox(0.3);
            Ray ray;
            ray.org = toFloat(at.sceneFromBall.point(from));
            Vec3 target = toFloat(at.sceneFromBall.point(to));
            for (std::size_t k = 0; k < 3; ++k)
                target[k] = meshes::stepped(target[k], static_cast<int>(random.below(7)) - 3);
            ray.dir = target - ray.org;
            if (random.chance(0.5)) ray.dir = normalize(ray.dir);
            ++tally.cases;
            if (!at.set.closest(ray).isHit() || !at.set.occluded(ray))
                tally.fail([&] { return cat(at.name, ", ", shown(ray)); });
        }
    });
}

template <std::uint64_t Seed, Form form, bool otherRings> Tally crack(const Effort& effort) {
    return atBorder(effort, Seed, form, otherRings);
}

constexpr Row kCracksRows[] = {
    {"T4a", "rays at the border of two halves of a ball, two objects", "", 0, true,
     crack<41, Form::Separate, false>},
    {"T4b", "the same, merged", "", 0, true, crack<42, Form::Merged, false>},
    {"T4c", "the same, two instances of one half", "", 0, true, crack<43, Form::Instances, false>},
    {"T4d", "halves of other tessellation that share the border", "", 0, true,
     crack<44, Form::Separate, true>},
    {"T4e", "the same as instances", "", 0, true, crack<45, Form::Instances, true>},
};

} // namespace

std::span<const Row> crackRows() { return kCracksRows; }

} // namespace battery
