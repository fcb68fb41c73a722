// A scene of the battery that has anything, in any company.
#pragma once

#include "verify/meshes.h"

namespace scenes {

// Of 32 x 24 pixels; valid. What can be said without a picture file: shapes of all kinds seen from
// some sides, that stand, walk, turn and grow; materials, lamps and cameras with any of their
// properties. Many are dark or hide behind each other: for questions that any picture answers.
SceneDesc anything(meshes::Random& random);
// So many stand beside one scene of each kind of scenes.h.
inline constexpr int kAnythings = 8;

} // namespace scenes
