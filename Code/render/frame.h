// SceneFrame: where the normalised space of a scene (or of a mesh) lies.
#pragma once

#include "base/transform.h"
#include "desc/scene_desc.h"

// normalised = (world - centre) * scale; scale is a power of two.
struct SceneFrame {
    Vec3d centre;
    double scale = 1;
    Vec3d point(Vec3d world) const { return (world - centre) * scale; }
    Vec3d worldPoint(Vec3d normalised) const { return normalised * (1 / scale) + centre; }
    // normalisedFromObject for a worldFromObject.
    Transform placed(const Rows& worldFromObject) const;
};

// Centre and size of all bounded objects; of lights and cameras when there are none. The largest
// side of the box comes to lie in [1,2).
SceneFrame frameOf(const SceneDesc& desc, int threads = 1);
SceneFrame frameOf(const MeshDesc& mesh);
