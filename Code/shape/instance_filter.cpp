#include "shape/instance_filter.h"

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
// is at Y at most a side of the triangle before or behind the hit: that much room have the boxes
// around it, before the start of the ray and behind what is wanted.

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

// Into the scene and back is not quite where it started from, less so the flatter the instance is:
// the most that a point of the box moves along axis i.
double wayOff(const Rows& back, const Rows& forth, std::size_t i, Vec3d movedCentre, Vec3d half) {
    double off = std::fabs(movedCentre[i]);
    for (std::size_t j = 0; j < 3; ++j) {
        const double entry = back[4 * i] * forth[j] + back[4 * i + 1] * forth[4 + j] +
                             back[4 * i + 2] * forth[8 + j];
        off += std::fabs(entry - (i == j ? 1 : 0)) * half[j];
    }
    return off;
}

Vec3d linear(const Rows& m, Vec3d v) {
    return {m[0] * v.x + m[1] * v.y + m[2] * v.z, m[4] * v.x + m[5] * v.y + m[6] * v.z,
            m[8] * v.x + m[9] * v.y + m[10] * v.z};
}

} // namespace

TreeRay::TreeRay(const MeshGeometry& mesh, const RaySetup& setup, float lateralError,
                 double depthPerT, double depthPerSide)
    : longestSide_(mesh.longestSide.data()), setup_(setup), lateralError_(lateralError),
      depthPerSide_(static_cast<float>(min(depthPerSide, 0x1p100))), depthPerT_(depthPerT) {
    acrossX_[setup.kx] = acrossY_[setup.ky] = 1;
    acrossX_[setup.k] = -setup.Sx * setup.sign;
    acrossY_[setup.k] = -setup.Sy * setup.sign;
    originX_ = static_cast<float>(-dot(toDouble(acrossX_), toDouble(setup.org)));
    originY_ = static_cast<float>(-dot(toDouble(acrossY_), toDouble(setup.org)));
}

InstanceFilter::InstanceFilter(const MeshGeometry& mesh, const Transform& sceneFromObject,
                               Vec3d farthest)
    : mesh_(&mesh) {
    if (sceneFromObject.isSingular()) {
        own_ = kInfinity;
        return;
    }
    const Transform objectFromScene = sceneFromObject.inverse();
    const Rows& forth = sceneFromObject.rows();
    const Rows& back = objectFromScene.rows();
    const Rows& tree = mesh.treeFromObject.rows();
    const double scale = tree[0]; // along all axes
    const BoundsD& box = mesh.exactBox;
    const Vec3d centre = box.centre(), half = box.hi - centre;
    const Vec3d movedCentre = objectFromScene.point(sceneFromObject.point(centre)) - centre;
    Vec3d largest, terms; // what a coordinate of the scene is made of may be larger than itself
    for (std::size_t i = 0; i < 3; ++i) largest[i] = std::fabs(centre[i]) + half[i];
    double error = 0;
    for (std::size_t i = 0; i < 3; ++i) {
        terms[i] =
            sumOfSizes(forth, i, largest) + std::fabs(forth[4 * i + 3]) + std::fabs(farthest[i]);
        const Vec3d row{forth[4 * i], forth[4 * i + 1], forth[4 * i + 2]};
        longer_ = max(kDepthSlack * length(row), longer_);
    }
    for (std::size_t i = 0; i < 3; ++i) {
        const double noise = kDoubleError * (sumOfSizes(back, i, terms) +
                                             std::fabs(back[4 * i + 3]) + 2 * largest[i]);
        error = max(scale * (wayOff(back, forth, i, movedCentre, half) + noise), error);
        stretch_ = max(kDepthSlack * scale * sumOfSizes(back, i, {1, 1, 1}), stretch_);
        for (std::size_t j = 4 * i; j < 4 * i + 4; ++j) treeFromScene_[j] = scale * back[j];
        treeFromScene_[4 * i + 3] += tree[4 * i + 3];
    }
    own_ = static_cast<double>(mesh.extent) + 0x1p24 * error;
}

InstanceFilter InstanceFilter::moved(Vec3d offset) const {
    InstanceFilter out = *this;
    const Vec3d inTree = linear(treeFromScene_, offset);
    for (std::size_t i = 0; i < 3; ++i) out.treeFromScene_[4 * i + 3] -= inTree[i];
    return out;
}

std::optional<TreeRay> InstanceFilter::treeRay(const Ray& ray, float sceneExtent) const {
    const Rows& m = treeFromScene_;
    const Vec3d dir = linear(m, toDouble(ray.dir));
    const Vec3d org = linear(m, toDouble(ray.org)) + Vec3d{m[3], m[7], m[11]};
    const Ray inTree{toFloat(org), toFloat(dir)};
    const auto extent = static_cast<float>(
        own_ + stretch_ * static_cast<double>(max(sceneExtent, maxAbs(ray.org))));
    // Pads that are larger than the tree let everything pass anyway.
    if (!isTraceable(inTree) || !(extent < 0x1p18f)) return {};
    const RaySetup setup(inTree.org, inTree.dir, extent);
    const double depthPerT = kDepthSlack * static_cast<double>(setup.dz);
    return TreeRay(*mesh_, setup, max(extent, maxAbs(inTree.org)) * 0x1p-18f, depthPerT,
                   depthPerT * longer_ / static_cast<double>(maxAbs(ray.dir)));
}
