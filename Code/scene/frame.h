// SceneFrame: where the normalised space of a scene (or of a mesh) lies.
#pragma once

#include "base/bounds.h"
#include "base/transform.h"
#include "base/vec.h"
#include "desc/scene_desc.h"

// normalised = (world - centre) * scale; scale is a power of two.
struct SceneFrame {
    Vec3d centre;
    double scale = 1;
    // Objects all of whose coordinates are larger are distant, see isDistant(); infinite: there are
    // none.
    float distantFrom = kInfinityF;
    Vec3d point(Vec3d world) const { return (world - centre) * scale; }
    Vec3d worldPoint(Vec3d normalised) const { return normalised * (1 / scale) + centre; }
    // normalisedFromObject for a worldFromObject.
    Transform placed(const Rows& worldFromObject) const;
};

// The frame in which a camera sees the scene. Floats are coarse in proportion to their size, so
// what the camera may see from nearby has to have small coordinates, and what is far may have large
// ones: a far object changes nothing that is near (tests/render/test_far_objects.cpp).
// - Objects are far when they are 8 times as distant as the nearest one.
// - The origin is the centre of the box of those that are near, and its largest side comes to lie
// in
//   [1,2), if that side is at most 16 times the distance of the nearest object. A rounding is then
//   below a thousandth of a pixel where a picture has 2,000 in a row.
// - Else the origin is the camera, and 16 times that distance lies in [1,2).
// Without objects lights and cameras take their place.
SceneFrame frameOf(const SceneDesc& desc, const CameraDesc& camera, int threads = 1);
// The centre of the box is the origin; its largest side comes to lie in [1,2).
SceneFrame frameAround(const BoundsD& box);
SceneFrame frameOf(const MeshDesc& mesh);

// Shapes so far from the origin have a tree of their own: the pads of boxes grow with coordinates,
// and stay small for all others.
inline bool isDistant(const Bounds& box, float distantFrom) {
    return max(max(max(box.lo.x, -box.hi.x), max(box.lo.y, -box.hi.y)), max(box.lo.z, -box.hi.z)) >
           distantFrom;
}

// The step from the double precision of a SceneDesc to the floats of a Scene.

constexpr float toFloat(double x) { return static_cast<float>(x); }
constexpr Rgb toRgb(Rgbd c) { return {toFloat(c.r), toFloat(c.g), toFloat(c.b)}; }
