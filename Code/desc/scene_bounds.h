// Boxes in double around what a description says.
#pragma once

#include "base/bounds.h"
#include "desc/scene_desc.h"

// Around all bounded objects at all their keys, in the world; empty when there are none.
BoundsD boundsOf(const SceneDesc& desc, int threads = 1);
// The same, but only until they are as long as `enough` along an axis.
BoundsD boundsUpTo(const SceneDesc& desc, double enough, int threads = 1);
// Around its points; empty when they are still to be read from a file.
BoundsD boundsOf(const MeshDesc& mesh, int threads = 1);

// What of a scene is near an eye, for coordinates that are fine where the eye sees details.
struct NearBounds {
    BoundsD near, all;  // around the objects that are not far, and around all
    double nearest = 0; // the distance of the nearest object
};
// `farTimes`: an object is far when it is more than so many times as distant as the nearest one.
// An object around the eye counts as 1/64 of its size away: what it is made of may be that near.
// No distance counts as less than `least`.
NearBounds boundsNear(const SceneDesc& desc, Vec3d eye, double farTimes, double least,
                      int threads = 1);
