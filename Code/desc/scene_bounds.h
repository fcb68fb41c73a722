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
