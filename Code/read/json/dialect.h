// The dialects of the course's scenes, told apart by the keys that they use, as the rules in which
// they differ. Nobody else asks which dialect it is.
#pragma once

#include "base/vec.h"
#include "read/json/json.h"

struct JsonRules {
    Vec3d attenuation;        // of a light that gives none
    bool directionalHasPower; // or its power is 1, whatever the file says
    bool refReplaces;         // the transform of a node with 'ref' replaces, or multiplies
    bool meshMovesFirst;      // a mesh is (v + position) * scale, or T * R * S
    bool allArePlaced;        // boxes and planes have position, rotation and scale like all others
    int width, height;        // of a picture without 'resolution'
};

JsonRules jsonRulesOf(const JsonValue& scene);
