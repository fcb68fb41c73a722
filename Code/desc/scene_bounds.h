// Boxes in double around what a description says.
#pragma once

#include "base/bounds.h"
#include "desc/scene_desc.h"

// Around all bounded objects at all their keys, in the world; empty when there are none.
// Stops where it is as long as `enough` along an axis.
BoundsD boundsOf(const SceneDesc& desc, double enough = kInfinity);
// Around its points; empty when they are still to be read from a file.
BoundsD boundsOf(const MeshDesc& mesh);
