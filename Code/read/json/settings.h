// Picture, sampling, surroundings, camera and lights of a JSON scene: resolution, AA, ambient,
// settings, world, camera, lights.
#pragma once

#include "desc/scene_desc.h"
#include "read/json/json.h"
#include "read/json/fields.h"
#include "read/json/names.h"

#include <vector>

void readJsonSettings(JsonFields& scene, const JsonRules& rules, SettingsDesc& settings);
void readJsonWorld(JsonFields& scene, const JsonNames& textures, WorldDesc& world);
CameraDesc readJsonCamera(const JsonValue& value, JsonProblems& problems);
void readJsonLights(JsonFields& scene, const JsonRules& rules, std::vector<LightDesc>& lights);
