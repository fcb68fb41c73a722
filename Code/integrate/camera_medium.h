// What transparent materials the camera stands in.
#pragma once

#include "scene/medium_tree.h"
#include "scene/scene.h"

// The materials around the eye, found by walking along the middle of the view: a surface that is
// left without having been entered has the eye inside, unless its object is entered later and never
// left: then it is inside out and the eye is outside of it. Empty for an orthographic camera, whose
// rays start in many places, and for scenes without transmission.
MediumTree::Inside mediumOfCamera(const Scene& scene, const RenderSettings& settings,
                                  MediumTree& media);
