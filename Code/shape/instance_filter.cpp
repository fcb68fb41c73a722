#include "shape/instance_filter.h"

#include "accel/triangle.h"

// What it rests on. Let u = 2^-24, S the largest coordinate of the scene and the ray's origin.
// An accepted triangle has a point Y that the ray passes by at most 12 uS beside (accel/triangle.h:
// the signs are those of corners which rounding moved laterally by that much). Corners in the scene
// are rounded by uS, so Y is within 13 uS of the image of a point P of the triangle in the tree,
// and the ray, taken there without error, within 13 uS * stretch of P. Rounding its origin and
// direction to float adds 3 u of its origin and of the tree's size, and the arithmetic in double
// what own_ says. RaySetup pads slabs by 64 u times the extent it is given, of which it uses 10
// itself: with the extent `size + own + stretch * S` the ray enters every box around P.
//
// The depth of a canonical hit is that of the triangle's plane where the ray is, at Y or beside it,
// and of a triangle seen edge-on it can be anywhere in the depths that the corners have. So the ray
// is at Y at most `reach` before or behind the hit, along its dominant axis: the ray in the tree
// starts that much earlier, and a depth cuts that much later.

namespace {

using Rows = Transform::Rows;

// Bound of the relative error of the few dozen operations in double from one space to the other.
constexpr double kDoubleError = 0x1p-48;
// Depths are compared with floats that are off by a few units.
constexpr double kDepthSlack = 1 + 1e-6;

double sumOfSizes(const Rows& m, std::size_t row, Vec3d at) {
    const std::size_t i = 4 * row;
    return std::fabs(m[i]) * at.x + std::fabs(m[i + 1]) * at.y + std::fabs(m[i + 2]) * at.z;
}

} // namespace

InstanceFilter::InstanceFilter(const MeshGeometry& geometry, const Transform& sceneFromObject) {
    const Transform objectFromScene = sceneFromObject.inverse();
    treeFromScene_ = geometry.treeFromObject * objectFromScene;
    if (sceneFromObject.isSingular() || treeFromScene_.isSingular()) {
        own_ = kInfinity;
        return;
    }
    const Rows& scene = sceneFromObject.rows();
    const Rows& toTree = treeFromScene_.rows();
    const Rows& fromScene = objectFromScene.rows();
    const Rows& ofTree = geometry.treeFromObject.rows();
    // Terms that make a coordinate of the scene, which may be larger than their sum.
    const BoundsD& box = geometry.exactBox;
    Vec3d largest, terms;
    for (std::size_t i = 0; i < 3; ++i)
        largest[i] = max(std::fabs(box.lo[i]), std::fabs(box.hi[i]));
    for (std::size_t i = 0; i < 3; ++i) {
        terms[i] = sumOfSizes(scene, i, largest) + std::fabs(scene[4 * i + 3]);
        const Vec3d row{scene[4 * i], scene[4 * i + 1], scene[4 * i + 2]};
        reach_[i] = kDepthSlack * length(row) * geometry.longestSide;
    }
    // There and back is not quite where it started from, less so the flatter the instance is.
    const Rows back =
        (treeFromScene_ * (sceneFromObject * geometry.treeFromObject.inverse())).rows();
    const double size = static_cast<double>(geometry.extent);
    double away = 0, noise = 0;
    for (std::size_t i = 0; i < 3; ++i) {
        double sum = std::fabs(back[4 * i + 3]);
        for (std::size_t j = 0; j < 3; ++j)
            sum += std::fabs(back[4 * i + j] - (i == j ? 1 : 0)) * size;
        away = max(sum, away);
        const double shift =
            std::fabs(ofTree[5 * i] * fromScene[4 * i + 3]) + std::fabs(ofTree[4 * i + 3]);
        noise = max(kDoubleError * (sumOfSizes(toTree, i, terms) + shift), noise);
        stretch_ = max(kDepthSlack * sumOfSizes(toTree, i, {1, 1, 1}), stretch_);
    }
    own_ = size + 0x1p24 * (away + noise);
}

std::optional<TreeRay> InstanceFilter::treeRay(const Ray& ray, const RaySetup& scene,
                                               float sceneExtent) const {
    const double early = reach_[scene.k] / static_cast<double>(scene.dz); // in t
    const RayD moved = treeFromScene_.ray(toDouble(ray));
    const Ray inTree{toFloat(moved.org - moved.dir * early), toFloat(moved.dir)};
    const auto extent = static_cast<float>(
        own_ + stretch_ * static_cast<double>(max(sceneExtent, maxAbs(ray.org))));
    // Pads that are larger than the tree let everything pass anyway.
    if (!isTraceable(inTree) || !(extent < 0x1p18f)) return {};
    const RaySetup setup(inTree.org, inTree.dir, extent);
    const double depthPerT = kDepthSlack * static_cast<double>(setup.dz);
    return TreeRay(setup, max(extent, maxAbs(inTree.org)) * 0x1p-18f,
                   depthPerT / static_cast<double>(scene.dz), 2 * early * depthPerT);
}

// Woop's test with edge functions that may be off: corners which are moved by up to `d` along each
// axis, at most m away from the ray, change them by 4 d m.
bool TreeRay::mayMeet(Vec3 v0, Vec3 v1, Vec3 v2) const {
    const ShearedTriangle s(setup_, v0, v1, v2);
    const float U = s.x[2] * s.y[1] - s.y[2] * s.x[1];
    const float V = s.x[0] * s.y[2] - s.y[0] * s.x[2];
    const float W = s.x[1] * s.y[0] - s.y[1] * s.x[0];
    float m = 0;
    for (int i = 0; i < 3; ++i) m = max(max(std::fabs(s.x[i]), std::fabs(s.y[i])), m);
    const float error = 5 * lateralError_ * m;
    return !(min(U, min(V, W)) < -error && max(U, max(V, W)) > error);
}
