// From the tree of geometries to the flat list of objects: transforms multiplied out, materials
// handed down, and a name for each that says where it came from ("stack/box/lid").
#pragma once

#include "read/json/geometry.h"

std::vector<ObjectDesc> flattenJson(const JsonGeometries& geometries, JsonProblems& problems);
