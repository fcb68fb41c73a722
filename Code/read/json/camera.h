// The camera of a JSON scene, as CameraDesc.
#pragma once

#include "desc/scene_desc.h"
#include "read/json/problems.h"

class JsonValue;

CameraDesc readJsonCamera(const JsonValue& value, JsonProblems& problems);
